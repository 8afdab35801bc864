#include "statistics/bound_figure.h"

#include <utility>
#include <vector>

namespace gainsmith::statistics {

BoundFigure::BoundFigure(const model::Figure& figure, const claims::RunSetup& setup) {
  std::optional<claims::RunValue> value;
  if (figure.value) {
    program_ = setup.texts.stated.bodies.link(figure.value->program);
    for (const expr::Input& input : program_->inputs)
      if (!setup.system.slot(input.name) && !setup.system.constants.contains(input.name))
        throw InputError(figure.value->place, "there is no value for " + input.name);
    value.emplace(*program_, setup.layout, setup.system.constants);
  }
  std::vector<double> constants;
  for (const model::Formula& number : figure.numbers)
    constants.push_back(setup.system.scalar(number));
  std::optional<Eigen::Index> passes;
  if (figure.kind == model::FigureKind::passes) {
    const std::string& event = setup.system.dynamics.events[figure.event].name;
    if (const auto slot = setup.system.slot(expr::event_number("passes", event)))
      passes = setup.system.layout.slots[*slot].offset;
  }
  number_.emplace(figure.kind, std::move(value), std::move(constants), figure.event, figure.count,
                  figure.after, passes);
}

}  // namespace gainsmith::statistics
