// Internal to forall: proof.h, instantiated by one source a scalar.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "base/number.h"
#include "expr/binding/derivative.h"
#include "forall/proof.h"
#include "forall/proof_branches.h"
#include "forall/proof_function.h"

namespace gainsmith::forall::proof {

/// Halves pieces until each holds; stops at the first point where the inequality fails.
template <class S>
class Search {
 public:
  Search(Function<S>& function, Branches<S>& branches, Piece whole, std::size_t budget)
      : function_(function), branches_(branches), whole_(whole), budget_(budget) {
    stack_.push_back(std::move(whole));
  }

  /// After a first open piece only so many more are examined, for a point that fails.
  static constexpr std::size_t kMoreAfterOpen = 200;

  void run() {
    while (!stack_.empty() && !failed) {
      const Piece piece = std::move(stack_.back());
      if (pieces == budget_) {
        if (!open) leave(piece, kTooMany);
        return;
      }
      stack_.pop_back();
      ++pieces;
      visit(piece);
    }
  }

  std::optional<std::pair<std::vector<double>, numbers::Vector>> failed;
  std::optional<Piece> open;
  std::string reason;
  double margin = 1;
  std::size_t pieces = 0;

 private:
  using Corner = typename Function<S>::Corner;

  /// Keeps the first piece that is left open, and why.
  void leave(const Piece& piece, std::string_view why) {
    if (open) return;
    open = piece;
    reason = why;
    budget_ = std::min(budget_, pieces + kMoreAfterOpen);
  }

  /// One piece: it fails at a corner, holds, or is cut in two. The tests are, in the order of their
  /// cost, the corners, the piece between them, and each branch by itself.
  void visit(const Piece& piece) {
    std::vector<const Corner*> corners;
    bool all_positive = true;
    for (std::size_t c = 0; c < piece.corners(); ++c) {
      const auto at = piece.corner(c);
      corners.push_back(&function_.corner(at, margin));
      if (!corners.back()->fault.empty()) return leave(piece, corners.back()->fault);
      if (function_.fails_at(*corners.back())) {
        failed = {at, corners.back()->direction};
        return;
      }
      all_positive = all_positive && corners.back()->sign == Sign::positive;
    }
    if (piece.low.empty()) {
      if (!all_positive) leave(piece, kNotDecided);
      return;
    }
    if (!all_positive) {
      // The corner stays in one of the halves.
      if (is_fine(piece)) return leave(piece, kNotDecided);
      return halve(piece, widest(piece), kNotDecided);
    }
    const auto spread = function_.over(piece);
    if (!spread.fault.empty()) return halve(piece, most_telling(piece), spread.fault);
    if (holds_between(corners, spread) || at_branches(piece)) return;
    const Matrix error = error_of(spread);
    if (piece.low.size() == 1 && error.allFinite()) return cut(piece, corners, spread, error);
    halve(piece, steepest(piece, spread, corners), kTooSteep);
  }

  /// E = sum_i errors_i, rounded upward.
  static Matrix error_of(const typename Function<S>::Spread& spread) {
    Matrix error = spread.errors.front();
    for (std::size_t i = 1; i < spread.errors.size(); ++i) error += spread.errors[i];
    return error * (1 + 0x1p-40);
  }

  /// With the sags d_i = w_i^2/8 B''_i: B(t) lies between the corners, less the sum of theta_i d_i
  /// with 0 <= theta_i <= 1. What a corner is nearly singular along then counts only by its own
  /// second derivative. Linear in theta, so theta_i = 0 and 1 are enough: 2^d - 1 tests a corner.
  bool above_sags(const std::vector<const Corner*>& corners,
                  const typename Function<S>::Spread& spread) const {
    if (spread.sags.size() != spread.errors.size()) return false;
    std::vector<Enclosed<S>> sags;
    for (const auto& sag : spread.sags)
      if (!sag.is_zero()) sags.push_back(numbers::converted<S>(sag));
    return std::all_of(corners.begin(), corners.end(), [&](const Corner* corner) {
      for (std::size_t chosen = 1; chosen < (std::size_t{1} << sags.size()); ++chosen) {
        Enclosed<S> B = corner->value;
        for (std::size_t i = 0; i < sags.size(); ++i)
          if (((chosen >> i) & 1U) != 0) B = numbers::difference(B, sags[i]);
        if (!holds(B, Matrix())) return false;
      }
      return true;
    });
  }

