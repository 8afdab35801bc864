#include "lmi/affine_algebra.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "forall/residues.h"
#include "lmi/affine_maps.h"
#include "numbers/dense/dense.h"
#include "numbers/types/degree.h"
#include "numbers/types/real.h"

namespace gainsmith::lmi {

namespace {

bool all_constant(std::span<const AffineForm* const> operands) {
  return std::all_of(operands.begin(), operands.end(),
                     [](const AffineForm* form) { return form->is_constant(); });
}

/// The rules of one evaluation, with the tables for messages.
class Rules {
 public:
  Rules(forall::MonomialTable& monomials, const Unknowns& unknowns)
      : monomials_(monomials), unknowns_(unknowns) {}

  /// (sum phi_a x_i A_ai) (sum phi_b B_b): the unknowns are those of one factor. A product of two
  /// monomials is a sum of monomials (forall/monomials.h). By operation: of matrices, of a scalar
  /// and a matrix, or element by element.
  AffineForm product(const AffineForm& a, const AffineForm& b, expr::Shape shape,
                     expr::Op op) const {
    refuse_two_unknowns(a, b);
    if (largest_power(a) + largest_power(b) > kLargestPower)
      throw expr::EvaluationError("a 'forall' variable has a power above " +
                                  std::to_string(kLargestPower));
    AffineForm result{shape, {}};
    for (const auto& [left_key, left] : a.terms) {
      for (const auto& [right_key, right] : b.terms) {
        const Sparse matrix = op == expr::Op::scale ? Sparse(left.coeff(0, 0) * right)
                              : op == expr::Op::elementwise_product
                                  ? Sparse(left.cwiseProduct(right))
                                  : multiplied(left, right);
        for (const auto& [factor, monomial] : monomials_.product(left_key.first, right_key.first))
          add_term(result, {monomial, left_key.second + right_key.second}, matrix, factor);
      }
    }
    for (const Product& left : a.products)
      for (const auto& [key, right] : b.terms)
        add_with_monomials(left, key.first, left.left, multiplied(left.right, right), result);
    for (const auto& [key, left] : a.terms)
      for (const Product& right : b.products)
        add_with_monomials(
            right, key.first, op == expr::Op::scale ? right.left : multiplied(left, right.left),
            op == expr::Op::scale ? Sparse(left.coeff(0, 0) * right.right) : right.right, result);
    return result;
  }

  /// By squaring, so that a large power of one function costs nothing; that of a sum is a sum of as
  /// many functions as its exponent says.
  AffineForm power(const AffineForm& form, const numbers::Matrix& identity, int exponent,
                   expr::Op by) const {
    const auto times = [&](const AffineForm& a, const AffineForm& b) {
      AffineForm both = product(a, b, form.shape, by);
      if (both.terms.size() <= kMostFunctions) return both;
      throw expr::EvaluationError(
          "the power expands to more than " + std::to_string(kMostFunctions) +
          " functions of the 'forall' variables; use synthesis: {forall: exchange}");
    };
    AffineForm result = constant_form(identity);
    AffineForm square = form;
    for (int left = exponent; left > 0; left /= 2) {
      if (left % 2 == 1) result = times(result, square);
      if (left > 1) square = times(square, square);
    }
    return result;
  }

  /// By a constant without zeros, a scalar or element by element.
  AffineForm quotient(const AffineForm& a, const AffineForm& b, expr::Op op) const {
    if (!b.is_constant()) refuse(op, b);
    const numbers::Matrix by = dense_constant(b);
    if ((by.array() == 0).any()) expr::fault::division_by_zero();
    if (op == expr::Op::divide) {
      AffineForm result =
          map_terms(a, a.shape, [&](const Sparse& matrix) { return Sparse(matrix / by(0, 0)); });
      for (Product product : a.products) {
        product.right /= by(0, 0);
        add_product(result.products, std::move(product));
      }
      return result;
    }
    return map_terms(a, a.shape, [&](const Sparse& matrix) {
      return moved(matrix, a.shape.rows, a.shape.cols, [&](const auto& it, auto& elements) {
        elements.emplace_back(it.row(), it.col(), it.value() / by(it.row(), it.col()));
      });
    });
  }

