#include "packs/lane_lengths.h"

#include <algorithm>

namespace gainsmith::packs {

using lanes::kLanes;
using model::LawKind;

LaneLengths::LaneLengths(const hybrid::System& system, const hybrid::Scenario& scenario)
    : system_(&system), clock_(&*system.clocks.front()), scenario_(&scenario) {}

void LaneLengths::begin(std::uint64_t seed, const LaneRuns& runs) {
  runs_ = runs;
  given_.clear();
  if (scenario_->given_for(runs.front()) != nullptr) {
    const bool one = std::ranges::all_of(runs, [&](auto run) { return run == runs.front(); });
    for (std::size_t l = 0; l < (one ? 1 : kLanes); ++l)
      given_.emplace_back(*system_, *scenario_, seed, runs[l]);
    return take_given();
  }
  const std::vector<hybrid::Law>& laws = scenario_->laws.front();
  law_ = laws.empty() ? nullptr : &laws[runs.front() % laws.size()];
  key_ = hybrid::stream_key(seed, hybrid::Purpose::length, 0);
  occurrences_ = numbers_ = drawn_ = 0;
  const auto& given = scenario_->first.empty() ? std::optional<double>() : scenario_->first.front();
  due_.fill(0);
  if (given) {
    length_.fill(*given);
  } else if (!clock_->first) {
    draw_lengths(numbers_++);
  } else {
    const auto [low, high] = *clock_->first;
    lanes::variant().uniforms(hybrid::stream_key(seed, hybrid::Purpose::first, 0), runs_.data(), 0,
                              low, high - low, length_.data());
  }
  due_ = first_ = length_;
}

/// Lengths between low and high: uniform, one of both ends with probability 1/2 each, the sinusoid
/// of the time t/high, or a law that needs no draw and is the same in all lanes.
void LaneLengths::draw_lengths(std::uint64_t number) {
  const double low = clock_->low, high = clock_->high;
  if (low == high) {
    length_.fill(low);
    return;
  }
  const LawKind kind = law_ == nullptr ? LawKind::uniform : law_->kind;
  if (kind == LawKind::uniform || kind == LawKind::extremes) {
    const bool between = kind == LawKind::uniform;
    lanes::variant().uniforms(key_, runs_.data(), drawn_++, between ? low : 0,
                              between ? high - low : 1, length_.data());
    if (!between)
      for (double& one : length_) one = one < 0.5 ? low : high;
    return;
  }
  // Without draws.
  RandomStream none(0, 0);
  if (kind != LawKind::sinusoid) {
    length_.fill(law_->reset_value(number, 0, none));
    return;
  }
  for (std::size_t l = 0; l < kLanes; ++l) length_[l] = due_[l] / high;
  lanes::variant().sines(length_.data());
  for (double& one : length_) one = hybrid::sinusoid_of(one, low, high);
}

void LaneLengths::take_given() {
  for (std::size_t l = 0; l < kLanes; ++l) {
    const hybrid::EventClocks& clocks = given_[std::min(l, given_.size() - 1)];
    length_[l] = clocks.length(0);
    due_[l] = clocks.due(0);
  }
}

/// A clock with one length is due at first + k low, without a sum that would collect rounding.
void LaneLengths::advance() {
  if (!given_.empty()) {
    for (hybrid::EventClocks& clocks : given_) clocks.advance(0, clocks.due(0));
    return take_given();
  }
  ++occurrences_;
  if (clock_->low == clock_->high) {
    length_.fill(clock_->low);
    for (std::size_t l = 0; l < kLanes; ++l)
      due_[l] = first_[l] + static_cast<double>(occurrences_) * clock_->low;
    return;
  }
  draw_lengths(numbers_++);
  for (std::size_t l = 0; l < kLanes; ++l) due_[l] += length_[l];
}

}  // namespace gainsmith::packs
