// What a person wants to see of a run: states with their estimates, errors, claims.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "gainsmith/run_table.h"
#include "report/figure.h"

namespace gainsmith::app {

namespace {

using verify::Column;
using verify::Replay;
using Kind = Column::Kind;

constexpr std::size_t kMostPanels = 6;

report::Curve curve(const Replay& replay, std::size_t column) {
  report::Curve result;
  result.label = replay.columns[column].name;
  for (Eigen::Index row = 0; row < replay.table.rows(); ++row) {
    result.t.push_back(replay.table(row, 0));
    result.value.push_back(replay.table(row, static_cast<Eigen::Index>(column)));
    if (row > 0 && replay.table(row, 1) > replay.table(row - 1, 1))
      result.jumps.push_back(static_cast<std::size_t>(row) - 1);
  }
  return result;
}

/// "xh2" or "x_hat2" for "x2": a column of an observer that estimates one of the plant.
bool estimates(const Column& estimate, const Column& state) {
  if (estimate.observer.empty()) return false;
  const std::string own = estimate.name.substr(estimate.name.rfind('.') + 1);
  const std::string index = state.name.substr(state.stem.size());
  return (estimate.stem == state.stem + "h" || estimate.stem == state.stem + "_hat") &&
         own == estimate.stem + index;
}

bool has_estimate(const Replay& replay, const Column& column) {
  return std::any_of(replay.columns.begin(), replay.columns.end(),
                     [&](const Column& one) { return estimates(one, column); });
}

/// Where the plant has neither, as a log: one panel a state of the observers.
void add_own_states(const Replay& replay, report::Figure& figure) {
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    const Column& state = replay.columns[k];
    if (state.kind != Kind::state || state.observer.empty()) continue;
    const std::string own = state.name.substr(state.name.rfind('.') + 1);
    const auto known = std::find_if(figure.panels.begin(), figure.panels.end(),
                                    [&](const report::Panel& panel) { return panel.title == own; });
    if (known == figure.panels.end() && figure.panels.size() == kMostPanels) continue;
    report::Panel& panel = known == figure.panels.end() ? figure.panels.emplace_back() : *known;
    panel.title = own;
    panel.curves.push_back(curve(replay, k));
    panel.curves.back().colour = static_cast<int>(panel.curves.size());
  }
}

/// One panel a state of the plant, or an output that is estimated, each observer in its colour.
void add_states(const Replay& replay, report::Figure& figure) {
  for (std::size_t k = 0; k < replay.columns.size() && figure.panels.size() < kMostPanels; ++k) {
    const Column& state = replay.columns[k];
    const bool is_output = state.kind == Kind::signal && has_estimate(replay, state);
    if (!state.observer.empty() || (state.kind != Kind::state && !is_output)) continue;
    report::Panel panel;
    panel.title = state.name;
    panel.curves.push_back(curve(replay, k));
    int colour = 0;
    for (std::size_t e = 0; e < replay.columns.size(); ++e) {
      const Column& estimate = replay.columns[e];
      if ((estimate.kind != Kind::state && estimate.kind != Kind::signal) ||
          !estimates(estimate, state))
        continue;
      panel.curves.push_back(curve(replay, e));
      panel.curves.back().dashed = true;
      panel.curves.back().colour = ++colour;
    }
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) add_own_states(replay, figure);
}

bool is_error(const Column& column) {
  return column.kind == Kind::signal &&
         (column.stem == "e" || column.stem.starts_with("e_") || column.stem.starts_with("error"));
}

/// The sizes of errors, signals e, e_... or error..., on a logarithmic axis.
void add_errors(const Replay& replay, report::Figure& figure) {
  std::map<std::string, report::Curve> sizes;
  std::vector<std::string> order;
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    const Column& column = replay.columns[k];
    if (!is_error(column)) continue;
    const std::string name =
        column.observer.empty() ? column.stem : column.observer + "." + column.stem;
    report::Curve one = curve(replay, k);
    const auto [found, fresh] = sizes.try_emplace(name, one);
    if (fresh) order.push_back(name);
    for (std::size_t i = 0; i < one.value.size(); ++i)
      found->second.value[i] =
          fresh ? std::abs(one.value[i]) : std::hypot(found->second.value[i], one.value[i]);
  }
  if (order.empty()) return;
  report::Panel panel;
  panel.title = "size of the error";
  panel.logarithmic = true;
  for (std::size_t k = 0; k < order.size(); ++k) {
    report::Curve one = sizes.at(order[k]);
    one.label = "|" + order[k] + "|";
    one.colour = static_cast<int>(k) + 1;
    panel.curves.push_back(std::move(one));
  }
  figure.panels.push_back(std::move(panel));
}

