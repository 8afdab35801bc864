// The methods as text, built into the program: every *.yaml file of this room.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gainsmith::methods {

struct Text {
  std::string_view name;  ///< of the file, without .yaml; equal to its `method:`
  std::string_view text;
  std::string_view example;  ///< the problem that the method names as its example
};

/// In alphabetical order.
std::span<const Text> all();

std::optional<std::string> find(std::string_view name);

/// The problem that the method names as its example. `name` is one of names().
std::string example(std::string_view name);

std::vector<std::string> names();

}  // namespace gainsmith::methods