  /// B(c) + F > 0 for all |F| <= E at all corners.
  bool at_corners(const std::vector<const Corner*>& corners, const Matrix& error) const {
    return error.allFinite() && std::all_of(corners.begin(), corners.end(), [&](const Corner* c) {
             return holds(c->value, error);
           });
  }

  /// Whether B holds over the piece with each choice of its branches.
  bool at_branches(const Piece& piece) {
    const auto all = branches_.over(piece);
    return !all.empty() && std::ranges::all_of(all, [&](Function<S>* function) {
      std::vector<const Corner*> corners;
      double unused = 1;
      for (std::size_t c = 0; c < piece.corners(); ++c) {
        corners.push_back(&function->corner(piece.corner(c), unused));
        if (corners.back()->sign != Sign::positive) return false;
      }
      const auto spread = function->over(piece);
      return spread.fault.empty() && holds_between(corners, spread);
    });
  }

  /// Any of the three criteria of proof.h.
  bool holds_between(const std::vector<const Corner*>& corners,
                     const typename Function<S>::Spread& spread) const {
    return at_corners(corners, error_of(spread)) || above_sags(corners, spread) ||
           (spread.value.is_known() && holds(spread.value, Matrix()));
  }

  /// How often E is divided by four before B(c) + F > 0 at a corner c; with the sag, where it has
  /// one.
  int quarterings(const Corner& corner, const typename Function<S>::Spread& spread,
                  Matrix error) const {
    // A cut is no nearer to a corner than 2^-24 of the piece.
    constexpr int kMost = 24;
    const bool has_sag = !spread.sags.empty();
    Enclosed<double> sag = has_sag ? spread.sags.front() : Enclosed<double>{};
    const auto passes = [&] {
      return has_sag
                 ? holds(numbers::difference(corner.value, numbers::converted<S>(sag)), Matrix())
                 : holds(corner.value, error);
    };
    int count = 0;
    for (; count < kMost && !passes(); ++count) {
      error /= 4;
      sag.mid /= 4;
      sag.rad /= 4;
    }
    return count;
  }

  /// E falls at least to a quarter where a piece is halved. Where one corner alone is the obstacle
  /// the piece is cut so near to it that the part there passes: B grows from a corner where it is
  /// nearly singular, so the rest mostly passes at once or is cut much farther away. Where it is
  /// not, E is no matter of that corner: the rest is halved.
  void cut(const Piece& piece, const std::vector<const Corner*>& corners,
           const typename Function<S>::Spread& spread, const Matrix& error) {
    const int low = quarterings(*corners[0], spread, error);
    const int high = quarterings(*corners[1], spread, error);
    const int most = std::max(low, high);
    if (std::min(low, high) > 1 || most > 1 + piece.cut / 2) return halve(piece, 0, kTooSteep);
    const double part = std::ldexp(piece.high[0] - piece.low[0], -most);
    const bool at_low = low >= high;
    split(piece, 0, at_low ? piece.low[0] + part : piece.high[0] - part, kTooSteep,
          {at_low ? Piece::kWhole : most, at_low ? most : Piece::kWhole});
  }

  /// M + F > 0 for all M in the enclosure and |F| <= more; of >= without the rows that are exactly
  /// 0.
  template <class T>
  bool holds(const Enclosed<T>& value, const Matrix& more) const {
    if (function_.strict()) return numbers::is_positive_definite(value, more);
    Enclosed<T> B = value;
    Matrix error = more;
    drop_zero_rows(B, error);
    return numbers::is_positive_definite(B, error);
  }

