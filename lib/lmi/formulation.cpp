#include "lmi/formulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lmi/assembler.h"
#include "lmi/correlation.h"

namespace gainsmith::lmi {

namespace {

std::vector<const Block*> all_blocks(const Lmi& lmi, const GainBounds& bounds) {
  std::vector<const Block*> blocks;
  for (const auto* list : {&lmi.blocks, &bounds.blocks})
    for (const Block& block : *list) blocks.push_back(&block);
  return blocks;
}

bool is_homogeneous(const Lmi& lmi, const GainBounds& bounds) {
  return is_homogeneous(lmi.blocks) && is_homogeneous(bounds.blocks);
}

/// S B(x) S in balanced units, at the variables y of the program; the constant part times `one`.
numbers::Matrix balanced_value(const Block& block, std::size_t at, const Balance& balance,
                               const std::vector<double>& y, double one) {
  numbers::Matrix value = numbers::Matrix::Zero(block.size, block.size);
  for (const auto& [i, matrix] : block.terms) {
    const double x = i == 0 ? one : y[static_cast<std::size_t>(i) - 1] * balance.unit(i);
    add_multiple(value, x, matrix);
  }
  for (int r = 0; r < block.size; ++r) {
    value.row(r) *= balance.row(at, r);
    value.col(r) *= balance.row(at, r);
  }
  return value;
}

/// N - sum_k tr(D_k^-1 B_k(x)) - x_0 / D_0 >= 0.
void add_trace_limit(const std::vector<const Block*>& blocks, const Balance& balance,
                     const Round& round, int constant, int rows, Assembler& assembler) {
  const int limit = assembler.add_block(1, true);
  assembler.add_entry(0, limit, 0, 0, rows);
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for (const auto& [i, matrix] : blocks[k]->terms)
      for (int r = 0; r < blocks[k]->size; ++r) {
        const double d = round.diagonals.empty() ? 1 : round.diagonals[k][r];
        assembler.add_entry(i == 0 ? constant : i, limit, 0, 0,
                            -matrix.coeff(r, r) * balance.factor(k, r, r, i) / d);
      }
  if (constant > 0) assembler.add_entry(constant, limit, 0, 0, -1 / round.constant);
}

}  // namespace

bool has_minimum(const Lmi& lmi, const GainBounds& bounds) {
  return lmi.has_objective && !is_homogeneous(lmi, bounds);
}

Formulation formulate_objective(const Lmi& lmi, const GainBounds& bounds, double shift) {
  Formulation result;
  result.shift = shift;
  const auto blocks = all_blocks(lmi, bounds);
  const int variables = lmi.unknowns + bounds.scalars;
  result.balance = balance(blocks, variables, lmi.objective);
  std::vector<const Block*> bound_blocks;
  for (const Block& block : bounds.blocks) bound_blocks.push_back(&block);
  result.releases = find_releases(lmi, bound_blocks);
  Assembler assembler(variables, result.balance);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const bool own = k < lmi.blocks.size();
    const auto& kept = own ? result.releases.kept[k] : all_rows(*blocks[k]);
    const int added = assembler.add(*blocks[k], k, kept, 0, 1);
    if (own && blocks[k]->strict)
      for (int r = 0; r < static_cast<int>(kept.size()); ++r)
        assembler.add_entry(0, added, r, r, -shift);
  }
  for (int i = 1; lmi.has_objective && i <= lmi.unknowns; ++i)
    assembler.set_cost(i, lmi.objective[static_cast<std::size_t>(i) - 1] * result.balance.unit(i));
  result.problem = assembler.take();
  return result;
}

Formulation formulate_interior(const Lmi& lmi, const GainBounds& bounds, const Round& round) {
  Formulation result;
  result.goal = Goal::interior;
  result.homogenised = !is_homogeneous(lmi, bounds);
  const auto blocks = all_blocks(lmi, bounds);
  const int own = lmi.unknowns + bounds.scalars;
  const int constant = result.homogenised ? own + 1 : 0;
  const int margin = own + (result.homogenised ? 2 : 1);
  result.balance = balance(blocks, own, {});
  Assembler assembler(margin, result.balance);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const int added =
        assembler.add(*blocks[k], k, all_rows(*blocks[k]), constant, 1 - round.margin);
    for (int r = 0; r < blocks[k]->size; ++r)
      assembler.add_entry(margin, added, r, r,
                          round.diagonals.empty() ? -1 : -round.diagonals[k][r]);
    result.rows += blocks[k]->size;
  }
  if (result.homogenised) {
    const int added = assembler.add_block(1, true);
    assembler.add_entry(constant, added, 0, 0, 1 - round.margin);
    assembler.add_entry(margin, added, 0, 0, -round.constant);
    ++result.rows;
  }
  add_trace_limit(blocks, result.balance, round, constant, result.rows, assembler);
  assembler.set_cost(margin, -1);
  result.problem = assembler.take();
  return result;
}

