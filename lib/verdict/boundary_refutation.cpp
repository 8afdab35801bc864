#include "verdict/boundary_refutation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "verdict/boundary_pair.h"
#include "verdict/wide_algebra.h"

namespace gainsmith::verdict {

namespace {

/// x_0 > 0, whose multiplier is v.
ExactBlock<Decimal100> block_of_constant() { return {1, {{0, {{0, 0, Decimal100(1), 0}}}}}; }

Decimal100 wide_number(const std::vector<double>& values, const std::vector<double>& rest,
                       std::size_t at) {
  return Decimal100(values[at]) + Decimal100(rest.empty() ? 0 : rest[at]);
}

/// The solution x beside its multipliers, both as far as the solver knew them.
BoundaryPair pair_of(const lmi::Lmi& lmi, const lmi::Formulation& formulation,
                     const sdp::Solution& solution) {
  BoundaryPair pair;
  const std::size_t size = solution.x.size();
  pair.x.push_back(formulation.homogenised ? wide_number(solution.x, solution.rest.x, size - 2)
                                           : Decimal100(0));
  for (std::size_t i = 0; i < static_cast<std::size_t>(lmi.unknowns); ++i)
    pair.x.push_back(wide_number(solution.x, solution.rest.x, i));
  pair.Y = wide_multipliers_of(formulation, lmi.blocks.size(), solution);
  if (formulation.homogenised) {
    const std::size_t k = formulation.sizes.size();
    pair.Y.push_back(Wide::Constant(1, 1, Decimal100(solution.Y.values[k][0])));
  }
  return pair;
}

/// Adds the coefficient -I of s, the unknown i: B(x) becomes B(x) - s I.
void add_identity(int i, ExactBlock<Decimal100>& block) {
  ExactElements<Decimal100> elements;
  for (int r = 0; r < block.size; ++r) elements.push_back({r, r, Decimal100(-1), 0});
  if (!elements.empty()) block.terms.emplace_back(i, std::move(elements));
}

/// In units in which no unknown is above 1, and tr Y = 1.
BoundaryPair violated_pair_of(const lmi::Lmi& lmi, const lmi::Formulation& formulation,
                              const sdp::Solution& solution) {
  BoundaryPair pair;
  pair.violated = true;
  double unit = 1;
  for (const double x : solution.x) unit = std::max(unit, std::abs(x));
  pair.x.push_back(Decimal100(1) / unit);
  for (const double x : solution.x) pair.x.push_back(Decimal100(x) / unit);
  pair.Y = wide_multipliers_of(formulation, lmi.blocks.size(), solution);
  Decimal100 whole(0);
  for (const Wide& Y : pair.Y) whole += Y.trace();
  for (Wide& Y : pair.Y) Y /= whole;
  return pair;
}

}  // namespace

Refutation refute_on_boundary(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                              const lmi::Formulation& formulation, const sdp::Solution& solution) {
  const auto blocks = exact_blocks<Decimal100>(of, lmi, formulation);
  const ExactBlock<Decimal100> constant = block_of_constant();
  std::vector<const ExactBlock<Decimal100>*> all;
  for (const auto& block : blocks) all.push_back(&block);
  if (formulation.homogenised) all.push_back(&constant);
  BoundaryPair pair = pair_of(lmi, formulation, solution);
  if (!refine(all, pair)) return {};
  pair.Y.resize(blocks.size());
  return refute<Decimal100>(lmi, blocks, std::move(pair.Y), Exactness::in_double);
}

namespace {

/// Multipliers of the least violation of blocks with a constant part, without a residual; none
/// where they do not settle.
std::optional<std::vector<Wide>> violation_of(std::vector<ExactBlock<Decimal100>> blocks,
                                              int unknowns, BoundaryPair pair) {
  std::vector<const ExactBlock<Decimal100>*> all;
  for (auto& block : blocks) {
    add_identity(unknowns + 1, block);
    all.push_back(&block);
  }
  if (!refine(all, pair)) return std::nullopt;
  return std::move(pair.Y);
}

/// Multipliers of the scaled inequalities become those of the homogeneous ones (lmi/scale.h): the
/// diagonal element of Y at c x_q gets -r_q/c = v/|c| more, so that r_q = 0. False where v < 0, or
/// the element was not solved.
bool close(const std::vector<ExactBlock<Decimal100>>& blocks, const lmi::Scale& scale,
           const std::vector<int>& kept, std::vector<Wide>& Y) {
  const auto row = std::find(kept.begin(), kept.end(), scale.row);
  if (row == kept.end()) return false;
  const auto at = row - kept.begin();
  Decimal100 r(0), c(0);
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for (const auto& [i, elements] : blocks[k].terms) {
      if (i != scale.unknown) continue;
      for (const auto& e : elements) {
        r += e.mid * Y[k](e.row, e.column);
        if (k == scale.block && e.row == at && e.column == at) c = e.mid;
      }
    }
  if (c == 0) return false;
  const Decimal100 added = -r / c;
  if (added < 0) return false;
  Y[scale.block](at, at) += added;
  return true;
}

}  // namespace

Refutation refute_by_violation(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                               const lmi::Formulation& formulation, const sdp::Solution& solution) {
  const auto blocks = exact_blocks<Decimal100>(of, lmi, formulation);
  auto Y = violation_of(blocks, lmi.unknowns, violated_pair_of(lmi, formulation, solution));
  return Y ? refute<Decimal100>(lmi, blocks, std::move(*Y), Exactness::in_double) : Refutation{};
}

Refutation refute_by_violation(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                               const lmi::Scale& scale, const lmi::Formulation& formulation,
                               const sdp::Solution& solution) {
  lmi::Formulation stated;
  stated.balance = formulation.balance;
  // The balance of the scaled inequalities, with unit 1 for the unknown that was fixed.
  stated.balance.unknowns.insert(stated.balance.unknowns.begin() + scale.unknown - 1, 0);
  stated.free_variables = formulation.free_variables;
  const auto blocks = exact_blocks<Decimal100>(of, lmi, stated);
  auto with_constants = blocks;
  for (auto& block : with_constants)
    for (auto& [i, elements] : block.terms) {
      i = scaled_number(i, scale);
      if (i != 0 || scale.sign > 0) continue;
      for (auto& e : elements) e.mid = -e.mid;
    }
  auto Y = violation_of(std::move(with_constants), lmi.unknowns - 1,
                        violated_pair_of(lmi, formulation, solution));
  if (!Y || !close(blocks, scale, formulation.free_variables.kept[scale.block], *Y)) return {};
  return refute<Decimal100>(lmi, blocks, std::move(*Y), Exactness::in_double);
}

}  // namespace gainsmith::verdict
