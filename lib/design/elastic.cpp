#include "design/elastic.h"

#include "design/sos_statements.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/number.h"
#include "design/synthesize.h"
#include "lmi/formulation.h"

namespace gainsmith::design {

namespace {

using model::Design;

/// No name of a person ends in two of these, so no slack shadows one.
std::string slack_name(const Design::Inequality& inequality) {
  return "slack_" + inequality.name + "__";
}

std::vector<std::string> decimals(const std::vector<double>& values, double factor = 1) {
  std::vector<std::string> result;
  for (const double value : values) result.push_back(decimal17(factor * value));
  return result;
}

/// One inequality for each comparison of the chain, its larger side raised by the slack.
void add_relaxed(const Design::Inequality& inequality, const std::string& slack,
                 const std::vector<double>& scale, std::vector<Design::Inequality>& out) {
  for (const Design::Comparison& comparison : inequality.comparisons) {
    Design::Inequality one = inequality;
    one.name = comparison.name;
    one.comparisons = {{comparison.name,
                        expr::with_diagonal(comparison.difference, decimals(scale), slack),
                        comparison.strict}};
    out.push_back(std::move(one));
  }
}

/// a < b becomes a + diag(scale) < b.
/// Only of strict comparisons.
Design::Inequality demanding(Design::Inequality inequality, const std::vector<double>& scale) {
  for (Design::Comparison& comparison : inequality.comparisons)
    if (comparison.strict)
      comparison.difference = expr::with_diagonal(comparison.difference, decimals(scale, -1));
  return inequality;
}

/// slack >= 0.
Design::Inequality not_negative(const std::string& slack, const Design::Inequality& of) {
  expr::Composer compose({of.place.file});
  const expr::Program program = compose.take(compose.input(slack));
  return {slack, {}, {{slack, program, false}}, of.place, of.place};
}

/// names_1 + names_2 + ... as an objective.
model::Formula sum_of(const std::vector<std::string>& names, const std::string& file) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
  const Place place{file, 1, 1};
  return {expr::combination(std::vector<expr::Program>(names.size()), names, {}, place), place,
          text};
}

}  // namespace

model::Instance without_gains(const model::Instance& instance) {
  return with_design(instance, [](Design& design) {
    design.gains.clear();
    design.search.reset();
    design.negotiable.clear();
    design.expect.reset();
  });
}

model::Instance without_objective(const model::Instance& instance) {
  return with_design(instance, [](Design& design) {
    design.objective.reset();
    design.quotient.reset();
  });
}

model::Instance with_objective_below(const model::Instance& instance, double value) {
  const model::Formula& objective = *instance.design->objective;
  expr::Composer compose(objective.place);
  // value - c'x >= 0.
  const int difference =
      compose.apply(expr::Op::subtract,
                    {compose.number(decimal17(value)), compose.program(objective.program)}, {1, 1});
  const std::string name = objective.text + " <= " + brief(value, 10);
  const expr::Program program = compose.take(difference);
  return with_design(without_objective(without_gains(instance)), [&](Design& design) {
    design.inequalities.push_back(
        {name, {}, {{name, program, false}}, objective.place, objective.place});
  });
}

model::Instance with_inequalities(const model::Instance& instance,
                                  const std::set<std::string>& names) {
  return with_design(instance, [&](Design& design) {
    std::erase_if(design.inequalities, [&](const Design::Inequality& inequality) {
      return !names.contains(inequality.name);
    });
  });
}

Diagonals row_scales_of(const model::Instance& instance) {
  Diagonals scales;
  if (has_sums_of_squares(*instance.design)) {
    for (const Design::Inequality& inequality : instance.design->inequalities)
      scales[inequality.name] = {1};
    return scales;
  }
  const lmi::Inequalities inequalities(instance);
  const lmi::Lmi lmi = lmi::compile(inequalities);
  const lmi::Balance balance = lmi::pose_objective(lmi, {}, 0).balance;
  for (const Design::Inequality& inequality : instance.design->inequalities) {
    std::vector<double>& rows = scales[inequality.name];
    for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
      if (!model::is_comparison_of(lmi.blocks[k].name, inequality.name)) continue;
      rows.resize(static_cast<std::size_t>(lmi.blocks[k].size));
      for (std::size_t r = 0; r < rows.size(); ++r)
        rows[r] = std::max(rows[r], std::pow(balance.row(k, static_cast<int>(r)), -2));
    }
  }
  return scales;
}

