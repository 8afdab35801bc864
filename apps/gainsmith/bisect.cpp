#include "design/bisect.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/number.h"
#include "base/stop.h"
#include "bind/instance.h"
#include "design/synthesize.h"
#include "gainsmith/advice.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/picture_file.h"
#include "gainsmith/range_option.h"
#include "gainsmith/search_figure.h"
#include "gainsmith/search_wanted.h"
#include "gainsmith/summary.h"
#include "gainsmith/terminal.h"
#include "gainsmith/units.h"
#include "io/json/gains_json.h"
#include "model/names.h"
#include "model/stated_file.h"
#include "verify/campaign.h"

namespace gainsmith::app {

namespace {

struct BisectOptions {
  std::string problem;
  std::vector<std::string> set;
  std::string largest;
  std::string smallest;
  std::vector<std::string> range;
  std::optional<double> tolerance;
  bool claims = false;
  std::string output;
  std::string plot;
  bool json = false;
};

/// A factor of a thousand to both sides of the bound that the problem states.
model::ScalarRange range_of_gain_bound(const model::Problem& problem) {
  constexpr double kFactor = 1000;
  const double bound = problem.synthesis.gain_bound.value_or(1);
  return {model::kGainBound,
          parse_expression(decimal17(bound / kFactor), "--in"),
          parse_expression(decimal17(bound * kFactor), "--in"),
          {"--in"}};
}

/// The range of a scalar that the command line names: --in, or what the problem says of it.
model::ScalarRange range_of(const BisectOptions& options, const model::Problem& problem,
                            const std::string& name) {
  model::check_scalar_name(*problem.method, name, {"--largest, --smallest"});
  if (!options.range.empty())
    return {name,
            parse_expression(options.range[0], "--in"),
            parse_expression(options.range[1], "--in"),
            {"--in"}};
  if (problem.search && problem.search->extreme && problem.search->extreme->name == name)
    return *problem.search->extreme;
  for (const model::ScalarRange& range : problem.negotiable)
    if (range.name == name) return range;
  if (name == model::kGainBound) return range_of_gain_bound(problem);
  throw InputError({options.problem}, "no range for " + name + "; give --in LOW HIGH");
}

bool is_named(const BisectOptions& options) {
  return !options.largest.empty() || !options.smallest.empty();
}

/// Adds the range that is bisected to what the problem is asked.
void add_range(const BisectOptions& options, model::Problem& problem) {
  const bool named = is_named(options);
  const auto& search = problem.search;
  if (!named && !(search && search->extreme))
    throw InputError({options.problem},
                     "nothing to bisect: give --largest NAME or --smallest NAME, or write "
                     "search: {largest: {NAME: [low, high]}} into the problem");
  const std::string name = !named                     ? search->extreme->name
                           : options.smallest.empty() ? options.largest
                                                      : options.smallest;
  for (const model::Setting& setting : problem.settings)
    if (setting.name == name)
      throw InputError({"--set " + name}, "a scalar that is bisected has no value of its own");
  problem.questions.ranges = {range_of(options, problem, name)};
  if (!named) return;
  model::Search stated = search.value_or(model::Search{});
  stated.extreme = problem.questions.ranges.front();
  stated.largest = options.smallest.empty();
  state_search(stated, problem);
}

/// What the command line asks for, or else the problem.
design::BisectChoices choices_of(const BisectOptions& options, const model::Instance& instance) {
  const auto& search = instance.design->search;
  design::BisectChoices choices;
  choices.largest = is_named(options) ? options.smallest.empty() : search->largest;
  choices.scalar = design::searched_scalar(instance, instance.design->asked.front());
  std::optional<double> width = options.tolerance;
  if (!width && search) width = search->tolerance;
  choices.tolerance = design::tolerance_of(width, choices.scalar.axis);
  return choices;
}

/// What is infeasible for a hull only is undecided.
std::string answer_of(const search::Sample& sample, const design::BisectResult& result) {
  return result.limits.contains(sample.value) ? "undecided" : word_of(sample.answer);
}

io::Json json_of(const design::BisectResult& result, const design::BisectChoices& choices) {
  io::Json samples = io::Json::array();
  for (const search::Sample& sample : result.found.samples)
    samples.push_back({{"value", sample.value}, {"answer", answer_of(sample, result)}});
  return {{"scalar", choices.scalar.name},
          {"goal", choices.largest ? "largest" : "smallest"},
          {"tolerance", choices.tolerance.width},
          {"relative", choices.tolerance.relative},
          {"samples", samples},
          {"result", json_without_statement(result.gains)}};
}

std::string table(const design::BisectResult& result, const std::string& name) {
  std::string text = fmt::format("{:<20}{}\n", name, "feasible");
  for (const search::Sample& sample : result.found.samples) {
    const auto limits = result.limits.find(sample.value);
    text += fmt::format("{:<20}{}{}\n", brief(sample.value, 12), answer_of(sample, result),
                        limits == result.limits.end() ? "" : ", infeasible" + limits->second);
  }
  return text;
}

/// What the smallest bound on the gains leaves of the objective; empty for other questions.
std::string objective_note(const BisectOptions& options, const model::Instance& instance,
                           const design::BisectChoices& choices, const model::Gains& gains) {
  constexpr double kWider = 2, kNear = 1.01, kFar = 10, kTells = 0.01;
  if (choices.scalar.name != model::kGainBound || choices.largest || !gains.objective ||
      gains.verdict != model::Verdict::yes)
    return "";
  const double bound = gains.searched.at(model::kGainBound);
  model::Overrides overrides = instance.overrides;
  overrides[model::kGainBound] = kWider * bound;
  try {
    const model::Gains wider =
        design::synthesize(bind::evaluate(instance.design, overrides), {}, design::Depth::verdict);
    if (!wider.objective || wider.verdict != model::Verdict::yes ||
        std::abs(*gains.objective - *wider.objective) <= kTells * std::abs(*gains.objective))
      return "";
    return fmt::format(
        "note        the smallest bound leaves little to the objective: it is {} here, {} at twice "
        "the bound\n"
        "try         gainsmith scan {} --over gain_bound={}:{}:9:log\n",
        brief(*gains.objective), brief(*wider.objective),
        model::problem_words(options.problem, instance.design->statement.settings),
        brief(kNear * bound, 3), brief(kFar * bound, 3));
  } catch (const Stopped&) {
    return "";
  }
}

/// The campaigns of values that have gains, by value.
class Campaigns {
 public:
  /// `name`: of the scalar.
  Campaigns(const model::Instance& own, std::string name) : own_(&own), name_(std::move(name)) {}

