// Programs from programs. Every instruction keeps the place that it was written at.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "expr/program.h"

namespace gainsmith::expr {

/// What a function of a number stands for: a program in its variable and in other inputs.
struct Body {
  std::string variable;
  Program program;
};

/// The program with each call replaced by what `body` gives for it, the variable being the call's
/// argument. Bodies may hold calls; those are replaced too. Evaluation needs a program without
/// calls.
Program link(const Program& program,
             const std::function<const Body&(const Instruction& call)>& body);

/// The name of the function that an instruction of the program calls.
const std::string& called_by(const Program& program, const Instruction& call);

/// The calls of a program, in its order.
std::vector<const Instruction*> calls_in(const Program& program);

/// The argument of a call, as a program.
Program argument_of(const Program& program, const Instruction& call);

/// sum_k factors[k] * terms[k]: inputs `terms` of one shape, and 1 x 1 programs; a program without
/// instructions stands for the factor 1. `place`: of the whole.
Program combination(const std::vector<Program>& factors, const std::vector<std::string>& terms,
                    Shape shape, const Place& place);

/// program + scale * s * I, with s the 1 x 1 input `name` and `scale` a decimal.
Program with_slack(const Program& program, const std::string& name, const std::string& scale);

/// The sum of 1 x 1 inputs.
Program sum_of(const std::vector<std::string>& names, const Place& place);

/// The input itself.
Program input_program(const std::string& name, Shape shape, const Place& place);

/// The number itself.
Program constant_program(const std::string& decimal, const Place& place);

}  // namespace gainsmith::expr
