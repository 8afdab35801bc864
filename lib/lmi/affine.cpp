#include "lmi/affine.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "forall/hull.h"
#include "forall/residues.h"
#include "numbers/dense.h"
#include "numbers/real.h"

namespace gainsmith::lmi {

namespace {

using Key = std::pair<int, int>;

expr::Shape transposed(expr::Shape shape) { return {shape.cols, shape.rows}; }

Sparse sparse(const numbers::Matrix& matrix) { return matrix.sparseView(0.0, 0.0); }

void accumulate(AffineForm& form, Key key, Sparse matrix) {
  if (matrix.nonZeros() == 0) return;
  const auto found = form.terms.lower_bound(key);
  if (found == form.terms.end() || found->first != key) {
    form.terms.emplace_hint(found, key, std::move(matrix));
    return;
  }
  found->second = sum_of(found->second, matrix, 1);
  if (found->second.nonZeros() == 0) form.terms.erase(found);
}

void accumulate(AffineForm& form, Key key, const Sparse& matrix, double factor) {
  if (matrix.nonZeros() == 0 || factor == 0) return;
  const auto found = form.terms.lower_bound(key);
  if (found == form.terms.end() || found->first != key) {
    form.terms.emplace_hint(found, key, factor == 1 ? matrix : Sparse(factor * matrix));
    return;
  }
  found->second = sum_of(found->second, matrix, factor);
  if (found->second.nonZeros() == 0) form.terms.erase(found);
}

/// The form with every coefficient mapped linearly.
template <class Map>
AffineForm map_terms(const AffineForm& form, expr::Shape shape, Map map) {
  AffineForm result{shape, {}};
  for (const auto& [key, matrix] : form.terms) accumulate(result, key, map(matrix));
  return result;
}

AffineForm sum(const AffineForm& a, const AffineForm& b, double factor) {
  AffineForm result = a;
  for (const auto& [key, matrix] : b.terms) accumulate(result, key, matrix, factor);
  return result;
}

numbers::Matrix dense_constant(const AffineForm& form) {
  const auto found = form.terms.find({0, 0});
  if (found == form.terms.end()) return numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
  return numbers::Matrix(found->second);
}

/// A matrix from the elements of `matrix` moved to other places.
template <class Move>
Sparse moved(const Sparse& matrix, int rows, int cols, Move move) {
  std::vector<Eigen::Triplet<double>> elements;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it) move(it, elements);
  Sparse result(rows, cols);
  result.setFromTriplets(elements.begin(), elements.end());
  return result;
}

AffineForm blocks(const expr::Instruction& instruction,
                  std::span<const AffineForm* const> operands) {
  AffineForm result{instruction.shape, {}};
  const auto columns = static_cast<std::size_t>(instruction.attributes[0]);
  int row = 0;
  for (std::size_t first = 0; first < operands.size(); first += columns) {
    int column = 0;
    for (std::size_t j = first; j < first + columns; ++j) {
      for (const auto& [key, matrix] : operands[j]->terms)
        accumulate(result, key,
                   placed(matrix, instruction.shape.rows, instruction.shape.cols, row, column));
      column += operands[j]->shape.cols;
    }
    row += operands[first]->shape.rows;
  }
  return result;
}

AffineForm index(const expr::Instruction& instruction, const AffineForm& form) {
  const auto& [row, row_end, column, column_end] = instruction.attributes;
  return map_terms(form, instruction.shape, [&, row = row, column = column](const Sparse& matrix) {
    return Sparse(matrix.block(row, column, instruction.shape.rows, instruction.shape.cols));
  });
}

AffineForm identity(const AffineForm& form, expr::Shape shape) {
  return map_terms(form, shape, [&](const Sparse& matrix) {
    Sparse eye(shape.rows, shape.cols);
    eye.setIdentity();
    return Sparse(matrix.coeff(0, 0) * eye);
  });
}

AffineForm trace(const AffineForm& form) {
  return map_terms(form, {}, [](const Sparse& matrix) {
    return sparse(numbers::Matrix::Constant(1, 1, matrix.diagonal().sum()));
  });
}

AffineForm diagonal(const expr::Instruction& instruction, const AffineForm& form) {
  const expr::Shape shape = instruction.shape;
  if (instruction.op == expr::Op::diagonal_of)
    return map_terms(form, shape, [](const Sparse& matrix) { return sparse(matrix.diagonal()); });
  return map_terms(form, shape, [&](const Sparse& matrix) {
    return moved(matrix, shape.rows, shape.cols, [](const auto& it, auto& elements) {
      const int at = static_cast<int>(it.row() + it.col());
      elements.emplace_back(at, at, it.value());
    });
  });
}

bool all_constant(std::span<const AffineForm* const> operands) {
  return std::all_of(operands.begin(), operands.end(),
                     [](const AffineForm* form) { return form->is_constant(); });
}

}  // namespace

