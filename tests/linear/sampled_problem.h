// A TextProblem as sampled dynamics, for the tests of bounded.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bind/stated.h"
#include "linear/bounded_run.h"
#include "linear/sampled_system.h"
#include "hybrid/exact_values.h"
#include "support/text_problem.h"

namespace gainsmith::linear {

/// What the runs of a problem share. At an address of its own.
struct SampledProblem {
  explicit SampledProblem(const tests::TextProblem& problem)
      : instance(problem.instance()),
        texts(bind::run_texts(instance, problem.gains)),
        dynamics(hybrid::make_system(texts.dynamics, texts.stated.values)),
        made(make_sampled_system(dynamics)),
        scenario(hybrid::make_scenario(texts.campaign, dynamics)),
        values(hybrid::exact_values(instance, dynamics.constants, problem.gains)) {
    if (made && made->flow) steps.emplace(*made->flow, made->longest, made->flow_place);
  }
  SampledProblem(const SampledProblem&) = delete;
  SampledProblem& operator=(const SampledProblem&) = delete;

  const SampledSystem& system() const {
    if (!made) throw std::logic_error("not sampled");
    return *made;
  }

  /// The states themselves as coordinates.
  Coordinates states() const {
    std::vector<expr::Program> functions;
    for (const hybrid::Slot& slot : made->layout.slots) {
      expr::Composer compose({});
      functions.push_back(compose.take(compose.input(slot.name, slot.shape)));
    }
    return make_coordinates(*made, values, functions);
  }

  model::Instance instance;
  model::RunTexts texts;
  hybrid::System dynamics;
  std::unique_ptr<const SampledSystem> made;
  hybrid::Scenario scenario;
  numbers::ValuesOf<Decimal100> values;
  std::optional<FlowSteps> steps;  ///< of an affine flow
};

}  // namespace gainsmith::linear
