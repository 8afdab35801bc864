#include "packs/pack_system.h"

#include <algorithm>

#include "claims/twin_parts.h"
#include "expr/program/branches.h"
#include "expr/program/square_of_norm.h"
#include "hybrid/breaks.h"
#include "hybrid/rounding_terms.h"
#include "numbers/graph/scalar_rules.h"
#include "ode/dormand_prince.h"
#include "packs/jump_code.h"
#include "packs/quintics.h"
#include "packs/sharp_parts.h"

namespace gainsmith::packs {

namespace {

using lanes::LaneCode;
using model::Dynamics;
using numbers::ScalarGraph;
using numbers::ScalarOp;

// --- What packs run. ---

/// False where a jump repeats a pass until a condition holds: lanes would need different numbers of
/// passes.
bool runs_jumps(const Dynamics& dynamics) {
  return std::none_of(dynamics.reactions.begin(), dynamics.reactions.end(), [](const auto& one) {
    return std::ranges::any_of(one.passes, &Dynamics::Pass::repeats);
  });
}

/// False where the value of a stated claim is no number.
bool runs_claims(const std::vector<claims::Claim>& claims) {
  return std::none_of(claims.begin(), claims.end(), [](const claims::Claim& claim) {
    return claim.stated() && claim.value.shape().size() != 1;
  });
}

/// Where the cost of a claim is kept; none of other claims.
std::optional<std::size_t> cost_element(const claims::Claim& claim, const hybrid::System& system) {
  const auto slot = system.slot(model::cost_name(claim.name));
  if (!slot) return std::nullopt;
  return static_cast<std::size_t>(system.layout.slots[*slot].offset);
}

// --- A step. ---

/// One step of the method of Dormand and Prince, order 8 (DOP853; Hairer, Norsett and Wanner,
/// Solving Ordinary Differential Equations I, II.5, 1993):
///
///   k_i = f(x + h sum_{j<i} a_ij k_j),   x+ = x + h sum_j b_j k_j
///   e5, e3 = sum_j w_j k_j, the differences to embedded methods of order 5 and 3
///   err = h S5 / sqrt(n max(S5 + 0.01 S3, 1e-200)),   S = sum_i (e_i / allowed_i)^2
///   allowed_i = absolute_i + relative max(|x_i|, |x+_i|)
///
/// The sums run over the n values that are integrated; clocks are exact. A step may be taken where
/// err is at most 1. All stages are one list of operations, so that they share what they have in
/// common.
class StepCode {
 public:
  explicit StepCode(const PackSystem& pack) : pack_(pack), texts_(*pack.system, pack.costs) {}

  LaneCode make(double relative, const Eigen::VectorXd& absolute) {
    ScalarGraph& graph = texts_.graph();
    const Nodes x = texts_.inputs();
    h_ = texts_.beside(0);
    for (std::size_t stage = 0; stage < ode::kStages; ++stage) {
      Nodes at = stage == 0 ? x : moved(x, ode::kStageWeights[stage - 1]);
      k_.push_back(texts_.rates(at));
    }
    const Nodes end = moved(x, ode::kStageWeights.back());
    Nodes out;
    for (const int row : pack_.rows) out.push_back(end[index(row)]);
    const int relative_factor = graph.multiply(texts_.beside(1), graph.constant(relative));
    const int absolute_factor = texts_.beside(2);
    int sum5 = graph.constant(0);
    int sum3 = graph.constant(0);
    int count = 0;
    for (const int row : pack_.rows) {
      if (!is_integrated(row)) continue;
      ++count;
      const int size = graph.apply(ScalarOp::maximum, graph.apply(ScalarOp::abs, x[index(row)]),
                                   graph.apply(ScalarOp::abs, end[index(row)]));
      const int allowed = graph.add(graph.multiply(absolute_factor, graph.constant(absolute(row))),
                                    graph.multiply(relative_factor, size));
      const int part5 = graph.divide(weighted(row, ode::kErrorOfOrder5), allowed);
      const int part3 = graph.divide(weighted(row, error_of_order_3()), allowed);
      sum5 = graph.add(sum5, graph.multiply(part5, part5));
      sum3 = graph.add(sum3, graph.multiply(part3, part3));
    }
    return {graph, {out, {error(sum5, sum3, count)}}, pack_.whole + 3};
  }

 private:
  /// Whether a value has an error of integration: states that flow, and costs.
  bool is_integrated(int row) const {
    if (std::any_of(pack_.costs.begin(), pack_.costs.end(),
                    [row](const RunningCost& cost) { return index(row) == cost.element; }))
      return true;
    const auto& variables = pack_.system->dynamics.variables;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const hybrid::Slot& slot = pack_.system->layout.slots[i];
      if (row < slot.offset || row >= slot.offset + slot.shape.size()) continue;
      return pack_.system->moves[i] == hybrid::Moves::flows;
    }
    return false;
  }