bool is_same(const AffineForm& a, const AffineForm& b) {
  return a.shape == b.shape && a.terms.size() == b.terms.size() &&
         std::equal(a.terms.begin(), a.terms.end(), b.terms.begin(),
                    [](const auto& left, const auto& right) {
                      return left.first == right.first &&
                             Sparse(left.second - right.second).norm() == 0;
                    });
}

bool AffineForm::is_constant() const {
  return terms.empty() || (terms.size() == 1 && terms.begin()->first == Key{0, 0});
}

bool AffineForm::has_unknown(int* which) const {
  for (const auto& [key, matrix] : terms) {
    if (key.second == 0) continue;
    if (which != nullptr) *which = key.second;
    return true;
  }
  return false;
}

AffineForm constant_form(const numbers::Matrix& matrix) {
  AffineForm result{{static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols())}, {}};
  accumulate(result, {0, 0}, sparse(matrix));
  return result;
}

AffineForm unknown_form(const Unknown& unknown) {
  AffineForm result{unknown.shape, {}};
  for (int k = 0; k < unknown.count; ++k) {
    Sparse matrix(unknown.shape.rows, unknown.shape.cols);
    for (const auto& [row, column] : unknown.places(k)) matrix.insert(row, column) = 1;
    matrix.makeCompressed();
    result.terms.emplace(Key{0, unknown.first + k}, std::move(matrix));
  }
  return result;
}

AffineForm variable_form(forall::MonomialTable& monomials, int variable) {
  const forall::Variable& v = monomials.variables()[static_cast<std::size_t>(variable)];
  AffineForm result{v.shape, {}};
  if (v.is_interval()) {
    const int tau = monomials.index(variable, forall::Atom{1, 0, 0, false});
    accumulate(result, {tau, 0}, sparse(numbers::Matrix::Ones(1, 1)));
    return result;
  }
  accumulate(result, {0, 0}, sparse(v.elements[0]));
  for (int j = 1; j < static_cast<int>(v.elements.size()); ++j)
    accumulate(result, {monomials.index_of_weight(variable, j), 0},
               sparse(v.elements[static_cast<std::size_t>(j)] - v.elements[0]));
  return result;
}

namespace {

/// The rules of one evaluation, with the tables for messages.
class Rules {
 public:
  Rules(forall::MonomialTable& monomials, const Unknowns& unknowns)
      : monomials_(monomials), unknowns_(unknowns) {}

  AffineForm product(const AffineForm& a, const AffineForm& b, expr::Shape shape,
                     bool scaling) const {
    refuse_two_unknowns(a, b);
    AffineForm result{shape, {}};
    for (const auto& [left_key, left] : a.terms) {
      for (const auto& [right_key, right] : b.terms) {
        const Sparse matrix = scaling ? Sparse(left.coeff(0, 0) * right) : multiplied(left, right);
        for (const auto& [factor, monomial] : monomials_.product(left_key.first, right_key.first))
          accumulate(result, {monomial, left_key.second + right_key.second}, matrix, factor);
      }
    }
    return result;
  }

  AffineForm power(const AffineForm& form, int exponent) const {
    AffineForm result = constant_form(numbers::Matrix::Identity(form.shape.rows, form.shape.rows));
    for (int i = 0; i < exponent; ++i) result = product(result, form, form.shape, false);
    return result;
  }

  AffineForm quotient(const AffineForm& a, const AffineForm& b) const {
    if (!b.is_constant()) refuse(expr::Op::divide, b);
    const double divisor = dense_constant(b)(0, 0);
    if (divisor == 0) throw expr::EvaluationError("division by zero");
    return map_terms(a, a.shape, [&](const Sparse& matrix) { return Sparse(matrix / divisor); });
  }

