#include "verify/twin_parts.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "verify/flow_looks.h"

namespace gainsmith::verify {

namespace {

using Eigen::VectorXd;
using hybrid::FlowPiece;
using hybrid::JumpPoint;
using hybrid::Trajectory;

constexpr std::size_t kMostAtOnce = 16;  ///< jumps of one instant

/// The next jumps of a run, and the length of the flows before and between them.
struct Instant {
  std::vector<const JumpPoint*> jumps;
  std::size_t end = 0;  ///< the part after them
  double flows = 0;
};

class Pairs {
 public:
  Pairs(const Trajectory& run, const Trajectory& twin, const hybrid::EventSystem& system,
        hybrid::JumpMaps& maps)
      : run_(run), twin_(twin), system_(system), maps_(maps) {}

  TwinParts all() {
    while (at_ < run_.parts.size() && other_ < twin_.parts.size())
      if (!alike() && !at_once()) return std::move(result_);
    result_.whole = at_ == run_.parts.size() && other_ == twin_.parts.size();
    return std::move(result_);
  }

 private:
  bool alike() {
    const auto& one = run_.parts[at_];
    const auto& other = twin_.parts[other_];
    if (one.index() != other.index()) return false;
    if (const auto* flow = std::get_if<FlowPiece>(&one)) {
      result_.parts.emplace_back(TwinFlow{flow, &std::get<FlowPiece>(other), {}});
    } else {
      const auto& jump = std::get<JumpPoint>(one);
      const auto& twin = std::get<JumpPoint>(other);
      if (jump.event != twin.event || jump.lost != twin.lost) return false;
      result_.parts.emplace_back(TwinJump{&jump, twin.before, twin.after, twin.t});
    }
    ++at_;
    ++other_;
    return true;
  }

  /// The same jumps in another order, as few as there are.
  bool at_once() {
    for (std::size_t count = 1; count <= kMostAtOnce; ++count) {
      const auto own = next(run_, at_, count);
      const auto other = next(twin_, other_, count);
      const double longest = kInstantOfRun * run_.end;
      if (!own || !other || own->flows > longest || other->flows > longest) return false;
      if (keys(*own) == keys(*other)) return in_order(*own, *other);
    }
    return false;
  }

  static std::optional<Instant> next(const Trajectory& run, std::size_t from, std::size_t count) {
    Instant result;
    result.end = from;
    while (result.jumps.size() < count) {
      if (result.end == run.parts.size()) return std::nullopt;
      const auto& part = run.parts[result.end++];
      if (const auto* flow = std::get_if<FlowPiece>(&part))
        result.flows += flow->to() - flow->from();
      else
        result.jumps.push_back(&std::get<JumpPoint>(part));
    }
    return result;
  }

  static std::vector<std::pair<std::size_t, bool>> keys(const Instant& instant) {
    std::vector<std::pair<std::size_t, bool>> result;
    for (const JumpPoint* jump : instant.jumps) result.emplace_back(jump->event, jump->lost);
    std::sort(result.begin(), result.end());
    return result;
  }

  bool in_order(const Instant& own, const Instant& other) {
    const auto& first = twin_.parts[other_];
    const auto* flow = std::get_if<FlowPiece>(&first);
    VectorXd values = flow != nullptr ? flow->start : std::get<JumpPoint>(first).before;
    const double twin_t = flow != nullptr ? flow->from() : std::get<JumpPoint>(first).t;
    std::vector<std::variant<TwinFlow, TwinJump>> parts;
    for (; at_ < own.end; ++at_) {
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
      parts.emplace_back(TwinJump{&jump, before, values, twin_t});
    }
    std::get<TwinJump>(parts.back()).twin_after = other.jumps.back()->after;
    std::move(parts.begin(), parts.end(), std::back_inserter(result_.parts));
    other_ = other.end;
    return true;
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
  const hybrid::EventSystem& system_;
  hybrid::JumpMaps& maps_;
  std::size_t at_ = 0, other_ = 0;
  TwinParts result_;
};

}  // namespace

VectorXd TwinFlow::twin_at(double share) const {
  return twin != nullptr ? state_at(*twin, share) : stays;
}

TwinParts pair_twins(const Trajectory& run, const Trajectory& twin,
                     const hybrid::EventSystem& system, hybrid::JumpMaps& maps) {
  return Pairs(run, twin, system, maps).all();
}

}  // namespace gainsmith::verify
