#include "model/design.h"

#include <algorithm>
#include <map>

#include "model/names.h"

namespace gainsmith::model {

bool Design::Inequality::calls_functions() const {
  return std::any_of(comparisons.begin(), comparisons.end(), [](const Comparison& comparison) {
    return !comparison.difference.functions.empty();
  });
}

bool is_comparison_of(const std::string& comparison, const std::string& inequality) {
  const std::size_t at = std::min(inequality.find(" at "), inequality.size());
  const std::string stem = inequality.substr(0, at) + ".";
  const std::string member = inequality.substr(at);
  if (comparison == inequality) return true;
  if (!comparison.starts_with(stem) || !comparison.ends_with(member)) return false;
  const std::size_t end = comparison.size() - member.size();
  return end > stem.size() && comparison.find_first_not_of("0123456789", stem.size()) >= end;
}

std::vector<std::string> scalar_names(const Design& design) {
  std::vector<std::string> names;
  for (const Design::Datum& datum : design.data)
    if (datum.structure == Structure::scalar) names.push_back(datum.name);
  for (const Design::Datum& parameter : design.parameters) names.push_back(parameter.name);
  return names;
}

void check_scalar_name(const Design& design, const std::string& name, const Place& place) {
  std::map<std::string, std::string> shapes;
  for (const Design::Datum& datum : design.data) shapes[datum.name] = datum.declared;
  check_scalar_name(design.method, scalar_names(design), shapes, name, place);
}

bool has_end(const Design& design) {
  return design.campaign.horizon || (design.dynamics && !design.dynamics->measured.empty());
}

bool ends(const Design& design) {
  return has_end(design) || (design.dynamics && design.dynamics->has_timer);
}

}  // namespace gainsmith::model
