#include "base/error.h"

#include <utility>

#include "base/visible.h"

namespace gainsmith {

std::string to_string(const Place& place) {
  std::string text = visible(place.file, "");
  if (place.line > 0) text += ":" + std::to_string(place.line);
  if (place.line > 0 && place.column > 0) text += ":" + std::to_string(place.column);
  return text;
}

namespace {

std::string with_place(const Place& place, const std::string& message) {
  const std::string where = to_string(place);
  return where.empty() ? message : where + ": " + message;
}

}  // namespace

InputError::InputError(Place place, const std::string& message)
    : std::runtime_error(with_place(place, visible(message))),
      place_(std::move(place)),
      message_(visible(message)) {}

}  // namespace gainsmith
