// Lists of things that have a name.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace gainsmith {

/// The first of the name; nullptr: none.
template <class List>
auto* find_named(List& list, const auto& name) {
  const auto found = std::ranges::find_if(list, [&](const auto& one) { return one.name == name; });
  return found == std::end(list) ? nullptr : &*found;
}

template <class List>
bool has_named(const List& list, const auto& name) {
  return find_named(list, name) != nullptr;
}

template <class List>
std::vector<std::string> names_of_all(const List& list) {
  std::vector<std::string> names;
  names.reserve(std::size(list));
  for (const auto& one : list) names.emplace_back(one.name);
  return names;
}

}  // namespace gainsmith
