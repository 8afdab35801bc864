#include "gainsmith/system_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/named.h"
#include "base/nearest.h"
#include "base/number.h"
#include "bind/stated.h"
#include "expr/evaluate.h"
#include "gainsmith/system_picture.h"

namespace gainsmith::app {

namespace {

using model::SystemFigure;
using model::SystemPicture;
using response::StateSpace;

bool is_over_frequency(SystemPicture kind) {
  return kind == SystemPicture::bode || kind == SystemPicture::singular_values ||
         kind == SystemPicture::nyquist;
}
bool is_over_time(SystemPicture kind) {
  return kind == SystemPicture::step || kind == SystemPicture::impulse;
}

/// Nothing where a gain of it has no value.
std::optional<StateSpace> value_of(const SystemFigure::System& of, const model::Stated& stated) {
  try {
    const auto matrix = stated.value(of.matrix);
    if (!matrix) return std::nullopt;
    if (!matrix->allFinite()) throw InputError(of.place, "'" + of.label + "' is not finite");
    double step = 0;
    if (of.step) {
      const auto value = stated.value(*of.step);
      if (!value) return std::nullopt;
      step = (*value)(0, 0);
      if (!(step > 0) || !std::isfinite(step))
        throw InputError(of.place, "the sampling time of '" + of.label +
                                       "' must be positive, not " + brief(step));
    }
    return response::state_space(*matrix, of.states, step);
  } catch (const expr::EvaluationError& error) {
    throw InputError(of.place, "'" + of.label + "' has no value: " + error.message());
  }
}

std::pair<double, double> given_range(const SystemFigure& figure, const model::Stated& stated) {
  const auto end = [&](const model::Formula& formula) {
    const auto value = stated.value(formula.program);
    if (!value) throw InputError(formula.place, "over: this end has no value");
    return (*value)(0, 0);
  };
  const std::pair<double, double> range{end(figure.over->first), end(figure.over->second)};
  const bool positive = is_over_frequency(figure.kind);
  if (!(range.first < range.second) || (positive ? !(range.first > 0) : range.first != 0))
    throw InputError(figure.over->first.place,
                     positive ? "over: a range of frequencies is positive and rises"
                              : "over: a range of times begins at 0 and rises");
  return range;
}

/// That of the figure, or the hull of those that its systems need.
std::pair<double, double> range_of(const SystemFigure& figure, const model::Stated& stated,
                                   const std::vector<DrawnSystem>& systems) {
  if (figure.over) return given_range(figure, stated);
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), 0};
  for (const DrawnSystem& drawn : systems) {
    const auto own = is_over_time(figure.kind) ? std::pair(0.0, response::duration_of(drawn.system))
                     : drawn.system.is_single() ? response::range_with_crossover(drawn.system)
                                                : response::range_of(drawn.system);
    range.first = std::min(range.first, own.first);
    range.second = std::max(range.second, own.second);
  }
  return range;
}

void compute(const SystemFigure& figure, std::pair<double, double> range, DrawnSystem& drawn) {
  const StateSpace& system = drawn.system;
  if (is_over_frequency(figure.kind)) {
    const double most = system.is_sampled() ? response::range_of(system).second
                                            : std::numeric_limits<double>::infinity();
    if (!(range.first < most))
      throw InputError(figure.place, "figures: " + figure.name +
                                         ": the range begins above half of the sampling frequency");
    drawn.sweep = response::sweep(system, range.first, std::min(range.second, most));
    if (figure.kind != SystemPicture::singular_values && system.is_single())
      drawn.margins = response::margins(system);
    if (figure.kind == SystemPicture::singular_values || !system.is_single())
      drawn.peak = response::peak(system);
  } else if (is_over_time(figure.kind)) {
    const auto stimulus =
        figure.kind == SystemPicture::step ? response::Stimulus::step : response::Stimulus::impulse;
    for (Eigen::Index j = 0; j < system.inputs(); ++j)
      drawn.time.push_back(response::time_response(system, stimulus, j, range.second));
  } else {
    drawn.poles = response::poles(system);
    drawn.zeros = response::zeros(system);
  }
}

// --- Facts. ---

/// null for what is not finite.
io::Json number(double value) { return std::isfinite(value) ? io::Json(value) : io::Json(); }

std::string at_frequency(double w) {
  return std::isfinite(w) ? " at " + brief(w) : " beyond all frequencies";
}

