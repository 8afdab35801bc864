#include "verify/event_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/number.h"
#include "model/stated.h"

namespace gainsmith::verify {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using hybrid::Ending;
using hybrid::Termination;

constexpr int kAround = 5;  ///< samples from which the bound of one is taken

std::string integral_name(const std::string& claim) { return "integral of " + claim; }

expr::Program zero() {
  expr::Instruction constant;
  constant.op = expr::Op::constant;
  constant.text = "0";
  expr::Program program;
  program.code.push_back(std::move(constant));
  program.result = 0;
  return program;
}

/// A state whose rate is the flow cost of a claim.
void add_integral(const model::Design::Claim& claim, model::Dynamics& dynamics) {
  model::Dynamics::Variable variable;
  variable.name = integral_name(claim.name);
  variable.start = {zero(), claim.place, "0"};
  variable.place = claim.place;
  dynamics.flow.push_back({dynamics.variables.size(), *claim.flow_cost, claim.place});
  dynamics.variables.push_back(std::move(variable));
}

/// The program that is an input of this name.
expr::Program input_of(const std::string& name) {
  expr::Instruction input;
  input.op = expr::Op::input;
  input.attributes = {0};
  expr::Program program;
  program.code.push_back(std::move(input));
  program.inputs.push_back({name, {}});
  program.result = 0;
  return program;
}

bool is_whole(model::Dynamics::VariableKind kind) {
  using Kind = model::Dynamics::VariableKind;
  return kind == Kind::mode || kind == Kind::jumps || kind == Kind::count || kind == Kind::passes;
}

/// Whether a value keeps its bits along flows. Noise may be drawn anew within one.
bool is_still(const expr::Program& program, const hybrid::EventSystem& system) {
  return std::none_of(program.inputs.begin(), program.inputs.end(), [&](const expr::Input& input) {
    if (system.is_moving(input.name)) return true;
    const auto slot = system.slot(input.name);
    if (!slot || *slot >= system.dynamics.variables.size()) return false;
    const auto& variable = system.dynamics.variables[*slot];
    return variable.kind == model::Dynamics::VariableKind::noise &&
           system.noise[variable.of].every.has_value();
  });
}

/// The functions of the claims that are stated, and the claims over them.
class Functions {
 public:
  explicit Functions(EventSetup& setup) : setup_(setup) {}

  void add_all() {
    for (const LinkedClaim& claim : setup_.claims) {
      if (!claim.stated()) continue;
      JudgedClaim judged;
      judged.name = claim.name;
      judged.kind = claim.kind;
      judged.after = claim.after;
      judged.looked_for = static_cast<int>(setup_.functions.size());
      judged.over = claim.over;
      Plan plan{std::move(judged), add(claim.value), {}};
      if (claim.flow_cost) plan.parts[0] = add_integral_of(claim);
      if (claim.jump_cost) plan.parts[1] = add(*claim.jump_cost);
      if (claim.factor) plan.parts[2] = add(*claim.factor);
      if (claim.bound) {
        plan.parts[3] = add(*claim.bound);
        plan.parts[4] = add(hybrid::absolute_terms(claim.value));
      }
      add_looks(claim, plan.value);
      plans_.push_back(std::move(plan));
    }
    for (Plan& plan : plans_) {
      JudgedClaim& judged = plan.judged;
      judged.value = function(plan.value);
      if (plan.parts[0]) {
        judged.flow_cost = function(*plan.parts[0]);
        judged.accumulated = static_cast<Index>(*plan.parts[0]);
      }
      if (plan.parts[1]) judged.jump_cost = function(*plan.parts[1]);
      if (plan.parts[2]) judged.factor = function(*plan.parts[2]);
      if (plan.parts[3]) judged.bound = function(*plan.parts[3]);
      if (plan.parts[4]) judged.terms = function(*plan.parts[4]);
      setup_.judged.push_back(std::move(judged));
    }
  }

 private:
  struct Plan {
    JudgedClaim judged;
    std::size_t value;
    std::array<std::optional<std::size_t>, 5> parts;
  };

  /// Where along flows the value of a claim is looked at besides.
  void add_looks(const LinkedClaim& claim, std::size_t value) {
    if (claim.after > 0) setup_.looks.times.push_back(claim.after);
    if (claim.over) return;
    setup_.looks.along.push_back(value);
    const bool above = claim.kind == model::ClaimKind::above;
    if (above || claim.kind == model::ClaimKind::below)
      setup_.looks.peaks.push_back({value, above ? -1.0 : 1.0, claim.after});
  }

  std::size_t add_integral_of(const LinkedClaim& claim) {
    const std::string name = integral_name(claim.name);
    return add(input_of(name));
  }

  std::size_t add(const expr::Program& program) {
    const std::size_t at = setup_.functions.size();
    const std::string name = "value_" + std::to_string(at);
    setup_.functions.push_back(program);
    hybrid::Coordinates& coordinates = setup_.coordinates;
    coordinates.layout.slots.push_back({name, {}, static_cast<Index>(at)});
    coordinates.layout.size = static_cast<Index>(at) + 1;
    const expr::Program own = input_of(name);
    const bool still = is_still(program, setup_.system);
    coordinates.list.push_back({own, still ? std::nullopt : std::optional(own), own, false});
    return at;
  }

