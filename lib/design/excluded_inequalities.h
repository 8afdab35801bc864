// A no for all values of what is searched.
#pragma once

#include <optional>

#include "design/search_request.h"

namespace gainsmith::design {

/// The inequalities that no scalar of the request changes, those that are only necessary included,
/// where a certificate excludes them: a problem of its own with nothing searched.
std::optional<model::Instance> excluded_inequalities(const model::Instance& instance,
                                                     const SearchRequest& request,
                                                     const sdp::Options& solver);

}  // namespace gainsmith::design
