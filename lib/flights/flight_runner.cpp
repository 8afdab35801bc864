#include "flights/flight_runner.h"

#include <algorithm>
#include <limits>

#include "base/stop.h"

namespace gainsmith::flights {

using lanes::kLanes;
using Flown = FlightSystem;

FlightRunner::FlightRunner(const PackSystem& pack, const FlightSystem& flights)
    : pack_(pack),
      flights_(flights),
      horizon_(pack.scenario->horizon),
      code_(*flights_.code),
      begin_(*pack.start),
      since_(pack.events.size()),
      set_by_jumps_(packs::set_by_jumps(*pack.system)),
      sizes_(static_cast<std::size_t>(pack.system->size)),
      zeno_(*pack.system, pack.scenario->horizon),
      scratch_(Eigen::VectorXd::Zero(pack.system->size)),
      largest_(scratch_) {
  for (const PackEvent& event : pack.events) jumps_.emplace_back(*event.jump);
  for (LaneValues& lane_values : states_)
    lane_values = LaneValues(static_cast<std::size_t>(pack.system->size));
  const auto& variables = pack.system->dynamics.variables;
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].kind == model::Dynamics::VariableKind::since)
      since_[variables[i].of].push_back(
          static_cast<std::size_t>(pack.system->layout.slots[i].offset));
}

std::vector<PackVerdict> FlightRunner::run(std::uint64_t seed, std::uint64_t first,
                                           std::uint64_t last) {
  seed_ = seed;
  first_ = next_ = first;
  last_ = last;
  busy_ = 0;
  verdicts_.assign(static_cast<std::size_t>(last - first), {});
  while (true) {
    check_stop();
    refill();
    if (busy_ == 0) break;
    fly();
  }
  return std::move(verdicts_);
}

void FlightRunner::refill() {
  std::uint32_t fresh = 0;
  for (std::size_t l = 0; l < kLanes && next_ < last_; ++l) {
    if ((busy_ >> l & 1U) != 0) continue;
    begin(l, next_++);
    fresh |= 1U << l;
  }
  busy_ |= fresh;
  if (fresh != 0) set_limits(fresh);
}

/// Both runs begin at the same drawn values; they part by moves alone.
void FlightRunner::begin(std::size_t l, std::uint64_t run) {
  runs_[l] = run;
  moves_[l] = packs::Moves(run);
  happened_[l] = 0;
  count_[l] = short_[l] = 0;
  t_[l] = 0;
  const Eigen::VectorXd start = hybrid::draw_start(*pack_.system, *pack_.scenario, seed_, run);
  for (std::size_t k = 0; k < pack_.whole; ++k)
    code_.input(k)[l] = code_.input(pack_.whole + k)[l] = start(static_cast<Eigen::Index>(k));
  for (std::size_t k = 0; k < sizes_.rows(); ++k) sizes_.at(k, l) = 0;
  input(Flown::shift)[l] = 0;
  input(Flown::fresh)[l] = 1;
  input(Flown::jumped)[l] = -1;
}

void FlightRunner::set_limits(std::uint32_t fresh) {
  if (pack_.claims.empty()) return;
  for (std::size_t k = 0; k < pack_.whole; ++k)
    std::copy_n(code_.input(k), kLanes, begin_.input(k));
  begin_.run(fresh);
  each(fresh, [&](std::size_t l) {
    claims_[l].resize(pack_.claims.size());
    for (std::size_t c = 0; c < pack_.claims.size(); ++c) {
      ClaimLane& claim = claims_[l][c];
      claim.begin(pack_.claims[c], pack_, {}, begin_.result(PackSystem::limits, c)[l]);
      const bool none = claim.open() || (begin_.faults() >> l & 1U) != 0;
      code_.input(flights_.limit_of(c))[l] =
          none ? std::numeric_limits<double>::quiet_NaN() : claim.limit();
    }
  });
}

void FlightRunner::fly() {
  double* const rest = input(Flown::rest);
  for (std::size_t l = 0; l < kLanes; ++l) rest[l] = horizon_ - t_[l];
  for (std::size_t k = 0; k < flights_.rows; ++k) {
    double* const move = code_.input(flights_.move_of_row(k));
    for (std::size_t l = 0; l < kLanes; ++l) move[l] = moves_[l].next();
  }
  code_.run(busy_);
  std::uint32_t goes_on = 0;
  each(busy_, [&](std::size_t l) {
    if (result(Flown::ok)[l] != 1 || (code_.faults() >> l & 1U) != 0) {
      verdict_of(l).why = Why::sign;
      busy_ &= ~(1U << l);
    } else if (result(Flown::event)[l] < 0) {
      finish(l);
    } else {
      goes_on |= 1U << l;
    }
  });
  if (goes_on != 0) arrive(goes_on);
}

/// The ends of both runs become the values before the jump. Lanes with the same event jump
/// together.
void FlightRunner::arrive(std::uint32_t mask) {
  const LaneMask moved(mask);
  for (std::size_t k = 0; k < flights_.rows; ++k) {
    const auto row = static_cast<std::size_t>(pack_.rows[k]);
    moved.copy(code_.result(Flown::ends, k), code_.input(row));
    moved.copy(code_.result(Flown::other_ends, k), code_.input(pack_.whole + row));
  }
  moved.copy(result(Flown::later), input(Flown::shift));
  moved.copy(result(Flown::event), input(Flown::jumped));
  for (std::size_t k = 0; k < flights_.crossings.size(); ++k)
    moved.copy(code_.result(Flown::sides_after, k), code_.input(flights_.side_before(k)));
  each(mask, [&](std::size_t l) {
    t_[l] += result(Flown::length)[l];
    input(Flown::fresh)[l] = 0;
  });
  mask = watch_zeno(mask);
  for (std::size_t e = 0; e < pack_.events.size() && mask != 0; ++e) {
    std::uint32_t same = 0;
    each(mask, [&](std::size_t l) {
      if (input(Flown::jumped)[l] == static_cast<double>(e)) same |= 1U << l;
    });
    mask &= ~same;
    if (same != 0) jump(e, same);
  }
}

