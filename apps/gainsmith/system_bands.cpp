#include "gainsmith/system_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number.h"
#include "gainsmith/drawn_systems.h"
#include "gainsmith/system_cases.h"
#include "gainsmith/system_facts.h"
#include "hybrid/scenario.h"

namespace gainsmith::app {

namespace {

using model::SystemFigure;

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t kDraws = 100;

/// The plant's uncertain data in a run; "in draw 3 (plant.k = 0.9)" as far as they are numbers.
std::string draw(const model::Design& design, const hybrid::System& system, std::uint64_t run,
                 model::Stated& stated) {
  hybrid::NoiseDraws draws(system, {}, design.campaign.seed, run);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(system.size);
  std::string numbers;
  for (std::size_t k = 0; k < system.dynamics.noise.size(); ++k) {
    draws.draw(k, values);
    const hybrid::Slot& slot = system.layout.slots[*system.slot(system.dynamics.noise[k].name)];
    const auto [rows, cols] = slot.shape;
    stated.values[slot.name] = values.segment(slot.offset, rows * cols).reshaped(rows, cols);
    if (slot.shape.is_scalar())
      numbers += fmt::format("{}{} = {}", numbers.empty() ? "" : ", ", slot.name,
                             brief(values(slot.offset), 4));
  }
  return fmt::format("in draw {}{}", run, numbers.empty() ? "" : " (" + numbers + ")");
}

/// The values of a curve at these places; not a number in its gaps and beyond its ends.
std::vector<double> values_at(const std::vector<double>& places, const drawing::Curve& curve,
                              bool logarithmic) {
  const auto scaled = [&](double x) { return logarithmic ? std::log(x) : x; };
  std::vector<double> values;
  for (const double x : places) {
    const auto next = std::upper_bound(curve.t.begin(), curve.t.end(), x) - curve.t.begin();
    const auto right =
        static_cast<std::size_t>(std::min<std::ptrdiff_t>(next, std::ssize(curve.t) - 1));
    const std::size_t left = right == 0 ? 0 : right - 1;
    const double a = scaled(curve.t[left]), b = scaled(curve.t[right]);
    const double share = b > a ? std::clamp((scaled(x) - a) / (b - a), 0.0, 1.0) : 1;
    const bool beyond = x < curve.t.front() || x > curve.t.back();
    values.push_back(beyond ? kGap : (1 - share) * curve.value[left] + share * curve.value[right]);
  }
  return values;
}

bool is_line(const drawing::Curve& curve) { return curve.joined && !curve.limit; }

/// Where the lines of a panel lie, and those of the same panel of each draw.
void add_bands(const drawing::Figure& figure, drawing::Panel& panel,
               const std::vector<const drawing::Panel*>& drawn) {
  constexpr std::size_t kPlaces = 400;
  std::size_t line = 0;
  for (const drawing::Curve& curve : panel.curves) {
    if (!is_line(curve) || curve.t.empty()) continue;
    drawing::Band band;
    band.colour = curve.colour;
    const double first = curve.t.front(), last = curve.t.back();
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const double share = static_cast<double>(k) / (kPlaces - 1);
      band.t.push_back(k + 1 == kPlaces     ? last
                       : figure.logarithmic ? first * std::pow(last / first, share)
                                            : first + share * (last - first));
    }
    band.low = band.high = values_at(band.t, curve, figure.logarithmic);
    for (const drawing::Panel* other : drawn) {
      auto lines = other->curves;
      std::erase_if(lines, [](const drawing::Curve& one) { return !is_line(one); });
      std::vector<double> values = values_at(band.t, lines.at(line), figure.logarithmic);
      // Phases are known but for turns.
      const double turns =
          panel.axis == "degrees" ? 360 * std::round((band.low.front() - values.front()) / 360) : 0;
      for (std::size_t k = 0; k < kPlaces; ++k) {
        band.low[k] = std::fmin(band.low[k], values[k] + (std::isfinite(turns) ? turns : 0));
        band.high[k] = std::fmax(band.high[k], values[k] + (std::isfinite(turns) ? turns : 0));
      }
    }
    panel.bands.push_back(std::move(band));
    ++line;
  }
}

io::Json values_json(const std::vector<double>& values) {
  io::Json json = io::Json::array();
  for (const double value : values) json.push_back(number_json(value));
  return json;
}

/// Behind what a plane has: thin lines, and dots for poles.
void add_cloud(drawing::Panel& panel, const std::vector<const drawing::Panel*>& drawn) {
  std::vector<drawing::Curve> cloud;
  for (const drawing::Panel* other : drawn)
    for (drawing::Curve curve : other->curves) {
      const bool poles = !curve.joined && curve.mark == drawing::Mark::cross && curve.label != "-1";
      if (!is_line(curve) && !poles) continue;
      curve.label.clear();
      if (poles)
        curve.mark = drawing::Mark::dot;
      else
        curve.limit = true;
      cloud.push_back(std::move(curve));
    }
  // What is drawn over a cloud of its colour is black, where it is the only one.
  constexpr int kBlack = 6;
  const bool single = std::ranges::all_of(
      cloud, [&](const drawing::Curve& curve) { return curve.colour == cloud.front().colour; });
  for (drawing::Curve& curve : panel.curves)
    if (single && !curve.limit) curve.colour = kBlack;
  panel.curves.insert(panel.curves.begin(), cloud.begin(), cloud.end());
}

std::string draws_text(const model::Design& design, std::size_t corners) {
  std::string names;
  for (const model::Dynamics::Noise& noise : design.varied.noise)
    names += (names.empty() ? "" : ", ") + noise.name;
  const std::string more = corners > 0 ? fmt::format(" and {} corners", corners) : "";
  return fmt::format("over {} draws{} of {}", kDraws, more, names);
}

/// The plant's data in all draws, and at all corners of their boxes, where these are few.
std::vector<std::pair<std::string, model::Stated>> plants(const model::Design& design,
                                                          const model::Stated& stated) {
  const hybrid::System noise = hybrid::make_system(design.varied, stated.values);
  std::vector<std::pair<std::string, model::Stated>> all;
  for (std::uint64_t run = 0; run < kDraws; ++run) {
    all.emplace_back("", stated);
    all.back().first = draw(design, noise, run, all.back().second);
  }
  constexpr std::size_t kMost = 6;
  std::vector<std::size_t> boxes;
  for (std::size_t k = 0; k < design.varied.noise.size(); ++k)
    if (design.varied.noise[k].kind == model::Dynamics::NoiseKind::uniform &&
        design.varied.noise[k].shape.is_scalar())
      boxes.push_back(k);
  if (boxes.empty() || boxes.size() > kMost) return all;
  for (std::size_t corner = 0; corner < std::size_t{1} << boxes.size(); ++corner) {
    model::Stated at = stated;
    std::string numbers;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const std::string& name = design.varied.noise[boxes[k]].name;
      at.values[name] = noise.noise[boxes[k]].values[corner >> k & 1U];
      numbers += fmt::format("{}{} = {}", numbers.empty() ? "" : ", ", name,
                             brief(at.values[name](0, 0), 4));
    }
    all.emplace_back("at " + numbers, std::move(at));
  }
  return all;
}

}  // namespace

