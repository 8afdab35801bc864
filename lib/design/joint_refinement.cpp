#include "design/joint_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bind/instance.h"
#include "design/refinement_blocks.h"
#include "numbers/dense/dense.h"

namespace gainsmith::design {

namespace {

using numbers::Matrix;
using Vector = std::vector<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// NotSmooth when the figure is one of the gains or of the result, not of the unknowns.
void require_figure_of_unknowns(const model::Instance& own, const SearchRequest& request) {
  if (request.measure) throw NotSmooth{"the figure is of runs, which have no smooth form"};
  if (!request.minimize) return;
  std::set<std::string> known;
  for (const auto& [name, value] : own.values) known.insert(name);
  for (const auto& unknown : unknown_matrices(*own.design, model::polynomials(*own.design)))
    known.insert(unknown.name);
  for (const expr::Input& input : request.minimize->program.inputs)
    if (!known.contains(input.name))
      throw NotSmooth{"the figure is of " + input.name + ", which is no unknown"};
}

/// A lower triangular L with L L' = M, M (whose terms are of size 1) made positive definite.
Matrix factor(const Matrix& matrix) {
  // Eigenvalues below it are raised to it: a factor of a singular block has no derivative.
  constexpr double kFloor = 1e-8;
  const numbers::SymmetricEigen eigen(matrix);
  const Eigen::VectorXd lifted = eigen.values().cwiseMax(kFloor);
  return numbers::Cholesky(eigen.vectors() * lifted.asDiagonal() * eigen.vectors().transpose())
      .lower();
}

/// The smooth program. Unknowns and rows are scaled to their sizes at the start.
/// v = (s, x, L_1, L_2, ...): the scalars as fractions of their ranges, unknowns over their sizes
/// at the start, and the factors column by column. Residuals are the lower triangles of (B_k -
/// shift_k I)/scale_k - L_k L_k', block by block.
class SmoothDesign {
 public:
  SmoothDesign(const model::Instance& own, const SearchRequest& request, const model::Gains& gains)
      : design_(own.design), figure_(request.minimize), held_(own.overrides) {
    require_figure_of_unknowns(own, request);
    scalars_ = request.over;
    if (request.extreme) {
      extreme_ = static_cast<std::ptrdiff_t>(scalars_.size());
      direction_ = request.largest ? -1 : 1;
      scalars_.push_back(*request.extreme);
    }
    Vector start;
    const model::Instance instance = bind::evaluate(design_, gains.searched);
    for (const SearchedScalar& scalar : scalars_) {
      const auto value = instance.values.find(scalar.name);
      if (value == instance.values.end()) throw NotSmooth{"the gain bound is in no inequality"};
      start.push_back(scalar.axis.fraction(value->second(0, 0)));
    }
    const SmoothBlocks& blocks = at(start);
    if (extreme_ < 0 && blocks.cost.empty()) throw NotSmooth{"the margin is no smooth figure"};
    add_unknowns(packed(blocks, gains), start);
    add_factors(blocks);
  }

  model::Overrides scalars(const Vector& v) const {
    model::Overrides values = held_;
    for (std::size_t i = 0; i < scalars_.size(); ++i)
      values[scalars_[i].name] = scalars_[i].axis.at(v[i]);
    return values;
  }

  search::SmoothProgram smooth() {
    search::SmoothProgram program;
    program.start = start_;
    program.low = low_;
    program.high = high_;
    program.objective = [this](const Vector& v) { return objective(v); };
    program.gradient = [this](const Vector& v) { return gradient(v); };
    program.residuals = [this](const Vector& v) { return residuals(v); };
    program.jacobian = [this](const Vector& v) { return jacobian(v); };
    add_structure(program);
    return program;
  }

 private:
  /// One block: where its factor is in v, the first row of its residuals, its size.
  struct Factor {
    std::size_t variable = 0;
    std::size_t row = 0;
    int size = 0;
    double scale = 1;
  };

  /// The design at values of its scalars, with the request's own figure as its objective.
  model::Instance instance_at(const model::Overrides& values) const {
    model::Instance instance = bind::evaluate(design_, values);
    if (instance.design != design_) throw NotSmooth{"a dimension changes with the scalars"};
    if (!figure_) return instance;
    return with_design(std::move(instance),
                       [&](model::Design& design) { design.objective = figure_; });
  }

  /// The blocks at the scalars of v; the last few are kept.
  const SmoothBlocks& at(const Vector& v) {
    const Vector key(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(scalars_.size()));
    if (const auto found = cache_.find(key); found != cache_.end()) return found->second;
    // Values of the scalars with their blocks.
    constexpr std::size_t kKept = 32;
    if (cache_.size() > kKept) cache_.clear();
    SmoothBlocks blocks = smooth_blocks(instance_at(scalars(key)));
    if (!factors_.empty()) {
      bool same = blocks.list.size() == factors_.size();
      for (std::size_t k = 0; same && k < factors_.size(); ++k)
        same = blocks.list[k].size == factors_[k].size;
      if (!same) throw NotSmooth{"the inequalities change their number or sizes"};
    }
    return cache_.emplace(key, std::move(blocks)).first->second;
  }

