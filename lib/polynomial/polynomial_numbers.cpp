#include "polynomial/polynomial_numbers.h"

#include <algorithm>

#include "base/stop.h"
#include "expr/program/evaluate.h"
#include "numbers/types/field_rules.h"

namespace gainsmith::polynomial {

namespace {

using Eigen::Index;
using expr::Op;

/// Says of the operation that it leaves polynomials, and what to write instead.
[[noreturn]] void refuse(Op op) {
  std::string mend;
  switch (op) {
    case Op::sin:
    case Op::cos:
      mend = "; take s and c for sine and cosine, with s^2 + c^2 == 1 under 'where'";
      break;
    case Op::divide:
    case Op::elementwise_quotient:
    case Op::inverse:
      mend = "; multiply the inequality by the denominator where that is positive";
      break;
    case Op::abs:
    case Op::norm:
    case Op::sqrt:
      mend = "; take a name for it, with its square under 'where'";
      break;
    default:
      break;
  }
  throw expr::EvaluationError("the " + to_string(op) +
                              " of what varies is no polynomial, and sums of squares take "
                              "polynomials alone" +
                              mend);
}

/// Whether no element has a variable or an unknown.
bool is_number(const PolynomialMatrix& x) {
  return std::ranges::all_of(x.reshaped(), [](const Polynomial& p) { return p.is_number(); });
}

/// Operations that a polynomial has no value of.
constexpr bool leaves_polynomials(Op op) {
  return op != Op::real_power &&
         (expr::is_function(op) || expr::is_one_of(op, {Op::where, Op::constant}));
}

/// The operations of polynomials beside those of every ring.
struct Rules : numbers::RingRules<Polynomial> {
  using RingRules::operator();
  const PolynomialNumbers& type;

  explicit Rules(const PolynomialNumbers& of) : type(of) {}

