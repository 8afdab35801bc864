// Internal to numbers: the rules of Enclosure, instantiated by one source a scalar.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/stop.h"
#include "numbers/dense/determinant.h"
#include "numbers/dense/householder.h"
#include "numbers/types/ball_functions.h"
#include "numbers/types/enclosed_functions.h"
#include "numbers/types/enclosure.h"
#include "numbers/types/shared_rules.h"

namespace gainsmith::numbers {

/// What complement() asks of balls.
template <class S>
struct BallNumbers {
  static Ball<S> root(const Ball<S>& x) {
    return ball::sqrt(x).value_or(Ball<S>{S(0), kNothingKnown});
  }
  static bool is_zero(const Ball<S>& x) { return x.is_zero(); }
  static std::optional<bool> is_negative(const Ball<S>& x) {
    if (is_not_negative(x)) return false;
    return is_positive(-x) ? std::optional(true) : std::nullopt;
  }
};

template <class S>
struct EnclosureRules {
  using Value = Enclosed<S>;
  using At = expr::Step<Value>;
  using Op = expr::Op;
  template <Op op>
  using Is = expr::Is<op>;

  /// Radius 0 for decimals that every scalar holds; two roundings of the scalar for others and pi.
  void operator()(Is<Op::constant>, const At& at, Value& out) const {
    const std::string& text = at.instruction.text;
    const auto value = text == "pi" ? Foundation<S>::pi() : Foundation<S>::parse(text);
    if (!value) expr::fault::beyond_range(at.instruction);
    out = exact_number<S>(*value);
    if (!is_exact_decimal(text))
      out.rad(0) = up(2 * unit_roundoff<S>() * magnitude(*value)) + kTiny;
  }
  void operator()(Is<Op::zeros>, const At& at, Value& out) const {
    out.mid.setZero(at.shape().rows, at.shape().cols);
    out.rad.setZero(at.shape().rows, at.shape().cols);
  }
  void operator()(Is<Op::fill>, const At& at, Value& out) const {
    out.mid.setConstant(at.shape().rows, at.shape().cols, at[0].mid(0));
    out.rad.setConstant(at.shape().rows, at.shape().cols, at[0].rad(0));
  }
  void operator()(Is<Op::identity>, const At& at, Value& out) const {
    out.mid.setZero(at.shape().rows, at.shape().cols);
    out.rad.setZero(at.shape().rows, at.shape().cols);
    out.mid.diagonal().setConstant(at[0].mid(0));
    out.rad.diagonal().setConstant(at[0].rad(0));
  }
  void operator()(Is<Op::add>, const At& at, Value& out) const {
    map_balls([](const Ball<S>& a, const Ball<S>& b) { return a + b; }, at[0], at[1], out);
  }
  void operator()(Is<Op::subtract>, const At& at, Value& out) const {
    map_balls([](const Ball<S>& a, const Ball<S>& b) { return a - b; }, at[0], at[1], out);
  }
  void operator()(Is<Op::negate>, const At& at, Value& out) const {
    out.mid = -at[0].mid;
    out.rad = at[0].rad;
  }
  void operator()(Is<Op::multiply>, const At& at, Value& out) const { multiply(at[0], at[1], out); }
  void operator()(Is<Op::scale>, const At& at, Value& out) const {
    const Ball<S> factor = at[0].ball(0);
    map_balls([&](const Ball<S>& a) { return factor * a; }, at[1], out);
  }
  /// By a ball that holds 0 without being 0 nothing is known, and nothing is thrown.
  void operator()(Is<Op::divide>, const At& at, Value& out) const {
    const Ball<S> by = at[1].ball(0);
    if (by.is_zero()) expr::fault::division_by_zero();
    map_balls([&](const Ball<S>& a) { return a / by; }, at[0], out);
  }
  void operator()(Is<Op::power>, const At& at, Value& out) const {
    if (at.shape().is_scalar()) {
      out.resize(1, 1);
      return out.set(0, ball::whole_power(at[0].ball(0), at.attribute(0)));
    }
    out = whole_power(exact_identity<S>(at[0].rows()), at[0], at.attribute(0),
                      [](const Value& a, const Value& b) { return product(a, b); });
  }
  void operator()(Is<Op::elementwise_product>, const At& at, Value& out) const {
    map_balls([](const Ball<S>& a, const Ball<S>& b) { return a * b; }, at[0], at[1], out);
  }
  void operator()(Is<Op::elementwise_quotient>, const At& at, Value& out) const {
    refuse_zeros(at[1]);
    map_balls([](const Ball<S>& a, const Ball<S>& b) { return a / b; }, at[0], at[1], out);
  }
  void operator()(Is<Op::elementwise_power>, const At& at, Value& out) const {
    const int exponent = at.attribute(0);
    map_balls([&](const Ball<S>& x) { return ball::whole_power(x, exponent); }, at[0], out);
  }
  void operator()(Is<Op::transpose>, const At& at, Value& out) const { out = transposed(at[0]); }
  void operator()(Is<Op::blocks>, const At& at, Value& out) const {
    out.resize(at.shape().rows, at.shape().cols);
    for_each_block(at, [&](Eigen::Index row, Eigen::Index column, const Value& part) {
      out.mid.block(row, column, part.rows(), part.cols()) = part.mid;
      out.rad.block(row, column, part.rows(), part.cols()) = part.rad;
    });
  }
  void operator()(Is<Op::index>, const At& at, Value& out) const {
    const Eigen::Index row = at.attribute(0), column = at.attribute(2);
    const Eigen::Index rows = at.attribute(1) - row, columns = at.attribute(3) - column;
    out.mid = at[0].mid.block(row, column, rows, columns);
    out.rad = at[0].rad.block(row, column, rows, columns);
  }
  /// Functions of numbers have their balls under their own names (ball_functions.h).
#define NUMBERS(op, ...)                                                             \
  void operator()(Is<Op::op>, const At& at, Value& out) const {                      \
    const auto function = [](const auto&... balls) -> decltype(ball::op(balls...)) { \
      return ball::op(balls...);                                                     \
    };                                                                               \
    each(Op::op, function, at, out);                                                 \
  }
#include "expr/operations.def"
  /// A ball that holds both branches where the sign of the condition is not certain.
  void operator()(Is<Op::where>, const At& at, Value& out) const {
    out.resize(at.shape().rows, at.shape().cols);
    for (Eigen::Index i = 0; i < out.mid.size(); ++i) {
      const auto holds = ball::holds(at[0].ball(i), at.attribute(0) != 0);
      out.set(i, !holds ? ball::either(at[1].ball(i), at[2].ball(i)) : at[*holds ? 1 : 2].ball(i));
    }
  }
  void operator()(Is<Op::trace>, const At& at, Value& out) const {
    Ball<S> sum;
    for (Eigen::Index i = 0; i < at[0].rows(); ++i) sum = sum + at[0].ball(i, i);
    out.resize(1, 1);
    out.set(0, sum);
  }
  /// The length of a row or column, the largest singular value of other matrices.
  void operator()(Is<Op::norm>, const At& at, Value& out) const {
    const Value& a = at[0];
    out.resize(1, 1);
    out.set(0, {});
    if (a.mid.size() == 0) return;
    if (a.rows() != 1 && a.cols() != 1) return out.set(0, enclosed::singular_values(a).ball(0));
    out.set(0, length(a));
  }
  /// `singular` is thrown of an exact matrix alone; of others nothing is known then.
  void operator()(Is<Op::inverse>, const At& at, Value& out) const {
    out = at[0];
    if (out.mid.size() == 0) return;
    auto found = Foundation<S>::inverse(at[0].mid);
    if (at[0].is_exact() && !(found.condition > S(0))) expr::fault::singular(at.instruction);
    out = enclosed::inverse_around<S>(found.matrix, at[0]);
  }
  /// Of full rank: A+ = (A'A)^-1 A' for rows >= cols, A' (A A')^-1 otherwise. 0 of an A that is 0.
  void operator()(Is<Op::pseudo_inverse>, const At& at, Value& out) const {
    const Value& a = at[0];
    out = exactly<S>(MatrixOf<S>::Zero(a.cols(), a.rows()));
    if (a.mid.size() == 0 || a.is_zero()) return;
    const Value turned = transposed(a);
    const bool tall = a.rows() >= a.cols();
    const Value gram = tall ? product(turned, a) : product(a, turned);
    const auto inverse = enclosed::inverse_around<S>(Foundation<S>::inverse(gram.mid).matrix, gram);
    out = tall ? product(inverse, turned) : product(turned, inverse);
  }
  void operator()(Is<Op::matrix_exponential>, const At& at, Value& out) const {
    out = enclosed::exponential(at[0]);
  }
  void operator()(Is<Op::diagonal_matrix>, const At& at, Value& out) const {
    const Eigen::Index n = at[0].mid.size();
    out = exactly<S>(MatrixOf<S>::Zero(n, n));
    for (Eigen::Index i = 0; i < n; ++i) out.set(i * n + i, at[0].ball(i));
  }
  void operator()(Is<Op::diagonal_of>, const At& at, Value& out) const {
    out.mid = at[0].mid.diagonal();
    out.rad = at[0].rad.diagonal();
  }
  /// By elimination over balls: nothing is known where a pivot may be 0. An exact 0 is never one.
  void operator()(Is<Op::determinant>, const At& at, Value& out) const {
    const auto size = [](const Ball<S>& x) { return x.is_zero() ? -1 : magnitude(x.mid); };
    out.resize(1, 1);
    out.set(0, determinant(columns(at[0]), Ball<S>{S(1), 0}, size));
  }
  void operator()(Is<Op::singular_values>, const At& at, Value& out) const {
    out = enclosed::singular_values(at[0]);
  }
  /// The identity for a subspace that is the whole space, no columns for {0}; else canonical.h. The
  /// dimension is that of the instruction.
  void operator()(Is<Op::range_basis>, const At& at, Value& out) const {
    const int count = at.shape().cols;
    out = exactly<S>(MatrixOf<S>::Identity(at[0].rows(), count));
    if (0 < count && count < at[0].rows()) out = enclosed::range_basis<S>(at[0], count);
  }
  void operator()(Is<Op::kernel_basis>, const At& at, Value& out) const {
    const int count = at.shape().cols;
    out = exactly<S>(MatrixOf<S>::Identity(at[0].cols(), count));
    if (0 < count && count < at[0].cols()) out = enclosed::kernel_basis<S>(at[0], count);
  }
  template <Op op>
  requires(expr::is_without_bounds(op)) void operator()(Is<op>, const At&, Value&) const {
    expr::fault::no_error_bound(op);
  }
  /// Householder over balls; nothing is known where the sign of a reflection is not certain.
  void operator()(Is<Op::complement_basis>, const At& at, Value& out) const {
    const Value& a = at[0];
    const auto basis =
        complement(columns(a), static_cast<std::size_t>(a.rows()),
                   static_cast<std::size_t>(at.shape().cols), Ball<S>{S(1), 0}, BallNumbers<S>{});
    out = nothing_known<S>(MatrixOf<S>::Zero(at.shape().rows, at.shape().cols));
    if (!basis) return;
    for (Eigen::Index i = 0; i < out.mid.size(); ++i)
      out.set(i, (*basis)[static_cast<std::size_t>(i / out.rows())]
                         [static_cast<std::size_t>(i % out.rows())]);
  }
  /// In double: over more digits it is right, but known to those of double alone.
  void operator()(Is<Op::jacobian>, const At& at, Value& out) const {
    std::vector<Enclosed<double>> operands;
    for (const Value* operand : at.operands) operands.push_back(converted<double>(*operand));
    out = converted<S>(enclosed_jacobian(at.instruction, operands));
  }