  /// exp, sin or cos of c0 + c1 tau.
  AffineForm function_of_tau(expr::Op op, const AffineForm& form) const {
    if (!form.shape.is_scalar()) refuse(op, form);
    const Linear argument = linear(op, form);
    const double offset = argument.constant(0, 0);
    const double slope = argument.slope(0, 0);
    AffineForm result;
    const auto add = [&](double factor, const forall::Atom& atom) {
      add_term(result, {monomials_.index(argument.variable, atom), 0},
               sparse(numbers::Matrix::Constant(1, 1, factor)));
    };
    if (op == expr::Op::exp) {
      add(std::exp(offset), {0, slope, 0, false});
      return result;
    }
    // sin(c0 + c1 t) = sin c0 cos c1 t + cos c0 sin c1 t; cos likewise. b >= 0 in an atom.
    const double sign = slope < 0 ? -1 : 1;
    const bool sine = op == expr::Op::sin;
    add(sine ? std::sin(offset) : std::cos(offset), {0, 0, std::abs(slope), false});
    add(sign * (sine ? std::cos(offset) : -std::sin(offset)), {0, 0, std::abs(slope), true});
    return result;
  }

  /// expm(M + F tau) = expm(M) expm(F tau) when M F = F M.
  AffineForm matrix_exponential(const AffineForm& form) const {
    // ||M F - F M|| beside ||M|| ||F||, up to which M and F count as commuting.
    constexpr double kCommutes = 1e-13;
    const Linear argument = linear(expr::Op::matrix_exponential, form);
    const numbers::Matrix& M = argument.constant;
    const numbers::Matrix& F = argument.slope;
    if ((M * F - F * M).norm() > kCommutes * M.norm() * F.norm())
      refuse(expr::Op::matrix_exponential, form);
    const forall::Variable& tau =
        monomials_.variables()[static_cast<std::size_t>(argument.variable)];
    const numbers::Matrix before = numbers::exponential(M);
    AffineForm result{form.shape, {}};
    for (const auto& [atom, matrix] : forall::residue_expansion(F, tau.low, tau.high))
      add_term(result, {monomials_.index(argument.variable, atom), 0},
               sparse(M.isZero(0) ? matrix : numbers::Matrix(before * matrix)));
    return result;
  }

  /// What says nearly the same and is affine.
  static std::string affine_form_of(expr::Op op) {
    if (op == expr::Op::eigenvalues)
      return "; for a symmetric P all eigenvalues are below 3 where P < 3*I, and above 1 where P > "
             "I";
    if (op == expr::Op::inverse)
      return "; by a Schur complement A - B*inv(C)*B' > 0 with C > 0 is [A, B; *, C] > 0";
    if (op == expr::Op::determinant)
      return "; det(X)^(1/n) is made of blocks, as docs/language.md shows under 'Determinants', "
             "and "
             "log(det(X)) is largest where it is";
    return "";
  }

  /// Throws EvaluationError: names an unknown in the operand, or says that it is no function of tau
  /// that forms have.
  [[noreturn]] void refuse(expr::Op op, const AffineForm& form) const {
    int which = 0;
    if (form.has_unknown(&which))
      throw expr::EvaluationError("not affine in the unknowns: the " + to_string(op) +
                                  " depends on " + unknowns_.scalar_name(which) +
                                  affine_form_of(op));
    throw expr::EvaluationError(
        "the " + to_string(op) +
        " of a function of a 'forall' variable: 'hull' takes sums and products of powers, "
        "exp, sin and cos of affine functions and expm of multiples of one variable; "
        "use synthesis: {forall: exchange}");
  }

 private:
  static constexpr int kLargestPower = 1'000'000;     ///< of a variable of `forall`
  static constexpr std::size_t kMostFunctions = 100;  ///< terms that an expanded power may have

  /// The largest exponent of a variable in its monomials.
  int largest_power(const AffineForm& form) const {
    int largest = 0;
    for (const int monomial : monomials_in(form))
      for (const forall::Factor& factor : monomials_[monomial])
        largest = std::max(largest, factor.atom.power);
    return largest;
  }

  /// Adds E V F with the monomial of `product` times another one.
  void add_with_monomials(const Product& product, int monomial, const Sparse& left,
                          const Sparse& right, AffineForm& result) const {
    for (const auto& [factor, both] : monomials_.product(product.monomial, monomial))
      add_product(result.products, {both, product.unknown, product.transposed, left, right},
                  factor);
  }

