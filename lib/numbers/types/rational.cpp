#include "numbers/types/rational.h"

#include <algorithm>

#include "base/stop.h"
#include "expr/program/evaluate.h"
#include "numbers/dense/rational_algebra.h"
#include "numbers/types/field_rules.h"

namespace gainsmith::numbers {

namespace {

using expr::Op;

[[noreturn]] void not_rational(Op op) {
  throw expr::EvaluationError("the " + expr::to_string(op) + " has no exact fraction");
}

/// EvaluationError for fractions that are too long to compute with. `times`: as much longer they
/// will be.
void check_size(const RationalMatrix& x, Eigen::Index times = 1) {
  // 1204 decimal digits.
  constexpr std::size_t kMostBits = 4000;
  if (most_bits(x) > kMostBits / static_cast<std::size_t>(std::max<Eigen::Index>(times, 1)))
    throw expr::EvaluationError("the fraction has more than 1,200 digits");
}

/// floor(x): the quotient of numerator and denominator, rounded down.
Rational whole_part(const Rational& x) {
  Rational floor(x);
  mpz_fdiv_q(mpq_numref(floor.backend().data()), mpq_numref(x.backend().data()),
             mpq_denref(x.backend().data()));
  mpz_set_ui(mpq_denref(floor.backend().data()), 1);
  return floor;
}

/// The rules of a field, and of functions that lead from fractions to fractions. Powers are made by
/// squaring, with a check of the length after each square.
struct Rules : FieldRules<Rational> {
  using FieldRules::operator();

  void operator()(Is<Op::constant>, const At& at, Value& out) const {
    const auto value = parse_rational(at.instruction.text);
    if (!value) not_rational(Op::constant);
    out = Value::Constant(1, 1, *value);
  }
  void operator()(Is<Op::multiply>, const At& at, Value& out) const {
    out = at[0].lazyProduct(at[1]);
    if (at[0].cols() == 0) out.setConstant(Rational(0));
  }
  void operator()(Is<Op::elementwise_quotient>, const At& at, Value& out) const {
    const auto quotient = [](const Rational& a, const Rational& b) {
      if (b == 0) expr::fault::division_by_zero();
      return Rational(a / b);
    };
    map(quotient, at, out);
  }
  void operator()(Is<Op::elementwise_power>, const At& at, Value& out) const {
    const auto one = Value::Constant(at[0].rows(), at[0].cols(), Rational(1));
    out = power_of(one, at, numbers::elementwise_product<Rational>);
  }
  void operator()(Is<Op::sign>, const At& at, Value& out) const {
    out = at[0].unaryExpr([](const Rational& x) { return Rational(x.sign()); });
  }
  void operator()(Is<Op::floor>, const At& at, Value& out) const {
    out = at[0].unaryExpr([](const Rational& x) { return whole_part(x); });
  }
  void operator()(Is<Op::mod>, const At& at, Value& out) const {
    const auto rest = [](const Rational& a, const Rational& b) {
      if (b == 0) expr::fault::division_by_zero();
      return Rational(a - b * whole_part(Rational(a / b)));
    };
    map(rest, at, out);
  }
  void operator()(Is<Op::power>, const At& at, Value& out) const {
    const auto one = Value::Identity(at[0].rows(), at[0].rows());
    out = power_of(one, at, [](const Value& a, const Value& b) { return a.lazyProduct(b); });
  }
  void operator()(Is<Op::inverse>, const At& at, Value& out) const {
    check_size(at[0], at[0].rows());
    const auto inverse = rational_inverse(at[0]);
    if (!inverse) expr::fault::singular(at.instruction);
    out = *inverse;
  }
  template <Op op>
  requires expr::OneOf<op, Op::sin, Op::tanh>
  void operator()(Is<op>, const At& at, Value& out) const {
    if (!is_rational_zero(at[0])) not_rational(op);
    out = at[0];
  }
  template <Op op>
  requires expr::OneOf<op, Op::exp, Op::cos>
  void operator()(Is<op>, const At& at, Value& out) const {
    if (!is_rational_zero(at[0])) not_rational(op);
    out = Value::Constant(at[0].rows(), at[0].cols(), Rational(1));
  }
  void operator()(Is<Op::matrix_exponential>, const At& at, Value& out) const {
    if (!is_rational_zero(at[0])) not_rational(Op::matrix_exponential);
    out = Value::Identity(at[0].rows(), at[0].cols());
  }
  template <Op op>
  requires(is_irrational(op)) void operator()(Is<op>, const At&, Value&) const { not_rational(op); }

 private:
  template <class Times>
  static Value power_of(const Value& one, const At& at, const Times& times) {
    return whole_power(one, at[0], at.attribute(0), [&](const Value& a, const Value& b) {
      Value product = times(a, b);
      check_size(product);
      return product;
    });
  }
};

}  // namespace

void RationalNumbers::apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
                            Value& out) const {
  check_stop();
  expr::dispatch(Rules{}, instruction, operands, out);
  check_size(out);
}

/// By the operations alone, whatever their operands.
void require_fractions(const expr::Program& program) {
  for (const expr::Instruction& instruction : program.code)
    if (is_irrational(instruction.op)) not_rational(instruction.op);
}

RationalMatrix rational_value(const expr::Program& program, const RationalValues& values) {
  require_fractions(program);
  expr::Evaluator<RationalNumbers> evaluator(program);
  for (const expr::Input& input : program.inputs) {
    const auto found = values.find(input.name);
    if (found == values.end())
      throw expr::EvaluationError("the value of " + input.name + " has no exact fraction");
    evaluator.set(input.name, found->second);
  }
  return evaluator.run();
}

/// hi + lo is compared with x as fractions: a double is one.
Ball<DoubleDouble> ball_of(const Rational& x) {
  const DoubleDouble mid = nearest_double_double(x);
  const bool exact = Rational(mid.hi()) + Rational(mid.lo()) == x;
  return {mid, exact ? 0 : unit_roundoff<DoubleDouble>() * magnitude(mid)};
}

std::size_t most_bits(const RationalMatrix& x) {
  std::size_t most = 0;
  for (const Rational& value : x.reshaped())
    most = std::max({most, mpz_sizeinbase(mpq_numref(value.backend().data()), 2),
                     mpz_sizeinbase(mpq_denref(value.backend().data()), 2)});
  return most;
}

RationalMatrix rational_symmetric_part(const RationalMatrix& x) {
  RationalMatrix out = x;
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i)
      if (x(i, j) != x(j, i)) out(i, j) = out(j, i) = (x(i, j) + x(j, i)) / 2;
  return out;
}

}  // namespace gainsmith::numbers
