#include "gainsmith/explain_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "gainsmith/output.h"
#include "gainsmith/summary.h"
#include "model/names.h"

namespace gainsmith::app {

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// The value with the decimals that its bracket settles, and at least three, rounded to the
/// feasible side.
std::string settled(const design::Reach& reach) {
  const double value = *reach.feasible;
  const auto next = reach.beyond ? reach.beyond : reach.open;
  const double width = next ? std::abs(*next - value) : 0;
  if (!(width > 0) || value == 0) return brief(value, 10);
  const double digits = std::floor(std::log10(std::abs(value))) - 2;
  const double unit = std::pow(10.0, std::min(std::ceil(std::log10(width)), digits));
  const double steps = value / unit;
  const double rounded = unit * (reach.at_most ? std::floor(steps) : std::ceil(steps));
  return brief(rounded, 10);
}

std::string reach_text(const design::Reach& reach) {
  return fmt::format("{} at {} {}", reach.name, reach.at_most ? "most" : "least", settled(reach));
}

io::Json side_of(const design::Reach& reach) {
  if (!reach.feasible) return nullptr;
  return reach.at_most ? "at most" : "at least";
}

std::string conflict_statement(const design::Conflict& conflict);

/// What stops a scalar that has room.
std::string stop_text(const design::Reach& reach) {
  if (!reach.beyond && reach.feasible == reach.end)
    return "            the end of its range: nothing before it stops " + reach.name + "\n";
  if (!reach.conflict) return reach.beyond ? "" : "            what lies beyond is undecided\n";
  if (reach.conflict->gain_bound && reach.name == model::kGainBound)
    return fmt::format("            with {} no gains were found\n", brief(reach.conflict_at, 5));
  return fmt::format("            at {}: {}\n", brief(reach.conflict_at, 5),
                     conflict_statement(*reach.conflict));
}

std::string negotiable_text(const design::Reach& reach) {
  if (!reach.feasible)
    return fmt::format("negotiable  {} does not help: nothing feasible was found in its range\n",
                       reach.name);
  const std::string beyond = reach.beyond ? "; " + brief(*reach.beyond, 10) + " is infeasible" +
                                                model::limits_of(*reach.certificate)
                                          : "";
  return fmt::format("negotiable  {} (it is {}{})\n", reach_text(reach), brief(reach.value),
                     beyond);
}

std::string conflict_statement(const design::Conflict& conflict) {
  if (conflict.gain_bound)
    return "the inequalities hold together, but not within the gain bound; raise "
           "synthesis.gain_bound";
  const std::string limits = (conflict.within_gain_bound ? " within the gain bound" : "") +
                             model::limits_of(conflict.certificate);
  if (conflict.names.size() == 1) return conflict.names.front() + " cannot hold" + limits;
  return listed(conflict.names) + " cannot hold together" + limits;
}

std::string certificate_brief(const model::CertificateRecord& certificate) {
  return certificate.exact ? "exact" : model::shown_by(certificate);
}

std::string conflict_text(const design::Conflict& conflict) {
  std::string text = "conflict    " + conflict_statement(conflict) + "\n";
  if (conflict.gain_bound) return text;
  text +=
      "            certificate of these alone: " + certificate_brief(conflict.certificate) + "\n";
  if (conflict.undecided.empty())
    return text + (conflict.names.size() == 1
                       ? "            without it the others can be satisfied\n"
                       : "            without any one of them the others can "
                         "be satisfied\n");
  return text + fmt::format("            whether {} {} needed is undecided\n",
                            listed(conflict.undecided),
                            conflict.undecided.size() == 1 ? "is" : "are");
}

/// The multiple of I that a slack adds to the larger side.
std::optional<double> in_units(const std::optional<double>& slack,
                               const design::Relaxation& relaxation) {
  if (!slack) return std::nullopt;
  return *slack * relaxation.scale;
}

std::string relaxations_text(const std::vector<design::Relaxation>& relaxations) {
  if (relaxations.empty()) return "";
  std::size_t width = 10;
  for (const auto& relaxation : relaxations) width = std::max(width, relaxation.name.size());
  std::string text =
      fmt::format("{:<{}}  {:>14}  {:>14}  {:>10}  {:>14}  {:>14}\n", "relax by", width, "alone",
                  "all together", "times size", "= t alone", "= t together");
  const auto number = [](const std::optional<double>& value, bool at_most, const char* none) {
    if (!value) return std::string(none);
    return (at_most && *value > 0 ? "at most " : "") + brief(*value, 4);
  };
  for (const auto& relaxation : relaxations)
    text += fmt::format(
        "{:<{}}  {:>14}  {:>14}  {:>10}  {:>14}  {:>14}\n", relaxation.name, width,
        relaxation.alone == 0.0
            ? "any above 0"
            : number(relaxation.alone, relaxation.alone_at_most,
                     relaxation.alone_undecided ? "undecided" : "does not help"),
        number(relaxation.together, relaxation.together_at_most, "undecided"),
        brief(relaxation.scale, 3),
        number(in_units(relaxation.alone, relaxation), relaxation.alone_at_most, "-"),
        number(in_units(relaxation.together, relaxation), relaxation.together_at_most, "-"));
  return text +
         "            alone: if no other requirement gives; all together: if all of them do.\n"
         "            t = that number times the size of the rows: t*I on the larger side is "
         "enough\n";
}

constexpr const char* kZeroOrNone = "0 or -inf";
constexpr const char* kUnbounded = "-inf";
constexpr const char* kNotFound = "not found";

/// "1.29", or why there is no number; `objective`: beside which a value may be 0.
std::string minimum_text(const std::optional<design::Changed>& changed, double objective) {
  constexpr double kNothing = 1e-6;
  if (!changed) return "-";
  if (changed->homogeneous) return kZeroOrNone;
  if (!changed->minimum) return changed->unbounded ? kUnbounded : kNotFound;
  const double least = changed->lower_bound.value_or(*changed->minimum);
  if (std::max(std::abs(least), std::abs(*changed->minimum)) <= kNothing * std::abs(objective))
    return "0";
  const std::string high = brief(*changed->minimum, 4);
  const std::string low = brief(least, 4);
  return low == high ? brief(*changed->minimum) : low + " to " + high;
}

/// "tau = 0.7 (83 %), tau = 0 (17 %)": where an inequality is active.
std::string places_text(const design::Limit& limit) {
  constexpr std::size_t kMost = 3;
  constexpr double kTells = 0.01;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, limit.points.size()); ++k) {
    const auto& [point, price] = limit.points[k];
    if (price < kTells * limit.price) break;
    text +=
        fmt::format("{}{} ({:.0f} %)", text.empty() ? "" : ", ", point, 100 * price / limit.price);
  }
  return text;
}

