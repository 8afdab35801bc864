#include "numbers/rational.h"

#include "base/stop.h"
#include "expr/evaluate.h"
#include "numbers/determinant.h"
#include "numbers/rational_algebra.h"
#include "numbers/shared_rules.h"

namespace gainsmith::numbers {

namespace {

using expr::Op;

template <class Function>
void map(const Function& function, const RationalMatrix& x, RationalMatrix& out) {
  out.resize(x.rows(), x.cols());
  for (Eigen::Index i = 0; i < x.size(); ++i) out(i) = function(x(i));
}
template <class Function>
void map(const Function& function, const RationalMatrix& x, const RationalMatrix& y,
         RationalMatrix& out) {
  out.resize(x.rows(), x.cols());
  for (Eigen::Index i = 0; i < x.size(); ++i) out(i) = function(x(i), y(i));
}

/// EvaluationError for fractions that are too long to compute with.
void check_size(const RationalMatrix& x) {
  constexpr std::size_t kMostBits = 20000;
  for (const Rational& value : x.reshaped())
    if (mpz_sizeinbase(mpq_numref(value.backend().data()), 2) > kMostBits ||
        mpz_sizeinbase(mpq_denref(value.backend().data()), 2) > kMostBits)
      throw expr::EvaluationError("the fraction has more than 6,000 digits");
}

Rational whole_part(const Rational& x) {
  Rational floor(x);
  mpz_fdiv_q(mpq_numref(floor.backend().data()), mpq_numref(x.backend().data()),
             mpq_denref(x.backend().data()));
  mpz_set_ui(mpq_denref(floor.backend().data()), 1);
  return floor;
}

struct Rules {
  using Value = RationalMatrix;
  using At = expr::Step<Value>;
  template <Op op>
  using Is = expr::Is<op>;

