#include "gainsmith/run_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "claims/run_values.h"
#include "gainsmith/plane_background.h"
#include "gainsmith/run_panels.h"
#include "model/problem.h"

namespace gainsmith::app {

namespace {

using verify::Column;
using verify::Replay;

drawing::Band band_of(const Replay& replay, const PlannedBand& planned) {
  constexpr double kSigmas = 2;
  const drawing::Curve estimate = curve_of(replay, {{planned.estimate}, {}, "", false, 0});
  const std::vector<double> variance = values_of(replay, planned.variance);
  drawing::Band band;
  band.t = estimate.t;
  band.jumps = estimate.jumps;
  for (std::size_t k = 0; k < variance.size(); ++k) {
    const double half = kSigmas * std::sqrt(variance[k]);
    band.low.push_back(estimate.value[k] - half);
    band.high.push_back(estimate.value[k] + half);
  }
  return band;
}

/// What has several solid lines, whose runs would have the same colours, in a panel each.
std::vector<PlannedPanel> parted(const PlannedPanel& planned) {
  std::vector<PlannedPanel> panels;
  for (const PlannedLine& line : planned.lines) {
    if (line.dashed && !panels.empty()) {
      panels.back().lines.push_back(line);
      continue;
    }
    panels.push_back(planned);
    panels.back().title = line.label;
    panels.back().lines = {line};
    std::erase_if(panels.back().bands,
                  [&](const PlannedBand& band) { return band.colour != line.colour; });
  }
  if (panels.size() < 2) return {planned};
  return panels;
}

/// Behind each estimate what corrects it.
PlannedPanel with_measurements(PlannedPanel panel, const DrawnRun& run) {
  constexpr int kGrey = 7;
  std::vector<PlannedLine> lines;
  for (const Correction& correction : run.corrections) {
    const auto draws = [&](std::size_t column) {
      return [column](const PlannedLine& line) {
        return line.columns == std::vector{column} && !line.across && !line.size;
      };
    };
    if (std::ranges::any_of(panel.lines, draws(correction.estimate)) &&
        std::ranges::none_of(panel.lines, draws(correction.measured)) &&
        std::ranges::none_of(lines, draws(correction.measured)))
      lines.push_back(
          {{correction.measured}, {}, run.replay.columns[correction.measured].name, false, kGrey});
  }
  panel.lines.insert(panel.lines.begin(), lines.begin(), lines.end());
  return panel;
}

/// A tick at each event.
void add_marks(const Replay& replay, drawing::Figure& figure) {
  for (std::size_t row = 0; row < replay.events.size(); ++row)
    if (!replay.events[row].empty())
      figure.marks.push_back(replay.table(static_cast<Eigen::Index>(row), 0));
}

/// Not larger than its rounding, or than that of its neighbours where its own is hardly less: among
/// what is rounding a few values come out larger.
bool is_rounding(const Replay& replay, Eigen::Index row, Eigen::Index column) {
  constexpr double kHardly = 10;
  constexpr Eigen::Index kNeighbours = 10;
  if (replay.rounding.size() == 0) return false;
  const double size = std::abs(replay.table(row, column));
  const double own = replay.rounding(row, column);
  if (size <= own) return true;
  if (!(size <= kHardly * own)) return false;
  const Eigen::Index first = std::max<Eigen::Index>(0, row - kNeighbours);
  const Eigen::Index last = std::min(replay.table.rows() - 1, row + kNeighbours);
  return (replay.rounding.col(column).segment(first, last - first + 1).array() >= size).any();
}

bool is_flow(const Replay& replay, Eigen::Index row) {
  return replay.table(row, 1) == replay.table(row - 1, 1);
}

/// The longest time between two points of a flow, as the integration went.
double widest_gap(const hybrid::Trajectory& run) {
  double widest = 0, last = 0;
  std::int64_t j = 0;
  claims::visit(run, 0, [&](const claims::Moment& moment) {
    if (moment.j == j) widest = std::max(widest, moment.t - last);
    last = moment.t;
    j = moment.j;
  });
  return widest;
}

/// How far points of flows lie from the line between their neighbours, of states and signals: the
/// largest distance in thousandths of the range of its column. Of points twice as dense it is a
/// quarter. Up to 1 a picture shows no corner.
double bend_of(const Replay& replay) {
  constexpr double kSeen = 1e-3;
  double bend = 0;
  for (std::size_t k = 0; k < replay.columns.size(); ++k) {
    const Column::Kind kind = replay.columns[k].kind;
    if (kind != Column::Kind::state && kind != Column::Kind::signal) continue;
    const auto t = replay.table.col(0);
    const auto value = replay.table.col(static_cast<Eigen::Index>(k));
    const double range =
        value.maxCoeff<Eigen::PropagateNumbers>() - value.minCoeff<Eigen::PropagateNumbers>();
    if (!(range > 0) || !std::isfinite(range)) continue;
    for (Eigen::Index row = 2; row < replay.table.rows(); ++row) {
      const double length = t(row) - t(row - 2);
      if (!is_flow(replay, row) || !is_flow(replay, row - 1) || !(length > 0)) continue;
      const double share = (t(row - 1) - t(row - 2)) / length;
      const double between = value(row - 2) + share * (value(row) - value(row - 2));
      const double away = std::abs(value(row - 1) - between) / (kSeen * range);
      if (away > bend) bend = away;  // what is no number is not
    }
  }
  return bend;
}

}  // namespace

const std::vector<std::string>& panel_groups() {
  static const std::vector<std::string> groups = {"states", "inputs", "errors", "claims"};
  return groups;
}

RunView view_of(const model::Design& design) {
  RunView view;
  if (!design.source) return view;
  const model::Problem& problem = *design.source;
  for (const model::UnitText& text : problem.units) view.units[text.name] = text.units;
  for (const model::CovarianceText& text : problem.covariances)
    view.covariances.push_back({text.estimate, text.covariance});
  for (const model::Named& input : problem.method->inputs) view.inputs.insert(input.name);
  for (const model::MeasuredText& text : problem.method->measured)
    if (!text.output) view.inputs.insert(text.name);
  return view;
}

std::string unit_of(const RunView& view, const Column& column) {
  for (const std::string& name : {column.observer + "." + column.stem, column.stem}) {
    const auto found = view.units.find(name);
    if (found == view.units.end()) continue;
    const std::vector<std::string>& units = found->second;
    const auto element = static_cast<std::size_t>(column.element);
    return units.size() == 1 ? units.front() : element < units.size() ? units[element] : "";
  }
  return {};
}

DrawnRun drawn_run(const verify::Setup& setup, std::uint64_t number, hybrid::Trajectory run,
                   double step) {
  constexpr double kPoints = 1500, kMostPoints = 12000;
  verify::Replay replay;
  replay.run = std::move(run);
  const double usual = replay.run.end / kPoints;
  const auto fill = [&](double next) {
    step = next;
    replay = verify::table_of_run(setup, std::move(replay.run), step);
  };
  const bool as_asked =
      step > 0 || replay.run.end <= 0 || replay.run.ending == hybrid::Ending::interrupted;
  const bool is_dense = as_asked || widest_gap(replay.run) <= usual;
  if (is_dense) fill(step);
  if (!as_asked && (!is_dense || bend_of(replay) > 1)) {
    fill(usual);
    if (const double bend = bend_of(replay); bend > 1)
      fill(replay.run.end / std::min(kPoints * std::ceil(std::sqrt(bend)), kMostPoints));
  }
  verify::add_rounding(setup, step, replay);
  auto corrected = corrections(setup.events->system, replay);
  return {number, std::move(replay), std::move(corrected)};
}

std::vector<double> values_of(const Replay& replay, std::size_t column) {
  const auto at = static_cast<Eigen::Index>(column);
  std::vector<double> values;
  for (Eigen::Index row = 0; row < replay.table.rows(); ++row) {
    values.push_back(is_rounding(replay, row, at) ? 0 : replay.table(row, at));
  }
  return values;
}

drawing::Curve curve_of(const Replay& replay, const PlannedLine& line) {
  drawing::Curve curve;
  curve.label = line.label;
  curve.dashed = line.dashed;
  curve.colour = line.colour;
  for (Eigen::Index row = 0; row < replay.table.rows(); ++row) {
    curve.t.push_back(replay.table(row, 0));
    if (row > 0 && replay.table(row, 1) > replay.table(row - 1, 1))
      curve.jumps.push_back(static_cast<std::size_t>(row) - 1);
  }
  if (line.across) curve.t = values_of(replay, *line.across);
  curve.value = values_of(replay, line.columns.front());
  if (!line.size) return curve;
  for (double& value : curve.value) value = std::abs(value);
  for (std::size_t k = 1; k < line.columns.size(); ++k) {
    const std::vector<double> more = values_of(replay, line.columns[k]);
    for (std::size_t row = 0; row < more.size(); ++row)
      curve.value[row] = std::hypot(curve.value[row], more[row]);
  }
  return curve;
}

drawing::Panel panel_of(const PlannedPanel& planned, const std::vector<DrawnRun>& runs) {
  const bool overlaid = runs.size() > 1;
  drawing::Panel panel;
  panel.title = planned.title;
  panel.axis = planned.unit;
  panel.logarithmic = planned.logarithmic;
  panel.across = planned.across;
  const bool explained = planned.lines.size() == 1 && planned.lines.front().label == planned.title;
  // Estimates lie above, and come last in the legend.
  for (const bool dashed : {false, true})
    for (std::size_t r = 0; r < runs.size(); ++r)
      for (const PlannedLine& line : planned.lines) {
        if (line.dashed != dashed) continue;
        drawing::Curve curve = curve_of(runs[r].replay, line);
        if (overlaid) curve.colour = static_cast<int>(r);
        if (overlaid && !dashed) curve.label = "run " + std::to_string(runs[r].number);
        if (overlaid ? dashed && r > 0 : explained) curve.label.clear();
        panel.curves.push_back(std::move(curve));
      }
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const PlannedBand& band : planned.bands) {
      panel.bands.push_back(band_of(runs[r].replay, band));
      panel.bands.back().colour = overlaid ? static_cast<int>(r) : band.colour;
      if (r == 0)
        panel.bands.back().label =
            runs[r].replay.columns[band.estimate].name + " \xC2\xB1 2\xCF\x83";
    }
  return panel;
}

