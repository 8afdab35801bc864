#include "search/known_values.h"

#include <bit>

namespace gainsmith::search {

KnownValues::Value KnownValues::value(const std::string& function, const std::vector<double>& point,
                                      const std::function<Value()>& ask) {
  Key key{function, {}};
  for (const double argument : point) key.second.push_back(std::bit_cast<std::uint64_t>(argument));
  {
    const std::scoped_lock lock(mutex_);
    if (const auto known = values_.find(key); known != values_.end()) return known->second;
  }
  // Not under the lock: several threads may ask the same at once, and the first answer stays.
  const Value found = ask();
  const std::scoped_lock lock(mutex_);
  if (values_.emplace(std::move(key), found).second && grown) grown();
  return found;
}

}  // namespace gainsmith::search
