#include "forall/between.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/number.h"
#include "numbers/dense.h"

namespace gainsmith::forall {

namespace {

constexpr std::size_t kMostPieces = 20000;
constexpr std::size_t kMostViolations = 16;

using Combined = std::vector<std::pair<double, Atom>>;

Combined second_derivative(const Atom& atom) {
  Combined second;
  for (const auto& [outer, first] : derivative(atom))
    for (const auto& [inner, term] : derivative(first)) second.emplace_back(outer * inner, term);
  return second;
}

/// A bound on |atom| on [low, high].
double size_on(const Atom& atom, double low, double high) {
  const Range envelope = range({atom.power, atom.rate, 0, false}, low, high);
  return std::max(std::abs(envelope.low), std::abs(envelope.high));
}

/// B(t) with its derivatives bounded.
class Function {
 public:
  Function(const Expansion& expansion, const MonomialTable& monomials, double slack)
      : slack_(slack) {
    for (const auto& [index, matrix] : expansion) {
      Term term{matrix, {}};
      size_ = static_cast<int>(matrix.rows());
      term.matrix = (0.5 * (term.matrix + term.matrix.transpose())).eval();
      for (const Factor& factor : monomials[index])
        term.factors.push_back({factor.variable, factor.atom, second_derivative(factor.atom)});
      terms_.push_back(std::move(term));
    }
  }

  numbers::Matrix at(const std::vector<double>& t) const {
    numbers::Matrix sum = slack_ * numbers::Matrix::Identity(size_, size_);
    for (const Term& term : terms_) {
      double value = 1;
      for (const auto& factor : term.factors) value *= evaluate(factor.atom, t[index(factor)]);
      sum += value * term.matrix;
    }
    return sum;
  }

  double slack() const { return slack_; }

  /// For each variable a bound on the second derivative over a piece, as a multiple of L L'.
  std::vector<double> bends(const std::vector<double>& low, const std::vector<double>& high,
                            const numbers::Cholesky& scale) const {
    std::vector<double> sums(low.size(), 0.0);
    for (const Term& term : terms_) {
      if (term.factors.empty()) continue;
      const double norm = scaled(term.matrix, scale).norm();
      for (const auto& bent : term.factors) {
        double size = norm;
        for (const auto& factor : term.factors)
          size *= &factor == &bent ? bend_of(factor, low[index(factor)], high[index(factor)])
                                   : size_on(factor.atom, low[index(factor)], high[index(factor)]);
        sums[index(bent)] += size;
      }
    }
    return sums;
  }

  /// L^-1 M L^-T.
  static numbers::Matrix scaled(const numbers::Matrix& matrix,
                                const numbers::Cholesky& scale) {
    const numbers::Matrix half = scale.lower_solve(matrix);
    return scale.lower_solve(half.transpose());
  }

 private:
  struct BentFactor {
    int variable = 0;
    Atom atom;
    Combined second;
  };
  struct Term {
    numbers::Matrix matrix;
    std::vector<BentFactor> factors;
  };

  static std::size_t index(const BentFactor& factor) {
    return static_cast<std::size_t>(factor.variable);
  }

  static double bend_of(const BentFactor& factor, double low, double high) {
    double sum = 0;
    for (const auto& [coefficient, atom] : factor.second)
      sum += std::abs(coefficient) * size_on(atom, low, high);
    return sum;
  }

  int size_ = 0;
  double slack_;
  std::vector<Term> terms_;
};

struct Piece {
  std::vector<double> low;
  std::vector<double> high;

  std::vector<double> corner(std::size_t which) const {
    std::vector<double> at = low;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (((which >> i) & 1U) != 0) at[i] = high[i];
    return at;
  }
  std::size_t corners() const { return std::size_t{1} << low.size(); }
};

/// Pieces that are halved until each is known to hold or has a corner where the inequality fails.
class Search {
 public:
  Search(const Function& function, Piece whole) : function_(function) {
    open_.push_back(std::move(whole));
  }

