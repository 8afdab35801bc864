#include "numbers/types/jet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "expr/program/evaluate.h"
#include "numbers/types/ball_functions.h"
#include "numbers/types/enclosed_functions.h"
#include "numbers/types/enclosure.h"
#include "numbers/types/jet_rules.h"

namespace gainsmith::numbers {

Enclosed<double> Jet::derivative(int k) const {
  if (k <= order) return derivatives[static_cast<std::size_t>(k)];
  return exactly<double>(Matrix::Zero(value().rows(), value().cols()));
}

Jet constant_jet(const Enclosed<double>& value) { return {0, {value, {}, {}}, nullptr}; }

/// Another variable does not move with t: it is the ball of its interval.
Jet other_variable_jet(double low, double high) {
  if (low == high) return constant_jet(exact_number<double>(low));
  Enclosed<double> value;
  value.resize(1, 1);
  value.set(0, hull<double>(low, high));
  return constant_jet(value);
}

Jet variable_jet(double low, double high) {
  Jet jet = other_variable_jet(low, high);
  jet.order = 1;
  jet.derivatives[1] = exact_number<double>(1);
  return jet;
}

namespace jets {

/// Leibniz: (x y)' = x' y + x y', (x y)'' = x'' y + 2 x' y' + x y'', for any bilinear product.
void multiply(const Jet& x, const Jet& y, const Product& product, Jet& out) {
  static thread_local Enclosed<double> term;
  out.order = std::min(2, x.order + y.order);
  product(x.derivatives[0], y.derivatives[0], out.derivatives[0]);
  bool has_terms = false;
  // Terms of the k-th derivative, a binomial coefficient times x^(i) y^(k - i).
  const auto add = [&](std::size_t k, std::size_t i) {
    if (static_cast<int>(i) > x.order || static_cast<int>(k - i) > y.order) return;
    Enclosed<double>& sum = out.derivatives[k];
    Enclosed<double>& made = has_terms ? term : sum;
    product(x.derivatives[i], y.derivatives[k - i], made);
    if (k == 2 && i == 1)
      map_balls([](const Ball<double>& a) { return Ball<double>{2, 0} * a; }, made, made);
    if (has_terms)
      map_balls([](const Ball<double>& a, const Ball<double>& b) { return a + b; }, sum, term, sum);
    has_terms = true;
  };
  add(1, 1);
  add(1, 0);
  has_terms = false;
  add(2, 2);
  add(2, 1);
  add(2, 0);
}

void matrix_product(const Jet& x, const Jet& y, Jet& out) {
  multiply(
      x, y, [](const auto& a, const auto& b, auto& to) { numbers::multiply(a, b, to); }, out);
}
Jet matrix_product(const Jet& x, const Jet& y) {
  Jet out;
  matrix_product(x, y, out);
  return out;
}

/// A jet of 1 x 1 times one of any shape.
void scale(const Jet& factor, const Jet& x, Jet& out) {
  const auto product = [](const auto& s, const auto& a, auto& to) {
    map_balls([by = s.ball(0)](const Ball<double>& b) { return by * b; }, a, to);
  };
  multiply(factor, x, product, out);
}

Jet transposed_jet(const Jet& x) {
  Jet out;
  out.order = x.order;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(x.order); ++k)
    out.derivatives[k] = transposed(x.derivatives[k]);
  return out;
}

/// R = X^-1, whose value is given:  R' = -R X' R,  R'' = -2 R' X' R - R X'' R.
Jet inverse(const Jet& x, Enclosed<double> value) {
  Jet out;
  out.order = x.order == 0 ? 0 : 2;
  out.derivatives[0] = std::move(value);
  if (x.order == 0) return out;
  const auto& R = out.derivatives[0];
  const auto turned = numbers::product(x.derivatives[1], R);
  out.derivatives[1] = negative(numbers::product(R, turned));
  out.derivatives[2] = scaled(Ball<double>{-2, 0}, numbers::product(out.derivatives[1], turned));
  if (x.order == 2)
    out.derivatives[2] =
        difference(out.derivatives[2], numbers::product(R, numbers::product(x.derivatives[2], R)));
  return out;
}

/// Not below e^Y - I, Y = |A|: X (1 + X/2 (1 + X/3 ...)) of X = Y / 2^k in balanced units, whose
/// rest is at most |X|^9/9! * 1.2 wherever a path leads, then k times 2 H + H^2. None for a Y that
/// is large in balanced units: the exponential would say nothing.
std::optional<Matrix> growth(const Enclosed<double>& A) {
  constexpr int kTerms = 8;
  constexpr double kMost = 30;
  const auto scale = [](double x, int exponent) {
    return x == 0 ? 0 : times_power_of_two(x, exponent) + kTiny;
  };
  std::vector<int> units = enclosed::balance(A);
  Matrix X = numerics::in_units(magnitudes<double>(A), units, scale);
  const double norm = up(X.rowwise().sum().maxCoeff(), 100);
  if (!(norm < kMost)) return std::nullopt;
  const int squarings = norm > 0.5 ? std::ilogb(norm) + 2 : 0;
  for (double& x : X.reshaped()) x = scale(x, -squarings);
  const double reached = std::ldexp(norm, -squarings);
  const double rest = std::pow(reached, kTerms + 1) / std::tgamma(kTerms + 2.0) * 1.2 + kTiny;
  Matrix H = X / kTerms * up(1);
  for (int k = kTerms - 1; k >= 1; --k) H = (X + product_upward(X, H)) / k * up(1);
  const auto paths = enclosed::paths(X);
  for (Eigen::Index i = 0; i < H.size(); ++i)
    if (paths(i)) H(i) = up(H(i) + rest);
  for (int k = 0; k < squarings; ++k) H = (2 * H + product_upward(H, H)) * up(1);
  for (int& unit : units) unit = -unit;
  return numerics::in_units(H, units, scale);
}

/// e^(f M) = e^(m M) e^((f - m) M), where the second factor is within e^(r |M|) - I of I, for the
/// ball (m, r) of f. With E = e^(f M):  E' = f' M E,  E'' = (f'^2 M^2 + f'' M) E.
Jet exponential_of(const Jet::Ray& ray) {
  const Ball<double> middle{ray.factor[0].mid, 0};
  const double radius = ray.factor[0].rad;
  Enclosed<double> value = enclosed::exponential(scaled(middle, ray.matrix));
  if (radius > 0) {
    const auto grown = growth(scaled(Ball<double>{radius, 0}, ray.matrix));
    if (!grown)
      return {2,
              {nothing_known<double>(value.mid), nothing_known<double>(value.mid),
               nothing_known<double>(value.mid)},
              nullptr};
    value.rad = (value.rad + product_upward(magnitudes<double>(value), *grown)) * up(1);
  }
  Jet out{0, {value, {}, {}}, nullptr};
  const bool moves = !ray.factor[1].is_zero() || !ray.factor[2].is_zero();
  if (!moves) return out;
  out.order = 2;
  const Enclosed<double> first = numbers::product(ray.matrix, value);
  out.derivatives[1] = scaled(ray.factor[1], first);
  out.derivatives[2] = scaled(ray.factor[1] * ray.factor[1], numbers::product(ray.matrix, first));
  if (!ray.factor[2].is_zero())
    out.derivatives[2] = numbers::sum(out.derivatives[2], scaled(ray.factor[2], first));
  return out;
}

/// The first row of blocks of exp([X, X', X''/2; 0, X, X'; 0, 0, X]) is e^X with its derivatives,
/// the second halved.
Jet exponential(const Jet& x) {
  const Eigen::Index n = x.value().rows();
  Enclosed<double> big = exactly<double>(Matrix::Zero(3 * n, 3 * n));
  const auto put = [&](Eigen::Index row, Eigen::Index column, const Enclosed<double>& block) {
    big.mid.block(row * n, column * n, n, n) = block.mid;
    big.rad.block(row * n, column * n, n, n) = block.rad;
  };
  for (Eigen::Index k = 0; k < 3; ++k) put(k, k, x.value());
  for (Eigen::Index k = 0; k < 2; ++k) put(k, k + 1, x.derivatives[1]);
  if (x.order == 2) put(0, 2, scaled(Ball<double>{0.5, 0}, x.derivatives[2]));
  const Enclosed<double> whole = enclosed::exponential(big);
  Jet out;
  out.order = 2;
  for (Eigen::Index k = 0; k < 3; ++k) {
    auto& part = out.derivatives[static_cast<std::size_t>(k)];
    part = {whole.mid.block(0, k * n, n, n), whole.rad.block(0, k * n, n, n)};
    if (k == 2) part = scaled(Ball<double>{2, 0}, part);
  }
  return out;
}

namespace {

/// D^2 of the body of a jacobian, its second derivative along straight lines through its inputs.
class Bend {
 public:
  Bend(const expr::Instruction& instruction, expr::Operands<Jet> operands)
      : evaluator_(*instruction.body), operands_(operands), inputs_(operands.size()) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) evaluator_.set(i, inputs_[i]);
  }