void add_bands(const SystemFigure& figure, const model::Design& design, const model::Stated& stated,
               std::pair<double, double> range, SystemResult& result) {
  std::vector<std::vector<SystemCase>> systems(figure.systems.size());
  std::vector<drawing::Figure> pictures;
  const auto all = plants(design, stated);
  for (const auto& [where, plant] : all) {
    std::string missing;
    std::vector<DrawnSystem> own = systems_of(figure, plant, missing).value();
    for (std::size_t k = 0; k < own.size(); ++k) {
      compute(figure, range, own[k]);
      systems[k].push_back({where, own[k]});
    }
    pictures.push_back(system_picture(figure.kind, own));
  }
  for (std::size_t k = 0; k < result.figure.panels.size(); ++k) {
    drawing::Panel& panel = result.figure.panels[k];
    std::vector<const drawing::Panel*> others;
    for (const drawing::Figure& picture : pictures) others.push_back(&picture.panels[k]);
    if (panel.across)
      add_cloud(panel, others);
    else
      add_bands(result.figure, panel, others);
    for (const drawing::Band& band : panel.bands)
      result.data["bands"].push_back({{"panel", panel.title},
                                      {"x", band.t},
                                      {"low", values_json(band.low)},
                                      {"high", values_json(band.high)}});
  }
  for (const std::vector<SystemCase>& cases : systems) {
    result.facts.push_back(worst_of(cases, figure.kind, draws_text(design, all.size() - kDraws)));
    result.data["draws"].push_back(cases_json(cases, figure.kind));
    add_numbers(cases, result);
  }
}

}  // namespace gainsmith::app
