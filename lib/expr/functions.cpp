#include "expr/functions.h"

#include <array>

namespace gainsmith::expr {

namespace {

using enum FunctionId;

constexpr std::array<Function, 29> kFunctions = {{
    {He, "He", 1, 1, "He(M)", "M + M'"},
    {inv, "inv", 1, 1, "inv(M)", "the inverse"},
    {pinv, "pinv", 1, 1, "pinv(M)", "the Moore-Penrose inverse"},
    {expm, "expm", 1, 1, "expm(M)", "the matrix exponential"},
    {exp, "exp", 1, 1, "exp(x)", "element by element"},
    {log, "log", 1, 1, "log(x)", "natural logarithm, element by element"},
    {sqrt, "sqrt", 1, 1, "sqrt(x)", "element by element"},
    {sin, "sin", 1, 1, "sin(x)", "element by element, radians"},
    {cos, "cos", 1, 1, "cos(x)", "element by element, radians"},
    {tanh, "tanh", 1, 1, "tanh(x)", "element by element"},
    {abs, "abs", 1, 1, "abs(x)", "element by element"},
    {sign, "sign", 1, 1, "sign(x)", "-1, 0 or 1, element by element"},
    {min, "min", 2, -1, "min(a, b, ...)", "the smaller, element by element"},
    {max, "max", 2, -1, "max(a, b, ...)", "the larger, element by element"},
    {clip, "clip", 3, 3, "clip(x, lo, hi)", "min(max(x, lo), hi)"},
    {where, "where", 3, 3, "where(a > b, x, y)", "x where the comparison holds, y elsewhere"},
    {trace, "trace", 1, 1, "trace(M)", "the sum of the diagonal"},
    {norm, "norm", 1, 1, "norm(M)", "the largest singular value; the length of a vector"},
    {eye, "eye", 1, 1, "eye(n)", "the n x n identity"},
    {zeros, "zeros", 1, 2, "zeros(n, m)", "zeros; zeros(n) is n x n"},
    {ones, "ones", 1, 2, "ones(n, m)", "ones; ones(n) is n x n"},
    {diag, "diag", 1, 1, "diag(v)", "the diagonal matrix of a vector; the diagonal of a matrix"},
    {blkdiag, "blkdiag", 1, -1, "blkdiag(A, B, ...)", "the block-diagonal matrix"},
    {orth, "orth", 1, 2, "orth(M, tol)",
     "orthonormal basis of the range; singular values above tol (relative) count"},
    {null, "null", 1, 2, "null(M, tol)", "orthonormal basis of the kernel"},
    {svd, "svd", 1, 1, "svd(M)", "the singular values, largest first, as a column"},
    {obsv, "obsv", 2, 2, "obsv(A, C)", "[C; C*A; ...; C*A^(n-1)]"},
    {gramian, "gramian", 5, 5, "gramian(F, Hc, J, Hd, t)",
     "observability Gramian over flows of the lengths t, of the state at their start"},
    {backward_gramian, "backward_gramian", 5, 5, "backward_gramian(F, Hc, J, Hd, t)",
     "the same of the state at their end; J must be invertible"},
}};

}  // namespace

std::span<const Function> functions() { return kFunctions; }

const Function* find_function(std::string_view name) {
  for (const Function& function : kFunctions)
    if (function.name == name) return &function;
  return nullptr;
}

bool is_reserved(std::string_view name) {
  return name == "I" || name == "pi" || find_function(name) != nullptr;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  names.reserve(kFunctions.size());
  for (const Function& function : kFunctions) names.emplace_back(function.name);
  return names;
}

}  // namespace gainsmith::expr
