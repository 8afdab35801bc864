// Internal to numbers: the rules of JetAlgebra.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "numbers/dense/foundation.h"
#include "numbers/types/ball_functions.h"
#include "numbers/types/enclosed_functions.h"
#include "numbers/types/enclosure.h"
#include "numbers/types/jet.h"
#include "numbers/types/jet_elements.h"

namespace gainsmith::numbers {

namespace jets {

using Product =
    std::function<void(const Enclosed<double>&, const Enclosed<double>&, Enclosed<double>& out)>;

/// (x y)^(k) by Leibniz' rule. `out` is neither factor, and may hold an old value.
void multiply(const Jet& x, const Jet& y, const Product& product, Jet& out);
void matrix_product(const Jet& x, const Jet& y, Jet& out);
Jet matrix_product(const Jet& x, const Jet& y);
void scale(const Jet& factor, const Jet& x, Jet& out);
Jet transposed_jet(const Jet& x);
/// Of the inverse whose value is given.
Jet inverse(const Jet& x, Enclosed<double> value);
Jet exponential_of(const Jet::Ray& ray);
Jet exponential(const Jet& x);
/// The derivative of Op::jacobian, whose operands move.
Enclosed<double> slope_of_jacobian(const expr::Instruction& instruction,
                                   expr::Operands<Jet> operands);

}  // namespace jets

struct JetRules {
  using At = expr::Step<Jet>;
  using Op = expr::Op;
  using Number = jets::Number;
  using Taylor = jets::Taylor;
  template <Op op>
  using Is = expr::Is<op>;

  /// Linear in all operands together.
  template <Op op>
  requires expr::OneOf<op, Op::fill, Op::identity, Op::add, Op::subtract, Op::negate, Op::transpose,
                       Op::blocks, Op::index, Op::trace, Op::diagonal_matrix, Op::diagonal_of>
  void operator()(Is<op>, const At& at, Jet& out) const {
    for (const Jet* operand : at.operands) out.order = std::max(out.order, operand->order);
    for (int k = 0; k <= out.order; ++k) coefficient(at, k, out);
    if ((op == Op::negate || op == Op::transpose) && at[0].ray != nullptr) {
      const Jet::Ray& ray = *at[0].ray;
      out.ray = std::make_shared<Jet::Ray>(
          Jet::Ray{ray.factor, op == Op::negate ? negative(ray.matrix) : transposed(ray.matrix)});
    }
  }

  template <Op op>
  requires expr::OneOf<op, Op::constant, Op::zeros>
  void operator()(Is<op>, const At& at, Jet& out) const { coefficient(at, 0, out); }

  void operator()(Is<Op::multiply>, const At& at, Jet& out) const {
    jets::matrix_product(at[0], at[1], out);
  }
  void operator()(Is<Op::scale>, const At& at, Jet& out) const {
    jets::scale(at[0], at[1], out);
    with_ray(at[0], at[1], out);
  }
  void operator()(Is<Op::divide>, const At& at, Jet& out) const {
    const Number by = at[1].value().ball(0);
    if (by.is_zero()) expr::fault::division_by_zero();
    if (at[1].order == 0) {
      out.order = at[0].order;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(out.order); ++k)
        out.derivatives[k] = quotient(at[0].derivatives[k], by);
      if (at[0].ray != nullptr) with_ray(reciprocal(at[1]), at[0], out);
      return;
    }
    const Jet factor = reciprocal(at[1]);
    jets::scale(factor, at[0], out);
    with_ray(factor, at[0], out);
  }
  void operator()(Is<Op::power>, const At& at, Jet& out) const {
    const int exponent = at.attribute(0);
    const Jet one = constant_jet(exact_identity<double>(at.shape().rows));
    out = whole_power(one, at[0], exponent,
                      [](const Jet& a, const Jet& b) { return jets::matrix_product(a, b); });
    // An even power of a number that changes its sign is a power of its size.
    if (at.shape().is_scalar() && exponent % 2 == 0 && exponent > 0) {
      const Number size = ball::whole_power(ball::abs(at[0].value().ball(0)), exponent);
      out.derivatives[0].set(0, size);
    }
  }
  void operator()(Is<Op::elementwise_product>, const At& at, Jet& out) const {
    const auto product = [](const auto& a, const auto& b, auto& to) {
      map_balls([](const Number& x, const Number& y) { return x * y; }, a, b, to);
    };
    jets::multiply(at[0], at[1], product, out);
  }
  void operator()(Is<Op::elementwise_quotient>, const At& at, Jet& out) const {
    each(out, {&at[0], &at[1]}, at.shape(),
         [](const std::vector<Taylor>& x) { return jets::quotient(x[0], x[1]); });
  }
  void operator()(Is<Op::elementwise_power>, const At& at, Jet& out) const {
    chain(at[0], out, [&](const Number& x) { return jets::whole_power(x, at.attribute(0)); });
  }
  void operator()(Is<Op::real_power>, const At& at, Jet& out) const {
    const bool moves = at[1].order > 0;
    each(out, {&at[0], &at[1]}, at.shape(),
         [&](const std::vector<Taylor>& x) { return jets::real_power(x[0], x[1], moves); });
  }

