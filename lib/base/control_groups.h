// The limits that control groups set for this process (Linux).
#pragma once

#include <string>

namespace gainsmith {

/// The least number in this file of the process's group and of those around it; infinite where
/// there is none ("max"). `controller`: of version 1, such as "memory"; empty for version 2. A
/// second number divides the first: "150000 100000" of cpu.max are 1.5 cores.
double least_of_groups(const std::string& controller, const std::string& file);

}  // namespace gainsmith
