#include "bind/data_names.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/named.h"
#include "base/nearest.h"
#include "expr/text/rename.h"

namespace gainsmith::bind {

/// Suggestions leave out what is given already.
void refuse_unknown_names(const Binding& binding) {
  const auto data = names_of_all(binding.method().data);
  const auto parameters = names_of_all(binding.method().parameters);
  const auto refuse = [&](const std::vector<model::Value>& values,
                          const std::vector<std::string>& known,
                          const std::vector<std::string>& elsewhere, const char* what,
                          const char* key, const char* other) {
    for (const model::Value& value : values) {
      if (std::find(known.begin(), known.end(), value.name) != known.end()) continue;
      // What is given already is no misspelling of this one.
      std::vector<std::string> missing;
      for (const std::string& one : known)
        if (!has_named(values, one)) missing.push_back(one);
      const bool misplaced =
          std::find(elsewhere.begin(), elsewhere.end(), value.name) != elsewhere.end();
      throw InputError(
          value.place,
          "the method " + binding.method().name + " has no " + what + " '" + value.name + "'" +
              (misplaced       ? "; write it under '" + std::string(other) + "'"
               : known.empty() ? "; declare it under '" + std::string(key) +
                                     "' of the method with its shape, such as " + value.name +
                                     ": scalar or n x p; only what the problem's own texts use "
                                     "needs no declaration"
                               : suggestion(value.name, missing.empty() ? known : missing)));
    }
  };
  refuse(binding.problem().data, data, parameters, "datum", "data", "parameters");
  for (const model::Let& function : binding.problem().functions) {
    const std::string& name = function.signature.name;
    if (!data.empty() && !nearest(name, data) &&
        std::find(data.begin(), data.end(), name) == data.end())
      throw InputError(function.place,
                       "the method " + binding.method().name + " has no datum '" + name +
                           "'; a part of a formula is named under 'let' of the problem");
    refuse({{name, function.body, false, function.place}}, data, parameters, "datum", "data",
           "parameters");
  }
  refuse(binding.problem().parameters, parameters, data, "parameter", "parameters", "data");
}

/// Data are evaluated in the order of their declarations.
void refuse_later_data(const Binding& binding, const model::Value& value) {
  const auto& data = binding.method().data;
  const auto self = std::find_if(data.begin(), data.end(),
                                 [&](const auto& datum) { return datum.name == value.name; });
  if (self == data.end()) return;
  expr::visit_names(value.value, [&](const expr::Node& node) {
    const bool later = std::any_of(self + 1, data.end(),
                                   [&](const auto& datum) { return datum.name == node.text; });
    if (later && !binding.names->known.symbols.contains(node.text))
      throw InputError(value.value.place(node), "unknown name '" + node.text +
                                                    "' here: the method declares it after " +
                                                    value.name + ", and data use data before them");
  });
}

}  // namespace gainsmith::bind