  /// exp, sin or cos of c0 + c1 tau.
  AffineForm function_of_tau(expr::Op op, const AffineForm& form) const {
    if (!form.shape.is_scalar()) refuse(op, form);
    const Linear argument = linear(op, form);
    const double offset = argument.constant(0, 0);
    const double slope = argument.slope(0, 0);
    AffineForm result;
    const auto add = [&](double factor, const forall::Atom& atom) {
      accumulate(result, {monomials_.index(argument.variable, atom), 0},
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
      accumulate(result, {monomials_.index(argument.variable, atom), 0},
                 sparse(M.isZero(0) ? matrix : numbers::Matrix(before * matrix)));
    return result;
  }

  [[noreturn]] void refuse(expr::Op op, const AffineForm& form) const {
    int which = 0;
    if (form.has_unknown(&which))
      throw expr::EvaluationError("not affine in the unknowns: the " + to_string(op) +
                                  " depends on " + unknowns_.scalar_name(which));
    throw expr::EvaluationError(
        "the " + to_string(op) +
        " of a function of a 'forall' variable: the way hull takes sums and products of powers, "
        "exp, sin and cos of affine functions and expm of multiples of one variable; use the way "
        "exchange");
  }

 private:
  /// constant + slope * (one interval variable).
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

  void refuse_two_unknowns(const AffineForm& a, const AffineForm& b) const {
    int first = 0;
    int second = 0;
    if (!a.has_unknown(&first) || !b.has_unknown(&second)) return;
    throw expr::EvaluationError("not affine in the unknowns: a product of " +
                                unknowns_.scalar_name(first) + " and " +
                                unknowns_.scalar_name(second));
  }

  forall::MonomialTable& monomials_;
  const Unknowns& unknowns_;
};

}  // namespace

void AffineAlgebra::apply(const expr::Instruction& instruction,
                          std::span<const AffineForm* const> operands, AffineForm& out) const {
  using expr::Op;
  const Rules rules(*monomials, *unknowns);
  const auto a = [&]() -> const AffineForm& { return *operands[0]; };
  const auto b = [&]() -> const AffineForm& { return *operands[1]; };
  if (all_constant(operands)) {
    std::vector<numbers::Matrix> dense;
    std::vector<const numbers::Matrix*> pointers;
    dense.reserve(operands.size());
    pointers.reserve(operands.size());
    for (const AffineForm* operand : operands) dense.push_back(dense_constant(*operand));
    for (const numbers::Matrix& matrix : dense) pointers.push_back(&matrix);
    numbers::Matrix result;
    numbers::RealAlgebra().apply(instruction, pointers, result);
    out = constant_form(result);
    return;
  }
  switch (instruction.op) {
    case Op::add:
      out = sum(a(), b(), 1);
      break;
    case Op::subtract:
      out = sum(a(), b(), -1);
      break;
    case Op::negate:
      out = sum({a().shape, {}}, a(), -1);
      break;
    case Op::multiply:
      out = rules.product(a(), b(), instruction.shape, false);
      break;
    case Op::scale:
      out = rules.product(a(), b(), instruction.shape, true);
      break;
    case Op::divide:
      out = rules.quotient(a(), b());
      break;
    case Op::power:
      out = rules.power(a(), instruction.attributes[0]);
      break;
    case Op::transpose:
      out = map_terms(a(), transposed(a().shape),
                      [](const Sparse& m) { return Sparse(m.transpose()); });
      break;
    case Op::blocks:
      out = blocks(instruction, operands);
      break;
    case Op::index:
      out = index(instruction, a());
      break;
    case Op::identity:
      out = identity(a(), instruction.shape);
      break;
    case Op::fill:
      out = rules.product(
          a(), constant_form(numbers::Matrix::Ones(instruction.shape.rows, instruction.shape.cols)),
          instruction.shape, true);
      break;
    case Op::trace:
      out = trace(a());
      break;
    case Op::diagonal_matrix:
    case Op::diagonal_of:
      out = diagonal(instruction, a());
      break;
    case Op::exp:
    case Op::sin:
    case Op::cos:
      out = rules.function_of_tau(instruction.op, a());
      break;
    case Op::matrix_exponential:
      out = rules.matrix_exponential(a());
      break;
    default:
      for (const AffineForm* operand : operands)
        if (!operand->is_constant()) rules.refuse(instruction.op, *operand);
  }
}

std::set<int> monomials_in(const AffineForm& form) {
  std::set<int> found;
  for (const auto& [key, matrix] : form.terms)
    if (key.first != 0) found.insert(key.first);
  return found;
}

void remove_noise(AffineForm& form, const forall::MonomialTable& monomials) {
  forall::Sizes sizes;
  for (const auto& [key, matrix] : form.terms)
    sizes[key.first] = std::max(sizes[key.first], largest_element(matrix));
  const std::set<int> noise = forall::noise(sizes, monomials);
  std::erase_if(form.terms, [&](const auto& term) { return noise.contains(term.first.first); });
}

AffineForm at_vertex(const AffineForm& form, const std::vector<double>& values) {
  AffineForm result{form.shape, {}};
  for (const auto& [key, matrix] : form.terms) {
    const double factor = values[static_cast<std::size_t>(key.first)];
    const auto [found, fresh] = result.terms.try_emplace({0, key.second}, factor * matrix);
    if (!fresh) found->second = found->second + factor * matrix;
  }
  return result;
}

forall::Expansion expansion_of(const AffineForm& form) {
  forall::Expansion expansion;
  for (const auto& [key, matrix] : form.terms)
    expansion.emplace_back(key.first, numbers::Matrix(matrix));
  if (expansion.empty())
    expansion.emplace_back(0, numbers::Matrix::Zero(form.shape.rows, form.shape.cols));
  return expansion;
}

numbers::Matrix value_of(const AffineForm& form, const std::vector<double>& x) {
  numbers::Matrix result = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
  for (const auto& [key, matrix] : form.terms)
    result += (key.second == 0 ? 1.0 : x[static_cast<std::size_t>(key.second) - 1]) *
              numbers::Matrix(matrix);
  return result;
}

}  // namespace gainsmith::lmi
