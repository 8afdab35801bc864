// What the careful runs of one problem share.
//
// A claim is judged by its own values along a run. The integral of a flow cost is a variable beside
// those of the plant and the observers.
//
// This room turns runs into verdicts on claims, and into figures, each with an error:
//
//   claims, claim_check       the claims, and one claim against the samples of one run
//   run_setup, run_tracks     what runs share; two runs as samples with error bounds
//   sample_points, smooth_parts, run_values   where a value is sampled, and its series on a step
//   text_ball, parting        errors of evaluation and of branches; where two runs have parted
//   twin_parts, twin_runs     the parts of two runs beside each other
//   event_doubts, independence   events that errors leave open, and which commute
//   run_costs, run_figures    costs and figures along the dense output
//
// The verdict has three values. `held` and `violated` need the error bound on their side; anything
// else is `undecided`. The bounds are estimates from two runs, and no proofs.
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