  search::Answer operator()(const model::Gains& gains) {
    const model::Instance instance = bind::evaluate(own_->design, gains.searched);
    const auto setup = verify::make_setup(instance, gains);
    const verify::Report report = verify::run_campaign(*setup);
    check_stop();
    lines_[gains.searched.at(name_)] = campaign_line(campaign_record(report, ""));
    switch (report.verdict) {
      case model::CampaignVerdict::held:
        return search::Answer::yes;
      case model::CampaignVerdict::violated:
        return search::Answer::no;
      case model::CampaignVerdict::undecided:
        break;
    }
    return search::Answer::undecided;
  }

  /// What the campaigns say at both ends of the bracket.
  std::string text(const search::Bisection& found) const {
    std::string text;
    for (const std::optional<double>& end : {found.yes, found.no}) {
      const auto line = end ? lines_.find(*end) : lines_.end();
      if (line != lines_.end())
        text += fmt::format("{:<12}{} = {}: {}\n", text.empty() ? "claims" : "", name_,
                            brief(line->first, 9), line->second);
    }
    return text;
  }

 private:
  const model::Instance* own_;
  std::string name_;
  std::map<double, std::string> lines_;
};

ExitCode bisect(const BisectOptions& options) {
  check_picture_name(options.plot);
  prepare_outputs(options.problem, {options.output, options.plot});
  check_positive(options.tolerance, "--tolerance");
  const model::Instance instance = load_problem(
      options.problem, options.set, [&](model::Problem& problem) { add_range(options, problem); });
  design::BisectChoices choices = choices_of(options, instance);
  Campaigns campaigns(instance, choices.scalar.name);
  if (options.claims) {
    refuse_without_campaign(*instance.design, options.problem);
    choices.also = std::ref(campaigns);
  }
  const design::BisectResult result = design::bisect(instance, {}, choices, {});
  const Telling telling;
  const std::string name = with_unit(*instance.design, choices.scalar.name);
  if (!options.plot.empty())
    write_picture(options.plot, bisect_figure(instance.design->name, name, result.found, choices));
  const std::string report = options.json
                                 ? io::to_text(json_of(result, choices))
                                 : table(result, name) + "\n" + synthesis_summary(result.gains) +
                                       campaigns.text(result.found) +
                                       objective_note(options, instance, choices, result.gains) +
                                       held_line(instance, {choices.scalar.name});
  write_result(result.gains, options.output, report, options.json);
  return exit_of_search(result.gains);
}

}  // namespace

Command bisect_command() {
  auto options = std::make_shared<BisectOptions>();
  return {
      "bisect",
      "Find the largest or smallest value of a scalar for which there are gains",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       set_option(options->set),
       Option("--largest", options->largest,
              "this scalar (default: what the problem's search says)"),
       Option("--smallest", options->smallest, "this scalar").excludes({"--largest"}),
       Option("--in", options->range, "LOW HIGH: the range (default: the problem's)").values(2),
       Option("--tolerance", options->tolerance,
              "width of the final bracket (default: the problem's, or 1e-4 of the range; of the "
              "value on a logarithmic scale)"),
       Option("--claims", options->claims,
              "a value counts as feasible only if the claims of its gains hold in the campaign"),
       Option("-o,--output", options->output,
              "write the gains of the feasible end here; - for standard output"),
       Option("--plot", options->plot,
              "draw the values that were tried and the bracket here (.svg, .pdf, .png)"),
       Option("--json", options->json, "print the result as JSON")},
      "Both ends of the bracket are checked: gains whose recomputed margins hold, and a\n"
      "certificate that excludes others. The other scalars keep the problem's values.\n"
      "Values that the assumptions exclude are 'refused'.\n"
      "The scalar 'gain_bound' is the bound on the gains (its range: a thousand times less to "
      "more).\n"
      "Exit code: 0 a feasible value was found, 2 wrong input, 3 none was found (which says\n"
      "nothing of the values between those tried).\n"
      "Examples:\n"
      "  gainsmith bisect problem.yaml --largest T2 --in 0.5 1.1 --tolerance 1e-5 -o gains.json\n"
      "  gainsmith bisect problem.yaml --smallest k --in 0 10 --claims\n"
      "  gainsmith bisect problem.yaml --smallest rho --in 0.05 1 --json | jq .samples",
      [options] { return bisect(*options); }};
}

}  // namespace gainsmith::app