  /// The weights of e3: those of x+ less those of the embedded method of order 3.
  static ode::StageWeights error_of_order_3() {
    ode::StageWeights weights = ode::kStageWeights.back();
    weights[0] -= ode::kOrder3Of1;
    weights[8] -= ode::kOrder3Of9;
    weights[11] -= ode::kOrder3Of12;
    return weights;
  }

  /// sum_j weights_j k_j of one row.
  int weighted(int row, const ode::StageWeights& weights) {
    ScalarGraph& graph = texts_.graph();
    int sum = graph.constant(0);
    for (std::size_t j = 0; j < k_.size(); ++j)
      if (weights[j] != 0)
        sum = graph.add(graph.multiply(graph.constant(weights[j]), k_[j][index(row)]), sum);
    return sum;
  }

  /// x + h sum_j weights_j k_j, with kinks and mirrored elements set anew.
  Nodes moved(const Nodes& x, const ode::StageWeights& weights) {
    ScalarGraph& graph = texts_.graph();
    Nodes at = x;
    for (const int row : pack_.rows)
      at[index(row)] = graph.add(graph.multiply(h_, weighted(row, weights)), x[index(row)]);
    texts_.complete(at);
    return at;
  }

  /// err from S5 and S3; 0 where nothing is integrated.
  int error(int sum5, int sum3, int count) {
    ScalarGraph& graph = texts_.graph();
    if (count == 0) return graph.constant(0);
    constexpr double tiny = 1e-200;
    const int both = graph.add(sum5, graph.multiply(graph.constant(0.01), sum3));
    const int scale = graph.apply(
        ScalarOp::sqrt, graph.multiply(graph.constant(count),
                                       graph.apply(ScalarOp::maximum, both, graph.constant(tiny))));
    return graph.divide(graph.multiply(h_, sum5), scale);
  }

  const PackSystem& pack_;
  PackGraph texts_;
  int h_ = 0;
  std::vector<Nodes> k_;
};

// --- Claims and what is watched. ---

/// The code of a point: rates, claims, and watched differences with their rates along the flow. The
/// rate of v(x) is the directional derivative v'(x) f(x), formed with the value by forward
/// differentiation. Terms are the sums of the absolute values of the terms of a value, which
/// rounding is measured by.
class PointCode {
 public:
  explicit PointCode(PackSystem& pack)
      : pack_(pack), texts_(*pack.system, pack.costs), sharp_(*pack.system, texts_.graph()) {
    x_ = texts_.inputs();
    rates_ = texts_.rates(x_);
    for (const int row : pack.rows) results_[PackSystem::rates].push_back(rates_[index(row)]);
  }

  void add(const claims::Claim& claim) {
    PackClaim& made = pack_.claims.emplace_back();
    made.kind = claim.kind;
    made.after = claim.after;
    made.over = claim.over;
    made.tolerance = claim.tolerance;
    made.always = claim.always;
    if (claim.kind == model::ClaimKind::cost) return add_cost(claim);
    const auto square = is_compared_once(claim) ? expr::square_of_norm(claim.value) : std::nullopt;
    made.squared = square.has_value();
    const expr::Program& text = square ? *square : claim.value;
    const numbers::TracedMatrix value = texts_.moving(text, x_, rates_);
    push(PackSystem::claim_values, value.value[0]);
    watch_peaks(value.value[0]);
    push(PackSystem::claim_rates, value.slopes[0][0]);
    made.rests = texts_.graph().is_zero(value.slopes[0][0]);
    made.starts_exact = is_exact(value.value[0]);
    push(PackSystem::claim_terms, texts_.value(hybrid::absolute_terms(text), x_).value[0]);
    const auto moves = [&](const std::string& name) { return pack_.system->is_moving(name); };
    for (const expr::Branch& branch : expr::branches_of(text, moves))
      for (const int node : texts_.value(branch.difference, x_).value) {
        made.branches.push_back(results_[PackSystem::extras].size());
        if (!branch.jumps) made.kinks.push_back(made.branches.back());
        push(PackSystem::extras, node);
      }
    for (const int node : sharp_.roots(value.value[0])) {
      made.roots.push_back(results_[PackSystem::extras].size());
      push(PackSystem::extras, node);
    }
  }

  /// False: a comparison that packs do not decide.
  bool add(const expr::Condition& condition, WatchedCondition& made) {
    made.kind = condition.kind;
    for (const expr::Condition& part : condition.parts)
      if (!add(part, made.parts.emplace_back())) return false;
    if (!condition.is_comparison()) return true;
    made.elements = watch(condition.difference);
    return condition.kind != expr::Condition::Kind::zero ||
           std::none_of(made.elements.begin(), made.elements.end(),
                        [&](const Watched& watched) { return pack_.watches[watched.watch].moves; });
  }