ByInequality scales_of(const model::Instance& instance) {
  ByInequality scales;
  for (const auto& [name, rows] : row_scales_of(instance))
    scales[name] = rows.empty() ? 0 : *std::max_element(rows.begin(), rows.end());
  return scales;
}

model::Instance elastic(const model::Instance& instance, const Diagonals& scales,
                        std::map<std::string, std::string>& slacks) {
  // Without constant parts every solution may be scaled, and every slack with it.
  const bool scaled = !has_sums_of_squares(*instance.design) &&
                      lmi::is_homogeneous(lmi::compile(lmi::Inequalities(instance)).blocks);
  const Diagonals demands = scaled ? row_scales_of(instance) : Diagonals{};
  return with_design(instance, [&](Design& design) {
    std::vector<Design::Inequality> relaxed;
    std::vector<std::string> names;
    for (const Design::Inequality& stated : design.inequalities) {
      const Design::Inequality inequality =
          scaled ? demanding(stated, demands.at(stated.name)) : stated;
      const auto scale = scales.find(inequality.name);
      if (scale == scales.end()) {
        relaxed.push_back(inequality);
        continue;
      }
      const std::string slack = slack_name(inequality);
      slacks[inequality.name] = slack;
      names.push_back(slack);
      Design::Unknown unknown;
      unknown.name = slack;
      unknown.structure = model::Structure::scalar;
      unknown.place = inequality.place;
      design.unknowns.push_back(std::move(unknown));
      add_relaxed(inequality, slack, scale->second, relaxed);
      relaxed.push_back(not_negative(slack, inequality));
    }
    design.inequalities = std::move(relaxed);
    design.quotient.reset();
    design.objective = sum_of(names, design.method_file);
  });
}

Slacks smallest_slacks(const model::Instance& instance, const ByInequality& scales,
                       const sdp::Options& solver) {
  constexpr double kNone = 1e-7;  // what the shift of a minimum and its tolerance leave
  std::map<std::string, std::string> names;
  Diagonals multiples;
  for (const auto& [name, scale] : scales) multiples[name] = {scale};
  const model::Gains gains = synthesize(elastic(instance, multiples, names), solver);
  Slacks slacks{gains.verdict, gains.solver.status == "optimal", {}};
  if (gains.verdict != model::Verdict::yes) return slacks;
  for (const auto& [inequality, slack] : names) {
    const double value = (*gains.find(slack))(0, 0);
    slacks.by_inequality[inequality] = value > kNone ? value : 0;
  }
  return slacks;
}

std::optional<double> estimated_violation(const model::Instance& instance, const Diagonals& scales,
                                          const sdp::Options& solver) {
  constexpr double kNear = 1e-4;  // of the objectives
  if (has_sums_of_squares(*instance.design)) return std::nullopt;
  std::map<std::string, std::string> names;
  const model::Instance relaxed = elastic(instance, scales, names);
  const lmi::Inequalities inequalities(relaxed);
  const lmi::Lmi lmi = lmi::compile(inequalities);
  const lmi::Formulation formulation =
      lmi::formulate_objective(lmi, {}, inequalities.design().synthesis.margin);
  sdp::Options narrow = solver;
  narrow.precision = "double";
  const sdp::Solution solution = sdp::solve(formulation.problem, narrow);
  if (!(std::abs(solution.relative_gap) <= kNear)) return std::nullopt;
  const double sum = lmi.objective_at(lmi::read_back(lmi, formulation, solution));
  if (!std::isfinite(sum)) return std::nullopt;
  return std::max(sum, 0.0);
}

}  // namespace gainsmith::design
