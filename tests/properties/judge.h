// A case put to the program.
#pragma once

#include <string>

#include "properties/families.h"

namespace gainsmith::tests::properties {

enum class Outcome { right, undecided, wrong };

struct Answer {
  Outcome outcome = Outcome::right;
  std::string message;
  double seconds = 0;
};

/// Synthesis in this process. What is refused or throws is wrong.
Answer judge(const Case& known);

/// The text with what came of it in its first lines.
std::string record(const Case& known, const Answer& answer);

}  // namespace gainsmith::tests::properties
