#include "linear/jump.h"

#include <algorithm>
#include <set>
#include <string>

#include "linear/coordinates.h"
#include "numbers/types/degree.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;

}  // namespace

/// Values of the clocks at a jump: start + rate s at the first one, reset + rate s at the others.
struct LinearJump::Clocks {
  const Coordinates* coordinates = nullptr;
  Wide start, reset, rate;  ///< of all coordinates; 0 of those that are no clocks
  std::vector<std::optional<WideFunction>> after;  ///< by coordinate; none: unchanged

  /// Whether clock i is set to a constant by jumps, and starts at one.
  bool add(std::size_t i, const Wide& start_of_all, const std::vector<bool>& same) {
    const hybrid::Slot& slot = coordinates->layout.slots[i];
    const auto& jump = coordinates->list[i].jump;
    if (!jump || std::any_of(jump->inputs.begin(), jump->inputs.end(), [&](const auto& input) {
          return coordinates->layout.moves(input.name);
        }))
      return false;
    WideFunction value(*jump, coordinates->layout, coordinates->constants);
    const Wide zero = Wide::Zero(coordinates->layout.size, 1);
    reset.middleRows(slot.offset, slot.shape.size()) = value(zero).reshaped();
    for (Index e = slot.offset; e < slot.offset + slot.shape.size(); ++e) {
      if (!same[static_cast<std::size_t>(e)] || !coordinates->linear.row(e).isZero(0)) return false;
      start(e) = start_of_all(e);
      rate(e) = coordinates->constant(e);
    }
    return true;
  }
};

LinearJump::LinearJump() = default;
LinearJump::LinearJump(LinearJump&&) noexcept = default;
LinearJump& LinearJump::operator=(LinearJump&&) noexcept = default;
LinearJump::~LinearJump() = default;

std::optional<LinearJump> LinearJump::make(const Coordinates& all, const Wide& start,
                                           const std::vector<bool>& same) {
  LinearJump made;
  const Index n = all.layout.size;
  if (const auto map = affine_jump(all)) {
    for (Index e = 0; e < n; ++e) made.elements_.push_back(e);
    made.constant_.resize(n, n + 1);
    made.constant_ << map->linear, map->constant;
    return made;
  }
  made.clocks_ = std::make_unique<Clocks>();
  Clocks& clocks = *made.clocks_;
  clocks.coordinates = &all;
  clocks.start = clocks.reset = clocks.rate = Wide::Zero(n, 1);
  std::set<std::string> others;
  std::vector<Index> clock_elements;
  for (std::size_t i = 0; i < all.list.size(); ++i) {
    const hybrid::Slot& slot = all.layout.slots[i];
    const bool is_clock = all.list[i].clock;
    if (is_clock && !clocks.add(i, start, same)) return std::nullopt;
    if (!is_clock) others.insert(slot.name);
    for (int e = 0; e < slot.shape.size(); ++e)
      (is_clock ? clock_elements : made.elements_).push_back(slot.offset + e);
  }
  // A flow that reads a clock is none of x alone.
  if (!all.linear(made.elements_, clock_elements).isZero(0)) return std::nullopt;
  for (const Coordinate& coordinate : all.list) {
    clocks.after.emplace_back();
    if (coordinate.clock || !coordinate.jump) continue;
    const auto degrees = numbers::degrees(
        *coordinate.jump, [&](const std::string& name) { return others.contains(name); });
    if (degrees[static_cast<std::size_t>(coordinate.jump->result)] == numbers::kNotAffine ||
        coordinate.jump->uses(all.layout.timer))
      return std::nullopt;
    clocks.after.back().emplace(*coordinate.jump, all.layout, all.constants);
  }
  return made;
}

/// [J, j] by values: j = g(0), column i of J = g(e_i) - g(0), clocks fixed at their values for this
/// length.
Wide LinearJump::operator()(const Decimal100& length, bool first) const {
  if (!clocks_) return constant_;
  const Coordinates& all = *clocks_->coordinates;
  const Index n = all.layout.size;
  Wide x = (first ? clocks_->start : clocks_->reset) + clocks_->rate * length;
  Wide map = Wide::Zero(n, n + 1);
  for (std::size_t i = 0; i < all.list.size(); ++i) {
    const hybrid::Slot& slot = all.layout.slots[i];
    auto& after = clocks_->after[i];
    const Index rows = slot.shape.size();
    if (!after) {
      map.block(slot.offset, slot.offset, rows, rows).setIdentity();
      continue;
    }
    const Wide constant = (*after)(x).reshaped();
    map.block(slot.offset, n, rows, 1) = constant;
    for (const Index j : elements_) {
      x(j) = Decimal100(1);
      map.block(slot.offset, j, rows, 1) = (*after)(x).reshaped() - constant;
      x(j) = Decimal100(0);
    }
  }
  remove_noise(map, largest_of(map));
  std::vector<Index> columns = elements_;
  columns.push_back(n);
  return map(elements_, columns);
}

}  // namespace gainsmith::linear
