#include "numbers/real.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "base/number.h"

namespace gainsmith::numbers {

using expr::EvaluationError;
using expr::Instruction;
using expr::Op;
using expr::Shape;

namespace {

double round_constant(const Instruction& instruction) {
  if (instruction.text == "pi") return std::numbers::pi;
  const auto value = parse_decimal(instruction.text);
  if (!value)
    throw EvaluationError("the number " + instruction.text + " is beyond the range of double");
  return *value;
}

void blocks(const Instruction& instruction, std::span<const Matrix* const> operands, Matrix& out) {
  out.resize(instruction.shape.rows, instruction.shape.cols);
  const auto columns = static_cast<std::size_t>(instruction.attributes[0]);
  Eigen::Index row = 0;
  for (std::size_t first = 0; first < operands.size(); first += columns) {
    Eigen::Index column = 0;
    for (std::size_t j = first; j < first + columns; ++j) {
      out.block(row, column, operands[j]->rows(), operands[j]->cols()) = *operands[j];
      column += operands[j]->cols();
    }
    row += operands[first]->rows();
  }
}

void inverse(const Matrix& a, const std::string& what, Matrix& out) {
  out = a;
  if (a.size() == 0) return;
  const Eigen::PartialPivLU<Matrix> lu(a);
  if (!(lu.rcond() > 1e-15))
    throw EvaluationError((what.empty() ? "inv: the matrix" : what) +
                          " is singular to working precision");
  out = lu.inverse();
}

Eigen::JacobiSVD<Matrix> full_svd(const Matrix& a) {
  return Eigen::JacobiSVD<Matrix>(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
}

void pseudo_inverse(const Matrix& a, Matrix& out) {
  out = Matrix::Zero(a.cols(), a.rows());
  const int rank = numerical_rank(a);
  if (rank == 0) return;
  const auto svd = full_svd(a);
  for (int i = 0; i < rank; ++i)
    out += svd.matrixV().col(i) / svd.singularValues()(i) * svd.matrixU().col(i).transpose();
}

void matrix_exponential(const Matrix& a, Matrix& out) {
  out = a;
  if (a.size() > 0) out = a.exp();
}

/// The first `count` left singular vectors: of the range. An empty matrix has no decomposition.
void range_basis(const Matrix& a, int count, Matrix& out) {
  out = Matrix::Zero(a.rows(), count);
  if (count > 0) out = full_svd(a).matrixU().leftCols(count);
}

/// The last `count` right singular vectors: of the kernel.
void kernel_basis(const Matrix& a, int count, Matrix& out) {
  out = Matrix::Identity(a.cols(), count);
  if (a.size() > 0) out = full_svd(a).matrixV().rightCols(count);
}

Eigen::VectorXd singular_values(const Matrix& a) {
  if (a.size() == 0) return Eigen::VectorXd::Zero(0);
  return Eigen::JacobiSVD<Matrix>(a).singularValues();
}

double norm(const Matrix& a) {
  if (a.size() == 0) return 0;
  if (a.rows() == 1 || a.cols() == 1) return a.norm();
  return singular_values(a).maxCoeff();
}

void power(const Matrix& a, int exponent, Matrix& out) {
  Matrix square = a;
  out = Matrix::Identity(a.rows(), a.cols());
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) out = out * square;
    if (exponent > 1) square = square * square;
  }
}

/// Small products, by far the most frequent here, are faster without the blocking of large ones.
void multiply(const Matrix& a, const Matrix& b, Matrix& out) {
  constexpr Eigen::Index kSmall = 16;
  if (std::max({a.rows(), a.cols(), b.cols()}) <= kSmall) {
    out.noalias() = a.lazyProduct(b);
  } else {
    out.noalias() = a * b;
  }
}

void divide(const Matrix& a, double by, Matrix& out) {
  if (by == 0) throw EvaluationError("division by zero");
  out = a / by;
}

void require_domain(const Matrix& a, bool holds, const char* what) {
  if (!holds) throw EvaluationError(std::string(what) + " of " + brief(a.minCoeff()));
}

void where(const Instruction& instruction, std::span<const Matrix* const> operands, Matrix& out) {
  out.resize(instruction.shape.rows, instruction.shape.cols);
  const bool strict = instruction.attributes[0] != 0;
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double difference = (*operands[0])(i);
    const bool holds = strict ? difference > 0 : difference >= 0;
    out(i) = (*operands[holds ? 1 : 2])(i);
  }
}

}  // namespace

