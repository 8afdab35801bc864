// Functions of other languages, MATLAB, Python and Julia, with what to write for them here.
#pragma once

#include <string>
#include <string_view>

namespace gainsmith::expr {

/// "write inv(M)"; empty when the name is not known.
std::string advice_on(std::string_view function);

}  // namespace gainsmith::expr
