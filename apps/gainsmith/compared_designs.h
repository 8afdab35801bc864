// Designs laid side by side on a page: a table of what differs, and common pictures.
#pragma once

#include <string>
#include <vector>

#include "page/page.h"

namespace gainsmith::app {

/// Of gain files, or folders of one problem each, with their results. The picture of runs is of run 0
/// of each campaign, where the plants have the same states.
page::Comparison compared(const std::vector<std::string>& paths,
                          const std::vector<page::Results>& results);

/// The table as text.
std::string comparison_text(const page::Comparison& comparison);

}  // namespace gainsmith::app
