// Claims: those of one size and unit in one panel, with what they must not pass.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gainsmith/run_panels.h"

namespace gainsmith::app {

namespace {

using verify::ClaimScope;
using verify::Replay;

/// Values that are further apart do not share one axis.
constexpr double kFar = 30;

/// A claim of one run where it is made, and what it must not pass.
struct ShownClaim {
  drawing::Curve value;
  std::optional<double> bound;
};

/// The claim of all runs.
struct ClaimOfRuns {
  std::size_t column = 0;
  std::string unit;
  std::vector<ShownClaim> runs;
  bool negative = false;  ///< somewhere
  double most = 0;        ///< the largest size
};

std::optional<double> bound_of(const ClaimScope& scope, const drawing::Curve& value) {
  if (scope.bound || !scope.factor) return scope.bound;
  const auto first = std::find_if(value.value.begin(), value.value.end(),
                                  [](double one) { return std::isfinite(one); });
  if (first == value.value.end()) return std::nullopt;
  return *scope.factor * *first;
}

ShownClaim shown(const Replay& replay, std::size_t column) {
  const ClaimScope& scope = replay.columns[column].scope;
  ShownClaim claim{curve_of(replay, {{column}, {}, replay.columns[column].name, false, 0}), {}};
  for (std::size_t row = 0; row < claim.value.t.size(); ++row)
    if (claim.value.t[row] < scope.after ||
        (!scope.over.empty() && replay.events[row] != scope.over))
      claim.value.value[row] = std::numeric_limits<double>::quiet_NaN();
  if (scope.after < replay.run.end) claim.bound = bound_of(scope, claim.value);
  return claim;
}

ClaimOfRuns claim_of(std::size_t column, const std::vector<DrawnRun>& runs, const RunView& view) {
  ClaimOfRuns claim{column, unit_of(view, runs.front().replay.columns[column]), {}};
  for (const DrawnRun& run : runs) {
    claim.runs.push_back(shown(run.replay, column));
    const auto see = [&](double value) {
      if (!std::isfinite(value)) return;
      claim.negative = claim.negative || value < 0;
      claim.most = std::max(claim.most, std::abs(value));
    };
    for (const double value : claim.runs.back().value.value) see(value);
    if (claim.runs.back().bound) see(*claim.runs.back().bound);
  }
  return claim;
}

/// What shares one panel: of one unit and sign, none much smaller than the next larger one. In the
/// order of their first members. Of several runs each claim is alone.
std::vector<std::vector<ClaimOfRuns>> grouped(std::vector<ClaimOfRuns> claims, bool alone) {
  std::vector<std::vector<ClaimOfRuns>> groups;
  while (!claims.empty()) {
    std::vector<ClaimOfRuns> group = {claims.front()};
    claims.erase(claims.begin());
    const auto fits = [&](const ClaimOfRuns& claim) {
      return !alone && std::any_of(group.begin(), group.end(), [&](const ClaimOfRuns& member) {
        const auto [least, greatest] = std::minmax(claim.most, member.most);
        return claim.unit == member.unit && claim.negative == member.negative &&
               (greatest <= kFar * least || greatest == 0);
      });
    };
    for (auto next = std::find_if(claims.begin(), claims.end(), fits); next != claims.end();
         next = std::find_if(claims.begin(), claims.end(), fits)) {
      group.push_back(*next);
      claims.erase(next);
    }
    std::sort(group.begin(), group.end(),
              [](const ClaimOfRuns& a, const ClaimOfRuns& b) { return a.column < b.column; });
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Whether its values are worth a logarithmic axis.
bool is_wide(const drawing::Panel& panel) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const drawing::Curve& curve : panel.curves)
    for (const double value : curve.value) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  return least >= 0 && most > kFar * least;
}

drawing::Panel panel_of(const std::vector<ClaimOfRuns>& group, const std::vector<DrawnRun>& runs) {
  drawing::Panel panel;
  panel.axis = group.front().unit;
  const bool overlaid = runs.size() > 1;
  for (std::size_t c = 0; c < group.size(); ++c)
    for (std::size_t r = 0; r < runs.size(); ++r) {
      drawing::Curve curve = group[c].runs[r].value;
      curve.colour = static_cast<int>(overlaid ? r : c + 1);
      if (overlaid) curve.label = "run " + std::to_string(runs[r].number);
      if (!overlaid && group.size() == 1) curve.label.clear();  // the title names it
      panel.curves.push_back(curve);
      const auto& bound = group[c].runs[r].bound;
      if (!bound || (overlaid && r > 0 && bound == group[c].runs[0].bound)) continue;
      const ClaimScope& scope = runs[r].replay.columns[group[c].column].scope;
      drawing::Curve limit;
      limit.t = {scope.after, runs[r].replay.run.end};
      limit.value = {*bound, *bound};
      limit.limit = true;
      limit.colour = curve.colour;
      panel.curves.push_back(std::move(limit));
    }
  panel.logarithmic = is_wide(panel);
  return panel;
}

}  // namespace

std::vector<drawing::Panel> claim_panels(const std::vector<std::size_t>& claims,
                                         const std::vector<DrawnRun>& runs, const RunView& view) {
  std::vector<ClaimOfRuns> all;
  for (const std::size_t column : claims) all.push_back(claim_of(column, runs, view));
  std::vector<drawing::Panel> panels;
  for (const auto& group : grouped(std::move(all), runs.size() > 1)) {
    panels.push_back(panel_of(group, runs));
    const std::string& name = runs.front().replay.columns[group.front().column].name;
    panels.back().title = group.size() == 1 ? "claim " + name : "claims";
  }
  return panels;
}

}  // namespace gainsmith::app