double interior_margin(const sdp::Solution& solution) { return solution.x.back(); }

std::vector<double> read_back(const Lmi& lmi, const Formulation& formulation,
                              const sdp::Solution& solution) {
  const bool homogenised = formulation.homogenised;
  const double one = homogenised ? solution.x[solution.x.size() - 2] : 1;
  std::vector<double> x = solution.x;
  x.resize(static_cast<std::size_t>(lmi.unknowns));
  for (int i = 1; i <= lmi.unknowns; ++i) {
    double& value = x[static_cast<std::size_t>(i) - 1];
    value = value / one * formulation.balance.unit(i);
  }
  if (formulation.goal == Goal::objective) restore(lmi, formulation.releases, formulation.balance, x);
  return x;
}

std::optional<Round> next_round(const Lmi& lmi, const GainBounds& bounds,
                                const Formulation& formulation, const sdp::Solution& solution) {
  const auto blocks = all_blocks(lmi, bounds);
  const double one = formulation.homogenised ? solution.x[solution.x.size() - 2] : 1;
  Round round;
  round.margin = 1;
  round.constant = one;
  if (!(one > 0)) return std::nullopt;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const numbers::Matrix value =
        balanced_value(*blocks[k], k, formulation.balance, solution.x, one);
    const double found = correlation_margin(value);
    if (!(found > 0)) return std::nullopt;
    round.margin = std::min(round.margin, found);
    round.diagonals.push_back(value.diagonal());
  }
  return round;
}

double objective_lower_bound(const Lmi& lmi, const Formulation& formulation,
                             const sdp::Solution& solution) {
  // F_0 holds the shifts on the diagonals: take them out again.
  double bound = solution.dual_objective + lmi.objective_constant;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    if (!lmi.blocks[k].strict) continue;
    const std::size_t n = formulation.releases.kept[k].size();
    for (std::size_t i = 0; i < n; ++i)
      bound -= formulation.shift * solution.Y.values[k][i * n + i];
  }
  return bound;
}

std::vector<numbers::Matrix> multipliers(const Lmi& lmi, const GainBounds& bounds,
                                         const Formulation& formulation,
                                         const sdp::Solution& solution) {
  const auto blocks = all_blocks(lmi, bounds);
  std::vector<numbers::Matrix> result;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    // The multiplier of a row that was left out is zero.
    const bool some = formulation.goal == Goal::objective && k < lmi.blocks.size();
    const std::vector<int> kept = some ? formulation.releases.kept[k] : all_rows(*blocks[k]);
    const auto n = static_cast<Eigen::Index>(kept.size());
    const Eigen::Map<const numbers::Matrix> y(solution.Y.values[k].data(), n, n);
    numbers::Matrix whole = numbers::Matrix::Zero(blocks[k]->size, blocks[k]->size);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const int r = kept[static_cast<std::size_t>(i)];
        const int c = kept[static_cast<std::size_t>(j)];
        whole(r, c) = y(i, j) * formulation.balance.row(k, r) * formulation.balance.row(k, c);
      }
    result.push_back(std::move(whole));
  }
  return result;
}

std::vector<double> multiplier_sizes(const Lmi& lmi, const Formulation& formulation,
                                     const sdp::Solution& solution, const std::string& inequality,
                                     std::size_t points) {
  std::vector<double> sizes(points, 0.0);
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const Block& block = lmi.blocks[k];
    if (block.name != inequality && !block.name.starts_with(inequality + ".")) continue;
    const std::size_t n = formulation.goal == Goal::objective ? formulation.releases.kept[k].size()
                                                              : static_cast<std::size_t>(block.size);
    for (std::size_t i = 0; i < n; ++i) sizes.at(block.at) += solution.Y.values[k][i * n + i];
  }
  return sizes;
}

}  // namespace gainsmith::lmi
