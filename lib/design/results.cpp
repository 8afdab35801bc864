#include "design/results.h"

#include "expr/compile.h"

namespace gainsmith::design {

Results::Results(const model::Instance& instance, const model::Gains& gains)
    : stated_(model::state(instance, gains)) {
  for (const auto& [name, matrix] : stated_.values)
    if (const auto symbol = stated_.scope.symbols.find(name); symbol != stated_.scope.symbols.end())
      symbol->second.value = matrix;
  stated_.scope.symbols["objective"] = {{}, std::nullopt};
  if (gains.objective) stated_.values["objective"] = numbers::Matrix::Constant(1, 1, *gains.objective);
}

std::optional<numbers::Matrix> Results::value(const expr::Expression& expression) const {
  const auto program = expr::compile(expression, stated_.scope);
  for (const expr::Input& input : program.inputs)
    if (!stated_.values.contains(input.name)) return std::nullopt;
  return numbers::evaluate(program, stated_.values);
}

}  // namespace gainsmith::design
