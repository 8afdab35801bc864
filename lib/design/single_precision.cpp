#include "design/single_precision.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/number.h"
#include "bind/stated.h"
#include "design/fixed_gains.h"
#include "design/synthesize.h"
#include "model/dynamics_programs.h"

namespace gainsmith::design {

namespace {

/// Rounds a matrix, and keeps the exact decimals under its key.
void round(numbers::Matrix& matrix, const std::string& key, model::Gains& gains) {
  constexpr int kAllDigits = 160;  // more than a number of single precision has
  std::vector<std::string> decimals;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const auto single = static_cast<float>(matrix(i, j));
      if (!std::isfinite(single))
        throw InputError({gains.file}, key + ": " + brief(matrix(i, j)) +
                                           " is beyond the range of single precision");
      matrix(i, j) = static_cast<double>(single);
      decimals.push_back(brief(matrix(i, j), kAllDigits));
    }
  gains.decimals[key] = std::move(decimals);
}

}  // namespace

model::Gains rounded_to_single(const model::Instance& instance, const model::Gains& gains) {
  model::Gains rounded = gains;
  std::set<std::string> read, moving;
  const model::Stated stated = bind::state(instance, gains);
  const auto& dynamics = instance.design->dynamics;
  if (dynamics)
    model::for_each_program(*dynamics, [&](const expr::Program& program) {
      for (const expr::Input& input : stated.bodies.link(program).inputs) moving.insert(input.name);
    });
  for (auto& [name, matrix] : rounded.gains)
    if (!dynamics || moving.contains(name)) round(matrix, "gains." + name, rounded);
  for (model::GainFunction& gain : rounded.gain_functions) {
    for (std::size_t k = 0; k < gain.coefficients.size(); ++k)
      round(gain.coefficients[k], model::coefficient_key(gain.name, k), rounded);
    if (!gain.coefficients.empty()) continue;
    const expr::Program program = stated.bodies.link(stated.bodies.body(gain.name, {}).program);
    for (const expr::Input& input : program.inputs) read.insert(input.name);
  }
  for (auto& [name, matrix] : rounded.unknowns)
    if (read.contains(name)) round(matrix, "unknowns." + name, rounded);
  return rounded;
}

namespace {

/// Keys of `synthesis`.
constexpr const char *kMargin = "margin", *kGainBound = "gain_bound";

/// The values to try, in this order.
std::vector<SinglePrecisionRemedy> candidates(const model::Design& design,
                                              const model::Gains& gains) {
  std::vector<SinglePrecisionRemedy> list;
  // Without an objective the margin is the largest already.
  if (design.objective)
    for (const double margin : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2})
      if (margin > design.synthesis.margin) list.push_back({kMargin, margin, {}});
  double reached = 0;
  for (const model::GainBound& bound : gains.bounds) reached = std::max(reached, bound.reached);
  // Of the largest gain: smaller gains lose less to rounding.
  for (const double part : {0.5, 0.1})
    if (reached > 0) {
      const auto value = parse_decimal(brief(part * reached, 2));
      list.push_back({kGainBound, value.value(), {}});
    }
  return list;
}

void apply(const SinglePrecisionRemedy& remedy, model::SynthesisOptions& synthesis) {
  if (remedy.name == kMargin) {
    synthesis.margin = remedy.value;
    return;
  }
  synthesis.gain_bounds.clear();
  synthesis.set_gain_bound(remedy.value);
}

}  // namespace

std::optional<SinglePrecisionRemedy> remedy_at_single(const model::Instance& instance,
                                                      const model::Gains& gains,
                                                      const sdp::Options& options) {
  if (gains.search) return std::nullopt;
  for (SinglePrecisionRemedy& remedy : candidates(*instance.design, gains)) {
    const model::Instance changed = model::with_design(
        instance, [&](model::Design& design) { apply(remedy, design.synthesis); });
    const model::Gains solved = synthesize(changed, options);
    if (solved.verdict != model::Verdict::yes) continue;
    const model::Gains single = rounded_to_single(changed, solved);
    if (check_gains(changed, single, options).verdict != model::Verdict::yes) continue;
    remedy.objective = solved.objective;
    return remedy;
  }
  return std::nullopt;
}

}  // namespace gainsmith::design
