// A TextProblem as sampled dynamics, for the tests of linear.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bind/exact_values.h"
#include "bind/stated.h"
#include "linear/coordinates.h"
#include "linear/polynomial.h"
#include "linear/sampled_system.h"
#include "support/text_problem.h"

namespace gainsmith::linear {

/// What the runs of a problem share. At an address of its own.
struct SampledProblem {
  explicit SampledProblem(const tests::TextProblem& problem)
      : instance(problem.instance()),
        texts(bind::run_texts(instance, problem.gains)),
        dynamics(hybrid::make_system(texts.dynamics, texts.stated.values)),
        made(make_sampled_system(dynamics)),
        values(bind::exact_values(instance, dynamics.constants, problem.gains)) {}
  SampledProblem(const SampledProblem&) = delete;
  SampledProblem& operator=(const SampledProblem&) = delete;

  const SampledSystem& system() const {
    if (!made) throw std::logic_error("not sampled");
    return *made;
  }

  /// The states themselves as coordinates.
  Coordinates states() const {
    std::vector<expr::Program> functions;
    for (const hybrid::Slot& slot : system().layout.slots)
      functions.push_back(input_program(slot.name, slot.shape));
    return make_coordinates(*made, values, functions);
  }

  model::Instance instance;
  model::RunTexts texts;
  hybrid::System dynamics;
  std::unique_ptr<const SampledSystem> made;
  numbers::ValuesOf<Decimal100> values;
};

}  // namespace gainsmith::linear