  void operator()(Is<Op::inverse>, const At& at, Jet& out) const {
    coefficient(at, 0, out);
    out = jets::inverse(at[0], std::move(out.derivatives[0]));
  }
  void operator()(Is<Op::pseudo_inverse>, const At& at, Jet& out) const {
    if (at[0].order == 0 || at[0].value().mid.size() == 0) return coefficient(at, 0, out);
    const Jet turned = jets::transposed_jet(at[0]);
    const bool tall = at[0].value().rows() >= at[0].value().cols();
    const Jet gram =
        tall ? jets::matrix_product(turned, at[0]) : jets::matrix_product(at[0], turned);
    const Jet inverse = jets::inverse(
        gram, enclosed::inverse_around<double>(Foundation<double>::inverse(gram.value().mid).matrix,
                                               gram.value()));
    out = tall ? jets::matrix_product(inverse, turned) : jets::matrix_product(turned, inverse);
  }
  void operator()(Is<Op::matrix_exponential>, const At& at, Jet& out) const {
    if (at[0].value().mid.size() == 0) return coefficient(at, 0, out);
    if (at[0].ray != nullptr) {
      out = jets::exponential_of(*at[0].ray);
    } else if (at[0].order == 0) {
      coefficient(at, 0, out);
    } else {
      out = jets::exponential(at[0]);
    }
  }

  void operator()(Is<Op::exp>, const At& at, Jet& out) const { chain(at[0], out, jets::exp_of); }
  void operator()(Is<Op::log>, const At& at, Jet& out) const {
    chain(at[0], out, [&](const Number& x) {
      const auto found = jets::log_of(x);
      if (!found) expr::fault::outside_domain(Op::log, x.mid);
      return *found;
    });
  }
  void operator()(Is<Op::sqrt>, const At& at, Jet& out) const {
    chain(at[0], out, [&](const Number& x) {
      const auto root = ball::sqrt(x);
      if (!root) expr::fault::outside_domain(Op::sqrt, x.mid);
      const Number half{0.5, 0};
      const Number first = half / *root;
      return Taylor{*root, first, -(half * first) / x};
    });
  }
  void operator()(Is<Op::sin>, const At& at, Jet& out) const {
    chain(at[0], out, [](const Number& x) {
      return Taylor{ball::sin(x), ball::cos(x), -ball::sin(x)};
    });
  }
  void operator()(Is<Op::cos>, const At& at, Jet& out) const {
    chain(at[0], out, [](const Number& x) {
      return Taylor{ball::cos(x), -ball::sin(x), -ball::cos(x)};
    });
  }
  void operator()(Is<Op::tanh>, const At& at, Jet& out) const {
    chain(at[0], out, [](const Number& x) {
      const Number t = ball::tanh(x), slope = Number{1, 0} - t * t;
      return Taylor{t, slope, Number{-2, 0} * t * slope};
    });
  }

