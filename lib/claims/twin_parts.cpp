#include "claims/twin_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/unit_roundoff.h"
#include "base/whole_number.h"
#include "claims/sample_points.h"

namespace gainsmith::claims {

namespace {

using Eigen::VectorXd;
using hybrid::FlowPiece;
using hybrid::JumpPoint;
using hybrid::Trajectory;

/// The next jumps of a run that lie within one instant.
struct Instant {
  struct Jump {
    const JumpPoint* point;
    std::size_t part;
  };
  std::vector<Jump> jumps;
};

/// What is told apart of a jump.
using Key = std::pair<std::size_t, bool>;
Key key_of(const JumpPoint& jump) { return {jump.event, jump.lost}; }

double length_of(const FlowPiece& flow) { return flow.to() - flow.from(); }

class Pairs {
 public:
  Pairs(const Trajectory& run, const Trajectory& twin, const hybrid::System& system,
        simulate::JumpMaps& maps)
      : run_(run), twin_(twin), system_(system), maps_(maps) {}

  TwinParts all() {
    while (at_ < run_.parts.size() || other_ < twin_.parts.size())
      if (!alike(true) && !at_once() && !alike(false)) return std::move(result_);
    result_.whole = true;
    return std::move(result_);
  }

 private:
  bool is_short(const FlowPiece& flow) const { return length_of(flow) <= kInstantOfRun * run_.end; }

  /// `strictly`: not a flow within an instant beside a longer one.
  bool alike(bool strictly) {
    if (at_ == run_.parts.size() || other_ == twin_.parts.size()) return false;
    const auto& one = run_.parts[at_];
    const auto& other = twin_.parts[other_];
    if (one.index() != other.index()) return false;
    if (const auto* flow = std::get_if<FlowPiece>(&one)) {
      const auto& twin = std::get<FlowPiece>(other);
      if (strictly && is_short(*flow) != is_short(twin)) return false;
      if (!is_short(*flow)) happened_.clear();
      result_.parts.emplace_back(TwinFlow{flow, &twin, {}});
    } else {
      const auto& jump = std::get<JumpPoint>(one);
      const auto& twin = std::get<JumpPoint>(other);
      if (key_of(jump) != key_of(twin)) return false;
      happened_.insert(key_of(jump));
      result_.parts.emplace_back(TwinJump{&jump, twin.before, twin.after, twin.t});
    }
    ++at_;
    ++other_;
    return true;
  }

  /// The same jumps in another order, as few as there are; or the same events, some of them more
  /// often than in the other.
  bool at_once() {
    const Instant own = next(run_, at_);
    const Instant other = next(twin_, other_);
    // At the start no flow tells them apart: each has jumps that the other has not.
    const auto at_start = [&](const Instant::Jump& jump) {
      return jump.point->t <= kInstantOfRun * run_.end;
    };
    if (std::ranges::all_of(own.jumps, at_start) && std::ranges::all_of(other.jumps, at_start))
      return false;
    std::map<Key, int> open;
    const auto add = [&](const JumpPoint& jump, int by) {
      if ((open[key_of(jump)] += by) == 0) open.erase(key_of(jump));
    };
    for (std::size_t k = 0; k < std::min(own.jumps.size(), other.jumps.size()); ++k) {
      add(*own.jumps[k].point, 1);
      add(*other.jumps[k].point, -1);
      if (open.empty()) return in_order(own, k + 1, other, k + 1);
    }
    if (own.jumps.empty() && other.jumps.empty()) return false;
    if (with_happened(own) != with_happened(other)) return false;
    return in_order(own, own.jumps.size(), other, other.jumps.size());
  }

  Instant next(const Trajectory& run, std::size_t from) const {
    Instant result;
    double flows = 0;
    for (std::size_t part = from; part < run.parts.size(); ++part) {
      if (const auto* flow = std::get_if<FlowPiece>(&run.parts[part])) {
        flows += length_of(*flow);
        if (flows > kInstantOfRun * run_.end) break;
      } else {
        result.jumps.push_back({&std::get<JumpPoint>(run.parts[part]), part});
      }
    }
    return result;
  }

  std::set<Key> with_happened(const Instant& instant) const {
    std::set<Key> result = happened_;
    for (const auto& jump : instant.jumps) result.insert(key_of(*jump.point));
    return result;
  }

