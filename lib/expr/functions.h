// The functions of the language: one table, from which binding, messages and help are made.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gainsmith::expr {

enum class FunctionId {
  He,
  inv,
  pinv,
  expm,
  exp,
  log,
  sqrt,
  sin,
  cos,
  tanh,
  abs,
  sign,
  min,
  max,
  clip,
  where,
  trace,
  norm,
  eye,
  zeros,
  ones,
  diag,
  blkdiag,
  orth,
  null,
  svd,
  obsv,
  gramian,
  backward_gramian
};

struct Function {
  FunctionId id;
  std::string_view name;
  int fewest;                ///< arguments
  int most;                  ///< -1: any number
  std::string_view usage;    ///< "clip(x, lo, hi)"
  std::string_view meaning;  ///< one line
};

std::span<const Function> functions();

/// nullptr when there is no function of that name.
const Function* find_function(std::string_view name);

/// Names that a definition, datum or unknown may not take: the functions, I and pi.
bool is_reserved(std::string_view name);

std::vector<std::string> function_names();

}  // namespace gainsmith::expr