  void operator()(Is<Op::abs>, const At& at, Jet& out) const {
    each(out, {&at[0]}, at.shape(), [](const std::vector<Taylor>& x) {
      if (is_not_negative(x[0].value)) return x[0];
      if (is_not_negative(-x[0].value)) return Taylor{-x[0].value, -x[0].first, -x[0].second};
      return Taylor{ball::abs(x[0].value), ball::either(x[0].first, -x[0].first),
                    jets::is_still(x[0]) ? Number{} : jets::kUnknown};
    });
  }
  void operator()(Is<Op::sign>, const At& at, Jet& out) const {
    each(out, {&at[0]}, at.shape(), [](const std::vector<Taylor>& x) {
      const Number sign = ball::sign(x[0].value);
      if (sign.is_exact() || jets::is_still(x[0])) return Taylor{sign, {}, {}};
      return Taylor{sign, jets::kUnknown, jets::kUnknown};
    });
  }
  void operator()(Is<Op::floor>, const At& at, Jet& out) const {
    chain(at[0], out, jets::floor_of);
  }
  void operator()(Is<Op::mod>, const At& at, Jet& out) const {
    each(out, {&at[0], &at[1]}, at.shape(),
         [](const std::vector<Taylor>& x) { return jets::rest_of(x[0], x[1]); });
  }
  void operator()(Is<Op::atan2>, const At& at, Jet& out) const {
    each(out, {&at[0], &at[1]}, at.shape(),
         [](const std::vector<Taylor>& x) { return jets::angle_of(x[0], x[1]); });
  }
  template <Op op>
  requires expr::OneOf<op, Op::minimum, Op::maximum>
  void operator()(Is<op>, const At& at, Jet& out) const {
    each(out, {&at[0], &at[1]}, at.shape(), [](const std::vector<Taylor>& x) {
      const auto& [larger, smaller] =
          op == Op::maximum ? std::pair(x[0], x[1]) : std::pair(x[1], x[0]);
      if (is_at_least(larger.value, smaller.value)) return x[0];
      if (is_at_least(smaller.value, larger.value)) return x[1];
      const Number value = op == Op::maximum ? ball::maximum(x[0].value, x[1].value)
                                             : ball::minimum(x[0].value, x[1].value);
      const bool still = jets::is_still(x[0]) && jets::is_still(x[1]);
      return Taylor{value, ball::either(x[0].first, x[1].first), still ? Number{} : jets::kUnknown};
    });
  }
  void operator()(Is<Op::where>, const At& at, Jet& out) const {
    const bool strict = at.attribute(0) != 0;
    each(out, {&at[0], &at[1], &at[2]}, at.shape(), [&](const std::vector<Taylor>& x) {
      const auto holds = ball::holds(x[0].value, strict);
      if (holds) return x[*holds ? 1 : 2];
      const Number value = ball::either(x[1].value, x[2].value);
      // Where t does not move the condition, it has one branch for all t.
      if (jets::is_still(x[0]))
        return Taylor{value, ball::either(x[1].first, x[2].first),
                      ball::either(x[1].second, x[2].second)};
      return Taylor{value, jets::kUnknown, jets::kUnknown};
    });
  }

  void operator()(Is<Op::norm>, const At& at, Jet& out) const {
    coefficient(at, 0, out);
    if (at[0].order == 0) return;
    const Enclosed<double> slope = at[0].derivative(1);
    const double steepest = enclosed::norm_upward(magnitudes<double>(slope));
    lipschitz(steepest, out);
    const Number size = out.value().ball(0);
    const bool is_vector = at[0].value().rows() == 1 || at[0].value().cols() == 1;
    if (!is_vector || !is_positive(size)) return;
    const Enclosed<double> bend = at[0].derivative(2);
    Number along, bent;
    for (Eigen::Index i = 0; i < slope.mid.size(); ++i) {
      along = along + at[0].value().ball(i) * slope.ball(i);
      bent = bent + slope.ball(i) * slope.ball(i) + at[0].value().ball(i) * bend.ball(i);
    }
    const Number first = along / size;
    out.derivatives[1].set(0, first);
    out.derivatives[2].set(0, (bent - first * first) / size);
  }
  void operator()(Is<Op::singular_values>, const At& at, Jet& out) const {
    coefficient(at, 0, out);
    if (at[0].order == 0) return;
    lipschitz(enclosed::norm_upward(magnitudes<double>(at[0].derivative(1))), out);
  }
  /// With R = A^-1, d = det A: d' = d tr R A', d'' = d ((tr R A')^2 - tr R A' R A' + tr R A'').
  void operator()(Is<Op::determinant>, const At& at, Jet& out) const {
    coefficient(at, 0, out);
    const Enclosed<double>& A = at[0].value();
    if (at[0].order == 0 || A.mid.size() == 0) return;
    const auto R = enclosed::inverse_around<double>(Foundation<double>::inverse(A.mid).matrix, A);
    if (!R.is_known()) return lipschitz(kNothingKnown, out);
    const auto trace = [](const Enclosed<double>& M) {
      Number sum;
      for (Eigen::Index i = 0; i < M.rows(); ++i) sum = sum + M.ball(i, i);
      return sum;
    };
    const auto slope = product(R, at[0].derivative(1));
    const Number d = out.value().ball(0), t = trace(slope);
    const Number bend = trace(product(R, at[0].derivative(2))) - trace(product(slope, slope));
    lipschitz(0, out);
    out.derivatives[1].set(0, d * t);
    out.derivatives[2].set(0, d * (t * t + bend));
  }
  template <Op op>
  requires expr::OneOf<op, Op::range_basis, Op::kernel_basis, Op::complement_basis>
  void operator()(Is<op>, const At& at, Jet& out) const {
    coefficient(at, 0, out);
    if (at[0].order > 0) lipschitz(kNothingKnown, out);
  }
  /// The second derivative would take a third one of the body.
  void operator()(Is<Op::jacobian>, const At& at, Jet& out) const {
    coefficient(at, 0, out);
    const bool moves = std::any_of(at.operands.begin(), at.operands.end(),
                                   [](const Jet* operand) { return operand->order > 0; });
    if (!moves) return;
    lipschitz(kNothingKnown, out);
    out.derivatives[1] = jets::slope_of_jacobian(at.instruction, at.operands);
  }
  template <Op op>
  requires(expr::is_without_bounds(op)) void operator()(Is<op>, const At&, Jet&) const {
    expr::fault::no_error_bound(op);
  }

