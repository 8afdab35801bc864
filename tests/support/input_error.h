// What a test wants to know of bad input: that it is refused with InputError, where and why.
#pragma once

#include <gtest/gtest.h>

#include <ostream>

#include "base/error.h"

namespace gainsmith {

inline void PrintTo(const Place& place, std::ostream* out) { *out << to_string(place); }

}  // namespace gainsmith

namespace gainsmith::tests {

/// The InputError that `action` throws; the test fails when it throws none. Any other exception
/// goes on to GoogleTest, which fails the test too.
template <class Action>
InputError input_error(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error;
  }
  ADD_FAILURE() << "expected an InputError, but nothing was thrown";
  return InputError({}, "");
}

}  // namespace gainsmith::tests
