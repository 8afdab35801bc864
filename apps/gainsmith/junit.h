// JUnit XML, which CI servers read.
#pragma once

#include <string>
#include <vector>

#include "gainsmith/job.h"

namespace gainsmith::app {

/// One test suite with one test case a problem. A difference or a verdict "no" is a failure; wrong
/// input, undecided and faults are errors.
std::string junit_text(const std::vector<JobResult>& results);

}  // namespace gainsmith::app