  /// Watches all elements; what is watched already, or its opposite, is not watched again.
  std::vector<Watched> watch(const expr::Program& difference) {
    const numbers::TracedMatrix value = texts_.moving(difference, x_, rates_);
    const Nodes terms = texts_.value(hybrid::terms_of_sign(difference), x_).value;
    const bool moves =
        std::any_of(difference.inputs.begin(), difference.inputs.end(),
                    [&](const expr::Input& input) { return pack_.system->is_moving(input.name); });
    std::vector<Watched> made;
    for (std::size_t e = 0; e < value.value.size(); ++e) {
      const int node = value.value[e];
      if (const auto same = known(node)) {
        made.push_back({*same, 1});
        continue;
      }
      if (const auto opposite = known(opposite_of(node))) {
        made.push_back({*opposite, -1});
        continue;
      }
      made.push_back({pack_.watches.size(), 1});
      watch_peaks(node);
      push(PackSystem::watch_values, node);
      push(PackSystem::watch_rates, value.slopes[0][e]);
      push(PackSystem::watch_terms, terms[e]);
      pack_.watches.push_back({moves, &difference, e, {}});
    }
    return made;
  }

  void add_kink(const expr::Program& difference) {
    for (const int node : texts_.value(difference, x_).value) {
      pack_.kinks.push_back(results_[PackSystem::extras].size());
      push(PackSystem::extras, node);
    }
  }

  void make() {
    pack_.point.emplace(texts_.graph(), results_, pack_.whole);
    using Is = PackSystem;
    pack_.coarse_point.emplace(
        without({Is::rates, Is::claim_rates, Is::claim_terms, Is::watch_terms, Is::extras}));
    pack_.between_points.emplace(
        without({Is::rates, Is::claim_rates, Is::claim_terms, Is::watch_rates, Is::watch_terms}));
  }

 private:
  /// With a number, without a tolerance: so is the square, with the square of the number.
  static bool is_compared_once(const claims::Claim& claim) {
    using model::ClaimKind;
    return claim.tolerance == 0 &&
           (claim.kind == ClaimKind::below || claim.kind == ClaimKind::above ||
            claim.kind == ClaimKind::shrinks);
  }

  /// Of values that are exact: whether it is one of them, or its size, or the largest of some.
  bool is_exact(int node) {
    const ScalarGraph::Node one = texts_.graph().nodes()[index(node)];
    switch (one.op) {
      case ScalarOp::input:
      case ScalarOp::constant:
        return true;
      case ScalarOp::abs:
      case ScalarOp::negate:
        return is_exact(one.a);
      case ScalarOp::minimum:
      case ScalarOp::maximum:
        return is_exact(one.a) && is_exact(one.b);
      default:
        return false;
    }
  }

  /// The same code without some results, and without what these alone need.
  LaneCode without(std::initializer_list<PackSystem::PointResult> left_out) {
    auto results = results_;
    for (const PackSystem::PointResult kind : left_out) results[kind].clear();
    return {texts_.graph(), results, pack_.whole, {}, numbers::Computed::needed};
  }

  /// A cost is a value of the state already: its element, its rate and its size.
  void add_cost(const claims::Claim& claim) {
    const std::size_t element = *cost_element(claim, *pack_.system);
    push(PackSystem::claim_values, x_[element]);
    push(PackSystem::claim_rates, rates_[element]);
    push(PackSystem::claim_terms, texts_.graph().apply(ScalarOp::abs, x_[element]));
  }

  /// Notes once each quantity beside which the value at a node has a narrow peak
  /// (SharpParts::flats).
  void watch_peaks(int node) {
    for (const int flat : sharp_.flats(node)) {
      auto& extras = results_[PackSystem::extras];
      const bool known = std::any_of(pack_.flats.begin(), pack_.flats.end(),
                                     [&](std::size_t k) { return extras[k] == flat; });
      if (known) continue;
      pack_.flats.push_back(extras.size());
      push(PackSystem::extras, flat);
    }
  }

  /// The watch whose value is this node. Equal nodes are one, so that indices are compared.
  std::optional<std::size_t> known(int node) const {
    const auto& all = results_[PackSystem::watch_values];
    const auto found = std::find(all.begin(), all.end(), node);
    if (found == all.end()) return std::nullopt;
    return static_cast<std::size_t>(found - all.begin());
  }

  /// The node of -d; for a difference a - b the node of b - a, which the graph may have already.
  int opposite_of(int node) {
    const ScalarGraph::Node one = texts_.graph().nodes()[index(node)];
    return one.op == ScalarOp::subtract ? texts_.graph().subtract(one.b, one.a)
                                        : texts_.graph().negate(node);
  }

