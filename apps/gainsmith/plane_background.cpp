#include "gainsmith/plane_background.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "base/number.h"
#include "gainsmith/level_curves.h"

namespace gainsmith::app {

namespace {

using claims::RunValue;
using model::ClaimKind;
using verify::Column;

constexpr int kBlack = 6;
constexpr std::size_t kMostLevels = 8;  // of one claim, of the first runs

/// The texts of a run that are functions of the states of its plant.
class PlantTexts {
 public:
  explicit PlantTexts(const claims::RunSetup& setup) : setup_(setup) {}

  bool is_state(std::size_t variable) const {
    const model::Dynamics::Variable& one = setup_.system.dynamics.variables[variable];
    return one.kind == model::Dynamics::VariableKind::state &&
           !setup_.system.dynamics.components[one.component].observer;
  }

  bool reads_states_alone(const expr::Program& program) const {
    return std::ranges::all_of(program.inputs, [&](const expr::Input& input) {
      const auto slot = setup_.layout.slot(input.name);
      return slot ? is_state(*slot) : setup_.system.constants.contains(input.name);
    });
  }

  RunValue value(const expr::Program& program) const {
    return {program, setup_.layout, setup_.system.constants};
  }

  /// The element of all variables that a column shows; none: it is no state of the plant.
  std::optional<Eigen::Index> element(const Column& column) const {
    const auto slot = setup_.layout.slot(column.stem);
    if (column.kind != Column::Kind::state || !slot || !is_state(*slot)) return std::nullopt;
    return setup_.layout.slots[*slot].offset + column.element;
  }

  /// By element its variable.
  std::size_t variable_of(Eigen::Index element) const {
    std::size_t k = 0;
    while (element >= setup_.layout.slots[k].offset + setup_.layout.slots[k].shape.size()) ++k;
    return k;
  }

  /// The rate of a variable, 0 without a flow.
  const expr::Program* flow(std::size_t variable) const {
    const auto& flows = setup_.system.dynamics.flow;
    for (std::size_t k = 0; k < flows.size(); ++k)
      if (flows[k].variable == variable)
        return setup_.system.free_flow[k] ? &*setup_.system.free_flow[k] : &flows[k].value.program;
    return nullptr;
  }

  /// Whether its rate depends on states of the plant alone.
  bool has_field(std::size_t variable) const {
    const expr::Program* const rate = flow(variable);
    return rate == nullptr || reads_states_alone(*rate);
  }

  bool has_levels(const claims::Claim& claim) const {
    const bool kind = claim.kind == ClaimKind::below || claim.kind == ClaimKind::above ||
                      claim.kind == ClaimKind::nonincreasing;
    return kind && claim.stated() && !claim.over && claim.value.shape().is_scalar() &&
           !claim.value.inputs.empty() && reads_states_alone(claim.value) &&
           std::ranges::any_of(claim.value.inputs, [&](const expr::Input& input) {
             return setup_.layout.slot(input.name).has_value();
           });
  }

  const claims::RunSetup& setup() const { return setup_; }

 private:
  const claims::RunSetup& setup_;
};

/// A function whose zeros are a level curve.
struct Level {
  std::string label;
  int colour = 0;
  std::function<double(double, double)> away;
};

class Background {
 public:
  Background(const PlantTexts& texts, Eigen::Index across, Eigen::Index up)
      : texts_(texts),
        across_(across),
        up_(up),
        origin_(Eigen::VectorXd::Zero(texts.setup().layout.size)) {}

  /// See add_background().
  void add(const std::vector<DrawnRun>& runs, drawing::Panel& panel) {
    const std::size_t a = texts_.variable_of(across_), b = texts_.variable_of(up_);
    if (!texts_.has_field(a) || !texts_.has_field(b)) return;
    add_levels(runs);
    const auto others = others_of(runs.front().replay.columns);
    if (!others.empty() && levels_.empty()) return;
    add_field(a, b, panel);
    add_curves(panel);
    for (const std::string& name : others) panel.title += ", " + name + " = 0";
  }

 private:
  /// The states of the plant that are in neither axis.
  std::vector<std::string> others_of(const std::vector<Column>& columns) const {
    std::vector<std::string> names;
    for (const Column& column : columns)
      if (const auto at = texts_.element(column); at && *at != across_ && *at != up_)
        names.push_back(column.name);
    return names;
  }

  std::function<double(double, double)> function_of(const expr::Program& program,
                                                    Eigen::Index element, double minus) const {
    const auto value = std::make_shared<RunValue>(texts_.value(program));
    return [=, across = across_, up = up_, point = origin_](double x, double y) mutable {
      point(across) = x;
      point(up) = y;
      return (*value)(point)(element)-minus;
    };
  }

  void add_field(std::size_t a, std::size_t b, drawing::Panel& panel) const {
    const auto rate = [&](std::size_t variable,
                          Eigen::Index element) -> std::function<double(double, double)> {
      const expr::Program* const flow = texts_.flow(variable);
      const Eigen::Index first = texts_.setup().layout.slots[variable].offset;
      if (!flow) return [](double, double) { return 0.0; };
      return function_of(*flow, element - first, 0);
    };
    panel.field = [x_rate = rate(a, across_), y_rate = rate(b, up_)](double x, double y) {
      return std::pair(x_rate(x, y), y_rate(x, y));
    };
  }

