// Checks of option values that CLI11 does not bring.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gainsmith::app {

/// Digits only: CLI11 itself would take -1 for the largest unsigned number.
inline CLI::Validator whole_number() {
  return {[](std::string& text) {
            const bool digits =
                !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
            return digits ? std::string()
                          : "expected a whole number, at least 0, not '" + text + "'";
          },
          "WHOLE"};
}

}  // namespace gainsmith::app
