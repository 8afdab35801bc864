// The order of binding, and the values that it depends on.
#include "bind/bind.h"

#include <filesystem>
#include <utility>

#include "bind/binding.h"
#include "bind/campaign.h"
#include "bind/claims.h"
#include "bind/data.h"
#include "bind/gains.h"
#include "bind/inequalities.h"
#include "bind/observer_families.h"
#include "bind/search.h"
#include "bind/shown.h"
#include "bind/simulation.h"
#include "bind/stated.h"
#include "bind/system_figures.h"
#include "expr/text/work.h"
#include "model/gains.h"

namespace gainsmith::bind {

double Recorder::number(const expr::Program& program) const {
  return numbers::evaluate(program, values)(0, 0);
}

/// A rank of the same matrix and tolerance is computed once.
int Recorder::rank(const expr::Program& matrix, const expr::Program* tolerance) const {
  for (const model::Design::Rank& known : ranks)
    if (is_same(known.matrix, matrix) && known.tolerance.has_value() == (tolerance != nullptr) &&
        (tolerance == nullptr || is_same(*known.tolerance, *tolerance)))
      return known.rank;
  const int found = numbers::KnownDoubles(values).rank(matrix, tolerance);
  ranks.push_back({matrix, tolerance ? std::optional(*tolerance) : std::nullopt, found});
  return found;
}

/// Each call notes what it found, with the programs that it was found for.
std::vector<int> Recorder::units(const expr::Program& A, const expr::Program& C) const {
  units_found.push_back({A, C, numbers::KnownDoubles(values).units(A, C)});
  return units_found.back().exponents;
}

/// The matrices are noted with their values: other values may have another gain.
std::vector<double> Recorder::output_gain(const expr::Program& A, const expr::Program& B,
                                          const expr::Program& C, bool discrete) const {
  for (const expr::Program* matrix : {&A, &B, &C})
    plants.push_back({*matrix, numbers::evaluate(*matrix, values)});
  return numbers::KnownDoubles(values).output_gain(A, B, C, discrete);
}

Binding::Binding(std::shared_ptr<const model::Problem> problem, const model::Overrides& overriding,
                 Checks checking)
    : source(std::move(problem)),
      overrides(overriding),
      checks(checking),
      design(std::make_shared<model::Design>()),
      names(std::make_shared<Names>()),
      recorder(std::make_shared<Recorder>()) {
  design->name = source->name;
  design->file = source->file;
  design->method = method().name;
  design->method_file = method().file;
  design->method_place = source->method_place;
  design->synthesis = source->synthesis;
  design->source = source;
  design->statement = {method().name,
                       method().text,
                       std::filesystem::path(source->file).filename().string(),
                       source->text,
                       "",
                       source->settings,
                       source->files};
  design->statement.hash = statement_hash(design->statement);
  names->known.known = recorder;
  names->known.read = std::make_shared<std::set<std::string>>();
}

namespace {

/// Data come first, as all shapes follow from them. Claims and figures come after the dynamics
/// whose signals they read. Variables of events that nothing reads are dropped at last.
model::Instance bound(Binding binding) {
  expr::count_design();
  bind_data(binding);
  bind_observer_families(binding);
  bind_inequalities(binding);
  bind_gains(binding);
  bind_components(binding);
  bind_search(binding);
  bind_claims(binding);
  bind_campaign(binding);
  bind_expectation(binding);
  bind_comparison(binding);
  bind_system_figures(binding);
  check_shown(binding);
  finish_dynamics(binding);
  binding.design->ranks = binding.recorder->ranks;
  binding.design->units = binding.recorder->units_found;
  binding.design->plants = binding.recorder->plants;
  const auto read = std::move(binding.names->known.read);
  for (expr::Scope* scope : {&binding.names->known, &binding.names->design, &binding.names->running,
                             &binding.names->results})
    scope->read = nullptr;
  binding.names->unread = unread_names(binding, *read);
  binding.design->names = binding.names;
  override_gain_bound(*binding.design, binding.overrides, binding.recorder->values);
  return {binding.design, binding.overrides, binding.recorder->values};
}

}  // namespace

model::Instance bind(std::shared_ptr<const model::Problem> problem,
                     const model::Overrides& overrides) {
  return bound({std::move(problem), overrides, Checks::all});
}

model::Instance bind(const model::Problem& problem, const model::Overrides& overrides) {
  return bind(std::make_shared<const model::Problem>(problem), overrides);
}

const std::vector<std::string>& unread_names(const model::Design& design) {
  return design.names->unread;
}

/// All texts anew, without the checks of ranges.
model::Instance bind_again(const model::Design& design, const model::Overrides& overrides) {
  return bound({design.source, overrides, Checks::none});
}

}  // namespace gainsmith::bind