  /// constant + slope * tau, tau one variable over an interval. Refuses everything else.
  struct Linear {
    numbers::Matrix constant;
    numbers::Matrix slope;
    int variable = -1;
  };

  Linear linear(expr::Op op, const AffineForm& form) const {
    const numbers::Matrix zero = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
    Linear result{zero, zero};
    for (const auto& [key, matrix] : form.terms) {
      const forall::Monomial& monomial = monomials_[key.first];
      if (key.second != 0) refuse(op, form);
      if (monomial.empty()) {
        result.constant = numbers::Matrix(matrix);
        continue;
      }
      const forall::Factor& factor = monomial.front();
      if (result.variable >= 0 || monomial.size() > 1 || factor.weight > 0 ||
          !(factor.atom == forall::Atom{1, 0, 0, false}))
        refuse(op, form);
      result.slope = numbers::Matrix(matrix);
      result.variable = factor.variable;
    }
    return result;
  }

  /// EvaluationError with a remedy where both factors have unknowns.
  void refuse_two_unknowns(const AffineForm& a, const AffineForm& b) const {
    int first = 0;
    int second = 0;
    if (!a.has_unknown(&first) || !b.has_unknown(&second)) return;
    const std::string one = unknowns_.scalar_name(first), other = unknowns_.scalar_name(second);
    if (one.substr(0, one.find('(')) == other.substr(0, other.find('(')))
      throw expr::EvaluationError("not affine in the unknowns: a product of " + one + " and " +
                                  other +
                                  "; of a column e the square e'*e, or e'*Q*e with Q >= 0, may be "
                                  "asked to be small");
    throw expr::EvaluationError(
        "not affine in the unknowns: a product of " + one + " and " + other +
        "; take the product as one unknown, as Y = P*K with the gain inv(P)*Y, fix one of them as "
        "data, or search it as a parameter if it is a number");
  }

  forall::MonomialTable& monomials_;
  const Unknowns& unknowns_;
};

/// An operation on constants, in doubles.
AffineForm constant_result(const expr::Instruction& instruction,
                           std::span<const AffineForm* const> operands) {
  std::vector<numbers::Matrix> dense;
  std::vector<const numbers::Matrix*> pointers;
  dense.reserve(operands.size());
  pointers.reserve(operands.size());
  for (const AffineForm* operand : operands) dense.push_back(dense_constant(*operand));
  for (const numbers::Matrix& matrix : dense) pointers.push_back(&matrix);
  numbers::Matrix result;
  numbers::RealAlgebra().apply(instruction, pointers, result);
  return constant_form(result);
}

/// The rules of expr/program/number_type.h; one operand at least is not constant.
struct AffineRules {
  using Op = expr::Op;
  using At = expr::Step<AffineForm>;
  template <Op op>
  using Is = expr::Is<op>;

  const Rules& rules;

