#include "bind/system_figures.h"

#include "bind/dynamics_binding.h"
#include "bind/formulas.h"
#include "expr/binding/compile.h"

namespace gainsmith::bind {

namespace {

/// A picture shows a system at fixed values: states and noise have none.
void refuse_moving(const expr::Program& program, const expr::Scope& scope, const Place& place) {
  for (const expr::Input& input : program.inputs)
    if (const auto found = scope.symbols.find(input.name);
        found != scope.symbols.end() && found->second.moves)
      throw InputError(place,
                       "figures: '" + input.name +
                           "' moves in a run; a linear system is of data, gains and unknowns");
}

/// One system [A, B; C, D] with its label. InputError where it has no input or no output.
model::SystemFigure::System system(const model::SystemFigureText::System& text,
                                   model::SystemPicture kind, const expr::Scope& scope) {
  const Place place = text.text.place(*text.text.root);
  const expr::CompiledSystem compiled = expr::compile_system(text.text, scope);
  refuse_moving(compiled.matrix, scope, place);
  const expr::Shape shape = compiled.matrix.shape();
  const int outputs = shape.rows - compiled.states, inputs = shape.cols - compiled.states;
  if (inputs == 0 || outputs == 0)
    throw InputError(place, "figures: '" + text.label + "' has no input or no output");
  if (kind_of(kind).single && (inputs != 1 || outputs != 1))
    throw InputError(place, "figures: " + to_string(kind) + " is of one input and one output; '" +
                                text.label + "' has " + std::to_string(inputs) + " and " +
                                std::to_string(outputs));
  return {text.label, compiled.matrix, compiled.states, compiled.step, place};
}

/// Names the plant's values of uncertain data, "plant.k", as numbers that rest.
void add_varied(Binding& binding, expr::Scope& scope) {
  const std::vector<model::UncertainText>& uncertain = binding.problem().uncertain;
  model::Dynamics& varied = binding.design->varied;
  if (const auto& dynamics = binding.design->dynamics) {
    // They are its first noise.
    for (const model::Dynamics::Variable& variable : dynamics->variables)
      if (variable.kind == model::Dynamics::VariableKind::noise && variable.of < uncertain.size())
        varied.variables.push_back(variable);
    varied.noise.assign(dynamics->noise.begin(), dynamics->noise.begin() + std::ssize(uncertain));
  } else {
    varied = DynamicsBinding(binding.method(), binding.design->dimensions, *binding.dynamics_names,
                             uncertain, binding.data_texts, scope)
                 .varied();
  }
  for (const model::Dynamics::Noise& one : varied.noise) scope.symbols[one.name].moves = false;
}

/// Of a number that a scan may change: one of the plant alone too, "plant.k".
model::Range scanned(const model::ScalarRange& text, const Binding& binding) {
  const std::vector<model::Dynamics::Noise>& varied = binding.design->varied.noise;
  const auto found = std::ranges::find(varied, text.name, &model::Dynamics::Noise::name);
  if (found != varied.end() && found->shape.is_scalar()) return range(text, binding.names->known);
  model::check_scalar_name(*binding.design, text.name, text.place);
  return range(text, binding.names->known);
}

}  // namespace

/// A picture varies where a system of it reads uncertain data. It has either a scan or such
/// variation.
void bind_system_figures(Binding& binding) {
  if (binding.problem().figures.empty()) return;
  expr::Scope scope = binding.names->running;
  add_varied(binding, scope);
  for (const model::SystemFigureText& text : binding.problem().figures) {
    model::SystemFigure figure;
    figure.name = text.name;
    figure.kind = text.kind;
    figure.title = text.title.empty() ? text.name : text.title;
    figure.place = text.place;
    for (const model::SystemFigureText::System& one : text.systems)
      figure.systems.push_back(system(one, text.kind, scope));
    for (const model::SystemFigure::System& system : figure.systems)
      if (figure.kind == model::SystemPicture::poles &&
          system.step.has_value() != figure.systems.front().step.has_value())
        throw InputError(system.place, "figures: " + text.name +
                                           ": poles of continuous and of sampled systems need two "
                                           "pictures");
    for (const model::SystemFigure::System& system : figure.systems)
      for (const model::Dynamics::Noise& noise : binding.design->varied.noise)
        figure.varies = figure.varies || system.matrix.uses(noise.name);
    if (text.over)
      figure.over = {scalar(text.over->first, scope), scalar(text.over->second, scope)};
    if (text.scan) figure.scan = scanned(*text.scan, binding);
    if (figure.scan && figure.scan->name.starts_with("plant.")) figure.varies = false;
    if (figure.scan && figure.varies)
      throw InputError(text.place, "figures: " + text.name +
                                       ": either a scan, or the plant's uncertain data: two "
                                       "pictures");
    binding.design->pictures.push_back(std::move(figure));
  }
}

}  // namespace gainsmith::bind
