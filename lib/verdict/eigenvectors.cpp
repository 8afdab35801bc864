#include "verdict/eigenvectors.h"

#include <algorithm>
#include <optional>

#include "base/stop.h"
#include "numbers/dense/rational_algebra.h"
#include "numbers/types/rational.h"
#include "verdict/rational_blocks.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::RationalMatrix;
using numbers::RationalValues;

/// The values of the instructions that do not depend on unknowns or variables and are fractions.
/// Those of the text alone, such as I, are left out, and what has long fractions, as iterations
/// have: no eigenvalue of it decides.
std::vector<std::optional<RationalMatrix>> constants_of(const expr::Program& program,
                                                        const RationalValues& known) {
  // Of numerators and denominators.
  constexpr std::size_t kMostBits = 200;
  std::vector<std::optional<RationalMatrix>> values;
  std::vector<bool> is_data;
  for (const expr::Instruction& instruction : program.code) {
    std::optional<RationalMatrix>& value = values.emplace_back();
    if (instruction.op == expr::Op::input) {
      const auto found = known.find(program.input_of(instruction).name);
      if (found != known.end()) value = found->second;
      continue;
    }
    std::vector<const RationalMatrix*> operands;
    for (const int operand : instruction.operands)
      if (const auto& of = values[static_cast<std::size_t>(operand)]) operands.push_back(&*of);
    if (operands.size() < instruction.operands.size()) continue;
    try {
      RationalMatrix result;
      numbers::RationalNumbers().apply(instruction, operands, result);
      if (numbers::most_bits(result) <= kMostBits) value = std::move(result);
    } catch (const expr::EvaluationError&) {
      continue;
    }
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    const expr::Instruction& of = program.code[k];
    bool data = of.op == expr::Op::input;
    for (const int operand : of.operands) data |= is_data[static_cast<std::size_t>(operand)];
    is_data.push_back(data);
    if (!data) values[k].reset();
  }
  return values;
}

constexpr auto kUnnamed = "a matrix of ";

std::string name_of(const expr::Program& program, const expr::Instruction& instruction,
                    const std::string& inequality) {
  if (instruction.op == expr::Op::input) return program.input_of(instruction).name;
  if (instruction.op == expr::Op::transpose)
    if (const auto& of = program.code[static_cast<std::size_t>(instruction.operands[0])];
        of.op == expr::Op::input)
      return name_of(program, of, inequality) + "'";
  return kUnnamed + inequality;
}

RationalMatrix joined(const std::vector<RationalMatrix>& columns) {
  RationalMatrix result(columns.front().rows(), std::ssize(columns));
  for (std::size_t j = 0; j < columns.size(); ++j) result.col(static_cast<Index>(j)) = columns[j];
  return result;
}

/// The Krylov vectors b, A b, A^2 b, ... until they depend on each other: p is the minimal
/// polynomial of b, and V_k = sum over j > k of p_j A^(j-k-1) b.
Eigenvector eigenvector(const RationalMatrix& A, const RationalMatrix& b) {
  std::vector<RationalMatrix> powers = {b};
  RationalMatrix kernel;
  while (kernel = numbers::rational_kernel(joined(powers)), kernel.cols() == 0)
    powers.push_back(numbers::rational_product(A, powers.back()));
  const Index d = kernel.rows() - 1;
  Eigenvector result;
  for (Index k = 0; k <= d; ++k) result.p.push_back(kernel(k, 0) / kernel(d, 0));
  result.V = RationalMatrix::Constant(A.rows(), d, Rational(0));
  for (Index k = 0; k < d; ++k)
    for (Index j = k + 1; j <= d; ++j)
      for (Index i = 0; i < A.rows(); ++i)
        result.V(i, k) +=
            result.p[static_cast<std::size_t>(j)] * powers[static_cast<std::size_t>(j - k - 1)](i);
  return result;
}

/// V e in powers up to those of a factor of degree f, n x f: l^k e_f = C^k e_f with the factor's
/// companion matrix C, so l^k is the first row of C^k times e_f.
RationalMatrix reduced(const RationalMatrix& V, const Polynomial& factor) {
  const RationalMatrix C = companion(factor);
  RationalMatrix power = RationalMatrix::Constant(1, C.cols(), Rational(0));
  power(0, 0) = 1;
  RationalMatrix result = RationalMatrix::Constant(V.rows(), C.cols(), Rational(0));
  for (Index k = 0; k < V.cols(); ++k) {
    result += numbers::rational_product(V.col(k), power);
    power = numbers::rational_product(power, C);
  }
  return result;
}

/// A basis of the kernel of the observability matrix (C; C A; ...; C A^(n-1)), n columns at most.
RationalMatrix unobserved(const RationalMatrix& A, const RationalMatrix& C) {
  constexpr double kWork = 5e-7;  // seconds of an operation in the fractions of powers
  const auto n = static_cast<double>(A.rows());
  spend(2 * n * n * n * static_cast<double>(C.rows()) * kWork);
  RationalMatrix all(C.rows() * A.rows(), A.cols()), rows = C;
  for (Index k = 0; k < A.rows(); ++k) {
    all.middleRows(k * C.rows(), C.rows()) = rows;
    rows = numbers::rational_product(rows, A);
  }
  return numbers::rational_kernel(all);
}

}  // namespace

std::vector<NamedMatrix> constant_matrices(const lmi::Inequalities& of) {
  const RationalValues known = rational_values(of.instance);
  std::vector<NamedMatrix> result;
  for (const lmi::Statement& statement : of.statements)
    for (const expr::Program& program : statement.differences) {
      const auto values = constants_of(program, known);
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (!values[k] || values[k]->size() == 0) continue;
        const auto same = [&](const NamedMatrix& other) {
          return other.value.rows() == values[k]->rows() &&
                 other.value.cols() == values[k]->cols() && other.value == *values[k];
        };
        if (std::none_of(result.begin(), result.end(), same))
          result.push_back({name_of(program, program.code[k], statement.stated->name), *values[k]});
      }
    }
  std::ranges::stable_partition(result,
                                [](const NamedMatrix& M) { return !M.name.starts_with(kUnnamed); });
  return result;
}

std::vector<RationalMatrix> starts_of(const RationalMatrix& A,
                                      const std::vector<NamedMatrix>& others) {
  const Index n = A.rows();
  std::vector<RationalMatrix> starts;
  const auto add = [&](const RationalMatrix& basis) {
    for (Index j = 0; j < basis.cols(); ++j) {
      const RationalMatrix b = basis.col(j);
      if (std::ranges::find(starts, b) == starts.end()) starts.push_back(b);
    }
  };
  for (const NamedMatrix& other : others) {
    if (other.value.cols() == n) add(unobserved(A, other.value));
    if (other.value.rows() == n) add(unobserved(A, other.value.transpose()));
  }
  add(RationalMatrix::Identity(n, n));
  return starts;
}

std::vector<Eigenvector> eigenvectors_from(const RationalMatrix& A, const RationalMatrix& b) {
  constexpr double kWork = 2e-6;  // seconds, times n^4
  const auto n = static_cast<double>(A.rows());
  spend(n * n * n * n * kWork);
  const Eigenvector whole = eigenvector(A, b);
  std::vector<Eigenvector> result;
  for (Polynomial& p : factors_to_try(square_free(whole.p))) {
    RationalMatrix V = reduced(whole.V, p);
    result.push_back({std::move(p), std::move(V)});
  }
  return result;
}

}  // namespace gainsmith::verdict
