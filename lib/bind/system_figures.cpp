#include "bind/system_figures.h"

#include "bind/formulas.h"
#include "expr/compile.h"

namespace gainsmith::bind {

namespace {

void refuse_moving(const expr::Program& program, const expr::Scope& scope, const Place& place) {
  for (const expr::Input& input : program.inputs)
    if (const auto found = scope.symbols.find(input.name);
        found != scope.symbols.end() && found->second.moves)
      throw InputError(place,
                       "figures: '" + input.name +
                           "' moves in a run; a linear system is of data, gains and unknowns");
}

model::SystemFigure::System system(const model::SystemFigureText::System& text,
                                   model::SystemPicture kind, const expr::Scope& scope) {
  const Place place = text.text.place(*text.text.root);
  const expr::CompiledSystem compiled = expr::compile_system(text.text, scope);
  refuse_moving(compiled.matrix, scope, place);
  const expr::Shape shape = compiled.matrix.shape();
  const int outputs = shape.rows - compiled.states, inputs = shape.cols - compiled.states;
  if (inputs == 0 || outputs == 0)
    throw InputError(place, "figures: '" + text.label + "' has no input or no output");
  if (kind == model::SystemPicture::nyquist && (inputs != 1 || outputs != 1))
    throw InputError(place, "figures: nyquist is of one input and one output; '" + text.label +
                                "' has " + std::to_string(inputs) + " and " +
                                std::to_string(outputs));
  return {text.label, compiled.matrix, compiled.states, compiled.step, place};
}

}  // namespace

void bind_system_figures(Binding& binding) {
  const expr::Scope& scope = binding.names->running;
  for (const model::SystemFigureText& text : binding.problem().figures) {
    model::SystemFigure figure{text.name, text.kind, {}, std::nullopt, text.place};
    for (const model::SystemFigureText::System& one : text.systems)
      figure.systems.push_back(system(one, text.kind, scope));
    if (text.over)
      figure.over = {scalar(text.over->first, scope), scalar(text.over->second, scope)};
    binding.design->pictures.push_back(std::move(figure));
  }
}

}  // namespace gainsmith::bind
