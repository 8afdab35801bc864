// Internal to api: the errors of the rooms become those of the library.
#pragma once

#include <stdexcept>

#include "api/gainsmith.h"
#include "base/error.h"

namespace gainsmith::api {

/// What `work` returns. Error for its InputError, and for arguments that it finds invalid.
template <class Work>
auto call(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const InputError& error) {
    throw Error(error.what(), error.place().file, error.place().line, error.place().column);
  } catch (const std::invalid_argument& error) {
    throw Error(error.what(), "", 0, 0);
  }
}

}  // namespace gainsmith::api