  /// In the direction a*e_j + s*v, with e_j that of an element of the variable and v that in which
  /// the operands move.
  Enclosed<double> along(Eigen::Index j, double a, double s) {
    for (std::size_t i = 0; i < operands_.size(); ++i) {
      Jet& input = inputs_[i];
      input = constant_jet(operands_[i]->value());
      input.order = 1;
      input.derivatives[1] = scaled(Ball<double>{s, 0}, operands_[i]->derivative(1));
      if (i == 0)
        input.derivatives[1] = numbers::sum(input.derivatives[1], exactly<double>(a * unit(j)));
    }
    return evaluator_.run().derivative(2);
  }

  /// Whether the operands move in the direction e_j.
  bool is_along(Eigen::Index j) const {
    for (std::size_t i = 0; i < operands_.size(); ++i) {
      const Enclosed<double> v = operands_[i]->derivative(1);
      const bool same = i == 0 ? v.mid == unit(j) : v.mid.isZero(0);
      if (!same || !v.rad.isZero(0)) return false;
    }
    return true;
  }

 private:
  Matrix unit(Eigen::Index j) const {
    Matrix unit = Matrix::Zero(operands_[0]->value().rows(), operands_[0]->value().cols());
    unit(j) = 1;
    return unit;
  }

  expr::Evaluator<JetAlgebra> evaluator_;
  expr::Operands<Jet> operands_;
  std::vector<Jet> inputs_;  ///< the evaluator reads them where they are
};

