// Which points of a domain are numbers of the file, whatever double made of them.
#pragma once

#include <cstddef>
#include <functional>

#include "lmi/block.h"
#include "lmi/inequalities.h"

namespace gainsmith::verdict {

/// The two ends of an interval.
enum class End { low, high };

/// The text that the block's value of its v-th variable represents; none at a point between. An end
/// of an interval represents that of the file, and so does what rounding put outside of it:
/// `reaches(end's text, end)` says whether the value, as it is, may be there or beyond.
const expr::Program* stated_at(const lmi::Statement& statement, std::size_t v,
                               const lmi::Block& block,
                               const std::function<bool(const expr::Program&, End)>& reaches);

}  // namespace gainsmith::verdict
