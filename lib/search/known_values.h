// Values of functions of points, kept so that a search that was stopped goes on from them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gainsmith::search {

/// May be used from several threads at once.
class KnownValues {
 public:
  using Value = std::optional<double>;
  /// The name of a function, and the bits of its arguments: NaN is one of them too.
  using Key = std::pair<std::string, std::vector<std::uint64_t>>;

  /// What is known of a function at a point, or else what `ask` gives. An exception of `ask` leaves
  /// nothing.
  Value value(const std::string& function, const std::vector<double>& point,
              const std::function<Value()>& ask);

  void add(Key key, Value value) { values_.emplace(std::move(key), value); }
  const std::map<Key, Value>& all() const { return values_; }

  /// Called after each new value; meanwhile there is no other.
  std::function<void()> grown;

 private:
  std::mutex mutex_;
  std::map<Key, Value> values_;
};

}  // namespace gainsmith::search
