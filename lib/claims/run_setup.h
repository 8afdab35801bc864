// What the careful runs of one problem share.
//
// A claim is judged by its own values along a run. The integral of a flow cost is a variable beside
// those of the plant and the observers.
#pragma once

#include <memory>
#include <vector>

#include "claims/claim_check.h"
#include "claims/claims.h"
#include "claims/run_costs.h"
#include "claims/run_values.h"
#include "claims/sample_points.h"
#include "claims/text_ball.h"
#include "claims/tolerances.h"
#include "model/run_texts.h"
#include "simulate/simulator.h"

namespace gainsmith::claims {

struct RunSetup {
  model::RunTexts texts;
  hybrid::System system;
  hybrid::StateLayout layout;  ///< of the variables: without branches that flows hold
  hybrid::Scenario scenario;
  std::vector<Claim> claims;
  std::vector<expr::Program> functions;  ///< of the claims that are stated
  std::vector<int> first_of_claim;       ///< of each function: the value of its claim
  std::vector<bool> at_ends;   ///< of each function: claims ask for it where a run starts and ends
  std::vector<RunCost> costs;  ///< of the claims that are stated
  numbers::EnclosedValues<double> constants;  ///< of the functions, with their errors
  std::vector<JudgedClaim> judged;            ///< the claims that are stated, in order
  SamplePoints sample_points;                 ///< that the claims ask for

  /// Whether runs may be made in 31 digits (simulate/state_31.h).
  bool has_31_digits() const { return simulate::State31::may_run(system, scenario); }
  /// To what a run is integrated: as the campaign asks, otherwise to `usual`; times a factor.
  simulate::Accuracy accuracy(double usual, double factor = 1) const;
};

/// At an address of its own: its parts point to each other. InputError for what does not fit.
/// `given`: runs whose draws are given (hybrid/given_run.h); they must outlive the setup.
std::unique_ptr<const RunSetup> make_run_setup(
    model::RunTexts texts, const std::vector<hybrid::GivenRun>* given = nullptr);

}  // namespace gainsmith::claims
