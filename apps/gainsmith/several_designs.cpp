#include "gainsmith/several_designs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "base/error.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

bool are_different(const std::vector<std::string>& names) {
  return std::set(names.begin(), names.end()).size() == names.size();
}

std::vector<std::string> parts_of(const std::vector<std::string>& files,
                                  const std::function<fs::path(const fs::path&)>& part) {
  std::vector<std::string> names;
  for (const std::string& file : files)
    names.push_back(part(fs::path(file).lexically_normal()).string());
  return names;
}

/// Its value at t, before a jump there.
double value_at(const drawing::Curve& curve, double t) {
  const auto next = std::lower_bound(curve.t.begin(), curve.t.end(), t) - curve.t.begin();
  if (next == std::ssize(curve.t)) return curve.value.back();
  const auto right = static_cast<std::size_t>(next);
  if (right == 0) return curve.value.front();
  const double share = (t - curve.t[right - 1]) / (curve.t[right] - curve.t[right - 1]);
  return (1 - share) * curve.value[right - 1] + share * curve.value[right];
}

/// Whether a picture would show both curves as one, away from jumps.
bool is_same(const drawing::Curve& a, const drawing::Curve& b) {
  constexpr double kSeen = 1e-3;
  if (a.dashed != b.dashed || a.limit != b.limit || a.t.empty() || b.t.empty()) return false;
  const auto [low, high] = std::minmax_element(a.value.begin(), a.value.end());
  const double seen = kSeen * std::max(*high - *low, 1e-9 * std::abs(*high));
  std::size_t away = 0;
  for (std::size_t k = 0; k < a.t.size(); ++k)
    away += std::abs(a.value[k] - value_at(b, a.t[k])) <= seen ? 0U : 1U;
  // At a jump the values of both sides are compared.
  return away <= 2 * a.jumps.size();
}

/// Adds the figures of designs to one.
class Merging {
 public:
  explicit Merging(drawing::Figure first, const std::string& name) : whole_(std::move(first)) {
    for (drawing::Panel& panel : whole_.panels) {
      for (drawing::Curve& curve : panel.curves) {
        next_colour_ = std::max(next_colour_, curve.colour + 1);
        curve.label = name + ": " + name_of(curve, panel);
      }
      for (drawing::Band& band : panel.bands) band.label = name + ": " + band.label;
    }
  }

  void add(const drawing::Figure& figure, const std::string& name) {
    std::map<int, int> colours;
    const auto colour = [&](int own) {
      const auto [at, is_new] = colours.try_emplace(own, next_colour_);
      if (is_new) ++next_colour_;
      return at->second;
    };
    if (figure.marks != whole_.marks) whole_.marks.clear();
    for (const drawing::Panel& own : figure.panels) {
      drawing::Panel& panel = panel_like(own);
      for (drawing::Curve curve : own.curves) {
        if (share(curve, own, panel)) continue;
        curve.label = name + ": " + name_of(curve, own);
        curve.colour = colour(curve.colour);
        panel.curves.push_back(std::move(curve));
      }
      for (drawing::Band band : own.bands) {
        band.label = name + ": " + band.label;
        band.colour = colour(band.colour);
        panel.bands.push_back(std::move(band));
      }
    }
  }

  /// Dashed ones last, so that they are seen.
  drawing::Figure take() {
    for (drawing::Panel& panel : whole_.panels)
      std::stable_partition(panel.curves.begin(), panel.curves.end(),
                            [](const drawing::Curve& curve) { return !curve.dashed; });
    return std::move(whole_);
  }

 private:
  static std::string name_of(const drawing::Curve& curve, const drawing::Panel& panel) {
    return curve.label.empty() ? panel.title : curve.label;
  }

  drawing::Panel& panel_like(const drawing::Panel& own) {
    const auto found = std::ranges::find_if(whole_.panels, [&](const drawing::Panel& panel) {
      return panel.title == own.title && panel.across == own.across &&
             panel.logarithmic == own.logarithmic;
    });
    if (found != whole_.panels.end()) return *found;
    whole_.panels.push_back(own);
    whole_.panels.back().curves.clear();
    whole_.panels.back().bands.clear();
    return whole_.panels.back();
  }

  /// Whether the panel has the same curve; it then has no name of a design.
  static bool share(const drawing::Curve& curve, const drawing::Panel& own, drawing::Panel& panel) {
    for (drawing::Curve& known : panel.curves) {
      const std::string name = name_of(curve, own);
      const bool named = known.label == name || known.label.ends_with(": " + name);
      if (!named || !is_same(known, curve)) continue;
      known.label = name;
      return true;
    }
    return false;
  }

  drawing::Figure whole_;
  int next_colour_ = 1;
};

std::vector<std::pair<std::string, expr::Shape>> plant_of(const model::Design& design) {
  std::vector<std::pair<std::string, expr::Shape>> states;
  for (const model::Dynamics::Variable& variable : design.dynamics->variables)
    if (variable.kind == model::Dynamics::VariableKind::state && variable.component == 0)
      states.emplace_back(variable.name, variable.shape);
  return states;
}

}  // namespace

std::vector<std::string> names_of_files(const std::vector<std::string>& files) {
  const auto stems = parts_of(files, [](const fs::path& path) { return path.stem(); });
  if (are_different(stems)) return stems;
  const auto folders =
      parts_of(files, [](const fs::path& path) { return path.parent_path().filename(); });
  const bool named = std::ranges::none_of(folders, &std::string::empty);
  return named && are_different(folders) ? folders : files;
}

void require_same_plant(const std::vector<LoadedGains>& designs,
                        const std::vector<std::string>& files) {
  const auto plant = plant_of(*designs.front().stated.design);
  for (std::size_t k = 1; k < designs.size(); ++k)
    if (plant_of(*designs[k].stated.design) != plant)
      throw InputError({files[k]}, "its plant has other states than that of " + files.front() +
                                       ": designs of one plant are compared");
}

drawing::Figure figure_of_designs(const std::vector<DesignRun>& runs,
                                  const std::function<RunView(const model::Design&)>& view) {
  std::string title;
  const auto figure_of = [&](const DesignRun& run) {
    title += (title.empty() ? "" : ", ") + run.name;
    return run_figure(run.design->name, *run.setup, {run.run}, view(*run.design));
  };
  Merging merging(figure_of(runs.front()), runs.front().name);
  for (std::size_t k = 1; k < runs.size(); ++k) merging.add(figure_of(runs[k]), runs[k].name);
  drawing::Figure figure = merging.take();
  figure.title = title;
  return figure;
}

}  // namespace gainsmith::app