drawing::Figure run_figure(const std::string& title, const claims::RunSetup& setup,
                           const std::vector<DrawnRun>& runs, RunView view) {
  drawing::Figure figure;
  figure.title = title;
  const Replay& first = runs.front().replay;
  const std::string unit = unit_of(view, first.columns.front());
  figure.axis = unit.empty() ? "t" : "t [" + unit + "]";
  std::vector<PlannedPanel> planned;
  const bool usual = view.planes.empty() && view.panels.empty();
  // Planes alone, where no panels are asked for beside them.
  if (view.planes.empty() || !view.panels.empty()) planned = planned_panels(first, view);
  if (const auto plane = usual_plane(setup, first); usual && plane) view.planes.push_back(*plane);
  for (PlannedPanel& plane : planned_planes(first, view)) planned.push_back(std::move(plane));
  for (const PlannedPanel& panel : planned) {
    for (drawing::Panel& claims : claim_panels(panel.claims, runs, view))
      figure.panels.push_back(std::move(claims));
    if (!panel.claims.empty()) continue;
    if (runs.size() == 1)
      figure.panels.push_back(panel_of(with_measurements(panel, runs.front()), runs));
    else
      for (const PlannedPanel& part : parted(panel)) figure.panels.push_back(panel_of(part, runs));
    if (panel.across)
      add_background(setup, runs, *panel.lines.front().across, panel.lines.front().columns.front(),
                     figure.panels.back());
  }
  if (runs.size() == 1) add_marks(first, figure);
  return figure;
}

}  // namespace gainsmith::app
