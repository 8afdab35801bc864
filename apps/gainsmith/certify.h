// The second program, scripts/certify: Python that proves what gain files say and shares nothing with
// this program (docs/trust.md).
#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace gainsmith::app {

/// InputError when python3 or the folder is not there.
void require_certify();

/// Its answer about gain files, with its own options: yes when all is proved, no when something is
/// refuted, undecided when something is open. It prints to standard output. InputError as above.
ExitCode certify(std::vector<std::string> arguments);

}  // namespace gainsmith::app
