// Work that may crash, hang or ask for all memory: a library that reads what nobody has checked.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace gainsmith {

/// The text that `work` gives, done in a process of its own; none when that process crashed, took
/// more than 20 s, or more than 200 MB beyond what this one has. An InputError of `work` is thrown
/// here, too. What `work` needs loaded should be loaded before.
std::optional<std::string> in_own_process(const std::function<std::string()>& work);

}  // namespace gainsmith
