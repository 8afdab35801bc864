#include "verify/setup.h"

#include <algorithm>
#include <utility>

#include "bind/exact_values.h"
#include "bind/stated.h"
#include "verify/coordinate_states.h"
#include "verify/error_states.h"

namespace gainsmith::verify {

namespace {

/// The programs of the claims that are stated.
std::vector<expr::Program> functions_of(const std::vector<claims::Claim>& claims) {
  std::vector<expr::Program> functions;
  for (const claims::Claim& claim : claims)
    if (claim.stated())
      for (expr::Program& program : claims::programs_of(claim))
        functions.push_back(std::move(program));
  return functions;
}

/// None when the dynamics or a claim are of another kind.
std::unique_ptr<const LinearSetup> make_linear_setup(const model::Instance& instance,
                                                     const model::Gains& gains,
                                                     const hybrid::System& dynamics,
                                                     const std::vector<expr::Program>& functions) {
  auto setup = std::make_unique<LinearSetup>();
  setup->system = linear::make_sampled_system(dynamics);
  if (!setup->system || !std::ranges::all_of(functions, [&](const expr::Program& program) {
        return linear::has_wide_value(program, setup->system->layout);
      }))
    return nullptr;
  setup->coordinates = linear::make_coordinates(
      *setup->system, bind::exact_values(instance, dynamics.constants, gains), functions);
  return setup;
}

}  // namespace

/// Coordinates of linear dynamics first; of others errors as states.
std::unique_ptr<const Setup> make_setup(const model::Instance& instance, const model::Gains& gains,
                                        const std::vector<hybrid::GivenRun>* given) {
  auto setup = std::make_unique<Setup>();
  setup->unread = bind::unread_names(*instance.design);
  setup->events = claims::make_run_setup(bind::run_texts(instance, gains), given);
  const std::vector<expr::Program> functions = functions_of(setup->events->claims);
  setup->linear = make_linear_setup(instance, gains, setup->events->system, functions);
  auto texts = setup->linear
                   ? std::optional(with_coordinates(
                         setup->events->texts, setup->linear->coordinates, setup->events->claims))
                   : with_error_states(setup->events->texts, functions);
  if (texts) setup->errors = claims::make_run_setup(std::move(*texts), given);
  return setup;
}

}  // namespace gainsmith::verify
