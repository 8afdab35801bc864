#include "gainsmith/system_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/number.h"
#include "gainsmith/system_facts.h"

namespace gainsmith::app {

namespace {

using model::SystemPicture;

/// The case with the least value of a number that some stable ones have.
struct Least {
  double value = 0;
  const SystemCase* at = nullptr;
};
Least least_of(const std::vector<SystemCase>& cases,
               const std::function<std::optional<double>(const DrawnSystem&)>& number) {
  Least least;
  for (const SystemCase& system_case : cases) {
    if (!is_stable(system_case.drawn)) continue;
    const auto value = number(system_case.drawn);
    if (value && (least.at == nullptr || *value < least.value)) least = {*value, &system_case};
  }
  return least;
}

void add(std::string& text, const std::string& what) {
  if (!what.empty()) text += (text.empty() ? "" : ", ") + what;
}

std::string worst_margins(const std::vector<SystemCase>& cases) {
  using Which = std::optional<response::Margin> response::Margins::*;
  const auto number = [](Which which, double (*size)(double)) {
    return [which, size](const DrawnSystem& drawn) -> std::optional<double> {
      const auto& margin = (*drawn.margins).*which;
      return margin ? std::optional(size(margin->value)) : std::nullopt;
    };
  };
  const auto itself = [](double value) { return std::abs(value); };
  const auto in_decibels = [](double value) { return std::abs(decibels(value)); };
  std::string text;
  if (const Least gain = least_of(cases, number(&response::Margins::gain, in_decibels)); gain.at)
    add(text,
        fmt::format("least gain margin {} ({} dB) {}", brief(gain.at->drawn.margins->gain->value),
                    brief(decibels(gain.at->drawn.margins->gain->value)), gain.at->where));
  if (const Least phase = least_of(cases, number(&response::Margins::phase, itself)); phase.at)
    add(text, fmt::format("least phase margin {} degrees {}", brief(phase.value), phase.at->where));
  if (const Least delay = least_of(cases, number(&response::Margins::delay, itself)); delay.at)
    add(text, fmt::format("least delay margin {} {}", brief(delay.value), delay.at->where));
  return text;
}

std::string worst_gain(const std::vector<SystemCase>& cases) {
  const Least least = least_of(cases, [](const DrawnSystem& drawn) -> std::optional<double> {
    return drawn.peak ? std::optional(-drawn.peak->value) : std::nullopt;
  });
  return least.at ? fmt::format("largest gain {} {}", brief(-least.value), least.at->where) : "";
}

/// Of what a step leaves at 0.
std::string largest_size(const std::vector<SystemCase>& cases) {
  const Least least = least_of(cases, [](const DrawnSystem& drawn) {
    std::optional<double> most;
    for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i)
      for (Eigen::Index j = 0; j < drawn.system.inputs(); ++j)
        if (const auto facts = response::step_facts(drawn.system, j, i);
            facts && facts->ends_at_0())
          most = std::min(most.value_or(0), -std::abs(facts->largest));
    return most;
  });
  return least.at ? fmt::format("largest size {} {}", brief(std::abs(least.value)), least.at->where)
                  : "";
}

std::string worst_step(const std::vector<SystemCase>& cases) {
  const auto worst = [&](double response::StepFacts::*which, const char* what) {
    const Least least = least_of(cases, [which](const DrawnSystem& drawn) -> std::optional<double> {
      std::optional<double> most;
      for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i)
        for (Eigen::Index j = 0; j < drawn.system.inputs(); ++j)
          if (const auto facts = response::step_facts(drawn.system, j, i);
              facts && !facts->ends_at_0())
            most = std::min(most.value_or(0), -((*facts).*which));
      return most;
    });
    if (least.at == nullptr) return std::string();
    const bool share = which == &response::StepFacts::overshoot;
    const double value = std::abs(share ? 100 * least.value : least.value);
    return fmt::format("{} {}{} {}", what, brief(value), share ? " %" : "", least.at->where);
  };
  std::string text;
  add(text, worst(&response::StepFacts::overshoot, "largest overshoot"));
  add(text, worst(&response::StepFacts::settling, "longest settling"));
  add(text, largest_size(cases));
  return text;
}