  /// So many jumps of both; those of the second run are taken again.
  bool in_order(const Instant& own, std::size_t count, const Instant& other,
                std::size_t other_count) {
    const auto start = before_next();
    if (!start) return false;
    auto [values, twin_t] = *start;
    std::vector<std::variant<TwinFlow, TwinJump>> parts;
    const std::size_t end = count > 0 ? own.jumps[count - 1].part + 1 : at_;
    for (; at_ < end; ++at_) {
      if (const auto* piece = std::get_if<FlowPiece>(&run_.parts[at_])) {
        parts.emplace_back(TwinFlow{piece, nullptr, with_clocks_of(piece->start, values)});
        continue;
      }
      const auto& jump = std::get<JumpPoint>(run_.parts[at_]);
      const VectorXd before = with_clocks_of(jump.before, values);
      try {
        values = after(jump, before);
      } catch (const std::exception&) {
        return false;
      }
      happened_.insert(key_of(jump));
      parts.emplace_back(TwinJump{&jump, before, values, twin_t});
    }
    std::move(parts.begin(), parts.end(), std::back_inserter(result_.parts));
    if (other_count == 0) return true;
    const auto& last = other.jumps[other_count - 1];
    other_ = last.part + 1;
    if (auto* jump = std::get_if<TwinJump>(&result_.parts.back()))
      jump->twin_after = with_clocks_of(jump->jump->after, last.point->after);
    return true;
  }

  /// Values and time of the second run there; none where nothing is left of it.
  std::optional<std::pair<VectorXd, double>> before_next() const {
    if (other_ < twin_.parts.size()) {
      const auto& part = twin_.parts[other_];
      if (const auto* flow = std::get_if<FlowPiece>(&part))
        return std::pair(flow->start, flow->from());
      return std::pair(std::get<JumpPoint>(part).before, std::get<JumpPoint>(part).t);
    }
    if (other_ == 0) return std::nullopt;
    const auto& part = twin_.parts[other_ - 1];
    if (const auto* flow = std::get_if<FlowPiece>(&part)) return std::pair(flow->end, flow->to());
    return std::pair(std::get<JumpPoint>(part).after, std::get<JumpPoint>(part).t);
  }

  VectorXd after(const JumpPoint& jump, const VectorXd& before) {
    VectorXd whole = VectorXd::Zero(system_.whole);
    whole.head(before.size()) = before;
    return maps_(jump.event, jump.lost, whole).head(before.size());
  }

  /// Times, noise and what else is given are those of the run.
  VectorXd with_clocks_of(const VectorXd& run, const VectorXd& values) const {
    using Kind = model::Dynamics::VariableKind;
    VectorXd result = run;
    const auto& variables = system_.dynamics.variables;
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const Kind kind = variables[k].kind;
      const bool own = kind == Kind::state || kind == Kind::mode || kind == Kind::jumps ||
                       kind == Kind::count || kind == Kind::passes;
      if (!own) continue;
      const hybrid::Slot& slot = system_.layout.slots[k];
      result.segment(slot.offset, slot.shape.size()) =
          values.segment(slot.offset, slot.shape.size());
    }
    return result;
  }

  const Trajectory& run_;
  const Trajectory& twin_;
  const hybrid::System& system_;
  simulate::JumpMaps& maps_;
  std::size_t at_ = 0, other_ = 0;
  std::set<Key> happened_;  ///< within this instant
  TwinParts result_;
};

}  // namespace

VectorXd errors_of(const VectorXd& run, const VectorXd& twin, double factor) {
  VectorXd result = factor * (run - twin).cwiseAbs();
  for (Eigen::Index e = 0; e < result.size(); ++e)
    if (result(e) != 0 || !is_exact_whole(run(e)))
      result(e) += 8 * kUnitRoundoff * std::abs(run(e));
  return result;
}

VectorXd TwinFlow::twin_at(double share) const {
  return twin != nullptr ? state_at(*twin, share) : stays;
}

TwinParts pair_twins(const Trajectory& run, const Trajectory& twin, const hybrid::System& system,
                     simulate::JumpMaps& maps) {
  return Pairs(run, twin, system, maps).all();
}

}  // namespace gainsmith::claims