  template <Op op>
  requires expr::OneOf<op, Op::add, Op::subtract>
  void operator()(Is<op>, const At& at, AffineForm& out) const {
    out = sum(at[0], at[1], op == Op::add ? 1 : -1);
  }
  void operator()(Is<Op::negate>, const At& at, AffineForm& out) const {
    out = sum({at[0].shape, {}}, at[0], -1);
  }
  template <Op op>
  requires expr::OneOf<op, Op::multiply, Op::scale, Op::elementwise_product>
  void operator()(Is<op>, const At& at, AffineForm& out) const {
    out = rules.product(at[0], at[1], at.shape(), op);
  }
  template <Op op>
  requires expr::OneOf<op, Op::divide, Op::elementwise_quotient>
  void operator()(Is<op>, const At& at, AffineForm& out) const {
    out = rules.quotient(at[0], at[1], op);
  }
  void operator()(Is<Op::power>, const At& at, AffineForm& out) const {
    const numbers::Matrix identity = numbers::Matrix::Identity(at.shape().rows, at.shape().rows);
    out = rules.power(at[0], identity, at.attribute(0), Op::multiply);
  }
  void operator()(Is<Op::elementwise_power>, const At& at, AffineForm& out) const {
    const numbers::Matrix ones = numbers::Matrix::Ones(at.shape().rows, at.shape().cols);
    out = rules.power(at[0], ones, at.attribute(0), Op::elementwise_product);
  }
  void operator()(Is<Op::transpose>, const At& at, AffineForm& out) const {
    out = transposed(at[0]);
  }
  void operator()(Is<Op::blocks>, const At& at, AffineForm& out) const {
    out = blocks(at.instruction, at.operands);
  }
  void operator()(Is<Op::index>, const At& at, AffineForm& out) const {
    out = index(at.instruction, at[0]);
  }
  void operator()(Is<Op::identity>, const At& at, AffineForm& out) const {
    out = identity(at[0], at.shape());
  }
  void operator()(Is<Op::fill>, const At& at, AffineForm& out) const {
    const expr::Shape shape = at.shape();
    out = rules.product(at[0], constant_form(numbers::Matrix::Ones(shape.rows, shape.cols)), shape,
                        Op::scale);
  }
  void operator()(Is<Op::trace>, const At& at, AffineForm& out) const { out = trace(at[0]); }
  template <Op op>
  requires expr::OneOf<op, Op::diagonal_matrix, Op::diagonal_of>
  void operator()(Is<op>, const At& at, AffineForm& out) const {
    out = diagonal(at.instruction, at[0]);
  }
  template <Op op>
  requires expr::OneOf<op, Op::exp, Op::sin, Op::cos>
  void operator()(Is<op>, const At& at, AffineForm& out) const {
    out = rules.function_of_tau(op, at[0]);
  }
  void operator()(Is<Op::matrix_exponential>, const At& at, AffineForm& out) const {
    out = rules.matrix_exponential(at[0]);
  }
  /// That of what is affine is a constant.
  void operator()(Is<Op::jacobian>, const At& at, AffineForm& out) const {
    numbers::Degree degree = 0;
    std::vector<numbers::Degree> degrees;
    std::vector<const numbers::Degree*> operands;
    degrees.reserve(at.operands.size());
    for (const AffineForm* operand : at.operands) degrees.push_back(operand->is_constant() ? 0 : 1);
    for (const numbers::Degree& of_operand : degrees) operands.push_back(&of_operand);
    numbers::DegreeAlgebra{}.apply(at.instruction, operands, degree);
    std::vector<AffineForm> constants;
    constants.reserve(at.operands.size());
    std::vector<const AffineForm*> pointers;
    for (const AffineForm* operand : at.operands) {
      if (degree != 0 && !operand->is_constant()) rules.refuse(Op::jacobian, *operand);
      constants.push_back(operand->is_constant() ? *operand : AffineForm{operand->shape, {}});
    }
    for (const AffineForm& constant : constants) pointers.push_back(&constant);
    out = constant_result(at.instruction, pointers);
  }
  /// Not affine in what moves: no value.
  template <Op op>
  requires(expr::is_one_of(op, {Op::constant, Op::zeros, Op::where}) ||
           (expr::is_function(op) &&
            !expr::is_one_of(op, {Op::exp, Op::sin, Op::cos, Op::matrix_exponential}))) void
  operator()(Is<op>, const At& at, AffineForm&) const {
    for (const AffineForm* operand : at.operands)
      if (!operand->is_constant()) rules.refuse(op, *operand);
  }
};

/// Whether the operation takes products with matrix unknowns as they are.
bool keeps_products(const expr::Instruction& instruction,
                    std::span<const AffineForm* const> operands) {
  using enum expr::Op;
  // A scalar that is a product is at many places.
  if (instruction.op == scale) return operands[0]->products.empty();
  return is_one_of(instruction.op,
                   {add, subtract, negate, multiply, divide, transpose, blocks, index});
}

}  // namespace

void AffineAlgebra::apply(const expr::Instruction& instruction,
                          std::span<const AffineForm* const> operands, AffineForm& out) const {
  check_stop();
  if (all_constant(operands)) {
    out = constant_result(instruction, operands);
    return;
  }
  const Rules rules(*monomials, *unknowns);
  std::vector<AffineForm> without_products;
  std::vector<const AffineForm*> pointers(operands.begin(), operands.end());
  if (!keeps_products(instruction, operands)) {
    without_products.reserve(operands.size());
    for (const AffineForm*& operand : pointers)
      if (!operand->products.empty()) operand = &without_products.emplace_back(expanded(*operand));
  }
  expr::dispatch(AffineRules{rules}, instruction, std::span<const AffineForm* const>(pointers),
                 out);
}

}  // namespace gainsmith::lmi
