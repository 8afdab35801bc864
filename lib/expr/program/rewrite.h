// Programs from programs. Every instruction keeps the place that it was written at.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "expr/program/assembly.h"
#include "expr/program/program.h"

namespace gainsmith::expr {

/// What replaces a function of a number: a program in its variable and in other inputs.
struct Body {
  std::string variable;
  Program program;
};

/// Gives the body of a function for one of its calls.
using BodyOf = std::function<const Body&(const std::string& function, const Instruction& call)>;

/// The program with each call replaced by what `body` gives for it, the variable being the call's
/// argument. Bodies may hold calls; those are replaced too. Evaluation needs a program without
/// calls.
Program link(const Program& program, const BodyOf& body);

/// The name of the function that an instruction of the program calls.
const std::string& called_by(const Program& program, const Instruction& call);

/// The calls of a program, in its order.
std::vector<const Instruction*> calls_in(const Program& program);

/// The argument of a call, as a program.
Program argument_of(const Program& program, const Instruction& call);

/// A program put together instruction by instruction, all at one place.
class Composer {
 public:
  explicit Composer(const Place& place);

  /// Each gives the index of an instruction. A decimal is kept as written.
  int number(const std::string& decimal);
  int input(const std::string& name, Shape shape = {});
  int apply(Op op, std::vector<int> operands, Shape shape = {}, std::array<int, 4> attributes = {});
  /// The result of another program over the same inputs.
  int program(const Program& program);
  /// The program of one of them.
  Program take(int result) const { return assembly_.extract(result); }

 private:
  Instruction like_;
  Assembly assembly_;
};

/// sum_k factors[k] * terms[k]: inputs `terms` of one shape, and 1 x 1 programs; a factor without
/// instructions is 1. `place`: of the whole.
Program combination(const std::vector<Program>& factors, const std::vector<std::string>& terms,
                    Shape shape, const Place& place);

/// The program that reads one input.
Program input_program(const std::string& name, Shape shape);

/// program + s * D, with s the 1 x 1 input `name` (1 where there is no name) and D the diagonal
/// matrix of decimals; one alone is for a multiple of I.
Program with_diagonal(const Program& program, const std::vector<std::string>& diagonal,
                      const std::string& name = {});

}  // namespace gainsmith::expr