 private:
  /// f(x) or f(x, y) element by element. A fault where all of a ball lies outside of the domain.
  template <class Function>
  static void each(Op op, const Function& function, const At& at, Value& out) {
    if (op == Op::mod) refuse_zeros(at[1]);
    const auto value = [&](const auto&... balls) {
      const auto found = function(balls...);
      if constexpr (std::is_same_v<decltype(found), const Ball<S>>) {
        return found;
      } else {
        if (!found && at.operands.size() == 1)
          expr::fault::outside_domain(op, static_cast<double>(at[0].mid.minCoeff()));
        if (!found) expr::fault::not_finite(op);
        return *found;
      }
    };
    if constexpr (std::is_invocable_v<Function, Ball<S>>)
      map_balls(value, at[0], out);
    else
      map_balls(value, at[0], at[1], out);
  }

  static Columns<Ball<S>> columns(const Value& a) {
    return columns_of<Ball<S>>(a.rows(), a.cols(),
                               [&](Eigen::Index i, Eigen::Index j) { return a.ball(i, j); });
  }

  static void refuse_zeros(const Value& divisor) {
    for (Eigen::Index i = 0; i < divisor.mid.size(); ++i)
      if (divisor.ball(i).is_zero()) expr::fault::division_by_zero();
  }

  /// The length of a vector, in a unit 2^k that leaves its squares in range. Radii add their own
  /// length: ||x| - |y|| <= |x - y|.
  static Ball<S> length(const Value& a) {
    const double largest = magnitudes<S>(a.mid).maxCoeff();
    const double moved = enclosed::norm_upward(a.rad);
    if (!(largest > 0) || !std::isfinite(largest)) return {S(0), moved};
    const int unit = std::ilogb(largest);
    S squares(0);
    for (const S& x : a.mid.reshaped()) {
      const S part = times_power_of_two(x, -unit);
      squares += part * part;
    }
    using std::sqrt;
    const S norm = times_power_of_two(S(sqrt(squares)), unit);
    const double n = static_cast<double>(a.mid.size()) + 6;
    const bool exact = a.mid.size() == 1 && moved == 0;
    if (a.mid.size() == 1) return ball::abs(a.ball(0));
    return {norm, exact ? 0 : up(moved + n * unit_roundoff<S>() * magnitude(norm)) + kTiny};
  }
};

template <class S>
void Enclosure<S>::apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
                         Value& out) const {
  check_stop();
  expr::dispatch(EnclosureRules<S>{}, instruction, operands, out);
  if (!is_finite<S>(out.mid)) expr::fault::not_finite(instruction.op);
}

template <class S>
Enclosed<S> enclose(const expr::Program& program, const EnclosedValues<S>& values) {
  return evaluate_once<Enclosure<S>>(program, values);
}

}  // namespace gainsmith::numbers