  /// The variable whose error weighs most against the first corner, among those that can be halved.
  std::size_t steepest(const Piece& piece, const typename Function<S>::Spread& spread,
                       const std::vector<const Corner*>& corners) {
    std::size_t along = 0;
    double most = -1;
    const auto& B = corners.front()->value;
    numbers::Vector size(B.rows());
    for (Eigen::Index k = 0; k < B.rows(); ++k)
      size[k] = std::sqrt(std::abs(static_cast<double>(B.mid(k, k))));
    for (std::size_t i = 0; i < spread.errors.size(); ++i) {
      if (!(piece.low[i] < piece.high[i])) continue;
      double weight = 0;
      for (Eigen::Index k = 0; k < std::min(B.rows(), spread.errors[i].rows()); ++k)
        weight += (spread.errors[i].col(k).array() / (size.array() * size[k])).sum();
      if (!std::isfinite(weight)) return most_telling(piece);
      if (weight > most) {
        along = i;
        most = weight;
      }
    }
    return most < 0 ? widest(piece) : along;
  }

  /// Where nothing is known over the piece: the variable of which one value alone leaves least
  /// unknown, of equal ones the widest. At a kink, as that of |x|, halving it teaches nothing once
  /// the piece is thin there: then what is left is known by the other variables.
  std::size_t most_telling(const Piece& piece) {
    constexpr double kThin = 0x1p-10;  // of the widest
    const std::size_t most = widest(piece);
    if (piece.low.size() == 1) return most;
    const std::size_t telling = least_unknown(piece, most);
    return width(piece, telling) < kThin * width(piece, most) ? most : telling;
  }

  std::size_t least_unknown(const Piece& piece, std::size_t along) {
    const auto unknown = [&](std::size_t i) {
      Piece part = piece;
      part.low[i] = part.high[i] = piece.low[i] + (piece.high[i] - piece.low[i]) / 2;
      const auto spread = function_.over(part);
      if (!spread.fault.empty()) return Eigen::Index{std::numeric_limits<Eigen::Index>::max()};
      return spread.value.rad.size() - error_of(spread).array().isFinite().count();
    };
    Eigen::Index least = unknown(along);
    for (std::size_t i = 0; i < piece.low.size(); ++i) {
      if (!(piece.low[i] < piece.high[i])) continue;
      const Eigen::Index left = unknown(i);
      if (left >= least) continue;
      along = i;
      least = left;
    }
    return along;
  }

  /// Against the whole domain.
  std::size_t widest(const Piece& piece) const {
    std::size_t along = 0;
    for (std::size_t i = 1; i < piece.low.size(); ++i)
      if (width(piece, i) > width(piece, along)) along = i;
    return along;
  }

  double width(const Piece& piece, std::size_t i) const {
    const double whole = whole_.high[i] - whole_.low[i];
    return whole > 0 ? (piece.high[i] - piece.low[i]) / whole : 0;
  }

  bool is_fine(const Piece& piece) const { return width(piece, widest(piece)) < 0x1p-60; }

  void halve(const Piece& piece, std::size_t along, std::string_view why) {
    split(piece, along, piece.low[along] + (piece.high[along] - piece.low[along]) / 2, why);
  }

  /// Cuts a piece in two; left open where no double lies between its ends.
  void split(const Piece& piece, std::size_t along, double at, std::string_view why,
             std::pair<int, int> cuts = {Piece::kWhole, Piece::kWhole}) {
    if (!(piece.low[along] < at && at < piece.high[along])) return leave(piece, why);
    Piece left = piece;
    Piece right = piece;
    left.cut = cuts.first;
    right.cut = cuts.second;
    left.high[along] = right.low[along] = at;
    stack_.push_back(std::move(right));
    stack_.push_back(std::move(left));
  }

  static constexpr std::string_view
      kNotDecided = "the sign at a point is within its error bound",
      kTooSteep =
          "it moves too much between two points that are next to each other; a sign, where or "
          "floor may jump there",
      kTooMany = "more pieces than are examined";