void RealAlgebra::apply(const Instruction& instruction, std::span<const Matrix* const> operands,
                        Matrix& out) const {
  const Shape shape = instruction.shape;
  const auto& attributes = instruction.attributes;
  const auto a = [&]() -> const Matrix& { return *operands[0]; };
  const auto b = [&]() -> const Matrix& { return *operands[1]; };
  switch (instruction.op) {
    case Op::constant:
      out = Matrix::Constant(1, 1, round_constant(instruction));
      break;
    case Op::input:
    case Op::call:
      throw std::logic_error("an input is not computed");
    case Op::zeros:
      out.setZero(shape.rows, shape.cols);
      break;
    case Op::fill:
      out.setConstant(shape.rows, shape.cols, a()(0, 0));
      break;
    case Op::identity:
      out = a()(0, 0) * Matrix::Identity(shape.rows, shape.cols);
      break;
    case Op::add:
      out = a() + b();
      break;
    case Op::subtract:
      out = a() - b();
      break;
    case Op::negate:
      out = -a();
      break;
    case Op::multiply:
      multiply(a(), b(), out);
      break;
    case Op::scale:
      out = a()(0, 0) * b();
      break;
    case Op::divide:
      divide(a(), b()(0, 0), out);
      break;
    case Op::power:
      power(a(), attributes[0], out);
      break;
    case Op::scalar_power:
      out = Matrix::Constant(1, 1, std::pow(a()(0, 0), b()(0, 0)));
      break;
    case Op::transpose:
      out = a().transpose();
      break;
    case Op::blocks:
      blocks(instruction, operands, out);
      break;
    case Op::index:
      out = a().block(attributes[0], attributes[2], attributes[1] - attributes[0],
                      attributes[3] - attributes[2]);
      break;
    case Op::exp:
      out = a().array().exp();
      break;
    case Op::log:
      require_domain(a(), (a().array() > 0).all(), "log");
      out = a().array().log();
      break;
    case Op::sqrt:
      require_domain(a(), (a().array() >= 0).all(), "sqrt");
      out = a().array().sqrt();
      break;
    case Op::sin:
      out = a().array().sin();
      break;
    case Op::cos:
      out = a().array().cos();
      break;
    case Op::tanh:
      out = a().array().tanh();
      break;
    case Op::abs:
      out = a().cwiseAbs();
      break;
    case Op::sign:
      out = a().array().sign();
      break;
    case Op::minimum:
      out = a().cwiseMin(b());
      break;
    case Op::maximum:
      out = a().cwiseMax(b());
      break;
    case Op::where:
      where(instruction, operands, out);
      break;
    case Op::trace:
      out = Matrix::Constant(1, 1, a().trace());
      break;
    case Op::norm:
      out = Matrix::Constant(1, 1, norm(a()));
      break;
    case Op::inverse:
      inverse(a(), instruction.text, out);
      break;
    case Op::pseudo_inverse:
      pseudo_inverse(a(), out);
      break;
    case Op::matrix_exponential:
      matrix_exponential(a(), out);
      break;
    case Op::diagonal_matrix:
      out = Eigen::VectorXd(a().reshaped()).asDiagonal();
      break;
    case Op::diagonal_of:
      out = a().diagonal();
      break;
    case Op::singular_values:
      out = singular_values(a());
      break;
    case Op::range_basis:
      range_basis(a(), shape.cols, out);
      break;
    case Op::kernel_basis:
      kernel_basis(a(), shape.cols, out);
      break;
  }
  if (!out.allFinite())
    throw EvaluationError("the " + to_string(instruction.op) + " is not a finite number");
}

Matrix evaluate(const expr::Program& program, const Values& values) {
  expr::Evaluator<RealAlgebra> evaluator(program);
  for (const expr::Input& input : program.inputs) {
    const auto found = values.find(input.name);
    if (found != values.end()) evaluator.set(input.name, found->second);
  }
  return evaluator.run();
}

double KnownDoubles::number(const expr::Program& program) const {
  return evaluate(program, values_)(0, 0);
}

int KnownDoubles::rank(const expr::Program& matrix, const expr::Program* tolerance) const {
  return numerical_rank(evaluate(matrix, values_), tolerance != nullptr ? number(*tolerance) : -1);
}

int numerical_rank(const Matrix& matrix, double tolerance) {
  if (matrix.size() == 0) return 0;
  if (tolerance < 0)
    tolerance = static_cast<double>(std::max(matrix.rows(), matrix.cols())) *
                std::numeric_limits<double>::epsilon();
  const Eigen::VectorXd values = singular_values(matrix);
  const double threshold = tolerance * values.maxCoeff();
  return static_cast<int>((values.array() > threshold).count());
}

}  // namespace gainsmith::numbers
