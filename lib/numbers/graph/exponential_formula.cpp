#include "numbers/graph/exponential_formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/eigen_scalars.h"
#include "numbers/dense/dense.h"
#include "numbers/dense/spectrum.h"
#include "numbers/dense/wide_dense.h"
#include "numerics/balance.h"

namespace gainsmith::numbers {

using Eigen::Index;

namespace {

using Wide = MatrixOf<DoubleDouble>;

/// The largest A: n^3 products, beside which e^(A s) itself takes as long.
constexpr Index kLargest = 10;
/// Eigenvalues of A, |A| = 1, that are nearer count as equal: their mean is as good to the square
/// of it.
constexpr double kSameEigenvalue = 1e-9;
/// The largest element of |C_1| + |C_2| + ..., |A| = 1, where e^(A s) is the unit matrix at s = 0.
constexpr double kLargestSum = 1000;
/// The difference from e^(A s) where it is computed otherwise, relative to its largest element.
constexpr double kDifference = 1e-12;
/// Elements of C_i below it are 0.
constexpr double kNothing = 1e-24;

/// s^power e^(a s) times cos(b s) or sin(b s).
struct Mode {
  double a = 0, b = 0;
  int power = 0;
  bool is_sine = false;

  double at(double s) const {
    return std::pow(s, power) * std::exp(a * s) * (is_sine ? std::sin(b * s) : std::cos(b * s));
  }
};

/// The modes of eigenvalues in the order of real_eigenvalues, of pairs those with b >= 0: for an
/// eigenvalue of multiplicity k the powers s^0 to s^(k-1), for b > 0 with cosine and sine.
std::vector<Mode> modes_of(const Matrix& eigenvalues) {
  std::vector<std::vector<Index>> groups;
  for (Index k = 0; k < eigenvalues.rows(); ++k) {
    if (eigenvalues(k, 1) < 0) continue;
    const auto is_near = [&](const std::vector<Index>& group) {
      return (eigenvalues.row(k) - eigenvalues.row(group.front())).norm() <= kSameEigenvalue;
    };
    const auto found = std::find_if(groups.begin(), groups.end(), is_near);
    if (found == groups.end())
      groups.push_back({k});
    else
      found->push_back(k);
  }
  std::vector<Mode> modes;
  for (const std::vector<Index>& group : groups) {
    Mode mode;
    for (const Index k : group) {
      mode.a += eigenvalues(k, 0) / static_cast<double>(group.size());
      mode.b += eigenvalues(k, 1) / static_cast<double>(group.size());
    }
    for (; mode.power < static_cast<int>(group.size()); ++mode.power)
      for (const bool is_sine : {false, true}) {
        if (is_sine && mode.b == 0) continue;
        mode.is_sine = is_sine;
        modes.push_back(mode);
      }
  }
  return modes;
}

/// Its derivatives of the orders 0 .. n-1 at s = 0: k!/(k-m)! lambda^(k-m), the real part or the
/// imaginary one.
Wide derivatives(const Mode& mode, Index n) {
  Wide result = Wide::Zero(n, 1);
  DoubleDouble real(1), imaginary(0);
  for (Index k = mode.power; k < n; ++k) {
    DoubleDouble falling(1);
    for (int m = 0; m < mode.power; ++m)
      falling = falling * DoubleDouble(static_cast<double>(k - m));
    result(k, 0) = falling * (mode.is_sine ? imaginary : real);
    const DoubleDouble next = real * DoubleDouble(mode.a) - imaginary * DoubleDouble(mode.b);
    imaginary = real * DoubleDouble(mode.b) + imaginary * DoubleDouble(mode.a);
    real = next;
  }
  return result;
}

struct Formula {
  std::vector<Mode> modes;
  std::vector<Matrix> coefficients;
};

/// Of A, n x n, |A| near 1. With F_ki the k-th derivative of f_i at 0 the conditions are
///   sum_i F_ki C_i = A^k, k = 0 .. n-1:   C_i = sum_k (F^-1)_ik A^k,
/// by Cayley and Hamilton then for all k. F and the sums are in 31 digits. None where F is singular
/// or the C_i are large.
std::optional<Formula> formula_of(const Matrix& A) {
  const Index n = A.rows();
  Formula formula{modes_of(real_eigenvalues<double>(A)), {}};
  if (static_cast<Index>(formula.modes.size()) != n) return std::nullopt;
  Wide conditions(n, n);
  for (Index i = 0; i < n; ++i)
    conditions.col(i) = derivatives(formula.modes[static_cast<std::size_t>(i)], n);
  const WideInverse<DoubleDouble> inverse = wide_inverse<DoubleDouble>(conditions);
  if (!(inverse.condition > DoubleDouble(0))) return std::nullopt;
  formula.coefficients.assign(static_cast<std::size_t>(n), Matrix::Zero(n, n));
  std::vector<Wide> sums(static_cast<std::size_t>(n), Wide::Zero(n, n));
  const Wide wide = A.cast<DoubleDouble>();
  Wide power = Wide::Identity(n, n);
  for (Index k = 0; k < n; ++k) {
    for (Index i = 0; i < n; ++i) sums[static_cast<std::size_t>(i)] += inverse.matrix(i, k) * power;
    power = times<DoubleDouble>(power, wide);
  }
  Matrix size = Matrix::Zero(n, n);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    formula.coefficients[i] = sums[i].unaryExpr([](const DoubleDouble& x) {
      const auto value = static_cast<double>(x);
      return std::abs(value) > kNothing ? value : 0.0;
    });
    size += formula.coefficients[i].cwiseAbs();
  }
  if (!(size.maxCoeff() <= kLargestSum)) return std::nullopt;
  return formula;
}

/// Whether the formula agrees with the exponential of A s at four times s.
bool is_right(const Formula& formula, const Matrix& A) {
  constexpr std::array<double, 4> kPoints = {-1, 0.125, 1, 8};
  return std::all_of(kPoints.begin(), kPoints.end(), [&](double s) {
    Matrix sum = Matrix::Zero(A.rows(), A.cols());
    for (std::size_t i = 0; i < formula.modes.size(); ++i)
      sum += formula.modes[i].at(s) * formula.coefficients[i];
    const Matrix truth = exponential(A * s);
    return (sum - truth).cwiseAbs().maxCoeff() <= kDifference * truth.cwiseAbs().maxCoeff();
  });
}

/// Nodes of the modes in the units of s: `rate` times what they are of |A| = 1.
class ModeNodes {
 public:
  ModeNodes(int s, double rate, ScalarGraph& graph) : s_(s), rate_(rate), graph_(graph) {}