/// The value of a claim where it is made.
report::Curve claimed(const Replay& replay, std::size_t column) {
  const verify::ClaimScope& scope = replay.columns[column].scope;
  report::Curve result = curve(replay, column);
  for (std::size_t row = 0; row < result.t.size(); ++row)
    if (result.t[row] < scope.after || (!scope.over.empty() && replay.events[row] != scope.over))
      result.value[row] = std::numeric_limits<double>::quiet_NaN();
  return result;
}

/// What it must not exceed or fall below.
report::Curve bound_of(const Replay& replay, const report::Curve& claim,
                       const verify::ClaimScope& scope) {
  report::Curve line;
  line.t = {scope.after, replay.run.end};
  line.value = {*scope.bound, *scope.bound};
  line.dashed = true;
  line.colour = claim.colour;
  return line;
}

/// Whether its values are worth a logarithmic axis.
bool is_wide(const report::Panel& panel) {
  constexpr double kWide = 30;
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const report::Curve& curve : panel.curves)
    for (const double value : curve.value) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  return most > kWide * least;
}

/// On a logarithmic axis those that are never negative; the others, such as dissipation
/// inequalities, on one of their own.
void add_claims(const Replay& replay, report::Figure& figure) {
  report::Panel sizes;
  sizes.title = "claims";
  report::Panel signed_ones;
  signed_ones.title = "claims of either sign";
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    if (replay.columns[k].kind != Kind::claim) continue;
    report::Curve one = claimed(replay, k);
    const verify::ClaimScope& scope = replay.columns[k].scope;
    const bool negative =
        scope.bound.value_or(0) < 0 ||
        std::any_of(one.value.begin(), one.value.end(), [](double value) { return value < 0; });
    report::Panel& panel = negative ? signed_ones : sizes;
    one.colour = 1 + static_cast<int>(
                         std::count_if(panel.curves.begin(), panel.curves.end(),
                                       [](const report::Curve& curve) { return !curve.dashed; }));
    panel.curves.push_back(std::move(one));
    const bool is_made = scope.after < replay.run.end;
    if (scope.bound && is_made && (negative || *scope.bound > 0))
      panel.curves.push_back(bound_of(replay, panel.curves.back(), scope));
  }
  sizes.logarithmic = is_wide(sizes);
  for (report::Panel* panel : {&sizes, &signed_ones})
    if (!panel->curves.empty()) figure.panels.push_back(std::move(*panel));
}

/// A tick at each jump.
void add_marks(const Replay& replay, report::Figure& figure) {
  for (std::size_t row = 0; row < replay.events.size(); ++row)
    if (!replay.events[row].empty())
      figure.marks.push_back(replay.table(static_cast<Eigen::Index>(row), 0));
}

}  // namespace

std::string run_figure(const std::string& title, const Replay& replay) {
  report::Figure figure;
  figure.title = title;
  figure.axis = "t";
  add_states(replay, figure);
  add_errors(replay, figure);
  add_claims(replay, figure);
  add_marks(replay, figure);
  return report::svg(figure);
}

}  // namespace gainsmith::app
