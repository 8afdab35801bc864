#include "gainsmith/run_panels.h"

#include <algorithm>
#include <functional>

#include "base/error.h"
#include "base/nearest.h"
#include "model/estimate_name.h"

namespace gainsmith::app {

namespace {

using verify::Column;
using verify::Replay;
using Kind = Column::Kind;

constexpr std::size_t kMostPanels = 6;

/// "xh1" of "ekf.xh1".
std::string own_name(const Column& column) {
  return column.observer.empty() ? column.name : column.name.substr(column.name.rfind('.') + 1);
}

/// "P1_2".
bool is_of_matrix(const std::string& name) {
  const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
  const std::size_t at = name.rfind('_');
  return at != std::string::npos && at > 0 && is_digit(name[at - 1]) && is_digit(name.back());
}

/// Whether the stem is named, alone or with its observer.
bool has_stem(const Column& column, const std::string& name) {
  return column.stem == name || column.observer + "." + column.stem == name;
}

bool is_named(const Column& column, const std::string& name) {
  return column.name == name || own_name(column) == name || has_stem(column, name);
}

bool is_quantity(const Column& column) {
  return column.kind != Kind::time && column.kind != Kind::jumps;
}

bool is_error(const Column& column) {
  return column.kind == Kind::signal &&
         (column.stem == "e" || column.stem.starts_with("e_") || column.stem.starts_with("error"));
}

/// "xh2" or "x_hat2" for "x2": a column of an observer that estimates one of the plant.
bool estimates(const Column& estimate, const Column& state) {
  if (estimate.observer.empty() || (estimate.kind != Kind::state && estimate.kind != Kind::signal))
    return false;
  const std::string index = state.name.substr(state.stem.size());
  return model::is_estimate_name(estimate.stem, state.stem) &&
         own_name(estimate) == estimate.stem + index;
}

/// Plans the panels of one view.
class Planner {
 public:
  Planner(const Replay& replay, const RunView& view) : replay_(replay), view_(view) {
    for (const Column& column : replay.columns)
      if (!column.observer.empty() &&
          std::find(observers_.begin(), observers_.end(), column.observer) == observers_.end())
        observers_.push_back(column.observer);
    for (const Covariance& covariance : view.covariances) check(covariance);
  }

  std::vector<PlannedPanel> usual() {
    add_states();
    if (panels_.empty()) add_own_states();
    if (panels_.size() < kMostPanels) add_inputs();
    add_errors();
    add_claims(columns([](const Column& column) { return column.kind == Kind::claim; }));
    return std::move(panels_);
  }

  std::vector<PlannedPanel> chosen() {
    for (const std::string& name : view_.panels) add(name);
    return std::move(panels_);
  }

  std::vector<PlannedPanel> planes() {
    for (const auto& [across, up] : view_.planes) add_plane(across, up);
    return std::move(panels_);
  }

 private:
  using Which = std::function<bool(const Column&)>;

  const Column& column(std::size_t k) const { return replay_.columns[k]; }

  std::vector<std::size_t> columns(const Which& which) const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < replay_.columns.size(); ++k)
      if (is_quantity(column(k)) && which(column(k))) found.push_back(k);
    return found;
  }

  std::vector<std::size_t> estimates_of(std::size_t state) const {
    return columns([&](const Column& candidate) { return estimates(candidate, column(state)); });
  }

  int colour_of(const Column& column) const {
    const auto found = std::find(observers_.begin(), observers_.end(), column.observer);
    return found == observers_.end() ? 0 : 1 + static_cast<int>(found - observers_.begin());
  }

  PlannedLine line(std::size_t k, bool dashed = false) const {
    return {{k}, std::nullopt, column(k).name, dashed, colour_of(column(k))};
  }