  void operator()(Is<Op::multiply>, const At& at, Value& out) const {
    out = at[0].lazyProduct(at[1]);
    if (at[0].cols() == 0) out.setConstant(Polynomial());
  }
  void operator()(Is<Op::scale>, const At& at, Value& out) const {
    out = at[1].unaryExpr([&](const Polynomial& p) { return at[0](0, 0) * p; });
  }
  void operator()(Is<Op::elementwise_product>, const At& at, Value& out) const {
    out = at[0].cwiseProduct(at[1]);
  }
  void operator()(Is<Op::divide>, const At& at, Value& out) const {
    if (!is_number(at[1])) refuse(Op::divide);
    const Rational by = at[1](0, 0).number();
    if (by == 0) expr::fault::division_by_zero();
    out = at[0];
    for (Polynomial& p : out.reshaped()) p *= Rational(1 / by);
  }
  void operator()(Is<Op::elementwise_quotient>, const At& at, Value& out) const {
    if (!is_number(at[1])) refuse(Op::elementwise_quotient);
    const auto quotient = [](Polynomial a, const Polynomial& b) {
      if (b.number() == 0) expr::fault::division_by_zero();
      return a *= Rational(1 / b.number());
    };
    map(quotient, at, out);
  }
  template <Op op>
  requires expr::OneOf<op, Op::power, Op::elementwise_power, Op::real_power>
  void operator()(Is<op>, const At& at, Value& out) const {
    // Larger exponents are refused: a power of a sum expands to too many terms.
    constexpr int kMost = 100;
    int exponent = 0;
    if constexpr (op == Op::real_power) {
      const Polynomial& of = at[1](0, 0);
      const bool is_whole = at[1].size() == 1 && of.is_number() && denominator(of.number()) == 1;
      if (!is_whole || of.number() < 0) refuse(op);
      exponent = of.number() > kMost ? kMost + 1 : numerator(of.number()).convert_to<int>();
    } else {
      exponent = at.attribute(0);
    }
    if (exponent > kMost) throw expr::EvaluationError("a power above 100 has too many terms");
    const bool is_matrix = op == Op::power;
    if (is_matrix)
      out = Value::Identity(at[0].rows(), at[0].cols());
    else
      out = Value::Constant(at[0].rows(), at[0].cols(), Polynomial(1));
    for (int k = 0; k < exponent; ++k)
      out = is_matrix ? Value(out.lazyProduct(at[0])) : Value(out.cwiseProduct(at[0]));
  }
  void operator()(Is<Op::jacobian>, const At& at, Value& out) const {
    // The body at new variables y, behind all that occur: d body/dy, with the point put in for y.
    const expr::Program& body = *at.instruction.body;
    std::size_t fresh = 0;
    for (const Value* operand : at.operands)
      for (const Polynomial& p : operand->reshaped()) fresh = std::max(fresh, p.variables());
    const Value& point = at[0];
    // y, of the shape of the point.
    Value varied(point.rows(), point.cols());
    for (Index k = 0; k < varied.size(); ++k)
      varied(k) = Polynomial(Term{Monomial(fresh + static_cast<std::size_t>(k)), 0});
    expr::Evaluator<PolynomialNumbers> evaluator(body, type);
    evaluator.set(0, varied);
    for (std::size_t k = 1; k < at.operands.size(); ++k) evaluator.set(k, at[k]);
    const Value value = evaluator.run();
    const std::vector<Polynomial> values(point.reshaped().begin(), point.reshaped().end());
    out.resize(value.size(), varied.size());
    for (Index c = 0; c < out.cols(); ++c)
      for (Index r = 0; r < out.rows(); ++r)
        out(r, c) =
            substituted(derivative(value(r), fresh + static_cast<std::size_t>(c)), fresh, values);
  }
  template <Op op>
  requires(leaves_polynomials(op)) void operator()(Is<op>, const At&, Value&) const { refuse(op); }
};

}  // namespace

void PolynomialNumbers::apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
                              Value& out) const {
  check_stop();
  const bool is_of_numbers =
      std::ranges::all_of(operands, [](const Value* x) { return is_number(*x); });
  if (!is_of_numbers || instruction.op == Op::jacobian) {
    try {
      expr::dispatch(Rules(*this), instruction, operands, out);
    } catch (const ProductOfUnknowns& product) {
      const auto name = [&](int k) { return (*unknowns)[static_cast<std::size_t>(k) - 1]; };
      throw expr::EvaluationError("not affine in the unknowns: a product of " +
                                  name(product.first) + " and " + name(product.second) +
                                  "; fix one of them as a datum, or solve for one and then, with "
                                  "its values, for the other");
    }
    return;
  }
  // Of numbers alone the rules of fractions hold.
  std::vector<numbers::RationalMatrix> values;
  for (const Value* operand : operands)
    values.push_back(operand->unaryExpr([](const Polynomial& p) { return p.number(); }));
  std::vector<const numbers::RationalMatrix*> pointers;
  for (const numbers::RationalMatrix& value : values) pointers.push_back(&value);
  numbers::RationalMatrix result;
  try {
    numbers::RationalNumbers{}.apply(instruction, pointers, result);
  } catch (const expr::EvaluationError& error) {
    if (!error.message().ends_with("no exact fraction")) throw;
    throw expr::EvaluationError(error.message() +
                                ", and sums of squares take no other numbers: give its decimals as "
                                "a datum");
  }
  out = polynomial_matrix(result);
}

PolynomialMatrix polynomial_value(const expr::Program& program, const PolynomialValues& values,
                                  const std::vector<std::string>& unknowns) {
  expr::Evaluator<PolynomialNumbers> evaluator(program, {&unknowns});
  for (const expr::Input& input : program.inputs) {
    const auto found = values.find(input.name);
    if (found == values.end())
      throw expr::EvaluationError("the value of " + input.name +
                                  " has no exact fraction, which sums of squares need: give its "
                                  "decimals as a datum");
    evaluator.set(input.name, found->second);
  }
  return evaluator.run();
}

PolynomialMatrix polynomial_matrix(const numbers::RationalMatrix& numbers) {
  return numbers.unaryExpr([](const Rational& x) { return Polynomial(x); });
}

}  // namespace gainsmith::polynomial
