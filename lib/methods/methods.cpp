#include "methods/methods.h"

namespace gainsmith::methods {

std::optional<std::string> find(std::string_view name) {
  for (const Text& text : all())
    if (text.name == name) return std::string(text.text);
  return std::nullopt;
}

std::string example(std::string_view name) {
  for (const Text& text : all())
    if (text.name == name) return std::string(text.example);
  return {};
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const Text& text : all()) result.emplace_back(text.name);
  return result;
}

}  // namespace gainsmith::methods
