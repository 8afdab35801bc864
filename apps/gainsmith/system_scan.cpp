#include "gainsmith/system_scan.h"

#include <fmt/format.h>

#include <exception>
#include <limits>
#include <utility>

#include "base/number.h"
#include "bind/instance.h"
#include "bind/stated.h"
#include "design/optimize.h"
#include "design/search_request.h"
#include "gainsmith/drawn_systems.h"
#include "gainsmith/search_wanted.h"
#include "gainsmith/system_cases.h"
#include "gainsmith/system_facts.h"
#include "gainsmith/units.h"

namespace gainsmith::app {

namespace {

using model::SystemFigure;
using model::SystemPicture;

constexpr double kNoMargin = std::numeric_limits<double>::quiet_NaN();

/// At least as many as make a locus, or margins, look like lines; and how many curves one tells
/// apart.
constexpr int kLine = 61, kCurves = 5;

/// By system of the figure: its cases, without those that have no gains.
struct Scanned {
  std::vector<double> values;  ///< of the cases
  std::vector<std::vector<SystemCase>> systems;
  std::size_t tried = 0;
  bool logarithmic = false;
};

/// With the gains that are designed for a value of a scalar; "plant.k" leaves them as they are.
model::Stated stated_at(const std::string& name, double value, const LoadedGains& loaded) {
  if (name.starts_with("plant.")) {
    model::Stated stated = nominal(loaded);
    stated.values[name] = numbers::Matrix::Constant(1, 1, value);
    return stated;
  }
  const model::Instance instance = bind::evaluate(loaded.stated.design, {{name, value}});
  return bind::state(instance,
                     design::synthesize_searched(instance, wanted_search(instance), 1, {}));
}

Scanned scanned(const SystemFigure& figure, const LoadedGains& loaded, int count) {
  const search::Axis axis = design::searched_scalar(loaded.stated, *figure.scan).axis;
  Scanned all;
  all.logarithmic = axis.logarithmic;
  all.systems.resize(figure.systems.size());
  std::exception_ptr fault;
  for (const double value : search::points_on(axis, count)) {
    ++all.tried;
    try {
      std::string missing;
      auto systems = systems_of(figure, stated_at(figure.scan->name, value, loaded), missing);
      if (!systems) continue;
      all.values.push_back(value);
      for (std::size_t k = 0; k < systems->size(); ++k)
        all.systems[k].push_back(
            {fmt::format("at {} = {}", figure.scan->name, brief(value)), (*systems)[k]});
    } catch (const InputError&) {
      if (!fault) fault = std::current_exception();
    }
  }
  if (all.values.empty() && fault) std::rethrow_exception(fault);
  return all;
}

drawing::Panel panel_of(const char* title, const char* axis) {
  drawing::Panel panel;
  panel.title = title;
  panel.axis = axis;
  return panel;
}

/// Over the scalar, where the closed loop is stable.
drawing::Figure margins_picture(const Scanned& all, const std::string& axis) {
  drawing::Figure figure;
  figure.axis = axis;
  figure.logarithmic = all.logarithmic;
  figure.panels = {panel_of("gain margin", "dB"), panel_of("phase margin", "degrees"),
                   panel_of("delay margin", "time")};
  int colour = 0;
  for (const std::vector<SystemCase>& cases : all.systems) {
    std::vector<drawing::Curve> curves(3);
    for (drawing::Curve& curve : curves) {
      curve.colour = colour;
      curve.t = all.values;
    }
    curves.front().label = cases.front().drawn.label;
    for (const SystemCase& system_case : cases) {
      const response::Margins& margins = *system_case.drawn.margins;
      const auto add = [&](drawing::Curve& curve, const std::optional<response::Margin>& margin) {
        curve.value.push_back(margins.stable && margin ? margin->value : kNoMargin);
      };
      add(curves[0], margins.gain);
      curves[0].value.back() = decibels(curves[0].value.back());
      add(curves[1], margins.phase);
      add(curves[2], margins.delay);
    }
    for (std::size_t k = 0; k < curves.size(); ++k)
      figure.panels[k].curves.push_back(std::move(curves[k]));
    ++colour;
  }
  return figure;
}

drawing::Curve marks_of(const response::Matrix& roots, drawing::Mark mark, int colour) {
  drawing::Curve made = points(mark, colour);
  for (Eigen::Index k = 0; k < roots.rows(); ++k) {
    made.t.push_back(roots(k, 0));
    made.value.push_back(roots(k, 1));
  }
  return made;
}

/// Dots, with crosses at the first value and triangles at the last one; zeros are those of the first.
drawing::Figure locus_picture(const Scanned& all) {
  std::vector<DrawnSystem> merged;
  for (const std::vector<SystemCase>& cases : all.systems) {
    DrawnSystem& whole = merged.emplace_back(cases.front().drawn);
    const Eigen::Index n = whole.poles.rows();
    whole.poles.conservativeResize(n * std::ssize(cases), 2);
    for (std::size_t k = 1; k < cases.size(); ++k)
      whole.poles.middleRows(n * static_cast<Eigen::Index>(k), n) = cases[k].drawn.poles;
  }
  drawing::Figure figure = system_picture(SystemPicture::poles, merged);
  std::vector<drawing::Curve>& curves = figure.panels.front().curves;
  for (drawing::Curve& curve : curves)
    if (curve.mark == drawing::Mark::cross) {
      curve.mark = drawing::Mark::dot;
      curve.label.clear();
    }
  int colour = 0;
  for (const std::vector<SystemCase>& cases : all.systems) {
    for (const auto& [one, mark] : {std::pair(&cases.front(), drawing::Mark::cross),
                                    std::pair(&cases.back(), drawing::Mark::triangle)}) {
      curves.push_back(marks_of(one->drawn.poles, mark, colour));
      curves.back().label = one->drawn.label + " " + one->where;
    }
    ++colour;
  }
  return figure;
}

/// Under the title that the result has.
void take_picture(drawing::Figure figure, SystemResult& result) {
  figure.title = std::move(result.figure.title);
  result.figure = std::move(figure);
}

/// The curves of a few values, each as a system of its own.
void add_curves(const SystemFigure& figure, const model::Stated& stated, const Scanned& all,
                SystemResult& result) {
  std::vector<DrawnSystem> systems;
  for (const std::vector<SystemCase>& cases : all.systems)
    for (const SystemCase& system_case : cases) {
      systems.push_back(system_case.drawn);
      systems.back().label += " " + system_case.where;
    }
  const auto range = range_of(figure, stated, systems);
  for (DrawnSystem& drawn : systems) {
    compute(figure, range, drawn);
    add_facts(drawn, figure.kind, result);
  }
  result.numbers.clear();  // designs are compared at one value
  take_picture(system_picture(figure.kind, systems), result);
}

}  // namespace

void add_scan(const SystemFigure& figure, const LoadedGains& loaded, SystemResult& result) {
  const bool line = kind_of(figure.kind).over == model::PictureRange::none;
  Scanned all = scanned(figure, loaded, line ? kLine : kCurves);
  const std::string& name = figure.scan->name;
  if (all.values.empty()) {
    result.missing = "there are no gains at any value of " + name;
    return;
  }
  result.data["scan"] = {{"name", name}, {"values", all.values}};
  if (!line) {
    add_curves(figure, nominal(loaded), all, result);
  } else {
    for (std::vector<SystemCase>& cases : all.systems) {
      for (SystemCase& system_case : cases) compute(figure, {}, system_case.drawn);
      result.facts.push_back(
          worst_of(cases, figure.kind,
                   fmt::format("over {} values of {} from {} to {}", cases.size(), name,
                               brief(all.values.front()), brief(all.values.back()))));
      result.data["systems"].push_back(cases_json(cases, figure.kind));
      add_numbers(cases, result);
    }
    take_picture(figure.kind == SystemPicture::poles
                     ? locus_picture(all)
                     : margins_picture(all, with_unit(*loaded.stated.design, name)),
                 result);
  }
  if (all.values.size() < all.tried)
    result.facts.push_back(fmt::format("no gains at {} of {} values of {}",
                                       all.tried - all.values.size(), all.tried, name));
}

}  // namespace gainsmith::app