  void add_variable(double start, double low, double high) {
    start_.push_back(start);
    low_.push_back(low);
    high_.push_back(high);
  }

  void add_unknowns(const Vector& x, const Vector& scalars) {
    for (const double fraction : scalars) add_variable(fraction, 0, 1);
    double size = 0;
    for (const double value : x) size = std::max(size, std::abs(value));
    constexpr double kSmallest = 1e-3;  // of the largest: the unit of an unknown that is 0
    for (const double value : x) {
      units_.push_back(std::max({std::abs(value), kSmallest * size, 1e-300}));
      add_variable(value / units_.back(), -kInfinity, kInfinity);
    }
  }

  /// Starts the L_k at the Cholesky factors of the shifted blocks, whose unit is the size of their
  /// terms.
  void add_factors(const SmoothBlocks& blocks) {
    const Vector x = unknowns(start_);
    for (std::size_t k = 0; k < blocks.list.size(); ++k) {
      const Matrix block = shifted(blocks, k, x);
      Factor entry{start_.size(), rows_, blocks.list[k].size, 1};
      entry.scale = size_of(blocks.list[k]);
      const Matrix lower = factor(block / entry.scale);
      for (int j = 0; j < entry.size; ++j) {
        for (int i = j; i < entry.size; ++i) {
          add_variable(lower(i, j), i == j ? 0.0 : -kInfinity, kInfinity);
          ++rows_;
        }
      }
      factors_.push_back(entry);
    }
    if (extreme_ < 0) figure_scale_ = std::max(std::abs(value(blocks, x)), 1e-300);
  }

  /// The largest element of the terms that add up to a block. The sum may be rounding alone: at an
  /// optimum blocks are singular, those of size 1 vanish.
  double size_of(const lmi::Block& block) const {
    double size = 0;
    for (const auto& [i, matrix] : block.terms) {
      const double unit = i == 0 ? 1 : units_[static_cast<std::size_t>(i) - 1];
      size = std::max(size, unit * Matrix(matrix).cwiseAbs().maxCoeff());
    }
    return std::max(size, 1e-300);
  }

  Vector unknowns(const Vector& v) const {
    Vector x(units_.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = v[scalars_.size() + i] * units_[i];
    return x;
  }

  /// B_k(x) - shift_k I.
  static Matrix shifted(const SmoothBlocks& blocks, std::size_t k, const Vector& x) {
    Matrix block = blocks.list[k].value(x);
    block.diagonal().array() -= blocks.shifts[k];
    return block;
  }

  static double value(const SmoothBlocks& blocks, const Vector& x) {
    double sum = blocks.constant;
    for (std::size_t i = 0; i < x.size(); ++i) sum += blocks.cost[i] * x[i];
    return sum;
  }

  double objective(const Vector& v) {
    if (extreme_ >= 0) return direction_ * v[static_cast<std::size_t>(extreme_)];
    return value(at(v), unknowns(v)) / figure_scale_;
  }

  /// v with scalar j a step further and back, within [0, 1], and the distance of the two.
  std::pair<std::pair<Vector, Vector>, double> steps(const Vector& v, std::size_t j) const {
    // Of the range of a scalar.
    constexpr double kStep = 1e-5;
    Vector forward = v;
    Vector backward = v;
    forward[j] = std::min(1.0, v[j] + kStep);
    backward[j] = std::max(0.0, v[j] - kStep);
    return {{forward, backward}, forward[j] - backward[j]};
  }

  /// Exact in the unknowns, by central differences in the scalars, 0 in the factors.
  Vector gradient(const Vector& v) {
    Vector result(v.size(), 0.0);
    if (extreme_ >= 0) {
      result[static_cast<std::size_t>(extreme_)] = direction_;
      return result;
    }
    const SmoothBlocks& blocks = at(v);
    for (std::size_t i = 0; i < units_.size(); ++i)
      result[scalars_.size() + i] = blocks.cost[i] * units_[i] / figure_scale_;
    for (std::size_t j = 0; j < scalars_.size(); ++j) {
      const auto [ends, distance] = steps(v, j);
      result[j] = (objective(ends.first) - objective(ends.second)) / distance;
    }
    return result;
  }

  /// L_k, n_k x n_k, from its elements in v.
  Matrix lower(const Vector& v, const Factor& entry) const {
    Matrix result = Matrix::Zero(entry.size, entry.size);
    std::size_t at = entry.variable;
    for (int j = 0; j < entry.size; ++j)
      for (int i = j; i < entry.size; ++i) result(i, j) = v[at++];
    return result;
  }

  /// The elements of the lower triangle, column by column.
  static void append(const Matrix& matrix, Vector& out) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      for (Eigen::Index i = j; i < matrix.rows(); ++i) out.push_back(matrix(i, j));
  }

  /// c(v), one element for each element of the lower triangles of all blocks.
  Vector residuals(const Vector& v) {
    const SmoothBlocks& blocks = at(v);
    const Vector x = unknowns(v);
    Vector result;
    for (std::size_t k = 0; k < factors_.size(); ++k) {
      const Matrix l = lower(v, factors_[k]);
      append(shifted(blocks, k, x) / factors_[k].scale - l * l.transpose(), result);
    }
    return result;
  }