  JudgedFunction function(std::size_t at) const {
    return make_function(input_of("value_" + std::to_string(at)), setup_.coordinates);
  }

  EventSetup& setup_;
  std::vector<Plan> plans_;
};

}  // namespace

std::unique_ptr<const EventSetup> make_event_setup(const model::Instance& instance,
                                                   const model::Gains& gains) {
  const model::Design& design = *instance.design;
  model::Dynamics dynamics = *design.dynamics;
  for (const model::Design::Claim& claim : design.claims)
    if (claim.flow_cost) add_integral(claim, dynamics);
  model::Stated stated = model::state(instance, gains);
  auto setup = std::make_unique<EventSetup>();
  setup->flow = dynamics.flow;
  setup->system =
      hybrid::make_event_system(dynamics, std::move(stated.values), std::move(stated.bodies));
  setup->layout = setup->system.layout;
  setup->layout.slots.resize(dynamics.variables.size());
  setup->layout.size = setup->system.size;
  setup->asked = design.campaign.accuracy;
  setup->scenario = hybrid::make_event_scenario(design.campaign, setup->system);
  hybrid::System plain;
  plain.layout = setup->layout;
  plain.constants = setup->system.constants;
  plain.bodies = setup->system.bodies;
  setup->claims = link_claims(design, plain);
  check_times(design, setup->claims, setup->scenario.horizon);
  setup->constants = rounded_once(setup->system.constants);
  setup->coordinates.affine = false;
  Functions(*setup).add_all();
  setup->narrow = std::make_unique<hybrid::BoundedSystem<double>>(setup->coordinates, std::nullopt);
  return setup;
}

hybrid::Accuracy EventSetup::accuracy(double usual, double factor) const {
  hybrid::Accuracy result{usual, usual};
  if (asked) {
    result.relative = asked->relative.value_or(usual);
    result.absolute = asked->absolute.value_or(result.relative);
    if (!asked->states.empty()) result.absolute_of.setConstant(system.size, result.absolute);
    for (const auto& [state, absolute] : asked->states) {
      const hybrid::Slot& slot = layout.slots[state];
      result.absolute_of.segment(slot.offset, slot.shape.size()).setConstant(absolute);
    }
  }
  return factor == 1 ? result : result.times(factor);
}

EventTracks::EventTracks(const EventSetup& setup, std::function<bool()> stopped)
    : setup_(&setup),
      simulator_(setup.system, setup.scenario, std::move(stopped)),
      rounds_(static_cast<std::size_t>(setup.system.whole), false) {
  const auto& variables = setup.system.dynamics.variables;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const hybrid::Slot& slot = setup.system.layout.slots[k];
    const auto first = rounds_.begin() + slot.offset;
    std::fill(first, first + slot.shape.size(), !is_whole(variables[k].kind));
  }
  for (const expr::Program& function : setup.functions) {
    functions_.emplace_back(function, setup.layout, setup.system.constants);
    roundings_.emplace_back(function, setup.layout, setup.constants);
  }
}

VectorXd EventTracks::values(const VectorXd& x) {
  VectorXd result(static_cast<Index>(functions_.size()));
  for (std::size_t k = 0; k < functions_.size(); ++k)
    result(static_cast<Index>(k)) = functions_[k].number(x);
  return result;
}

/// x as rounding may have left it: exact flows and jumps round in both runs alike. Elements whose
/// numbers differ in the bit are rounded apart, so that a difference of two shows it.
VectorXd EventTracks::with_rounding(const VectorXd& x, int bit) const {
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  VectorXd result = x;
  for (Index e = 0; e < x.size(); ++e) {
    if (!rounds_[static_cast<std::size_t>(e)]) continue;
    const bool up = ((e >> bit) & 1) == 0;
    result(e) += (up ? 1 : -1) * (4 + rounded_) * kUnit * std::abs(x(e));
  }
  return result;
}

/// The bits `pattern`, `pattern` + `stride`, ... of the numbers of elements are rounded apart.
void EventTracks::append(const FlowLook& look, std::int64_t j, const VectorXd& coarse,
                         const VectorXd& fine, int pattern, int stride) {
  const VectorXd value = values(fine);
  VectorXd difference = (values(coarse) - value).cwiseAbs();
  for (int bit = pattern; bit == 0 || (fine.size() - 1) >> bit > 0; bit += stride)
    difference = difference.cwiseMax((values(with_rounding(fine, bit)) - value).cwiseAbs());
  track_.t.push_back(look.t);
  track_.looked_for.push_back(look.function);
  track_.j.push_back(j);
  track_.timer.push_back(0);
  track_.timer_bound.push_back(0);
  track_.stacked.insert(track_.stacked.end(), value.data(), value.data() + value.size());
  track_.bounds.insert(track_.bounds.end(), difference.data(),
                       difference.data() + difference.size());
  for (TextRounding& rounding : roundings_) rounding_.push_back(rounding(fine));
}