  /// The piece that was left undone, if any.
  std::optional<Piece> run() {
    for (std::size_t done = 0; !open_.empty(); ++done) {
      const Piece piece = open_.back();
      if (done == kMostPieces) return piece;
      open_.pop_back();
      if (!visit(piece)) return piece;
      if (violations.size() >= kMostViolations) return std::nullopt;
    }
    return std::nullopt;
  }

  std::vector<std::pair<std::vector<double>, double>> violations;

 private:
  /// False when the piece cannot be halved any more.
  bool visit(const Piece& piece) {
    std::vector<numbers::Matrix> values;
    for (std::size_t c = 0; c < piece.corners(); ++c) {
      values.push_back(function_.at(piece.corner(c)));
      const double smallest = numbers::smallest_eigenvalue(values.back());
      if (smallest > 0) continue;
      if (!std::isfinite(smallest)) return false;
      const auto at = piece.corner(c);
      const auto is_known = [&](const auto& known) { return known.first == at; };
      if (std::none_of(violations.begin(), violations.end(), is_known))
        violations.emplace_back(at, smallest - function_.slack());
      return true;
    }
    numbers::Matrix mean = values.front();
    for (std::size_t c = 1; c < values.size(); ++c) mean += values[c];
    const numbers::Cholesky scale(mean / static_cast<double>(values.size()));
    if (!scale) return false;
    double least = 1;
    for (const numbers::Matrix& value : values)
      least = std::min(least, numbers::smallest_eigenvalue(Function::scaled(value, scale)));
    std::vector<double> errors = function_.bends(piece.low, piece.high, scale);
    double error = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double width = piece.high[i] - piece.low[i];
      errors[i] *= width * width / 8;
      error += errors[i];
    }
    if (least > error) return true;
    const auto widest = std::max_element(errors.begin(), errors.end()) - errors.begin();
    return halve(piece, static_cast<std::size_t>(widest));
  }

  bool halve(const Piece& piece, std::size_t along) {
    const double middle = piece.low[along] + (piece.high[along] - piece.low[along]) / 2;
    if (!(piece.low[along] < middle && middle < piece.high[along])) return false;
    Piece left = piece;
    Piece right = piece;
    left.high[along] = right.low[along] = middle;
    open_.push_back(std::move(right));
    open_.push_back(std::move(left));
    return true;
  }

  const Function& function_;
  std::vector<Piece> open_;
};

std::string label_of(const Point& fixed, const std::vector<const Variable*>& axes,
                     const Piece& piece) {
  std::string label = fixed.label;
  for (std::size_t i = 0; i < axes.size(); ++i)
    label += (label.empty() ? "" : ", ") + axes[i]->name + " in [" + brief(piece.low[i]) + ", " +
             brief(piece.high[i]) + "]";
  return label;
}

}  // namespace

DomainBound bound_on_domain(const Expand& expand, const Domain& domain, double slack) {
  using Status = DomainBound::Status;
  DomainBound bound;
  const auto axes = intervals(domain);
  Domain symbolic;
  Piece whole;
  for (const Variable* axis : axes) {
    symbolic.push_back(*axis);
    whole.low.push_back(axis->low);
    whole.high.push_back(axis->high);
  }
  for (const Point& fixed : finite_points(domain)) {
    MonomialTable monomials(symbolic);
    const auto expansion = expand(fixed, monomials);
    if (!expansion) return {Status::unknown, {}, {}};
    const Function function(*expansion, monomials, slack);
    Search search(function, whole);
    const auto left = search.run();
    for (const auto& [at, value] : search.violations) {
      Point point = fixed;
      for (std::size_t i = 0; i < axes.size(); ++i) point = extended(point, axes[i]->name, at[i]);
      bound.violations.push_back({value, std::move(point)});
    }
    if (!left || bound.status == Status::open) continue;
    bound.status = Status::open;
    bound.where = label_of(fixed, axes, *left);
  }
  if (!bound.violations.empty()) bound.status = Status::violated;
  return bound;
}

}  // namespace gainsmith::forall