  void add_levels(const std::vector<DrawnRun>& runs) {
    for (const claims::Claim& claim : texts_.setup().claims)
      if (texts_.has_levels(claim) && claim.bound && texts_.reads_states_alone(*claim.bound)) {
        const double bound = texts_.value(*claim.bound).number(origin_);
        add_level(claim, bound, kBlack + static_cast<int>(levels_.size()),
                  claim.name + ": " + brief(bound));
      }
    if (!levels_.empty()) return;
    for (const claims::Claim& claim : texts_.setup().claims)
      for (std::size_t r = 0; texts_.has_levels(claim) && r < std::min(runs.size(), kMostLevels);
           ++r)
        add_level(claim, texts_.value(claim.value).number(start_of(runs[r])), static_cast<int>(r),
                  r == 0 ? claim.name + " at the start" : "");
  }

  static Eigen::VectorXd start_of(const DrawnRun& run) {
    Eigen::VectorXd start;
    claims::visit(run.replay.run, run.replay.run.end, [&](const claims::Moment& moment) {
      if (start.size() == 0) start = moment.x;
    });
    return start;
  }

  void add_level(const claims::Claim& claim, double level, int colour, const std::string& label) {
    if (std::isfinite(level))
      levels_.push_back({label, colour, function_of(claim.value, 0, level)});
  }

  /// Closed curves within four times the extent of the runs whole, others as far as the runs and
  /// these reach.
  void add_curves(drawing::Panel& panel) const {
    const Window runs = window_of(panel.curves);
    std::vector<drawing::Curve> curves;
    std::vector<const Level*> open;
    for (const Level& level : levels_) {
      bool closed = false;
      for (const double times : {1.2, 2.0, 4.0}) {
        if (closed) break;
        const LevelCurves found = zero_curves(level.away, widened(runs, times));
        closed = found.inside;
        if (closed) add(level, found, curves);
      }
      if (!closed) open.push_back(&level);
    }
    std::vector<drawing::Curve> all = panel.curves;
    all.insert(all.end(), curves.begin(), curves.end());
    const Window window = window_of(all);
    for (const Level* level : open) add(*level, zero_curves(level->away, window), curves);
    panel.curves.insert(panel.curves.end(), curves.begin(), curves.end());
  }

  static void add(const Level& level, const LevelCurves& found,
                  std::vector<drawing::Curve>& curves) {
    std::string label = level.label;
    for (const auto& points : found.curves) {
      drawing::Curve& curve = curves.emplace_back();
      curve.label = std::exchange(label, "");
      curve.colour = level.colour;
      curve.limit = true;
      for (const PlanePoint& point : points) {
        curve.t.push_back(point.x);
        curve.value.push_back(point.y);
      }
    }
  }

  static Window window_of(const std::vector<drawing::Curve>& curves) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    Window window{{kInfinite, kInfinite}, {-kInfinite, -kInfinite}};
    for (const drawing::Curve& curve : curves)
      for (std::size_t k = 0; k < curve.t.size(); ++k) {
        if (!std::isfinite(curve.t[k]) || !std::isfinite(curve.value[k])) continue;
        window.low = {std::min(window.low.x, curve.t[k]), std::min(window.low.y, curve.value[k])};
        window.high = {std::max(window.high.x, curve.t[k]),
                       std::max(window.high.y, curve.value[k])};
      }
    for (const auto axis : {&PlanePoint::x, &PlanePoint::y})
      if (!(window.low.*axis < window.high.*axis)) {
        const double middle = std::isfinite(window.low.*axis) ? window.low.*axis : 0;
        window.low.*axis = middle - 1;
        window.high.*axis = middle + 1;
      }
    return window;
  }

  static Window widened(Window window, double times) {
    for (const auto axis : {&PlanePoint::x, &PlanePoint::y}) {
      const double more = (times - 1) / 2 * (window.high.*axis - window.low.*axis);
      window.low.*axis -= more;
      window.high.*axis += more;
    }
    return window;
  }

  const PlantTexts& texts_;
  const Eigen::Index across_, up_;
  const Eigen::VectorXd origin_;
  std::vector<Level> levels_;
};

}  // namespace

void add_background(const claims::RunSetup& setup, const std::vector<DrawnRun>& runs,
                    std::size_t across, std::size_t up, drawing::Panel& panel) {
  const PlantTexts texts(setup);
  const std::vector<Column>& columns = runs.front().replay.columns;
  const auto x = texts.element(columns[across]), y = texts.element(columns[up]);
  if (x && y && *x != *y) Background(texts, *x, *y).add(runs, panel);
}

std::optional<std::pair<std::string, std::string>> usual_plane(const claims::RunSetup& setup,
                                                               const verify::Replay& replay) {
  const PlantTexts texts(setup);
  std::vector<std::string> states;
  bool has_field = true;
  for (const Column& column : replay.columns)
    if (const auto element = texts.element(column)) {
      states.push_back(column.name);
      has_field = has_field && texts.has_field(texts.variable_of(*element));
    }
  const auto has_levels = [&](const claims::Claim& claim) { return texts.has_levels(claim); };
  if (states.size() != 2 || !has_field || std::ranges::none_of(setup.claims, has_levels))
    return std::nullopt;
  return std::pair(states[0], states[1]);
}

}  // namespace gainsmith::app