/// The power of two nearest to sqrt(s/a), within 2^-20 and 2^20.
double balance(double a, double s) {
  constexpr double kMost = 0x1p20;
  if (!(a > 0)) return s > 0 ? kMost : 1;
  const double ratio = std::sqrt(s / a);
  if (!std::isfinite(ratio)) return 1;
  return std::exp2(std::round(std::log2(std::clamp(ratio, 1 / kMost, kMost))));
}

}  // namespace

/// Column j is D^2(e_j, v) = (D^2[a e_j + v] - D^2[a e_j - v])/(4 a). What D^2[e_j] and D^2[v] are
/// uncertain by does not cancel; a makes the sum of both small.
Enclosed<double> slope_of_jacobian(const expr::Instruction& instruction,
                                   expr::Operands<Jet> operands) {
  Bend bend(instruction, operands);
  const auto column = [&](Eigen::Index j) {
    const Enclosed<double> own = bend.along(j, 1, 0);
    if (bend.is_along(j)) return own;
    const double a = balance(own.rad.maxCoeff(), bend.along(j, 0, 1).rad.maxCoeff());
    return scaled(Ball<double>{0.25 / a, 0}, difference(bend.along(j, a, 1), bend.along(j, a, -1)));
  };
  Enclosed<double> result =
      exactly<double>(Matrix::Zero(instruction.shape.rows, instruction.shape.cols));
  if (instruction.shape.rows == 0) return result;
  for (Eigen::Index j = 0; j < operands[0]->value().mid.size(); ++j) {
    const Enclosed<double> found = column(j);
    result.mid.col(j) = found.mid.reshaped();
    result.rad.col(j) = found.rad.reshaped();
  }
  return result;
}

}  // namespace jets

/// Column j is the derivative of the body along e_j, a jet of order 1 in the variable.
Enclosed<double> enclosed_jacobian(const expr::Instruction& instruction,
                                   const std::vector<Enclosed<double>>& operands) {
  const Enclosed<double>& variable = operands.front();
  Enclosed<double> result =
      exactly<double>(Matrix::Zero(instruction.shape.rows, instruction.shape.cols));
  std::vector<Jet> inputs;
  inputs.reserve(operands.size());
  for (const Enclosed<double>& operand : operands) inputs.push_back(constant_jet(operand));
  inputs.front().order = 1;
  expr::Evaluator<JetAlgebra> evaluator(*instruction.body);
  for (std::size_t i = 0; i < inputs.size(); ++i) evaluator.set(i, inputs[i]);
  for (Eigen::Index j = 0; j < variable.mid.size(); ++j) {
    Matrix direction = Matrix::Zero(variable.rows(), variable.cols());
    direction(j) = 1;
    inputs.front().derivatives[1] = exactly<double>(direction);
    const Enclosed<double> slope = evaluator.run().derivative(1);
    result.mid.col(j) = slope.mid.reshaped();
    result.rad.col(j) = slope.rad.reshaped();
  }
  return result;
}

/// A value that is not finite is a fault; of a derivative that is not finite nothing is known.
void JetAlgebra::apply(const expr::Instruction& instruction, expr::Operands<Jet> operands,
                       Jet& out) const {
  check_stop();
  JetRules rules;
  out.order = 0;
  out.ray.reset();
  expr::dispatch(rules, instruction, operands, out);
  for (std::size_t k = 0; k <= static_cast<std::size_t>(out.order); ++k) {
    Enclosed<double>& part = out.derivatives[k];
    if (is_finite(part.mid)) continue;
    if (k == 0) expr::fault::not_finite(instruction.op);
    part = nothing_known<double>(Matrix::Zero(part.rows(), part.cols()));
  }
}

}  // namespace gainsmith::numbers