/// The least slack of a requirement with which the optimum may be 1 % better.
std::string slack_for_one_percent(const design::Limit& limit, double objective) {
  if (!(limit.price > 0) || objective == 0) return "-";
  return brief(0.01 * std::abs(objective) / limit.price, 3);
}

/// What the cells of the table mean, those that occur.
std::string legend_of(const std::vector<design::Limit>& active, double objective) {
  std::string text =
      "price       t*I on the larger side of a requirement lowers the optimum by at most price*t.\n"
      "            'for 1 %' is the least t that can make it 1 % better; compare it with 'size',\n"
      "            the size of the largest row of the requirement\n";
  const auto add = [&](const char* cell, const char* meaning) {
    if (std::any_of(active.begin(), active.end(), [&](const design::Limit& limit) {
          return minimum_text(limit.without, objective) == cell;
        }))
      text += fmt::format("{:<12}{}\n", cell, meaning);
  };
  add(kZeroOrNone,
      "without this requirement nothing bounds the objective: the optimum is 0, or there is none;\n"
      "            this number does not tell what limits the design");
  add(kUnbounded,
      "without this requirement the objective falls below every number; this does not tell what\n"
      "            limits the design");
  add(kNotFound, "the solver did not settle the problem without this requirement");
  return text;
}

std::string limits_text(const design::Limits& limits, const model::Gains& gains) {
  std::size_t width = 10;
  for (const auto& limit : limits.active) width = std::max(width, limit.name.size());
  std::string text;
  if (!limits.active.empty())
    text = fmt::format("{:<{}}  {:>11}  {:>9}  {:>9}  {:>18}  {}\n", "limited by", width, "price",
                       "for 1 %", "size", "optimum without it", "most at");
  for (const auto& limit : limits.active) {
    text += fmt::format("{:<{}}  {:>11}  {:>9}  {:>9}  {:>18}  {}", limit.name, width,
                        brief(limit.price, 3), slack_for_one_percent(limit, *gains.objective),
                        brief(limit.scale, 3), minimum_text(limit.without, *gains.objective),
                        places_text(limit));
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  if (!limits.active.empty()) text += legend_of(limits.active, *gains.objective);
  if (!limits.inactive.empty())
    text += "no limit    " + listed(limits.inactive) +
            (limits.inactive.size() == 1 ? " costs" : " cost") + " nothing\n";
  if (limits.wider_gains)
    text += fmt::format(
        "gain bound  it costs: the optimum with ten times the bound is {}, without a bound {}\n",
        minimum_text(limits.wider_gains, *gains.objective),
        minimum_text(limits.any_gains, *gains.objective));
  for (const auto& scalar : limits.scalars) {
    const double change = *scalar.changed.minimum - *gains.objective;
    text += fmt::format("{:<12}{} = {} instead of {} gives {} ({}{} %)\n",
                        &scalar == limits.scalars.data() ? "scalars" : "", scalar.name,
                        brief(scalar.other), brief(scalar.value), brief(*scalar.changed.minimum, 6),
                        change < 0 ? "" : "+", brief(100 * change / std::abs(*gains.objective), 2));
  }
  return text;
}

io::Json number(const std::optional<double>& value) {
  return value ? io::Json(*value) : io::Json();
}

io::Json changed_json(const std::optional<design::Changed>& changed) {
  if (!changed) return nullptr;
  return {{"minimum", number(changed->minimum)},
          {"lower_bound", number(changed->lower_bound)},
          {"unbounded", changed->unbounded},
          {"homogeneous", changed->homogeneous}};
}

io::Json limits_json(const design::Limits& limits) {
  io::Json document = {{"active", io::Json::array()},
                       {"inactive", limits.inactive},
                       {"ten_times_the_gain_bound", changed_json(limits.wider_gains)},
                       {"without_gain_bound", changed_json(limits.any_gains)},
                       {"scalars", io::Json::array()}};
  for (const auto& limit : limits.active) {
    io::Json points = io::Json::array();
    for (const auto& [point, price] : limit.points)
      points.push_back({{"at", point}, {"price", price}});
    document["active"].push_back({{"requirement", limit.name},
                                  {"price", limit.price},
                                  {"scale", limit.scale},
                                  {"points", points},
                                  {"without", changed_json(limit.without)}});
  }
  for (const auto& scalar : limits.scalars)
    document["scalars"].push_back({{"scalar", scalar.name},
                                   {"value", scalar.value},
                                   {"other", scalar.other},
                                   {"minimum", *scalar.changed.minimum}});
  return document;
}

io::Json conflict_json(const design::Conflict& conflict) {
  return {{"requirements", conflict.names},
          {"undecided", conflict.undecided},
          {"gain_bound", conflict.gain_bound},
          {"within_gain_bound", conflict.within_gain_bound},
          {"exact", conflict.certificate.exact},
          {"shows", model::shown_by(conflict.certificate)},
          {"about", conflict.certificate.about},
          {"backward_error", conflict.certificate.backward_error}};
}

/// "no at b = 0.001, infeasible by a checked certificate; synth also searches b".
std::string verdict_text(const design::Explanation& explanation) {
  const std::string line = verdict_line(explanation.gains);
  if (explanation.gains.verdict != model::Verdict::no || explanation.held.empty()) return line;
  std::vector<std::string> names;
  for (const design::HeldScalar& scalar : explanation.held) names.push_back(scalar.name);
  return "no at " + design::held_text(explanation.held) + line.substr(std::string("no").size()) +
         "; synth also searches " + listed(names);
}

}  // namespace