  /// InputError for a name of which there is nothing; `known` is what may be there, of which each
  /// is listed once, the nearest first.
  static void require(bool found, const char* option, const std::string& name,
                      std::vector<std::string> known) {
    if (found) return;
    std::stable_sort(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
      return doubled_edit_distance(name, a) < doubled_edit_distance(name, b);
    });
    std::vector<std::string> once;
    for (const std::string& observer : known)
      if (std::find(once.begin(), once.end(), observer) == once.end()) once.push_back(observer);
    throw InputError({option},
                     "no quantity of the run is named '" + name + "'" + suggestion(name, once));
  }

  /// Names of quantities as `name` gives them.
  std::vector<std::string> names(const std::function<std::string(const Column&)>& name) const {
    std::vector<std::string> all;
    for (const std::size_t k : columns([](const Column&) { return true; }))
      all.push_back(name(column(k)));
    return all;
  }

  /// What may be an axis of a plane. The values of claims have their own panels.
  std::vector<std::string> names_of_axes() const {
    std::vector<std::string> all;
    for (const std::size_t k :
         columns([](const Column& column) { return column.kind != Kind::claim; }))
      all.push_back(column(k).name);
    return all;
  }

  std::vector<std::string> stems() const {
    return names([](const Column& column) { return column.stem; });
  }

  void check(const Covariance& pair) const {
    const auto has = [&](const std::string& name) {
      return std::any_of(replay_.columns.begin(), replay_.columns.end(), [&](const Column& column) {
        return is_quantity(column) && has_stem(column, name);
      });
    };
    require(has(pair.estimate), "--band", pair.estimate, stems());
    require(has(pair.covariance), "--band", pair.covariance, stems());
    if (columns([&](const Column& column) {
          return has_stem(column, pair.estimate) && variance_of(column, pair);
        }).empty())
      throw InputError({"--band"}, "'" + pair.covariance + "' is no covariance of '" +
                                       pair.estimate +
                                       "': of n elements it is n x n, and of the same observer");
  }

  /// The column of the diagonal that belongs to a column of an estimate.
  std::optional<std::size_t> variance_of(const Column& estimate, const Covariance& pair) const {
    if (!has_stem(estimate, pair.estimate)) return std::nullopt;
    const auto of = [&](const std::string& stem) {
      return columns([&](const Column& column) {
        return column.stem == stem && column.observer == estimate.observer;
      });
    };
    const std::size_t n = of(estimate.stem).size();
    const std::string stem = pair.covariance.substr(pair.covariance.rfind('.') + 1);
    const std::vector<std::size_t> elements = of(stem);
    if (elements.size() != n * n || !has_stem(column(elements.front()), pair.covariance))
      return std::nullopt;
    return elements[static_cast<std::size_t>(estimate.element) * (n + 1)];
  }

  void add(PlannedPanel panel) {
    for (const PlannedLine& line : panel.lines)
      for (const Covariance& covariance : view_.covariances)
        if (line.columns.size() == 1)
          if (const auto variance = variance_of(column(line.columns.front()), covariance))
            panel.bands.push_back({line.columns.front(), *variance, line.colour});
    panels_.push_back(std::move(panel));
  }

  /// A column of the plant with its estimates, or one of observers.
  void add_quantity(const std::vector<std::size_t>& same) {
    const Column& first = column(same.front());
    PlannedPanel panel{
        same.size() > 1 ? own_name(first) : first.name, unit_of(view_, first), false, {}};
    for (const std::size_t k : same) {
      panel.lines.push_back(line(k));
      if (!column(k).observer.empty()) continue;
      for (const std::size_t estimate : estimates_of(k))
        panel.lines.push_back(line(estimate, true));
    }
    add(std::move(panel));
  }

  /// Each state of the plant, and each output that is estimated.
  void add_states() {
    const auto shown = columns([&](const Column& column) {
      if (!column.observer.empty()) return false;
      const auto k = static_cast<std::size_t>(&column - replay_.columns.data());
      return column.kind == Kind::state ||
             (column.kind == Kind::signal && !estimates_of(k).empty());
    });
    for (const std::size_t k : shown)
      if (panels_.size() < kMostPanels) add_quantity({k});
  }

  /// Where the plant has neither, as a log: one panel a state of the observers, matrices last, and
  /// no covariance that is drawn as a band.
  void add_own_states() {
    const auto is_band = [&](const Column& state) {
      return std::ranges::any_of(view_.covariances, [&](const Covariance& pair) {
        return has_stem(state, pair.covariance);
      });
    };
    std::vector<std::string> names;
    for (const std::size_t k : columns([&](const Column& column) {
           return column.kind == Kind::state && !column.observer.empty() && !is_band(column);
         }))
      if (const std::string name = own_name(column(k));
          std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    std::stable_partition(names.begin(), names.end(),
                          [](const auto& unplanned) { return !is_of_matrix(unplanned); });
    for (const std::string& name : names)
      if (panels_.size() < kMostPanels)
        add_quantity(columns([&](const Column& column) {
          return column.kind == Kind::state && !column.observer.empty() && own_name(column) == name;
        }));
  }

  /// One panel an input. By custom u is an input, a signal or a state that an observer
  /// holds, and the signal z is to stay small.
  void add_inputs() {
    const auto is_shown = [&](const Column& column) {
      const bool held = column.kind == Kind::state && !column.observer.empty();
      if (column.stem == "u" && (held || column.kind == Kind::signal)) return true;
      if (column.stem == "z" && column.kind == Kind::signal) return true;
      return (column.kind == Kind::signal || column.kind == Kind::other) &&
             column.observer.empty() && view_.inputs.contains(column.stem);
    };
    std::vector<std::string> stems;
    for (const std::size_t k : columns(is_shown))
      if (std::find(stems.begin(), stems.end(), column(k).stem) == stems.end())
        stems.push_back(column(k).stem);
    for (const std::string& stem : stems) {
      PlannedPanel panel{stem, "", false, {}};
      for (const std::size_t k :
           columns([&](const Column& column) { return is_shown(column) && column.stem == stem; })) {
        panel.unit = unit_of(view_, column(k));
        panel.lines.push_back(line(k));
        if (column(k).observer.empty())
          panel.lines.back().colour = static_cast<int>(panel.lines.size()) - 1;
      }
      add(std::move(panel));
    }
  }

  /// The sizes of errors, signals e, e_... or error..., on a logarithmic axis.
  void add_errors() {
    PlannedPanel panel{"size of the error", "", true, {}};
    std::set<std::string> units;
    for (const std::size_t k : columns(is_error)) {
      const Column& shown = column(k);
      units.insert(unit_of(view_, shown));
      const bool alone = shown.observer.empty() || observers_.size() == 1;
      const std::string label = "|" + (alone ? "" : shown.observer + ".") + shown.stem + "|";
      if (panel.lines.empty() || panel.lines.back().label != label)
        panel.lines.push_back(
            {{}, std::nullopt, label, false, static_cast<int>(panel.lines.size()) + 1, true});
      panel.lines.back().columns.push_back(k);
    }
    if (panel.lines.empty()) return;
    if (units.size() == 1) panel.unit = *units.begin();
    panels_.push_back(std::move(panel));
  }

  void add_claims(const std::vector<std::size_t>& claims) {
    if (claims.empty()) return;
    panels_.emplace_back().claims = claims;
  }

  /// What a name under --panels asks for.
  void add(const std::string& name) {
    const auto named = columns([&](const Column& column) { return is_named(column, name); });
    if (named.empty()) return add_group(name);
    add_claims(columns([&](const Column& column) {
      return column.kind == Kind::claim && is_named(column, name);
    }));
    std::vector<std::size_t> left = named;
    std::erase_if(left, [&](std::size_t k) { return column(k).kind == Kind::claim; });
    while (!left.empty()) {
      const std::string element = own_name(column(left.front()));
      std::vector<std::size_t> same;
      for (const std::size_t k : left)
        if (own_name(column(k)) == element) same.push_back(k);
      std::erase_if(left, [&](std::size_t k) { return own_name(column(k)) == element; });
      add_quantity(same);
    }
  }

  void add_group(const std::string& name) {
    const std::size_t before = panels_.size();
    if (name == "states") add_states();
    if (name == "states" && panels_.size() == before) add_own_states();
    if (name == "inputs") add_inputs();
    if (name == "errors") add_errors();
    if (name == "claims")
      add_claims(columns([](const Column& column) { return column.kind == Kind::claim; }));
    const auto& groups = panel_groups();
    const bool is_group = std::find(groups.begin(), groups.end(), name) != groups.end();
    if (is_group && panels_.size() == before)
      throw InputError({"--panels"}, "the run has no " + name);
    std::vector<std::string> known = groups;
    for (const auto& more : {stems(), names([](const Column& column) { return column.name; })})
      known.insert(known.end(), more.begin(), more.end());
    require(is_group, "--panels", name, known);
  }

  /// The elements of a name: exactly it, or that of each observer.
  std::vector<std::size_t> elements(const std::string& name) const {
    std::vector<std::size_t> found = columns(
        [&](const Column& column) { return column.name == name || own_name(column) == name; });
    if (found.empty() &&
        !columns([&](const Column& column) { return has_stem(column, name); }).empty())
      throw InputError(
          {"--phase"},
          "'" + name + "' has several elements; name one, such as " +
              column(columns([&](const Column& column) { return has_stem(column, name); }).front())
                  .name);
    require(!found.empty(), "--phase", name, names_of_axes());
    return found;
  }

  void add_plane(const std::string& across, const std::string& up) {
    const auto with_unit = [&](const std::string& name, std::size_t k) {
      const std::string unit = unit_of(view_, column(k));
      return unit.empty() ? name : name + " [" + unit + "]";
    };
    const auto a = elements(across), b = elements(up);
    PlannedPanel panel{up + " over " + across, with_unit(up, b.front()), false, {}};
    panel.across = with_unit(across, a.front());
    const auto add_line = [&](std::size_t x, std::size_t y, bool dashed) {
      panel.lines.push_back(line(y, dashed));
      panel.lines.back().across = x;
      panel.lines.back().label = column(x).name + ", " + column(y).name;
    };
    for (const std::size_t x : a)
      for (const std::size_t y : b) {
        const bool alone = a.size() == 1 && b.size() == 1;
        if (column(x).observer != column(y).observer && !alone) continue;
        add_line(x, y, false);
        if (!column(x).observer.empty() || !column(y).observer.empty()) continue;
        for (const std::size_t xh : estimates_of(x))
          for (const std::size_t yh : estimates_of(y))
            if (column(xh).observer == column(yh).observer) add_line(xh, yh, true);
      }
    if (panel.lines.empty())
      throw InputError({"--phase"},
                       "'" + across + "' and '" + up + "' belong to different observers");
    panels_.push_back(std::move(panel));
  }

  const Replay& replay_;
  const RunView& view_;
  std::vector<std::string> observers_;
  std::vector<PlannedPanel> panels_;
};

}  // namespace

std::vector<PlannedPanel> planned_panels(const Replay& replay, const RunView& view) {
  Planner planner(replay, view);
  return view.panels.empty() ? planner.usual() : planner.chosen();
}

std::vector<PlannedPanel> planned_planes(const Replay& replay, const RunView& view) {
  return Planner(replay, view).planes();
}

}  // namespace gainsmith::app
