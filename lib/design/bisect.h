// The largest or smallest value of a scalar for which a problem has gains.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "design/search_request.h"
#include "design/synthesize.h"
#include "model/gains.h"
#include "sdp/solver.h"
#include "search/bisect.h"

namespace gainsmith::design {

struct BisectChoices {
  SearchedScalar scalar;
  bool largest = true;  ///< otherwise the smallest value with gains
  search::Tolerance tolerance;
  std::optional<double> guess;  ///< see search::BisectOptions
  Depth depth = Depth::thorough;
  /// What else a value with gains must satisfy, such as a campaign of runs; empty: nothing.
  std::function<search::Answer(const model::Gains&)> also{};
};

/// Both ends of a bracket with what they rest on.
struct BisectResult {
  search::Bisection found;
  /// The gains at the outermost yes, with every margin recomputed. When no value tried is feasible
  /// the verdict is undecided, as nothing is known of the values between; the rest is the result at
  /// the end where it should have been easiest. Its `search` says how the bisection ended, with the
  /// checked certificate at the no end.
  model::Gains gains;
  /// Values with a no that is about a condition which is only sufficient: " for the hull only".
  std::map<double, std::string> limits;
};

/// Synthesizes at the values that search::bisect asks for, the problem's `own` among them, the
/// scalars in `fixed` and the instance's overrides held. A value is yes when synthesize() says yes,
/// no when a certificate was checked (perhaps of a hull only: `limits`), refused when it does not
/// fit the problem's assumptions. With `also` a yes counts as what that answers. `gains.search`
/// holds the bracket. InputError when every value tried is refused.
BisectResult bisect(const model::Instance& own, const model::Overrides& fixed,
                    const BisectChoices& choices, const sdp::Options& solver);

}  // namespace gainsmith::design