std::string worst_damping(const std::vector<SystemCase>& cases) {
  const Least least = least_of(cases, [](const DrawnSystem& drawn) {
    std::optional<double> damping;
    for (Eigen::Index k = 0; k < drawn.poles.rows(); ++k) {
      const double own =
          response::mode_of(drawn.poles(k, 0), drawn.poles(k, 1), drawn.system.step).damping;
      damping = std::min(damping.value_or(own), own);
    }
    return damping;
  });
  return least.at ? fmt::format("least damping {} {}", brief(least.value), least.at->where) : "";
}

/// "stable in all", or how many are not, and which is the first.
std::string stability(const std::vector<SystemCase>& cases, bool loop) {
  const auto unstable = [](const SystemCase& system_case) { return !is_stable(system_case.drawn); };
  const auto first = std::find_if(cases.begin(), cases.end(), unstable);
  const std::string what = loop ? "the closed loop is" : "it is";
  if (first == cases.end()) return what + " stable in all";
  return fmt::format("{} not stable in {} of {}, first {}", what,
                     std::count_if(cases.begin(), cases.end(), unstable), cases.size(),
                     first->where);
}

io::Json margin_json(const std::optional<response::Margin>& margin) {
  return margin ? number_json(margin->value) : io::Json();
}

}  // namespace

void add_numbers(const std::vector<SystemCase>& cases, SystemResult& result) {
  if (!cases.front().drawn.margins) return;
  const auto add = [&](const char* what, std::optional<response::Margin> response::Margins::*which,
                       double (*size)(double)) {
    const Least least = least_of(cases, [&](const DrawnSystem& drawn) -> std::optional<double> {
      const auto& margin = (*drawn.margins).*which;
      return margin ? std::optional(size(margin->value)) : std::nullopt;
    });
    if (least.at)
      result.numbers.push_back(
          {0, result.name + ", " + cases.front().drawn.label + ": " + what, least.value});
  };
  const auto itself = [](double value) { return std::abs(value); };
  const auto unstable = std::ranges::count_if(
      cases, [](const SystemCase& system_case) { return !is_stable(system_case.drawn); });
  result.numbers.push_back({0,
                            result.name + ", " + cases.front().drawn.label +
                                fmt::format(": not stable, of {}", cases.size()),
                            static_cast<double>(unstable)});
  add("least gain margin, dB", &response::Margins::gain,
      [](double value) { return std::abs(decibels(value)); });
  add("least phase margin, degrees", &response::Margins::phase, itself);
  add("least delay margin", &response::Margins::delay, itself);
}

bool is_stable(const DrawnSystem& drawn) {
  return drawn.margins ? drawn.margins->stable : response::is_stable(drawn.system);
}

std::string worst_of(const std::vector<SystemCase>& cases, SystemPicture kind,
                     const std::string& of) {
  const bool loop = cases.front().drawn.margins.has_value();
  std::string worst;
  if (loop)
    worst = worst_margins(cases);
  else if (cases.front().drawn.peak)
    worst = worst_gain(cases);
  else if (kind == SystemPicture::step)
    worst = worst_step(cases);
  else if (kind == SystemPicture::poles)
    worst = worst_damping(cases);
  return fmt::format("{} {}: {}{}{}", cases.front().drawn.label, of, worst,
                     worst.empty() ? "" : "; ", stability(cases, loop));
}

io::Json cases_json(const std::vector<SystemCase>& cases, SystemPicture kind) {
  io::Json json = {{"system", cases.front().drawn.label}};
  for (const SystemCase& system_case : cases) {
    json["stable"].push_back(is_stable(system_case.drawn));
    if (const auto& margins = system_case.drawn.margins) {
      json["gain_margin"].push_back(margin_json(margins->gain));
      json["phase_margin"].push_back(margin_json(margins->phase));
      json["delay_margin"].push_back(margin_json(margins->delay));
    }
    if (kind == SystemPicture::poles) json["locus"].push_back(rows_json(system_case.drawn.poles));
  }
  return json;
}

}  // namespace gainsmith::app
