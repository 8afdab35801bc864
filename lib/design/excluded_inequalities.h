// A no for all values of what is searched: inequalities that contain none of the searched scalars
// hold or fail for all values alike, and a certificate against them alone excludes every value.
#pragma once

#include <optional>

#include "design/search_request.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// Without an objective and a search, and with what is only necessary among its inequalities.
model::Instance with_necessary(const model::Instance& instance);

/// The inequalities that no scalar of a request changes, and the no of a certificate about them.
struct Excluded {
  model::Instance inequalities;  ///< a problem of its own with nothing searched
  model::Gains gains;
};

/// Where a certificate excludes them, those that are only necessary included. InputError, at its
/// place, for what is necessary and cannot be posed.
std::optional<Excluded> excluded_inequalities(const model::Instance& instance,
                                              const SearchRequest& request,
                                              const sdp::Options& solver);

}  // namespace gainsmith::design