 private:
  /// The instruction applied to the k-th derivatives.
  static void coefficient(const At& at, int k, Jet& out) {
    const std::size_t count = at.operands.size();
    std::array<const Enclosed<double>*, 4> few;
    std::vector<const Enclosed<double>*> many(count > few.size() ? count : 0);
    const Enclosed<double>** const operands = many.empty() ? few.data() : many.data();
    std::vector<Enclosed<double>> zeros;
    for (std::size_t i = 0; i < count; ++i) {
      if (k <= at[i].order) {
        operands[i] = &at[i].derivatives[static_cast<std::size_t>(k)];
        continue;
      }
      if (zeros.empty()) zeros.reserve(count);
      operands[i] = &zeros.emplace_back(at[i].derivative(k));
    }
    Enclosure<double>{}.apply(at.instruction, {operands, count},
                              out.derivatives[static_cast<std::size_t>(k)]);
  }

  /// The derivatives of a value that moves at most so fast, in any direction.
  static void lipschitz(double steepest, Jet& out) {
    const Matrix zero = Matrix::Zero(out.value().rows(), out.value().cols());
    out.order = 2;
    out.derivatives[1] = {zero, Matrix::Constant(zero.rows(), zero.cols(), steepest)};
    out.derivatives[2] = nothing_known<double>(zero);
  }

  /// A function of the elements of several operands, each with its derivatives.
  template <class Function>
  static void each(Jet& out, const std::vector<const Jet*>& operands, expr::Shape shape,
                   const Function& function) {
    bool moves = false;
    for (const Jet* operand : operands) moves = moves || operand->order > 0;
    out.order = moves ? 2 : 0;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(out.order); ++k)
      out.derivatives[k].resize(shape.rows, shape.cols);
    std::vector<Taylor> at(operands.size());
    for (Eigen::Index i = 0; i < shape.size(); ++i) {
      for (std::size_t k = 0; k < operands.size(); ++k) at[k] = element(*operands[k], i);
      const Taylor result = function(at);
      out.derivatives[0].set(i, result.value);
      if (!moves) continue;
      out.derivatives[1].set(i, result.first);
      out.derivatives[2].set(i, result.second);
    }
  }

  static Taylor element(const Jet& x, Eigen::Index i) {
    Taylor result{x.derivatives[0].ball(i), {}, {}};
    if (x.order >= 1) result.first = x.derivatives[1].ball(i);
    if (x.order >= 2) result.second = x.derivatives[2].ball(i);
    return result;
  }

  template <class Function>
  static void chain(const Jet& x, Jet& out, const Function& function) {
    each(out, {&x}, {static_cast<int>(x.value().rows()), static_cast<int>(x.value().cols())},
         [&](const std::vector<Taylor>& at) {
           return jets::composed(function(at[0].value), at[0]);
         });
  }
  static Jet reciprocal(const Jet& x) {
    Jet out;
    chain(x, out, [](const Number& at) {
      const Number value = Number{1, 0} / at;
      return Taylor{value, -(value * value), Number{2, 0} * value * value * value};
    });
    return out;
  }

  /// What `factor` times `x` is a ray of: x a constant, or a ray times a constant.
  static void with_ray(const Jet& factor, const Jet& x, Jet& out) {
    const auto number = [](const Jet& jet) {
      const Taylor at = element(jet, 0);
      return std::array<Number, 3>{at.value, at.first, at.second};
    };
    if (x.order == 0 && x.ray == nullptr) {
      out.ray = std::make_shared<Jet::Ray>(Jet::Ray{number(factor), x.value()});
    } else if (x.ray != nullptr && factor.order == 0) {
      Jet::Ray ray = *x.ray;
      for (Number& part : ray.factor) part = part * factor.value().ball(0);
      out.ray = std::make_shared<Jet::Ray>(std::move(ray));
    }
  }
};

}  // namespace gainsmith::numbers
