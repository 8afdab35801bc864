// One name, one meaning: the names of a method do not clash.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/method.h"

namespace gainsmith::model {

/// InputError when two things of the method share a name, when a name is reserved (a function, I,
/// pi, a dimension), is none, or when flow or jump maps name no state.
void check_names(const Method& method);

/// Whether the name is `owner` with numbers: "P_1", "P_1_0" of P.
bool is_numbered(const std::string& name, const std::string& owner);

/// The bound on the gains, `synthesis.gain_bound`: it is searched and overridden like a scalar of
/// the method, unless one has this name.
inline constexpr const char* kGainBound = "gain_bound";

/// The name of a setting that gives the ranges of a search: those of the command line.
inline constexpr const char* kSearch = "search";

/// InputError at `place` when `name` is none of the method's scalars and not kGainBound, with the
/// nearest that is. `shapes`: of all data, as they are declared.
void check_scalar_name(const std::string& method, const std::vector<std::string>& scalars,
                       const std::map<std::string, std::string>& shapes, const std::string& name,
                       const Place& place);

}  // namespace gainsmith::model
