#include "lmi/prove.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/number.h"
#include "lmi/block.h"

namespace gainsmith::lmi {

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
  Function(const AffineForm& form, const MonomialTable& monomials, double slack)
      : size_(form.shape.rows), slack_(slack) {
    for (const auto& [key, matrix] : form.terms) {
      Term term{numbers::Matrix(matrix), {}};
      term.matrix = (0.5 * (term.matrix + term.matrix.transpose())).eval();
      for (const Factor& factor : monomials[key.first])
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
                            const Eigen::LLT<numbers::Matrix>& scale) const {
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
  static numbers::Matrix scaled(const numbers::Matrix& matrix, const Eigen::LLT<numbers::Matrix>& scale) {
    const numbers::Matrix half = scale.matrixL().solve(matrix);
    return scale.matrixL().solve(half.transpose());
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

  int size_;
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

/// Pieces that are halved until each is proved or has a corner where the inequality fails.
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
      const double smallest = smallest_eigenvalue(values.back());
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
    const Eigen::LLT<numbers::Matrix> scale(mean / static_cast<double>(values.size()));
    if (scale.info() != Eigen::Success) return false;
    double least = 1;
    for (const numbers::Matrix& value : values)
      least = std::min(least, smallest_eigenvalue(Function::scaled(value, scale)));
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

/// The form with numbers for everything but the intervals; none when it is no sum of monomials.
std::optional<AffineForm> form_of(const expr::Program& difference, const numbers::Values& known,
                                  const Point& fixed, MonomialTable& monomials) {
  const Unknowns none{model::Instance{}};
  numbers::Values values = known;
  for (const auto& [name, value] : fixed.values) values.insert_or_assign(name, value);
  try {
    return evaluate_affine(difference, none, monomials, values);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

DomainProof prove_on_domain(const expr::Program& difference, const Domain& domain,
                            const numbers::Values& known, double slack) {
  using Status = DomainProof::Status;
  DomainProof proof;
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
    const auto form = form_of(difference, known, fixed, monomials);
    if (!form) return {Status::unknown, {}, {}};
    const Function function(*form, monomials, slack);
    Search search(function, whole);
    const auto left = search.run();
    for (const auto& [at, value] : search.violations) {
      Point point = fixed;
      for (std::size_t i = 0; i < axes.size(); ++i) point = extended(point, axes[i]->name, at[i]);
      proof.violations.push_back({value, std::move(point)});
    }
    if (!left || proof.status == Status::open) continue;
    proof.status = Status::open;
    proof.where = label_of(fixed, axes, *left);
  }
  if (!proof.violations.empty()) proof.status = Status::violated;
  return proof;
}

}  // namespace gainsmith::lmi