void add_margins(const DrawnSystem& drawn, std::vector<std::string>& facts, io::Json& json) {
  const response::Margins& of = *drawn.margins;
  std::string text = drawn.label + " under u = -y: ";
  text += of.gain ? fmt::format("gain margin {} ({} dB){}", brief(of.gain->value),
                                brief(20 * std::log10(of.gain->value)),
                                at_frequency(of.gain->frequency))
                  : "no gain margin: the phase does not cross -180 degrees";
  text += of.phase ? fmt::format(", phase margin {} degrees{}", brief(of.phase->value),
                                 at_frequency(of.phase->frequency))
                   : ", no phase margin: the gain does not cross 1";
  if (of.delay && of.stable) text += fmt::format(", delay margin {}", brief(of.delay->value));
  text += of.stable ? "; the closed loop is stable" : "; the closed loop is not stable";
  facts.push_back(text);
  const auto margin = [](const std::optional<response::Margin>& one) {
    return one ? io::Json{{"value", one->value}, {"frequency", number(one->frequency)}}
               : io::Json();
  };
  json["margins"] = {{"gain", margin(of.gain)},
                     {"phase", margin(of.phase)},
                     {"delay", margin(of.delay)},
                     {"closed_loop_stable", of.stable}};
}

void add_peak(const DrawnSystem& drawn, std::vector<std::string>& facts, io::Json& json) {
  const response::Peak& of = *drawn.peak;
  std::string text = drawn.label + ": largest gain " + brief(of.value) + at_frequency(of.frequency);
  const auto end = [](const std::optional<double>& value) {
    return value ? io::Json(*value) : io::Json();
  };
  if (of.low && of.high)
    text += ", proved between " + brief_below(*of.low, 9) + " and " + brief_above(*of.high, 9);
  else
    text += ", not proved";
  facts.push_back(text);
  json["peak"] = {{"value", of.value},
                  {"frequency", number(of.frequency)},
                  {"low", end(of.low)},
                  {"high", end(of.high)}};
}

std::string step_text(const response::StepFacts& of) {
  if (of.ends_at_0())
    return fmt::format("ends at 0, largest {} at {}", brief(of.largest), brief(of.largest_at));
  std::string text =
      fmt::format("ends at {}, overshoot {} %", brief(of.final_value), brief(100 * of.overshoot));
  if (of.overshoot > 0)
    text += fmt::format(" (largest {} at {})", brief(of.largest), brief(of.largest_at));
  if (of.undershoot > 0) text += fmt::format(", undershoot {} %", brief(100 * of.undershoot));
  return text +
         fmt::format(", rises in {}, settles to 2 % at {}", brief(of.rise), brief(of.settling));
}

void add_step(const DrawnSystem& drawn, std::vector<std::string>& facts, io::Json& json) {
  if (!response::is_stable(drawn.system)) {
    facts.push_back(drawn.label + ": not stable, so there is no final value");
    return;
  }
  for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i)
    for (Eigen::Index j = 0; j < drawn.system.inputs(); ++j) {
      const std::string label = drawn.label + element_label(drawn.system, i, j);
      const auto of = response::step_facts(drawn.system, j, i);
      facts.push_back(label + ": " +
                      (of ? step_text(*of) : "oscillates for too long to be followed to its end"));
      if (!of) continue;
      json["steps"].push_back({{"output", i + 1},
                               {"input", j + 1},
                               {"final_value", of->final_value},
                               {"largest", of->largest},
                               {"largest_at", of->largest_at},
                               {"overshoot", of->overshoot},
                               {"undershoot", of->undershoot},
                               {"rise", of->rise},
                               {"settling", of->settling}});
    }
}

void add_modes(const DrawnSystem& drawn, const response::Matrix& roots, const char* what,
               std::vector<std::string>& facts) {
  for (Eigen::Index k = 0; k < roots.rows(); ++k) {
    const double real = roots(k, 0), imaginary = roots(k, 1);
    if (imaginary < 0) continue;
    const response::Mode mode = response::mode_of(real, imaginary, drawn.system.step);
    facts.push_back(fmt::format("{}: {} {}{}, frequency {}, damping {}", drawn.label, what,
                                brief(real), imaginary > 0 ? " +- " + brief(imaginary) + "i" : "",
                                brief(mode.frequency), brief(mode.damping)));
  }
}