  Function<S>& function_;
  Branches<S>& branches_;
  Piece whole_;
  std::size_t budget_;
  std::vector<Piece> stack_;
};

/// "k = 2, tau in [0.2, 0.25]".
inline std::string label_of(const Point& fixed, const std::vector<const Variable*>& axes,
                            const Piece& piece) {
  std::string label = fixed.label;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    label += (label.empty() ? "" : ", ") + axes[i]->name;
    label += piece.low[i] == piece.high[i]
                 ? " = " + brief(piece.low[i], 10)
                 : " in [" + brief(piece.low[i], 10) + ", " + brief(piece.high[i], 10) + "]";
  }
  return label;
}

/// One choice of the elements, with their enclosures and what else a program reads in `known`.
template <class S>
struct Choice {
  Point point;
  numbers::EnclosedValues<S> known;
};

/// Every combination of elements of sets and vertices of polytopes.
template <class S>
std::vector<Choice<S>> choices(const expr::Program& program, const Domain& domain,
                               const numbers::EnclosedValues<S>& known,
                               const EnclosedElements<S>& elements) {
  std::vector<Choice<S>> all(1);
  for (const expr::Input& input : program.inputs)
    if (const auto value = known.find(input.name); value != known.end())
      all.front().known.insert(*value);
  for (const Variable& variable : domain) {
    if (variable.is_interval()) continue;
    const auto stated = elements.find(variable.name);
    std::vector<Choice<S>> next;
    for (const Choice<S>& choice : all)
      for (std::size_t k = 0; k < variable.elements.size(); ++k) {
        Choice<S> chosen = choice;
        chosen.point =
            extended(choice.point, variable.name, variable.elements[k], variable.labels[k]);
        chosen.known.insert_or_assign(
            variable.name, stated != elements.end()
                               ? stated->second.at(k)
                               : numbers::exactly<S>(variable.elements[k].template cast<S>()));
        next.push_back(std::move(chosen));
      }
    all = std::move(next);
  }
  return all;
}

}  // namespace gainsmith::forall::proof

namespace gainsmith::forall {

template <class S>
DomainProof prove_on_domain(const expr::Program& difference, const Domain& domain,
                            const numbers::EnclosedValues<S>& known, bool strict,
                            const EnclosedElements<S>& elements, const ProofOptions& options) {
  using Status = DomainProof::Status;
  DomainProof result;
  const expr::Program program = expr::with_derivatives(difference);
  std::vector<const Variable*> axes;
  for (const Variable* axis : intervals(domain))
    if (program.uses(axis->name)) axes.push_back(axis);
  proof::Piece whole;
  for (const Variable* axis : axes) {
    // Intervals that the program does not read are left out: B is constant along them.
    whole.low.push_back(axis->low);
    whole.high.push_back(axis->high);
  }
  for (const auto& choice : proof::choices(program, domain, known, elements)) {
    proof::Function<S> function(program, choice.known, strict, axes);
    proof::Branches<S> branches(program, choice.known, strict, axes);
    proof::Search<S> search(function, branches, whole, options.most_pieces - result.pieces);
    search.run();
    result.pieces += search.pieces;
    result.margin = std::min(result.margin, search.margin);
    if (search.failed) {
      Point point = choice.point;
      auto found = search.failed->first.begin();
      for (const Variable* axis : intervals(domain))
        point = extended(point, axis->name, program.uses(axis->name) ? *found++ : axis->low);
      result.status = Status::fails;
      result.point = std::move(point);
      result.direction = search.failed->second;
      result.where.clear();
      result.reason.clear();
      return result;
    }
    if (!search.open || result.status == Status::open) continue;
    result.status = Status::open;
    result.where = proof::label_of(choice.point, axes, *search.open);
    result.reason = search.reason;
  }
  return result;
}

}  // namespace gainsmith::forall
