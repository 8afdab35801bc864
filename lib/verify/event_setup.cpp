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
      const std::size_t value = add(claim.value);
      std::optional<std::size_t> parts[3];
      if (claim.flow_cost) parts[0] = add_integral_of(claim);
      if (claim.jump_cost) parts[1] = add(*claim.jump_cost);
      if (claim.factor) parts[2] = add(*claim.factor);
      plans_.push_back({std::move(judged), value, {parts[0], parts[1], parts[2]}});
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
      setup_.judged.push_back(std::move(judged));
    }
  }

 private:
  struct Plan {
    JudgedClaim judged;
    std::size_t value;
    std::array<std::optional<std::size_t>, 3> parts;
  };

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
    coordinates.list.push_back({own, own, own, false});
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
    : setup_(&setup), simulator_(setup.system, setup.scenario, std::move(stopped)) {
  for (const expr::Program& function : setup.functions)
    functions_.emplace_back(function, setup.layout, setup.system.constants);
}

VectorXd EventTracks::values(const VectorXd& x) {
  VectorXd result(static_cast<Index>(functions_.size()));
  for (std::size_t k = 0; k < functions_.size(); ++k)
    result(static_cast<Index>(k)) = functions_[k].number(x);
  return result;
}

/// x as rounding may have left it: exact flows and jumps round in both runs alike.
VectorXd EventTracks::with_rounding(const VectorXd& x) const {
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  VectorXd result = x;
  for (Index e = 0; e < x.size(); ++e) {
    const bool up = (static_cast<std::size_t>(e) + track_.samples()) % 2 == 0;
    result(e) += (up ? 1 : -1) * (4 + rounded_) * kUnit * std::abs(x(e));
  }
  return result;
}

void EventTracks::append(double t, std::int64_t j, const VectorXd& coarse, const VectorXd& fine) {
  const VectorXd value = values(fine);
  const VectorXd difference = (values(coarse) - value)
                                  .cwiseAbs()
                                  .cwiseMax((values(with_rounding(fine)) - value).cwiseAbs());
  track_.t.push_back(t);
  track_.j.push_back(j);
  track_.timer.push_back(0);
  track_.timer_bound.push_back(0);
  track_.stacked.insert(track_.stacked.end(), value.data(), value.data() + value.size());
  track_.bounds.insert(track_.bounds.end(), difference.data(),
                       difference.data() + difference.size());
}

void EventTracks::add_flow(const hybrid::FlowPiece& coarse, const hybrid::FlowPiece& fine) {
  const auto at = [](const hybrid::FlowPiece& flow, int piece) {
    if (piece == kPieces) return flow.end;
    const double t = flow.from() + (flow.to() - flow.from()) * piece / kPieces;
    const auto step = std::find_if(flow.steps.begin(), flow.steps.end() - 1,
                                   [&](const hybrid::DenseStep& one) { return t <= one.to; });
    return (*step)(t);
  };
  const double length = fine.to() - fine.from();
  rounded_ += static_cast<double>(fine.steps.size());
  for (int piece = 1; piece <= kPieces; ++piece) {
    track_.moves.push_back({false, {hybrid::FlowStep::kRest, length / kPieces}});
    append(fine.from() + length * piece / kPieces, fine.j, at(coarse, piece), at(fine, piece));
  }
}

/// What the two runs have in common.
void EventTracks::add_parts(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine) {
  append(0, 0, coarse.start, fine.start);
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
    track_.moves.push_back({true, {}});
    append(jump.t, jump.j + 1, other.after, jump.after);
  }
  widen(first);
}

/// Of the samples of one flow, once all are there.
void EventTracks::widen(std::size_t first) {
  constexpr Index kBeside = 2;
  constexpr double kMargin = 4;
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  const auto size = track_.size;
  const auto count = static_cast<Index>(track_.samples() - first);
  Eigen::Map<numbers::Matrix> bounds(track_.bounds.data() + static_cast<Index>(first) * size, size,
                                     count);
  const numbers::Matrix own = bounds;
  for (Index k = 0; k < count; ++k) {
    const Index from = std::max<Index>(k - kBeside, 0);
    const Index to = std::min<Index>(k + kBeside, count - 1);
    bounds.col(k) = kMargin * own.middleCols(from, to - from + 1).rowwise().maxCoeff() +
                    8 * kUnit * track_.state(first + static_cast<std::size_t>(k)).cwiseAbs();
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
  const hybrid::Trajectory coarse = simulator_.run(seed, run, accuracy);
  const hybrid::Trajectory fine = simulator_.run(seed, run, accuracy.times(kSharper));
  add_parts(coarse, fine);
  end(coarse, fine);
  return track_;
}

}  // namespace gainsmith::verify
