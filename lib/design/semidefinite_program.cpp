#include "design/semidefinite_program.h"

#include "base/number.h"
#include "design/facial_reduction.h"
#include "design/sos_statements.h"
#include "design/sums_of_squares.h"
#include "lmi/formulation.h"

namespace gainsmith::design {

namespace {

std::string variable(int i) { return "x_" + std::to_string(i); }

/// What the objective and the last variables mean.
std::vector<std::string> goal_remarks(const lmi::Lmi& lmi, const lmi::Formulation& formulation) {
  const std::string margin = variable(formulation.variables);
  if (formulation.goal == lmi::Goal::interior)
    return {"The largest margin " + margin + " of the inequalities is wanted, all scaled together" +
                (formulation.homogenised
                     ? ", their constant parts by " + variable(formulation.variables - 1) + "."
                     : "."),
            margin + " > 0: they have a strict solution. " + margin +
                " = 0: the multipliers Y show that they have none."};
  std::vector<std::string> remarks = {
      "Objective of the problem = (c'x)/" + brief(formulation.cost_unit, 17) +
      (lmi.objective_constant == 0 ? "" : " + " + brief(lmi.objective_constant, 17)) + "."};
  if (formulation.shift != 0)
    remarks.push_back(
        std::string(formulation.only_strict ? "Strict inequalities" : "Inequalities") +
        " hold with a margin: B >= " + brief(formulation.shift, 17) + " I in these units.");
  return remarks;
}

std::vector<std::string> remarks(const lmi::Inequalities& inequalities, const lmi::Lmi& lmi,
                                 const lmi::Formulation& formulation) {
  std::vector<std::string> result = {
      "Written by gainsmith in balanced units: rows of the inequalities and scalars of the "
      "unknowns are multiplied by "
      "powers of 2."};
  for (std::string& remark : goal_remarks(lmi, formulation)) result.push_back(std::move(remark));
  const std::string one = formulation.homogenised ? "/" + variable(formulation.variables - 1) : "";
  for (int i = 1; i <= lmi.unknowns; ++i) {
    const std::string name = inequalities.unknowns.scalar_name(i);
    result.push_back(formulation.free_variables.contains(i)
                         ? name + " is left out: nothing keeps it from what suits its rows."
                         : name + " = " + brief(formulation.balance.unit(i), 17) + "*" +
                               variable(i) + one);
  }
  return result;
}

}  // namespace

SemidefiniteProgram semidefinite_program(const model::Instance& instance) {
  if (instance.design->inequalities.empty())
    throw InputError({instance.design->method_file, 0, 0},
                     "the method requires nothing, so there is no semidefinite program");
  if (instance.design->quotient)
    throw InputError(instance.design->quotient->place,
                     "minimize: " + instance.design->quotient->text +
                         " is solved by several semidefinite programs; there is no one to write");
  const lmi::Inequalities inequalities(instance);
  if (has_sums_of_squares(*instance.design)) return program_of_sums_of_squares(inequalities);
  const model::SynthesisOptions& choices = inequalities.design().synthesis;
  const lmi::Lmi lmi = lmi::compile(inequalities);
  const lmi::GainBounds bounds = lmi::gain_bounds(inequalities, lmi);
  lmi::Formulation formulation = lmi::has_minimum(lmi, bounds)
                                     ? lmi::pose_objective(lmi, bounds, choices.margin)
                                     : lmi::pose_interior(lmi, bounds);
  // Beside equations what is not strict may have no margin at all.
  formulation.only_strict = states_equations(lmi);
  lmi::assemble(lmi, bounds, {}, formulation);
  return {std::move(formulation.problem), remarks(inequalities, lmi, formulation)};
}

}  // namespace gainsmith::design
