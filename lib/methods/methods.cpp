#include "methods/methods.h"

#include "base/named.h"

namespace gainsmith::methods {

std::optional<std::string> find(std::string_view name) {
  const auto texts = all();
  const Text* found = find_named(texts, name);
  return found == nullptr ? std::nullopt : std::optional<std::string>(found->text);
}

std::string example(std::string_view name) {
  const auto texts = all();
  const Text* found = find_named(texts, name);
  return found == nullptr ? "" : std::string(found->example);
}

std::vector<std::string> names() { return names_of_all(all()); }

}  // namespace gainsmith::methods