void EventTracks::add_flow(const hybrid::FlowPiece& coarse, const hybrid::FlowPiece& fine) {
  rounded_ += static_cast<double>(fine.steps.size());
  double before = fine.from();
  int number = 0;
  for (const FlowLook& look : looks_along(fine, setup_->looks, functions_)) {
    track_.moves.push_back({false, {hybrid::FlowStep::kRest, look.t - before}});
    append(look, fine.j, state_at(coarse, look.share), state_at(fine, look.share),
           ++number % kAround, kAround);
    before = look.t;
  }
}

/// What the two runs have in common.
void EventTracks::add_parts(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine) {
  append({0, 0}, 0, coarse.start, fine.start, 0, 1);
  std::size_t first = 0;
  const std::size_t parts = std::min(coarse.parts.size(), fine.parts.size());
  for (std::size_t k = 0; k < parts; ++k) {
    if (coarse.parts[k].index() != fine.parts[k].index()) break;
    if (const auto* flow = std::get_if<hybrid::FlowPiece>(&fine.parts[k])) {
      add_flow(std::get<hybrid::FlowPiece>(coarse.parts[k]), *flow);
      continue;
    }
    const auto& jump = std::get<hybrid::JumpPoint>(fine.parts[k]);
    const auto& other = std::get<hybrid::JumpPoint>(coarse.parts[k]);
    if (jump.event != other.event || jump.lost != other.lost) break;
    widen(first);
    first = track_.samples();
    rounded_ += 1;
    track_.moves.push_back({true, {}, jump.event});
    append({1, jump.t}, jump.j + 1, other.after, jump.after, 0, 1);
  }
  widen(first);
}

/// Of the samples of one flow, once all are there.
void EventTracks::widen(std::size_t first) {
  constexpr double kMargin = 4;
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  const auto size = track_.size;
  const auto count = static_cast<Index>(track_.samples() - first);
  const Index skipped = static_cast<Index>(first) * size;
  Eigen::Map<numbers::Matrix> bounds(track_.bounds.data() + skipped, size, count);
  const Eigen::Map<const numbers::Matrix> rounding(rounding_.data() + skipped, size, count);
  const numbers::Matrix own = bounds;
  std::vector<Index> seen;  // the samples that count for a function
  for (Index f = 0; f < size; ++f) {
    seen.clear();
    for (Index k = 0; k < count; ++k) {
      const int of = track_.looked_for[first + static_cast<std::size_t>(k)];
      if (of == track_.kForAll || of == f) seen.push_back(k);
    }
    const auto all = static_cast<Index>(seen.size());
    for (Index i = 0; i < all; ++i) {
      const Index k = seen[static_cast<std::size_t>(i)];
      const Index from = std::max<Index>(std::min<Index>(i - kAround / 2, all - kAround), 0);
      double around = 0;
      for (Index other = from; other < std::min<Index>(from + kAround, all); ++other)
        around = std::fmax(around, own(f, seen[static_cast<std::size_t>(other)]));
      const double value = track_.state(first + static_cast<std::size_t>(k))(f);
      bounds(f, k) = kMargin * around + 8 * kUnit * std::abs(value) + rounding(f, k);
    }
  }
}

void EventTracks::end(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine) {
  constexpr double kSame = 1e-6;
  track_.message = fine.message;
  const bool same = coarse.ending == fine.ending && coarse.parts.size() == fine.parts.size() &&
                    std::abs(coarse.end - fine.end) <= kSame * fine.end;
  const bool complete = fine.ending == Ending::horizon || fine.ending == Ending::zeno;
  const bool breaks = fine.ending == Ending::escaped || fine.ending == Ending::undefined ||
                      fine.ending == Ending::stuck;
  if (same && complete) {
    track_.termination = Termination::horizon;
  } else if (same && breaks) {
    track_.termination = Termination::broken_off;
  } else {
    track_.termination = Termination::lost;
    if (!same)
      track_.message = "which events happen, and when, hangs on the accuracy" +
                       (fine.message.empty() ? "" : "; " + fine.message);
  }
}

const hybrid::Track<double>& EventTracks::run(std::uint64_t seed, std::uint64_t run,
                                              double factor) {
  constexpr double kSharper = 1e-2;
  track_.clear();
  track_.size = setup_->coordinates.layout.size;
  const hybrid::Accuracy accuracy = setup_->accuracy(kUsualOfMany, factor);
  track_.accuracy = accuracy.relative;
  rounded_ = 0;
  rounding_.clear();
  const hybrid::Trajectory coarse = simulator_.run(seed, run, accuracy);
  const hybrid::Trajectory fine = simulator_.run(seed, run, accuracy.times(kSharper));
  add_parts(coarse, fine);
  end(coarse, fine);
  return track_;
}

}  // namespace gainsmith::verify
