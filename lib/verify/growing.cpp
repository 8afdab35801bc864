#include "verify/growing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "base/number.h"
#include "hybrid/affine.h"
#include "hybrid/state_layout.h"
#include "numbers/dense.h"

namespace gainsmith::verify {

namespace {

using Assignments = std::vector<const model::Dynamics::Assignment*>;

/// The maps of all components at the only event; none: a map is not one assignment a state.
std::optional<Assignments> jump_of(const model::Dynamics& dynamics) {
  Assignments all;
  for (const model::Dynamics::Reaction& reaction : dynamics.reactions) {
    if (reaction.passes.size() != 1 || reaction.passes[0].repeats) return std::nullopt;
    for (const auto& one : reaction.passes[0].map) all.push_back(&one);
  }
  return all;
}

/// The elements of what the claims read, and what these depend on.
std::vector<Eigen::Index> elements_read(const claims::RunSetup& setup,
                                        const Assignments& equations) {
  const hybrid::System& system = setup.system;
  std::set<std::string> names;
  const auto add = [&](const expr::Program& program) {
    for (const expr::Input& input : program.inputs) names.insert(input.name);
  };
  for (const expr::Program& function : setup.functions) add(function);
  for (std::size_t before = 0; before != names.size();) {
    before = names.size();
    for (const auto* one : equations)
      if (names.contains(system.layout.slots[one->variable].name)) add(one->value.program);
  }
  std::vector<Eigen::Index> elements;
  for (const hybrid::Slot& slot : system.layout.slots)
    for (Eigen::Index k = 0; names.contains(slot.name) && k < slot.shape.size(); ++k)
      elements.push_back(slot.offset + k);
  return elements;
}

/// The slopes of the elements by each other; `kept`: of what has no equation. Empty where an
/// equation of them is not affine.
numbers::Matrix slopes(const hybrid::System& system, const Assignments& equations,
                       const std::vector<Eigen::Index>& elements, double kept) {
  const Eigen::Index size = system.layout.size;
  numbers::Matrix whole = kept * numbers::Matrix::Identity(size, size);
  const auto moves = [&](const std::string& name) { return !system.constants.contains(name); };
  for (const auto* one : equations) {
    const hybrid::Slot& slot = system.layout.slots[one->variable];
    if (std::ranges::find(elements, slot.offset) == elements.end()) continue;
    if (hybrid::first_not_affine(one->value.program, moves) != nullptr) return {};
    hybrid::PointFunction function(one->value.program, system.layout, system.constants);
    const auto at = [&](const Eigen::VectorXd& x) {
      return numbers::Vector(function(x, 0).reshaped());
    };
    const numbers::Vector center = at(Eigen::VectorXd::Zero(size));
    for (const Eigen::Index j : elements)
      whole.block(slot.offset, j, center.size(), 1) = at(Eigen::VectorXd::Unit(size, j)) - center;
  }
  return whole(elements, elements);
}

}  // namespace

std::string growing_mode(const claims::RunSetup& setup) {
  const hybrid::System& system = setup.system;
  const model::Dynamics& dynamics = system.dynamics;
  const auto jump = jump_of(dynamics);
  if (!jump || (!jump->empty() && dynamics.events.size() != 1)) return "";
  Assignments flow, all = *jump;
  for (const auto& one : dynamics.flow) flow.push_back(&one);
  all.insert(all.end(), flow.begin(), flow.end());
  const auto elements = elements_read(setup, all);
  numbers::Matrix M = slopes(system, flow, elements, 0);
  if (!jump->empty()) {
    if (!flow.empty() && !system.clocks[0]) return "";
    const double length = flow.empty() ? 0 : system.clocks[0]->high;
    const numbers::Matrix J = slopes(system, *jump, elements, 1);
    if (J.size() != M.size()) return "";
    M = J * numbers::exponential(length * M);
  }
  if (M.size() == 0 || !M.allFinite()) return "";
  const auto growth = [&](std::complex<double> lambda) {
    return jump->empty() ? lambda.real() : std::abs(lambda) - 1;
  };
  const numbers::ComplexVector all_modes = numbers::eigenvalues(M);
  const std::complex<double> most = *std::ranges::max_element(all_modes, {}, growth);
  // An eigenvalue of a Jordan block is known to the root of rounding.
  if (!(growth(most) > 1e-6 * M.cwiseAbs().maxCoeff())) return "";
  std::string text = brief(most.real(), 4);
  if (most.imag() != 0) text += " +- " + brief(std::abs(most.imag()), 4) + "i";
  return "the closed loop grows: its eigenvalue " + text +
         (jump->empty() ? " has a positive real part"
                        : ", of one period, lies outside the unit circle");
}

}  // namespace gainsmith::verify