/// Notes the flight, and ends runs whose jumps accumulate. After kInARow flights below kHardly of
/// the horizon a run is left open.
std::uint32_t FlightRunner::watch_zeno(std::uint32_t mask) {
  const std::size_t at = ++number_ % kept;
  std::copy_n(result(Flown::length), kLanes, lengths_[at].begin());
  std::copy_n(result(Flown::event), kLanes, events_[at].begin());
  for (std::size_t k = 0; k < sizes_.rows(); ++k) {
    std::copy_n(code_.input(k), kLanes, states_[at].row(k));
    const double* const largest = code_.result(Flown::largest, k);
    for (std::size_t l = 0; l < kLanes; ++l)
      sizes_.at(k, l) = std::max(sizes_.at(k, l), largest[l]);
  }
  const std::uint32_t near = may_accumulate();
  each(mask, [&](std::size_t l) {
    ++count_[l];
    const double length = lengths_[at][l];
    short_[l] = length < hybrid::kHardly * horizon_ ? short_[l] + 1 : 0;
    if (short_[l] >= hybrid::kInARow) {
      verdict_of(l).why = Why::jumps;
      busy_ &= ~(1U << l);
    } else if ((near >> l & 1U) != 0 && accumulates(l)) {
      finish(l);
    }
  });
  return mask & busy_;
}

std::uint32_t FlightRunner::may_accumulate() const {
  std::array<char, kLanes> near{};
  Row last{};
  const Row& length = lengths_[number_ % kept];
  for (std::size_t period = 1; period <= hybrid::ZenoDetector::kLongestPeriod; ++period) {
    const Row& other = lengths_[(number_ + kept + 1 - period) % kept];
    const Row& before = lengths_[(number_ + kept - period) % kept];
    for (std::size_t l = 0; l < kLanes; ++l) {
      last[l] += other[l];
      near[l] = static_cast<char>(near[l] | static_cast<char>(hybrid::ZenoDetector::is_near(
                                                last[l], length[l], before[l], t_[l])));
    }
  }
  std::uint32_t mask = 0;
  for (std::size_t l = 0; l < kLanes; ++l) mask |= near[l] != 0 ? 1U << l : 0;
  return mask;
}

bool FlightRunner::accumulates(std::size_t l) {
  zeno_.start_over();
  for (std::size_t k = 0; k < sizes_.rows(); ++k)
    largest_(static_cast<Eigen::Index>(k)) = sizes_.at(k, l);
  for (std::size_t back = std::min(count_[l], kept); back-- > 0;) {
    const std::size_t at = (number_ + kept - back) % kept;
    for (std::size_t k = 0; k < sizes_.rows(); ++k)
      scratch_(static_cast<Eigen::Index>(k)) = states_[at].at(k, l);
    zeno_.push(t_[l], lengths_[at][l], static_cast<std::size_t>(events_[at][l]), scratch_,
               largest_);
  }
  return zeno_.accumulation().has_value();
}

void FlightRunner::jump(std::size_t event, std::uint32_t mask) {
  lanes::LaneMachine& machine = jumps_[event];
  std::uint32_t bad = 0;
  const LaneMask jumping(mask);
  for (const std::size_t first : {std::size_t{0}, pack_.whole}) {
    std::copy_n(code_.input(first), pack_.whole * kLanes, machine.input(0));
    if (first != 0)
      packs::move_elements(
          set_by_jumps_, mask, [&](std::size_t l) -> packs::Moves& { return moves_[l]; },
          machine.input(0));
    machine.run(mask);
    bad |= machine.faults();
    for (std::size_t k = 0; k < sizes_.rows(); ++k)
      jumping.copy(machine.result(0, k), code_.input(first + k));
    for (const std::size_t element : since_[event])
      each(mask, [&](std::size_t l) { code_.input(first + element)[l] = 0; });
    for (std::size_t k = 0; k < machine.size(1); ++k)
      each(mask, [&](std::size_t l) { bad |= machine.result(1, k)[l] != 0 ? 1U << l : 0; });
  }
  each(mask, [&](std::size_t l) { happened_[l] |= std::uint64_t{1} << event; });
  each(bad & mask, [&](std::size_t l) {
    verdict_of(l).why = Why::no_value;
    busy_ &= ~(1U << l);
  });
}

void FlightRunner::finish(std::size_t l) {
  PackVerdict& verdict = verdict_of(l);
  verdict.open = false;
  for (std::size_t c = 0; c < pack_.claims.size(); ++c) {
    const auto value = [&](Flown::Field which) {
      return flights_.has(c, which) ? code_.input(flights_.field_of(c, which))[l] : 0;
    };
    const auto& over = pack_.claims[c].over;
    ClaimLane& claim = claims_[l][c];
    claim.finish({!over || (happened_[l] >> *over & 1U) != 0, value(Flown::violated) != 0,
                  value(Flown::peak), value(Flown::first), value(Flown::first_error),
                  value(Flown::last), value(Flown::last_error), value(Flown::floor)});
    verdict.open = verdict.open || claim.open();
    verdict.findings.push_back(claim.finding());
  }
  for (std::size_t e = 0; e < pack_.events.size(); ++e)
    verdict.happened.push_back((happened_[l] >> e & 1U) != 0 ? 1 : 0);
  busy_ &= ~(1U << l);
}

}  // namespace gainsmith::flights
