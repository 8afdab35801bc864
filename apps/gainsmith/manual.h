// The manual page, made from the records of the commands.
#pragma once

#include <string>

#include "gainsmith/command_line.h"

namespace gainsmith::app {

/// One page of section 1, for man: the same commands, options and footers as --help.
std::string manual_page(const Program& program);

}  // namespace gainsmith::app
