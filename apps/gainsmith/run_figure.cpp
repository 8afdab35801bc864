// What a person wants to see of a run: states with their estimates, errors, claims.
#include <algorithm>
#include <cmath>
#include <map>

#include "gainsmith/run_table.h"
#include "report/figure.h"

namespace gainsmith::app {

namespace {

using verify::Column;
using verify::EventReplay;
using Kind = Column::Kind;

constexpr std::size_t kMostPanels = 6;

report::Curve curve(const EventReplay& replay, std::size_t column) {
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

/// One panel a state of the plant, each observer in its colour; or, of one observer, all states.
void add_states(const EventReplay& replay, report::Figure& figure) {
  for (std::size_t k = 0; k < replay.columns.size() && figure.panels.size() < kMostPanels; ++k) {
    const Column& state = replay.columns[k];
    if (state.kind != Kind::state || !state.observer.empty()) continue;
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
}

/// The size of a signal that begins with e, on a logarithmic axis.
void add_errors(const EventReplay& replay, report::Figure& figure) {
  std::map<std::string, report::Curve> sizes;
  std::vector<std::string> order;
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    const Column& column = replay.columns[k];
    if (column.kind != Kind::signal || !column.stem.starts_with("e")) continue;
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

/// On a logarithmic axis those that are never negative; the others, such as dissipation
/// inequalities, on one of their own.
void add_claims(const EventReplay& replay, report::Figure& figure) {
  report::Panel sizes;
  sizes.title = "claims";
  sizes.logarithmic = true;
  report::Panel signed_ones;
  signed_ones.title = "claims of either sign";
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    if (replay.columns[k].kind != Kind::claim) continue;
    report::Curve one = curve(replay, k);
    const bool negative =
        std::any_of(one.value.begin(), one.value.end(), [](double value) { return value < 0; });
    report::Panel& panel = negative ? signed_ones : sizes;
    one.colour = static_cast<int>(panel.curves.size()) + 1;
    panel.curves.push_back(std::move(one));
  }
  for (report::Panel* panel : {&sizes, &signed_ones})
    if (!panel->curves.empty()) figure.panels.push_back(std::move(*panel));
}

}  // namespace

std::string run_figure(const std::string& title, const EventReplay& replay) {
  report::Figure figure;
  figure.title = title;
  figure.axis = "t";
  add_states(replay, figure);
  add_errors(replay, figure);
  add_claims(replay, figure);
  return report::svg(figure);
}

}  // namespace gainsmith::app