std::string explanation_line(const design::Conflict& conflict,
                             const std::vector<design::Reach>& reaches) {
  std::string text = conflict_statement(conflict);
  std::string ways;
  for (const design::Reach& reach : reaches)
    if (reach.feasible) ways += (ways.empty() ? "" : ", or ") + reach_text(reach);
  return text + (ways.empty() ? "" : "; " + ways + " would do");
}

std::string explanation_text(const design::Explanation& explanation) {
  std::string text = fmt::format("problem     {}\nverdict     {}\n", explanation.gains.problem_name,
                                 verdict_text(explanation));
  const bool yes = explanation.gains.verdict == model::Verdict::yes;
  if (!explanation.conflict) text += message_lines(explanation.gains);
  if (yes) text += margins_note(explanation.gains) + objective_text(explanation.gains);
  if (explanation.conflict) text += conflict_text(*explanation.conflict);
  text += relaxations_text(explanation.relaxations);
  if (explanation.limits) text += limits_text(*explanation.limits, explanation.gains);
  for (const design::Reach& reach : explanation.reaches)
    text += negotiable_text(reach) + (yes ? stop_text(reach) : "");
  return text;
}

io::Json explanation_json(const design::Explanation& explanation) {
  io::Json document = {{"problem", explanation.gains.problem_name},
                       {"verdict", to_string(explanation.gains.verdict)},
                       {"conflict", nullptr},
                       {"relaxations", io::Json::array()},
                       {"negotiable", io::Json::array()}};
  if (const auto& conflict = explanation.conflict) document["conflict"] = conflict_json(*conflict);
  for (const auto& relaxation : explanation.relaxations)
    document["relaxations"].push_back({{"requirement", relaxation.name},
                                       {"scale", relaxation.scale},
                                       {"alone", number(relaxation.alone)},
                                       {"alone_undecided", relaxation.alone_undecided},
                                       {"alone_at_most", relaxation.alone_at_most},
                                       {"together", number(relaxation.together)},
                                       {"together_at_most", relaxation.together_at_most}});
  for (const auto& reach : explanation.reaches)
    document["negotiable"].push_back(
        {{"scalar", reach.name},
         {"value", reach.value},
         {"side", side_of(reach)},
         {"feasible", number(reach.feasible)},
         {"beyond", number(reach.beyond)},
         {"beyond_about", reach.certificate ? io::Json(reach.certificate->about) : io::Json()},
         {"conflict", reach.conflict ? conflict_json(*reach.conflict) : io::Json()},
         {"conflict_at", reach.conflict ? io::Json(reach.conflict_at) : io::Json()}});
  document["held"] = io::Json::object();
  for (const design::HeldScalar& scalar : explanation.held)
    document["held"][scalar.name] = scalar.value;
  if (explanation.gains.objective) document["objective"] = *explanation.gains.objective;
  document["limits"] = explanation.limits ? limits_json(*explanation.limits) : io::Json();
  return document;
}

}  // namespace gainsmith::app
