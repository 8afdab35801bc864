#include "gainsmith/system_figures.h"

#include <algorithm>

#include "base/named.h"
#include "base/nearest.h"
#include "bind/stated.h"
#include "gainsmith/drawn_systems.h"
#include "gainsmith/system_bands.h"
#include "gainsmith/system_facts.h"
#include "gainsmith/system_scan.h"

namespace gainsmith::app {

namespace {

using model::SystemFigure;

/// The figure of this name and kind.
const SystemFigure* like(const SystemFigure& figure, const model::Design& design) {
  const SystemFigure* found = find_named(design.pictures, figure.name);
  return found != nullptr && found->kind == figure.kind ? found : nullptr;
}

SystemResult empty_result(const SystemFigure& figure, const std::string& name,
                          const std::string& title) {
  SystemResult result;
  result.name = name;
  result.figure.title = title;
  result.data = {{"name", name}, {"kind", to_string(figure.kind)}};
  return result;
}

/// All systems of the designs in one picture.
SystemResult result_of(const SystemFigure& figure, const std::vector<NamedDesign>& designs) {
  SystemResult result = empty_result(figure, figure.name, figure.title);
  std::vector<DrawnSystem> systems;
  for (std::size_t k = 0; k < designs.size(); ++k) {
    const SystemFigure* own = like(figure, *designs[k].loaded.stated.design);
    if (own == nullptr) continue;
    auto found = systems_of(*own, nominal(designs[k].loaded), result.missing);
    if (!found) return result;
    for (DrawnSystem& drawn : *found) {
      drawn.design = k;
      drawn.own_label = drawn.label;
      drawn.label = designs[k].label(drawn.label);
      systems.push_back(std::move(drawn));
    }
  }
  const auto range = range_of(figure, nominal(designs.front().loaded), systems);
  for (DrawnSystem& drawn : systems) {
    compute(figure, range, drawn);
    add_facts(drawn, figure.kind, result);
  }
  const std::string title = result.figure.title;
  result.figure = system_picture(figure.kind, systems);
  result.figure.title = title;
  if (figure.varies)
    add_bands(figure, *designs.front().loaded.stated.design, nominal(designs.front().loaded), range,
              result);
  return result;
}

}  // namespace

std::vector<SystemResult> system_results(const std::vector<NamedDesign>& designs,
                                         const std::vector<std::string>& names) {
  const std::vector<SystemFigure>& all = designs.front().loaded.stated.design->pictures;
  for (const std::string& name : names)
    if (!has_named(all, name))
      throw InputError({"--figure"}, "the problem has no figure '" + name + "'" +
                                         suggestion(name, names_of_all(all)));
  std::vector<SystemResult> results;
  for (const SystemFigure& figure : all) {
    if (!names.empty() && std::find(names.begin(), names.end(), figure.name) == names.end())
      continue;
    if (!figure.scan && !figure.varies) {
      results.push_back(result_of(figure, designs));
      continue;
    }
    for (std::size_t k = 0; k < designs.size(); ++k) {
      const NamedDesign& design = designs[k];
      const SystemFigure* own = like(figure, *design.loaded.stated.design);
      if (own == nullptr) continue;
      const std::string of = design.name.empty() ? "" : " of " + design.name;
      if (!own->scan) {
        results.push_back(result_of(*own, {{"", design.loaded}}));
      } else {
        results.push_back(empty_result(*own, "", own->title));
        results.back().name = own->name;
        add_scan(*own, design.loaded, results.back());
      }
      for (SystemNumber& number : results.back().numbers) number.design = k;
      results.back().name = own->name + of;
      results.back().figure.title = own->title + of;
      results.back().data["name"] = results.back().name;
    }
  }
  return results;
}

}  // namespace gainsmith::app