  void push(PackSystem::PointResult result, int node) { results_[result].push_back(node); }

  PackSystem& pack_;
  PackGraph texts_;
  Nodes x_, rates_;
  SharpParts sharp_;
  std::vector<std::vector<int>> results_{PackSystem::extras + 1};
};

/// With what claims are compared, at the start of a run.
lanes::LaneCode start_code(const PackSystem& pack, const std::vector<claims::Claim>& claims) {
  PackGraph texts(*pack.system, pack.costs);
  const Nodes x = texts.inputs();
  const int zero = texts.graph().constant(0);
  std::vector<Nodes> results(PackSystem::limit_terms + 1);
  for (const claims::Claim& claim : claims) {
    if (!claim.stated()) continue;
    const bool is_cost = claim.kind == model::ClaimKind::cost;
    const expr::Program* limit = is_cost        ? &claim.value
                                 : claim.bound  ? &*claim.bound
                                 : claim.factor ? &*claim.factor
                                                : nullptr;
    results[PackSystem::limits].push_back(limit ? texts.value(*limit, x).value[0] : zero);
    results[PackSystem::limit_terms].push_back(
        is_cost ? texts.value(hybrid::absolute_terms(*limit), x).value[0] : zero);
  }
  return {texts.graph(), results, pack.whole};
}

/// Watches what an event is due by. False: packs do not decide its condition.
bool add_event(const Dynamics::Event& event, PointCode& point, PackSystem& pack) {
  PackEvent& made = pack.events.emplace_back();
  if (event.condition && !point.add(*event.condition, made.when.emplace())) return false;
  if (event.only_if && !point.add(*event.only_if, made.only_if.emplace())) return false;
  if (event.crossing) made.crossing = point.watch(event.crossing->program).front();
  return true;
}

/// Steps go up to kinks, across which the flow is continuous, where errors ask for it.
void add_switches(PointCode& point, PackSystem& pack) {
  for (const hybrid::Switch& one : pack.system->switches) {
    if (one.kind == hybrid::Switch::Kind::kink) {
      point.add_kink(one.difference);
      continue;
    }
    const auto& slot = pack.system->layout.slots[*pack.system->slot(one.input)];
    auto element = static_cast<std::size_t>(slot.offset);
    for (const Watched& watched : point.watch(one.difference))
      pack.watches[watched.watch].branches.push_back(
          {element++, watched.factor, one.kind == hybrid::Switch::Kind::sign, one.strict});
  }
}

}  // namespace

std::unique_ptr<const PackSystem> make_pack_system(const hybrid::System& system,
                                                   const hybrid::Scenario& scenario,
                                                   const std::vector<claims::Claim>& claims,
                                                   double relative,
                                                   const Eigen::VectorXd& absolute) {
  if (!system.dynamics.measured.empty() || !runs_jumps(system.dynamics) || !runs_claims(claims))
    return nullptr;
  auto pack = std::make_unique<PackSystem>();
  pack->system = &system;
  pack->scenario = &scenario;
  pack->accuracy = relative;
  pack->error_factor = claims::error_factor(system);
  pack->whole = static_cast<std::size_t>(system.whole);
  for (const claims::Claim& claim : claims)
    if (const auto element = cost_element(claim, system); element && claim.stated())
      pack->costs.push_back({*element, claim.flow_cost ? &*claim.flow_cost : nullptr,
                             claim.jump_cost ? &*claim.jump_cost : nullptr});
  pack->rows = PackGraph(system, pack->costs).rows();
  try {
    pack->step.emplace(StepCode(*pack).make(relative, absolute));
    PointCode point(*pack);
    for (const claims::Claim& claim : claims)
      if (claim.stated()) point.add(claim);
    for (const Dynamics::Event& event : system.dynamics.events)
      if (!add_event(event, point, *pack)) return nullptr;
    for (const Dynamics::Component& component : system.dynamics.components)
      for (const auto& set : component.flow_sets)
        if (!point.add(set.where, pack->flow_sets.emplace_back())) return nullptr;
    add_switches(point, *pack);
    point.make();
    pack->polynomials.emplace(StepPolynomials::code(pack->claims.size() + pack->watches.size()));
    pack->start.emplace(start_code(*pack, claims));
  } catch (const numbers::NoFormula&) {
    return nullptr;
  }
  for (std::size_t e = 0; e < pack->events.size(); ++e) {
    pack->events[e].jump.emplace(jump_code(*pack, e, false));
    if (system.dynamics.events[e].lost > 0) pack->events[e].lost.emplace(jump_code(*pack, e, true));
  }
  return pack;
}

}  // namespace gainsmith::packs
