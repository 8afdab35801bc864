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
  std::map<std::string, std::string> shapes;
  for (const Design::Datum& datum : design.data) shapes[datum.name] = datum.declared;
  check_scalar_name(design.method, scalar_names(design), shapes, name, place);
}

}  // namespace gainsmith::model