  void operator()(Is<Op::constant>, const At& at, Value& out) const {
    const auto value = parse_rational(at.instruction.text);
    if (!value) not_rational(Op::constant);
    out = Value::Constant(1, 1, *value);
  }
  void operator()(Is<Op::zeros>, const At& at, Value& out) const {
    out = Value::Constant(at.shape().rows, at.shape().cols, Rational(0));
  }
  void operator()(Is<Op::fill>, const At& at, Value& out) const {
    out = Value::Constant(at.shape().rows, at.shape().cols, at[0](0));
  }
  void operator()(Is<Op::identity>, const At& at, Value& out) const {
    out = Value::Constant(at.shape().rows, at.shape().cols, Rational(0));
    for (Eigen::Index i = 0; i < out.rows(); ++i) out(i, i) = at[0](0);
  }
  void operator()(Is<Op::add>, const At& at, Value& out) const { out = at[0] + at[1]; }
  void operator()(Is<Op::subtract>, const At& at, Value& out) const { out = at[0] - at[1]; }
  void operator()(Is<Op::negate>, const At& at, Value& out) const { out = -at[0]; }
  void operator()(Is<Op::multiply>, const At& at, Value& out) const {
    out = at[0].lazyProduct(at[1]);
    if (at[0].cols() == 0) out.setConstant(Rational(0));
  }
  void operator()(Is<Op::scale>, const At& at, Value& out) const {
    const Rational factor = at[0](0);
    map([&](const Rational& a) { return Rational(factor * a); }, at[1], out);
  }
  void operator()(Is<Op::divide>, const At& at, Value& out) const {
    const Rational by = at[1](0);
    if (by == 0) expr::fault::division_by_zero();
    map([&](const Rational& a) { return Rational(a / by); }, at[0], out);
  }
  void operator()(Is<Op::elementwise_product>, const At& at, Value& out) const {
    map([](const Rational& a, const Rational& b) { return Rational(a * b); }, at[0], at[1], out);
  }
  void operator()(Is<Op::elementwise_quotient>, const At& at, Value& out) const {
    const auto quotient = [](const Rational& a, const Rational& b) {
      if (b == 0) expr::fault::division_by_zero();
      return Rational(a / b);
    };
    map(quotient, at[0], at[1], out);
  }
  void operator()(Is<Op::elementwise_power>, const At& at, Value& out) const {
    Value square = at[0];
    out = RationalMatrix::Constant(square.rows(), square.cols(), Rational(1));
    for (int exponent = at.attribute(0); exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) out = Value(out.cwiseProduct(square));
      if (exponent > 1) square = Value(square.cwiseProduct(square));
      check_size(square);
    }
  }
  void operator()(Is<Op::floor>, const At& at, Value& out) const {
    map([](const Rational& x) { return whole_part(x); }, at[0], out);
  }
  void operator()(Is<Op::mod>, const At& at, Value& out) const {
    const auto rest = [](const Rational& a, const Rational& b) {
      if (b == 0) expr::fault::division_by_zero();
      return Rational(a - b * whole_part(Rational(a / b)));
    };
    map(rest, at[0], at[1], out);
  }
  void operator()(Is<Op::power>, const At& at, Value& out) const {
    Value square = at[0];
    out = RationalMatrix::Identity(square.rows(), square.rows());
    for (int exponent = at.attribute(0); exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) out = Value(out.lazyProduct(square));
      if (exponent > 1) square = Value(square.lazyProduct(square));
      check_size(square);
    }
  }
  void operator()(Is<Op::transpose>, const At& at, Value& out) const { out = at[0].transpose(); }
  void operator()(Is<Op::blocks>, const At& at, Value& out) const {
    out.resize(at.shape().rows, at.shape().cols);
    for_each_block(at, [&](Eigen::Index row, Eigen::Index column, const Value& part) {
      out.block(row, column, part.rows(), part.cols()) = part;
    });
  }
  void operator()(Is<Op::index>, const At& at, Value& out) const {
    const Eigen::Index row = at.attribute(0), column = at.attribute(2);
    out = at[0].block(row, column, at.attribute(1) - row, at.attribute(3) - column);
  }
  void operator()(Is<Op::abs>, const At& at, Value& out) const {
    map([](const Rational& x) { return Rational(abs(x)); }, at[0], out);
  }
  void operator()(Is<Op::sign>, const At& at, Value& out) const {
    map([](const Rational& x) { return Rational(x.sign()); }, at[0], out);
  }
  void operator()(Is<Op::minimum>, const At& at, Value& out) const {
    map([](const Rational& a, const Rational& b) { return a < b ? a : b; }, at[0], at[1], out);
  }
  void operator()(Is<Op::maximum>, const At& at, Value& out) const {
    map([](const Rational& a, const Rational& b) { return a < b ? b : a; }, at[0], at[1], out);
  }
  void operator()(Is<Op::where>, const At& at, Value& out) const {
    const bool strict = at.attribute(0) != 0;
    out.resize(at.shape().rows, at.shape().cols);
    for (Eigen::Index i = 0; i < out.size(); ++i) {
      const Rational& d = at[0](i);
      out(i) = (strict ? d > 0 : d >= 0) ? at[1](i) : at[2](i);
    }
  }
  void operator()(Is<Op::trace>, const At& at, Value& out) const {
    Rational sum = 0;
    for (Eigen::Index i = 0; i < at[0].rows(); ++i) sum += at[0](i, i);
    out = Value::Constant(1, 1, sum);
  }
  void operator()(Is<Op::inverse>, const At& at, Value& out) const {
    const auto inverse = rational_inverse(at[0]);
    if (!inverse) expr::fault::singular(at.instruction);
    out = *inverse;
  }
  void operator()(Is<Op::determinant>, const At& at, Value& out) const {
    const auto size = [](const Rational& x) { return x < 0 ? Rational(-x) : x; };
    auto columns = columns_of<Rational>(
        at[0].rows(), at[0].cols(), [&](Eigen::Index i, Eigen::Index j) { return at[0](i, j); });
    out = Value::Constant(1, 1, determinant(std::move(columns), Rational(1), size));
  }
  void operator()(Is<Op::diagonal_matrix>, const At& at, Value& out) const {
    out = Value::Constant(at[0].size(), at[0].size(), Rational(0));
    for (Eigen::Index i = 0; i < at[0].size(); ++i) out(i, i) = at[0](i);
  }
  void operator()(Is<Op::diagonal_of>, const At& at, Value& out) const { out = at[0].diagonal(); }
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
  requires expr::OneOf<op, Op::real_power, Op::log, Op::sqrt, Op::atan2, Op::norm,
                       Op::pseudo_inverse, Op::singular_values, Op::range_basis, Op::kernel_basis,
                       Op::complement_basis, Op::jacobian, Op::project_polytope,
                       Op::project_ellipsoid, Op::project_affine, Op::project_convex, Op::flow_map,
                       Op::extremum, Op::eigenvalues, Op::continuous_riccati, Op::discrete_riccati>
  void operator()(Is<op>, const At&, Value&) const { not_rational(op); }

 private:
  [[noreturn]] static void not_rational(Op op) {
    throw expr::EvaluationError("the " + expr::to_string(op) + " has no exact fraction");
  }
};

}  // namespace

void RationalNumbers::apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
                            Value& out) const {
  check_stop();
  expr::dispatch(Rules{}, instruction, operands, out);
  check_size(out);
}

RationalMatrix rational_value(const expr::Program& program, const RationalValues& values) {
  expr::Evaluator<RationalNumbers> evaluator(program);
  for (const expr::Input& input : program.inputs) {
    const auto found = values.find(input.name);
    if (found == values.end())
      throw expr::EvaluationError("the value of " + input.name + " has no exact fraction");
    evaluator.set(input.name, found->second);
  }
  return evaluator.run();
}

RationalMatrix rational_symmetric_part(const RationalMatrix& x) {
  RationalMatrix out = x;
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i)
      if (x(i, j) != x(j, i)) out(i, j) = out(j, i) = (x(i, j) + x(j, i)) / 2;
  return out;
}

}  // namespace gainsmith::numbers
