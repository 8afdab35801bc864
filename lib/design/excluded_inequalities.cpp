#include "design/excluded_inequalities.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "design/elastic.h"
#include "design/limits.h"
#include "design/synthesize.h"

namespace gainsmith::design {

namespace {

/// Whether a scalar of the request is in what the inequalities of the design are made of.
bool is_changed(const model::Design& design, const SearchRequest& request) {
  const std::vector<std::string> used = scalars_in_use(design);
  const auto uses = [&](const SearchedScalar& scalar) {
    return std::ranges::find(used, scalar.name) != used.end();
  };
  return std::ranges::any_of(request.over, uses) || (request.extreme && uses(*request.extreme));
}

}  // namespace

model::Instance with_necessary(const model::Instance& instance) {
  return with_design(without_objective(instance), [](model::Design& design) {
    const auto append = [](auto& list, auto& more) {
      list.insert(list.end(), more.begin(), more.end());
      more.clear();
    };
    append(design.unknowns, design.necessary.unknowns);
    append(design.inequalities, design.necessary.inequalities);
    design.search.reset();
    design.open.clear();
    design.negotiable.clear();
  });
}

std::optional<Excluded> excluded_inequalities(const model::Instance& instance,
                                              const SearchRequest& request,
                                              const sdp::Options& solver) {
  const model::Instance all = with_necessary(instance);
  std::set<std::string> fixed;
  for (const auto& inequality : all.design->inequalities)
    if (!inequality.calls_functions() &&
        !is_changed(*with_inequalities(all, {inequality.name}).design, request))
      fixed.insert(inequality.name);
  if (fixed.empty()) return std::nullopt;
  const model::Instance rest = with_inequalities(all, fixed);
  try {
    model::Gains gains = synthesize(rest, solver);
    if (gains.verdict == model::Verdict::no && gains.certificate->is_about_problem())
      return Excluded{rest, std::move(gains)};
  } catch (const InputError&) {
    // Without what a scalar changes, 0 may be a solution, or a formula has no value here.
    if (!instance.design->necessary.inequalities.empty()) throw;
  }
  return std::nullopt;
}

}  // namespace gainsmith::design
