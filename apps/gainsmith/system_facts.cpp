#include "gainsmith/system_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/number.h"

namespace gainsmith::app {

namespace {

using model::SystemPicture;

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
    return one ? io::Json{{"value", number_json(one->value)},
                          {"frequency", number_json(one->frequency)}}
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
  json["peak"] = {{"value", number_json(of.value)},
                  {"frequency", number_json(of.frequency)},
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
                               {"final_value", number_json(of->final_value)},
                               {"largest", number_json(of->largest)},
                               {"largest_at", number_json(of->largest_at)},
                               {"overshoot", number_json(of->overshoot)},
                               {"undershoot", number_json(of->undershoot)},
                               {"rise", number_json(of->rise)},
                               {"settling", number_json(of->settling)}});
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

/// The curves.
io::Json data_of(const DrawnSystem& drawn, SystemPicture kind) {
  io::Json data = {{"system", drawn.label}};
  if (!drawn.sweep.frequency.empty()) {
    data["frequency"] = drawn.sweep.frequency;
    if (kind == SystemPicture::singular_values) {
      io::Json& values = data["singular_values"] = io::Json::array();
      for (const auto& response : drawn.sweep.response)
        values.push_back(rows_json(response::gains_of(response).transpose())[0]);
    } else {
      for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i)
        for (Eigen::Index j = 0; j < drawn.system.inputs(); ++j) {
          io::Json real = io::Json::array(), imaginary = io::Json::array();
          for (const auto& response : drawn.sweep.response) {
            real.push_back(number_json(response(i, j).real()));
            imaginary.push_back(number_json(response(i, j).imag()));
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
    data["outputs"].push_back({{"input", j + 1}, {"y", rows_json(drawn.time[j].y)}});
  }
  if (kind == SystemPicture::poles) {
    data["poles"] = rows_json(drawn.poles);
    data["zeros"] = rows_json(drawn.zeros);
  }
  return data;
}

void add_numbers(const DrawnSystem& drawn, SystemPicture kind, SystemResult& result) {
  const auto add = [&](const std::string& what, double value) {
    result.numbers.push_back({drawn.design,
                              result.name + ", " +
                                  (drawn.own_label.empty() ? drawn.label : drawn.own_label) + ": " +
                                  what,
                              value});
  };
  if (drawn.margins) {
    if (const auto& gain = drawn.margins->gain) add("gain margin, dB", decibels(gain->value));
    if (const auto& phase = drawn.margins->phase) add("phase margin, degrees", phase->value);
    if (const auto& delay = drawn.margins->delay; delay && drawn.margins->stable)
      add("delay margin", delay->value);
    add("closed loop stable, 1 or 0", drawn.margins->stable ? 1 : 0);
  }
  if (drawn.peak) add("largest gain", drawn.peak->value);
  if (kind == SystemPicture::poles && drawn.poles.rows() > 0) {
    double most = -std::numeric_limits<double>::infinity(), damping = 1;
    for (Eigen::Index k = 0; k < drawn.poles.rows(); ++k) {
      const double real = drawn.poles(k, 0), imaginary = drawn.poles(k, 1);
      most = std::max(most, drawn.system.is_sampled() ? std::hypot(real, imaginary) : real);
      damping = std::min(damping, response::mode_of(real, imaginary, drawn.system.step).damping);
    }
    add(drawn.system.is_sampled() ? "largest size of a pole" : "largest real part of a pole", most);
    add("least damping", damping);
  }
  if (kind != SystemPicture::step || !response::is_stable(drawn.system)) return;
  for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i)
    for (Eigen::Index j = 0; j < drawn.system.inputs(); ++j)
      if (const auto of = response::step_facts(drawn.system, j, i)) {
        const std::string element = element_label(drawn.system, i, j);
        const std::string which = element.empty() ? "" : "," + element;
        if (of->ends_at_0()) {
          add("largest size" + which, std::abs(of->largest));
          continue;
        }
        add("overshoot, %" + which, 100 * of->overshoot);
        add("settling time" + which, of->settling);
      }
}

}  // namespace

io::Json number_json(double value) { return std::isfinite(value) ? io::Json(value) : io::Json(); }

io::Json rows_json(const response::Matrix& matrix) {
  io::Json rows = io::Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    io::Json row = io::Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(number_json(matrix(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
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
  add_numbers(drawn, kind, result);
  result.data["systems"].push_back(std::move(data));
}

}  // namespace gainsmith::app
