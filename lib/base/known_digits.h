// Numbers with an error as text.
#pragma once

#include <string>

namespace gainsmith {

/// For people: as many of `digits` significant digits as are known of a number with an error: the
/// last one is right within one. Where it has fewer, the error of what is printed follows:
/// "2.7 +- 0.04".
std::string brief(double value, int digits, double error);

}  // namespace gainsmith