io::Json rows_of(const response::Matrix& matrix) {
  io::Json rows = io::Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    io::Json row = io::Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(number(matrix(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The curves.
io::Json data_of(const DrawnSystem& drawn, SystemPicture kind) {
  io::Json data = {{"system", drawn.label}};
  if (!drawn.sweep.frequency.empty()) {
    data["frequency"] = drawn.sweep.frequency;
    if (kind == SystemPicture::singular_values) {
      io::Json& values = data["singular_values"] = io::Json::array();
      for (const auto& response : drawn.sweep.response)
        values.push_back(rows_of(response::gains_of(response).transpose())[0]);
    } else {
      for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i)
        for (Eigen::Index j = 0; j < drawn.system.inputs(); ++j) {
          io::Json real = io::Json::array(), imaginary = io::Json::array();
          for (const auto& response : drawn.sweep.response) {
            real.push_back(number(response(i, j).real()));
            imaginary.push_back(number(response(i, j).imag()));
          }
          data["response"].push_back({{"output", i + 1},
                                      {"input", j + 1},
                                      {"real", std::move(real)},
                                      {"imaginary", std::move(imaginary)}});
        }
    }
  }
  for (std::size_t j = 0; j < drawn.time.size(); ++j) {
    data["time"] = drawn.time[j].t;
    data["outputs"].push_back({{"input", j + 1}, {"y", rows_of(drawn.time[j].y)}});
  }
  if (kind == SystemPicture::poles) {
    data["poles"] = rows_of(drawn.poles);
    data["zeros"] = rows_of(drawn.zeros);
  }
  return data;
}

void add_facts(const DrawnSystem& drawn, SystemPicture kind, SystemResult& result) {
  io::Json data = data_of(drawn, kind);
  if (drawn.margins) add_margins(drawn, result.facts, data);
  if (drawn.peak) add_peak(drawn, result.facts, data);
  if (kind == SystemPicture::singular_values && !drawn.peak)
    result.facts.push_back(drawn.label + ": not stable, so there is no largest gain");
  if (kind == SystemPicture::step) add_step(drawn, result.facts, data);
  if (kind == SystemPicture::poles) {
    add_modes(drawn, drawn.poles, "pole", result.facts);
    add_modes(drawn, drawn.zeros, "zero", result.facts);
  }
  result.data["systems"].push_back(std::move(data));
}

SystemResult result_of(const SystemFigure& figure, const model::Stated& stated) {
  SystemResult result;
  result.name = figure.name;
  result.data = {{"name", figure.name}, {"kind", to_string(figure.kind)}};
  std::vector<DrawnSystem> systems;
  for (const SystemFigure::System& of : figure.systems) {
    auto system = value_of(of, stated);
    if (!system) {
      result.missing =
          "'" + of.label + "' uses what has no value, such as a gain of a design without solution";
      return result;
    }
    systems.push_back({of.label, std::move(*system), {}, {}, {}, {}, {}, {}});
  }
  const bool is_poles = figure.kind == SystemPicture::poles;
  for (const DrawnSystem& drawn : systems)
    if (is_poles && drawn.system.is_sampled() != systems.front().system.is_sampled())
      throw InputError(figure.place, "figures: " + figure.name +
                                         ": poles of continuous and of sampled systems need two "
                                         "pictures");
  const auto range = is_poles ? std::pair(0.0, 0.0) : range_of(figure, stated, systems);
  for (DrawnSystem& drawn : systems) {
    compute(figure, range, drawn);
    add_facts(drawn, figure.kind, result);
  }
  result.svg = report::svg(system_picture(figure.name, figure.kind, systems));
  return result;
}

}  // namespace

std::vector<SystemResult> system_results(const LoadedGains& loaded,
                                         const std::vector<std::string>& names) {
  const std::vector<SystemFigure>& all = loaded.stated.design->pictures;
  for (const std::string& name : names)
    if (!has_named(all, name))
      throw InputError({"--figure"}, "the problem has no figure '" + name + "'" +
                                         suggestion(name, names_of_all(all)));
  std::vector<SystemResult> results;
  if (all.empty()) return results;
  const model::Stated stated = bind::state(loaded.stated, loaded.gains);
  for (const SystemFigure& figure : all)
    if (names.empty() || std::find(names.begin(), names.end(), figure.name) != names.end())
      results.push_back(result_of(figure, stated));
  return results;
}

}  // namespace gainsmith::app
