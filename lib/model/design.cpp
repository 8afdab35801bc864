#include "model/design.h"

#include <algorithm>

#include "base/nearest.h"

namespace gainsmith::model {

bool Design::Inequality::calls_functions() const {
  return std::any_of(comparisons.begin(), comparisons.end(), [](const Comparison& comparison) {
    return !comparison.difference.functions.empty();
  });
}

const Design::Inequality* find_inequality(const Design& design, const std::string& name) {
  for (const Design::Inequality& inequality : design.inequalities)
    if (inequality.name == name) return &inequality;
  return nullptr;
}

std::vector<std::string> scalar_names(const Design& design) {
  std::vector<std::string> names;
  for (const Design::Datum& datum : design.data)
    if (datum.structure == Structure::scalar) names.push_back(datum.name);
  for (const Design::Datum& parameter : design.parameters) names.push_back(parameter.name);
  return names;
}

void check_scalar_name(const Design& design, const std::string& name, const Place& place) {
  const std::vector<std::string> known = scalar_names(design);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  for (const Design::Datum& datum : design.data)
    if (datum.name == name)
      throw InputError(place, "'" + name + "' is a matrix (" + datum.declared +
                                  "); expected a scalar datum or parameter");
  throw InputError(place, "the method " + design.method + " has no scalar datum or parameter '" +
                              name + "'" + suggestion(name, known));
}

}  // namespace gainsmith::model
