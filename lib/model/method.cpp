#include "model/method.h"

#include <map>

#include "model/names.h"

namespace gainsmith::model {

const std::vector<std::string>& tasks() {
  static const std::vector<std::string> kTasks = {
      "state feedback", "observers",    "output feedback", "nonlinear plants",
      "analysis",       "sampled data", "switched plants", "hybrid plants"};
  return kTasks;
}

std::string timer_name(const Method& method) {
  for (const EventText& event : method.events)
    if (!event.left.empty()) return event.left;
  return {};
}

std::vector<std::string> scalar_names(const Method& method) {
  std::vector<std::string> names;
  for (const Declaration& datum : method.data)
    if (datum.shape.structure == Structure::scalar && datum.indices.empty() &&
        datum.arguments.empty())
      names.push_back(datum.name);
  for (const Parameter& parameter : method.parameters) names.push_back(parameter.name);
  return names;
}

void check_scalar_name(const Method& method, const std::string& name, const Place& place) {
  std::map<std::string, std::string> shapes;
  for (const Declaration& datum : method.data) {
    shapes[datum.name] = datum.shape.text;
    if (datum.indices.empty() || datum.shape.structure != Structure::scalar) continue;
    if (is_numbered(name, datum.name)) return;
    if (name == datum.name)
      throw InputError(place,
                       "'" + name + "' is a family of scalars; one of them is " + name + "_1");
  }
  check_scalar_name(method.name, scalar_names(method), shapes, name, place);
}

}  // namespace gainsmith::model
