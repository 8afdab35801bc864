#include "verify/growing.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "base/number.h"
#include "hybrid/affine.h"
#include "numbers/dense/dense.h"

namespace gainsmith::verify {

namespace {

using Assignments = std::vector<const model::Dynamics::Assignment*>;

/// The maps of all components at the only event, which always happens; none: of another kind.
std::optional<Assignments> jump_of(const model::Dynamics& dynamics) {
  Assignments all;
  for (const model::Dynamics::Reaction& reaction : dynamics.reactions) {
    const model::Dynamics::Event& event = dynamics.events[reaction.event];
    if (dynamics.events.size() != 1 || reaction.passes.size() != 1 || reaction.passes[0].repeats ||
        event.only_if || event.lost > 0 || event.kind != model::Dynamics::EventKind::every)
      return std::nullopt;
    for (const auto& one : reaction.passes[0].map) all.push_back(&one);
  }
  return all;
}

/// The slopes of all variables by each other; `kept`: of those without an equation. Empty where an
/// equation is not affine, or reads more than states and noise.
numbers::Matrix slopes(const hybrid::System& system, const Assignments& equations, double kept) {
  const Eigen::Index size = system.layout.size;
  numbers::Matrix whole = kept * numbers::Matrix::Identity(size, size);
  const auto moves = [&](const std::string& name) { return !system.constants.contains(name); };
  for (const auto* equation : equations) {
    const bool other = std::ranges::any_of(equation->value.program.inputs, [&](const auto& input) {
      const auto slot = system.slot(input.name);
      if (!slot) return false;
      if (*slot >= system.dynamics.variables.size()) return true;
      using Kind = model::Dynamics::VariableKind;
      const Kind kind = system.dynamics.variables[*slot].kind;
      return kind != Kind::state && kind != Kind::noise;
    });
    if (other || hybrid::first_not_affine(equation->value.program, moves) != nullptr) return {};
    hybrid::PointFunction function(equation->value.program, system.layout, system.constants);
    const auto at = [&](const Eigen::VectorXd& x) {
      return numbers::Vector(function(x, 0).reshaped());
    };
    const numbers::Vector center = at(Eigen::VectorXd::Zero(size));
    for (Eigen::Index j = 0; j < size; ++j)
      whole.block(system.layout.slots[equation->variable].offset, j, center.size(), 1) =
          at(Eigen::VectorXd::Unit(size, j)) - center;
  }
  return whole;
}

/// Whether the value of the claim differs along the mode of M, at two points.
bool is_seen(const claims::RunSetup& setup, const claims::Claim& claim, const numbers::Matrix& M,
             std::complex<double> lambda) {
  const Eigen::Index n = M.rows();
  numbers::Matrix whole(2 * n, 2 * n);
  const numbers::Matrix I = numbers::Matrix::Identity(n, n), real = M - lambda.real() * I;
  // The real form of M - lambda I; its null vector is [Re v; Im v].
  whole << real, lambda.imag() * I, -lambda.imag() * I, real;
  const numbers::Vector v = numbers::full_svd(whole).V.col(2 * n - 1);
  hybrid::PointFunction value(claim.value, setup.system.layout, setup.system.constants);
  const auto at = [&](const Eigen::VectorXd& x) { return value(x, 0)(0, 0); };
  for (const double k : {1.0, 2.0}) {
    // Two points without symmetries: from k to 3 - k^2.
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, k, 3 - k * k);
    for (const numbers::Vector& part : {v.head(n).eval(), v.tail(n).eval()})
      if (std::abs(at(x + part) - at(x)) > 1e-6 * std::abs(at(x))) return true;
  }
  return false;
}

}  // namespace

std::string growing_mode(const claims::RunSetup& setup, const claims::Claim& claim) {
  const hybrid::System& system = setup.system;
  const model::Dynamics& dynamics = system.dynamics;
  const auto jump = jump_of(dynamics);
  const bool frozen = std::ranges::any_of(dynamics.components,
                                          [](const auto& one) { return one.frozen.has_value(); });
  if (!jump || frozen || !claim.stated() || claim.kind == model::ClaimKind::above) return "";
  Assignments flow;
  for (const auto& one : dynamics.flow) flow.push_back(&one);
  numbers::Matrix M = slopes(system, flow, 0);
  if (!jump->empty()) {
    const auto& clock = system.clocks[0];
    const numbers::Matrix J = slopes(system, *jump, 1);
    if (!clock || clock->low != clock->high || clock->high > setup.scenario.horizon / 2 ||
        J.size() != M.size())
      return "";
    // From just after a jump to just after the next one.
    M = J * numbers::exponential(clock->high * M);
  }
  if (M.size() == 0 || !M.allFinite()) return "";
  const auto growth = [&](std::complex<double> lambda) {
    return jump->empty() ? lambda.real() : std::abs(lambda) - 1;
  };
  std::optional<std::complex<double>> most;
  try {
    // An eigenvalue of a Jordan block is known to the root of rounding.
    for (const std::complex<double> lambda : numbers::eigenvalues(M))
      if (growth(lambda) > 1e-6 * M.cwiseAbs().maxCoeff() &&
          (!most || growth(lambda) > growth(*most)) && is_seen(setup, claim, M, lambda))
        most = lambda;
  } catch (const expr::EvaluationError&) {
  }
  if (!most) return "";
  return "the closed loop grows: its eigenvalue " + brief(most->real(), 4) +
         (most->imag() == 0 ? "" : " +- " + brief(std::abs(most->imag()), 4) + "i") +
         (jump->empty() ? " has a positive real part"
                        : ", of one period, lies outside the unit circle");
}

}  // namespace gainsmith::verify
