// How the name of an estimate tells what it estimates: pictures and exported code read it so.
#pragma once

#include <string>

namespace gainsmith::model {

/// Whether the name says that it estimates `what`: "xh" or "x_hat" of "x".
inline bool is_estimate_name(const std::string& name, const std::string& what) {
  return name == what + "h" || name == what + "_hat";
}

}  // namespace gainsmith::model