  /// Calls visit(row, variable) for each element of the Jacobian that may be nonzero, in the order
  /// of jacobian(): for each block the scalars, then all unknowns, then the factor.
  template <class Visit>
  void for_each_element(Visit visit) const {
    for (const Factor& entry : factors_) {
      const std::size_t rows = triangle(entry.size);
      for (std::size_t column = 0; column < scalars_.size() + units_.size(); ++column)
        for (std::size_t row = 0; row < rows; ++row) visit(entry.row + row, column);
      std::size_t row = entry.row;
      for (int j = 0; j < entry.size; ++j)
        for (int i = j; i < entry.size; ++i, ++row)
          for (int c = 0; c <= j; ++c) {
            visit(row, entry.variable + place(entry.size, i, c));
            if (i != j) visit(row, entry.variable + place(entry.size, j, c));
          }
    }
  }

  static std::size_t triangle(int n) {
    return static_cast<std::size_t>(n) * (static_cast<std::size_t>(n) + 1) / 2;
  }

  /// The number of element (i, j), i >= j, in a lower triangle column by column.
  static std::size_t place(int n, int i, int j) {
    const int before = j * n - j * (j - 1) / 2;
    return static_cast<std::size_t>(before) + static_cast<std::size_t>(i - j);
  }

  void add_structure(search::SmoothProgram& program) const {
    program.constraints = rows_;
    for_each_element([&](std::size_t row, std::size_t column) {
      program.rows.push_back(row);
      program.columns.push_back(column);
    });
  }

  /// The elements of dc/dv that may be nonzero, block by block, in the order of for_each_element().
  Vector jacobian(const Vector& v) {
    const Vector x = unknowns(v);
    std::vector<std::vector<Matrix>> slopes;  // by scalar, by block
    for (std::size_t j = 0; j < scalars_.size(); ++j) slopes.push_back(slope(v, x, j));
    const SmoothBlocks& blocks = at(v);
    Vector result;
    for (std::size_t k = 0; k < factors_.size(); ++k) {
      const Factor& entry = factors_[k];
      for (const auto& by_block : slopes) append(by_block[k] / entry.scale, result);
      std::vector<Matrix> coefficients(units_.size(), Matrix::Zero(entry.size, entry.size));
      for (const auto& [i, matrix] : blocks.list[k].terms)
        if (i > 0) coefficients[static_cast<std::size_t>(i) - 1] = Matrix(matrix);
      for (std::size_t i = 0; i < units_.size(); ++i)
        append(coefficients[i] * (units_[i] / entry.scale), result);
      append_factor(lower(v, entry), result);
    }
    return result;
  }

  /// d B_k / d s_j for every block.
  std::vector<Matrix> slope(const Vector& v, const Vector& x, std::size_t j) {
    const auto [ends, distance] = steps(v, j);
    std::vector<Matrix> forward;
    const SmoothBlocks& ahead = at(ends.first);
    for (std::size_t k = 0; k < factors_.size(); ++k) forward.push_back(shifted(ahead, k, x));
    const SmoothBlocks& behind = at(ends.second);
    for (std::size_t k = 0; k < factors_.size(); ++k)
      forward[k] = (forward[k] - shifted(behind, k, x)) / distance;
    return forward;
  }

  /// -d (L L')_ij / d L: (L L')_ij = sum_c L_ic L_jc.
  static void append_factor(const Matrix& l, Vector& out) {
    for (Eigen::Index j = 0; j < l.cols(); ++j)
      for (Eigen::Index i = j; i < l.rows(); ++i)
        for (Eigen::Index c = 0; c <= j; ++c) {
          out.push_back(i == j ? -2 * l(i, c) : -l(j, c));
          if (i != j) out.push_back(-l(i, c));
        }
  }

  model::DesignPtr design_;
  std::optional<model::Formula> figure_;  ///< in place of the objective
  model::Overrides held_;
  std::vector<SearchedScalar> scalars_;
  std::ptrdiff_t extreme_ = -1;  ///< which scalar is the figure; -1: none
  double direction_ = 1;
  double figure_scale_ = 1;
  Vector units_;  ///< of the unknowns
  std::vector<Factor> factors_;
  std::size_t rows_ = 0;
  Vector start_, low_, high_;
  std::map<Vector, SmoothBlocks> cache_;
};

}  // namespace

Proposal refine_jointly(const model::Instance& own, const SearchRequest& request,
                        const model::Gains& gains, const search::SmoothSolver& solver) {
  constexpr double kTolerance = 1e-9;
  constexpr int kIterations = 500;
  try {
    SmoothDesign program(own, request, gains);
    const search::SmoothSolution solution = solver(program.smooth(), kTolerance, kIterations);
    return {program.scalars(solution.v), solution.cause};
  } catch (const NotSmooth& none) {
    return {std::nullopt, none.cause};
  } catch (const InputError& error) {
    return {std::nullopt, error.message()};
  }
}

}  // namespace gainsmith::design