  int operator()(const Mode& mode) {
    int node = graph_.apply(ScalarOp::exp, scaled(mode.a));
    if (mode.b != 0)
      node = graph_.multiply(
          node, graph_.apply(mode.is_sine ? ScalarOp::sin : ScalarOp::cos, scaled(mode.b)));
    for (int m = 0; m < mode.power; ++m) node = graph_.multiply(node, scaled(1));
    return node;
  }

 private:
  int scaled(double factor) { return graph_.multiply(graph_.constant(factor * rate_), s_); }

  int s_;
  double rate_;
  ScalarGraph& graph_;
};

/// A node as a constant times a node that is neither negated nor a multiple; of constants the node
/// 1.
std::pair<double, int> as_product(int number, ScalarGraph& graph) {
  double factor = 1;
  while (true) {
    const ScalarGraph::Node node = graph.nodes()[static_cast<std::size_t>(number)];
    if (node.op == ScalarOp::constant) return {factor * graph.value(number), graph.constant(1)};
    const bool is_left = node.op == ScalarOp::multiply && graph.is_constant(node.a);
    const bool is_right = node.op == ScalarOp::multiply && graph.is_constant(node.b);
    if (node.op == ScalarOp::negate) {
      factor = -factor;
      number = node.a;
    } else if (is_left || is_right) {
      factor *= graph.value(is_left ? node.a : node.b);
      number = is_left ? node.b : node.a;
    } else {
      return {factor, number};
    }
  }
}

}  // namespace

std::optional<Multiple> as_multiple(const std::vector<int>& nodes, int rows, ScalarGraph& graph) {
  Multiple result{Matrix(rows, rows), -1};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto [factor, number] = as_product(nodes[k], graph);
    result.factor(static_cast<Index>(k)) = factor;
    if (factor == 0) continue;
    if (result.number >= 0 && result.number != number) return std::nullopt;
    result.number = number;
  }
  if (result.number < 0) result.number = graph.constant(1);
  return result;
}

/// A = rate D U D^-1 with |U| near 1, D balanced units and rate a power of two, both exact: the
/// formula of U in rate s, with D C_i D^-1 for its C_i.
std::optional<std::vector<int>> exponential_nodes(const Multiple& argument, ScalarGraph& graph) {
  const Matrix& A = argument.factor;
  const Index n = A.rows();
  if (n == 0 || n > kLargest || !A.allFinite()) return std::nullopt;
  std::vector<int> units = numerics::balance(A.cwiseAbs());
  const auto scale = [](double x, int exponent) { return std::ldexp(x, exponent); };
  Matrix unit = numerics::in_units(A, units, scale);
  const double norm = unit.cwiseAbs().colwise().sum().maxCoeff();
  const double rate = norm > 0 ? std::ldexp(1, std::ilogb(norm)) : 1;
  unit /= rate;
  std::optional<Formula> formula = formula_of(unit);
  if (!formula || !is_right(*formula, unit)) return std::nullopt;
  for (int& exponent : units) exponent = -exponent;
  for (Matrix& C : formula->coefficients) C = numerics::in_units(C, units, scale);
  ModeNodes node_of(argument.number, rate, graph);
  std::vector<int> result(static_cast<std::size_t>(n * n), graph.constant(0));
  for (std::size_t i = 0; i < formula->modes.size(); ++i) {
    const int mode = node_of(formula->modes[i]);
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] = graph.add(
          result[k],
          graph.multiply(graph.constant(formula->coefficients[i](static_cast<Index>(k))), mode));
  }
  return result;
}

}  // namespace gainsmith::numbers
