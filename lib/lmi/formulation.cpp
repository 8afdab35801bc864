#include "lmi/formulation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/scalars.h"
#include "lmi/assembler.h"
#include "lmi/correlation.h"

namespace gainsmith::lmi {

namespace {

/// The blocks of the Lmi and then those of the bounds; both must outlive the list.
std::vector<const Block*> all_blocks(const Lmi& lmi, const GainBounds& bounds) {
  std::vector<const Block*> blocks;
  for (const auto* list : {&lmi.blocks, &bounds.blocks})
    for (const Block& block : *list) blocks.push_back(&block);
  return blocks;
}

bool is_homogeneous(const Lmi& lmi, const GainBounds& bounds) {
  return is_homogeneous(lmi.blocks) && is_homogeneous(bounds.blocks);
}

/// The rows that stay, of the blocks and then of the bounds.
std::vector<std::vector<int>> rows_of(const FreeVariables& free_variables,
                                      const GainBounds& bounds) {
  std::vector<std::vector<int>> rows = free_variables.kept;
  for (const Block& block : bounds.blocks) rows.push_back(all_rows(block));
  return rows;
}

/// The rows that stay of S_k M S_k.
numbers::Matrix in_units(const numbers::Matrix& whole, const Balance& balance, std::size_t k,
                         const std::vector<int>& rows) {
  numbers::Matrix value = whole(rows, rows);
  for (Eigen::Index c = 0; c < value.cols(); ++c)
    for (Eigen::Index r = 0; r < value.rows(); ++r)
      value(r, c) *= balance.row(k, rows[static_cast<std::size_t>(r)]) *
                     balance.row(k, rows[static_cast<std::size_t>(c)]);
  return value;
}

/// The number of rows that stay in each block.
std::vector<int> sizes_of(const FreeVariables& free_variables, const GainBounds& bounds) {
  std::vector<int> sizes;
  for (const auto& kept : free_variables.kept) sizes.push_back(static_cast<int>(kept.size()));
  for (const Block& block : bounds.blocks) sizes.push_back(block.size);
  return sizes;
}

/// 2^k with which the largest cost is in [1, 2): tolerances of the objective are relative to 1 and
/// its size, whatever its unit.
double cost_unit_of(const Lmi& lmi, const Balance& balance) {
  double largest = 0;
  for (int i = 1; lmi.has_objective && i <= lmi.unknowns; ++i)
    largest = std::max(largest,
                       std::abs(lmi.objective[static_cast<std::size_t>(i) - 1]) * balance.unit(i));
  return largest > 0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1;
}

/// N - sum_k tr(D_k^-1 B_k(x)) - x_0 / D_0 >= 0.
void add_trace_limit(const std::vector<BalancedBlock>& blocks, const Round& round, int constant,
                     int rows, Assembler& assembler) {
  const int limit = assembler.add_block(1, true);
  assembler.add_entry(0, limit, 0, 0, rows);
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for (const BalancedBlock::Element& e : blocks[k].elements) {
      if (e.row != e.column) continue;
      const double d = round.diagonals.empty() ? 1 : round.diagonals[k][e.row];
      assembler.add_entry(e.unknown == 0 ? constant : e.unknown, limit, 0, 0, -e.value / d);
    }
  if (constant > 0) assembler.add_entry(constant, limit, 0, 0, -1 / round.constant);
}

}  // namespace

bool has_minimum(const Lmi& lmi, const GainBounds& bounds) {
  return lmi.has_objective && !is_homogeneous(lmi, bounds);
}

Formulation pose_objective(const Lmi& lmi, const GainBounds& bounds, double shift) {
  Formulation result;
  result.shift = shift;
  result.variables = lmi.unknowns + bounds.scalars;
  result.balance = balance(all_blocks(lmi, bounds), result.variables, lmi.objective);
  result.free_variables = find_free_variables(lmi, bounds.blocks, true);
  result.sizes = sizes_of(result.free_variables, bounds);
  result.cost_unit = cost_unit_of(lmi, result.balance);
  return result;
}

Formulation pose_interior(const Lmi& lmi, const GainBounds& bounds) {
  Formulation result;
  result.goal = Goal::interior;
  result.homogenised = !is_homogeneous(lmi, bounds);
  const int own = lmi.unknowns + bounds.scalars;
  result.variables = own + (result.homogenised ? 2 : 1);
  result.balance = balance(all_blocks(lmi, bounds), own, {});
  result.free_variables = find_free_variables(lmi, bounds.blocks, false);
  result.sizes = sizes_of(result.free_variables, bounds);
  result.rows =
      std::accumulate(result.sizes.begin(), result.sizes.end(), 0) + (result.homogenised ? 1 : 0);
  return result;
}

namespace {

/// In y_i = x_i / d_i:  minimise cost_unit sum_i c_i d_i y_i + weight sum_k tr(B_k)
///   subject to  S_k B_k S_k >= shift I  (blocks of the Lmi),  >= 0  (bounds).
void assemble_objective(const Lmi& lmi, const std::vector<const Block*>& blocks,
                        const std::vector<std::vector<int>>& rows, Formulation& result) {
  Assembler assembler(result.variables);
  std::vector<double> traces(static_cast<std::size_t>(result.variables) + 1, 0.0);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    result.blocks.push_back(balanced(*blocks[k], result.balance, k, rows[k]));
    for (const BalancedBlock::Element& e : result.blocks[k].elements)
      if (k < lmi.blocks.size() && e.row == e.column)
        traces[static_cast<std::size_t>(e.unknown)] += e.value;
    const int added = assembler.add(result.blocks[k], 0, 1);
    const bool shifted = k < lmi.blocks.size() && (blocks[k]->strict || !result.only_strict);
    for (int r = 0; shifted && r < result.blocks[k].size; ++r)
      assembler.add_entry(0, added, r, r, -result.shift);
  }
  for (int i = 1; lmi.has_objective && i <= lmi.unknowns; ++i)
    assembler.set_cost(i, lmi.objective[static_cast<std::size_t>(i) - 1] * result.balance.unit(i) *
                                  result.cost_unit +
                              result.weight * traces[static_cast<std::size_t>(i)]);
  result.problem = assembler.take();
}

/// The program of Goal::interior. t multiplies the diagonals of the blocks by 1 - t.
void assemble_interior(const std::vector<const Block*>& blocks,
                       const std::vector<std::vector<int>>& rows, const Round& round,
                       const Exactly& exactly, Formulation& result) {
  const int margin = result.variables;
  const int constant = result.homogenised ? margin - 1 : 0;
  Assembler assembler(margin);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    result.blocks.push_back(exactly ? exactly(k, result.balance, rows[k])
                                    : balanced(*blocks[k], result.balance, k, rows[k]));
    // A block without rows keeps its place.
    const int added = result.blocks[k].size == 0
                          ? assembler.add_block(1, true)
                          : assembler.add(result.blocks[k], constant, 1 - round.margin);
    for (int r = 0; r < result.blocks[k].size; ++r)
      assembler.add_entry(margin, added, r, r,
                          round.diagonals.empty() ? -1 : -round.diagonals[k][r]);
  }
  if (result.homogenised) {
    const int added = assembler.add_block(1, true);
    assembler.add_entry(constant, added, 0, 0, 1 - round.margin);
    assembler.add_entry(margin, added, 0, 0, -round.constant);
  }
  add_trace_limit(result.blocks, round, constant, result.rows, assembler);
  assembler.set_cost(margin, -1);
  result.problem = assembler.take();
}

}  // namespace

void assemble(const Lmi& lmi, const GainBounds& bounds, const Round& round,
              Formulation& formulation, const Exactly& exactly) {
  const auto blocks = all_blocks(lmi, bounds);
  const auto rows = rows_of(formulation.free_variables, bounds);
  formulation.blocks.clear();
  if (formulation.goal == Goal::objective)
    assemble_objective(lmi, blocks, rows, formulation);
  else
    assemble_interior(blocks, rows, round, exactly, formulation);
}

Formulation formulate_objective(const Lmi& lmi, const GainBounds& bounds, double shift) {
  Formulation result = pose_objective(lmi, bounds, shift);
  assemble(lmi, bounds, {}, result);
  return result;
}

Formulation formulate_interior(const Lmi& lmi, const GainBounds& bounds, const Round& round,
                               const Exactly& exactly) {
  Formulation result = pose_interior(lmi, bounds);
  assemble(lmi, bounds, round, result, exactly);
  return result;
}

Formulation formulate_violation(const Lmi& lmi) {
  Formulation result = pose_interior(lmi, {});
  const auto blocks = all_blocks(lmi, {});
  const int margin = lmi.unknowns + 1;
  result.homogenised = false;
  result.variables = margin;
  result.rows = std::accumulate(result.sizes.begin(), result.sizes.end(), 0);
  Assembler assembler(margin);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    result.blocks.push_back(balanced(*blocks[k], result.balance, k, result.free_variables.kept[k]));
    // A block without rows keeps its place.
    const int added = result.blocks[k].size == 0 ? assembler.add_block(1, true)
                                                 : assembler.add(result.blocks[k], 0, 1);
    for (int r = 0; r < std::max(1, result.blocks[k].size); ++r)
      assembler.add_entry(margin, added, r, r, -1);
  }
  assembler.set_cost(margin, -1);
  result.problem = assembler.take();
  return result;
}

// The last variable is s.
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
  restore(lmi, formulation.free_variables, formulation.balance, x);
  return x;
}

// t = min_k correlation_margin(B_k(x)), D_k = diag(B_k(x)) in balanced units, D_0 = x_0.
std::optional<Round> next_round(const Lmi& lmi, const GainBounds& bounds,
                                const Formulation& formulation, const std::vector<double>& x) {
  Round round;
  round.margin = 1;
  round.constant = formulation.homogenised ? x[x.size() - 2] : 1;
  if (!(round.constant > 0)) return std::nullopt;
  const auto blocks = all_blocks(lmi, bounds);
  const auto rows = rows_of(formulation.free_variables, bounds);
  std::vector<double> in_given_units = x;
  for (std::size_t i = 0; i < formulation.balance.unknowns.size(); ++i)
    in_given_units[i] *= formulation.balance.unit(static_cast<int>(i) + 1);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const numbers::Matrix value = formulation.blocks.empty()
                                      ? in_units(blocks[k]->value(in_given_units, round.constant),
                                                 formulation.balance, k, rows[k])
                                      : value_of(formulation.blocks[k], x, round.constant);
    const double found = correlation_margin(value);
    if (!(found > 0)) return std::nullopt;
    round.margin = std::min(round.margin, found);
    round.diagonals.push_back(value.diagonal());
  }
  return round;
}

Formulation in_units_of_solution(const Lmi& lmi, const GainBounds& bounds,
                                 const Formulation& formulation, const std::vector<double>& x) {
  const auto blocks = all_blocks(lmi, bounds);
  const auto rows = rows_of(formulation.free_variables, bounds);
  Formulation result = formulation;
  result.problem = {};
  result.blocks.clear();
  Balance& balance = result.balance;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    // s_r^2 sum_i |x_i B_ki[r, r]| is brought to about 1.
    std::vector<double> sizes(rows[k].size(), 0.0);
    for_each_balanced(*blocks[k], formulation.balance, k, rows[k],
                      [&](int i, int row, int column, double value) {
                        const double times = i == 0 ? 1 : x[static_cast<std::size_t>(i) - 1];
                        if (row == column)
                          sizes[static_cast<std::size_t>(row)] += std::abs(value * times);
                      });
    for (std::size_t r = 0; r < sizes.size(); ++r)
      if (sizes[r] > 0 && std::isfinite(sizes[r]))
        balance.rows[k][static_cast<std::size_t>(rows[k][r])] -= std::ilogb(sizes[r]) / 2;
  }
  std::vector<double> largest(balance.unknowns.size(), 0.0);
  std::fill(balance.unknowns.begin(), balance.unknowns.end(), 0);
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for_each_balanced(*blocks[k], balance, k, rows[k], [&](int i, int, int, double value) {
      if (i == 0) return;
      double& own = largest[static_cast<std::size_t>(i) - 1];
      own = std::max(own, std::abs(value));
    });
  for (std::size_t i = 0; i < largest.size(); ++i)
    balance.unknowns[i] =
        largest[i] > 0 ? -std::ilogb(largest[i]) : formulation.balance.unknowns[i];
  result.cost_unit = cost_unit_of(lmi, balance);
  return result;
}

bool is_narrow_bracket(double low, double high, const Formulation& formulation) {
  return high - low <= 1e-6 * std::abs(high) ||
         std::max(-low, std::abs(high)) <= 1e-8 / formulation.cost_unit;
}

double objective_lower_bound(const Lmi& lmi, const GainBounds& bounds,
                             const Formulation& formulation, const sdp::Solution& solution) {
  // How much larger than the solution an x may be for which the bound holds: |x_i|, and the trace.
  constexpr double kLike = 2, kLikeTrace = 30;
  constexpr double kRounding = 3e-16;  // of the coefficients, which represent decimals
  // c'x >= r_0 + r'x - w sum_k tr(B_k(x))  with the weight w, c_0 = 0 and
  // r_i = c_i + w sum_k tr(B_ki) - sum_k <B_ki, Y_k>, i = 0 the constant part.
  double trace = 0;
  std::vector<DoubleDouble> r(solution.x.size() + 1, DoubleDouble(0));
  std::vector<double> sizes(r.size(), 0.0);
  const auto add = [&](int i, double factor, double times = 1) {
    r[static_cast<std::size_t>(i)] += DoubleDouble(factor) * DoubleDouble(times);
    sizes[static_cast<std::size_t>(i)] += std::abs(factor * times);
  };
  for (int i = 1; i <= lmi.unknowns; ++i)
    add(i, lmi.objective[static_cast<std::size_t>(i) - 1] * formulation.balance.unit(i) *
               formulation.cost_unit);
  const auto blocks = all_blocks(lmi, bounds);
  const auto rows = rows_of(formulation.free_variables, bounds);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const std::size_t n = rows[k].size();
    const auto& Y = solution.Y.values[k];
    for_each_balanced(
        *blocks[k], formulation.balance, k, rows[k], [&](int i, int row, int column, double value) {
          add(i, -(row == column ? 1 : 2) * value,
              Y[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)]);
          if (row != column || k >= lmi.blocks.size() || formulation.weight == 0) return;
          trace += value * (i == 0 ? 1 : solution.x[static_cast<std::size_t>(i) - 1]);
          add(i, formulation.weight, value);
        });
  }
  double bound = as<double>(r[0]) - kRounding * sizes[0] - kLikeTrace * formulation.weight * trace;
  for (std::size_t i = 1; i < r.size(); ++i)
    bound -=
        (std::abs(as<double>(r[i])) + kRounding * sizes[i]) * kLike * std::abs(solution.x[i - 1]);
  return bound / formulation.cost_unit + lmi.objective_constant;
}

// <S B S, Y> = <B, S Y S>.
numbers::Matrix in_data_units(const Lmi& lmi, const GainBounds& bounds,
                              const Formulation& formulation, std::size_t k,
                              const Eigen::Ref<const numbers::Matrix>& y) {
  // The multiplier of a row that was left out is zero.
  const bool own = k < lmi.blocks.size();
  const Block& block = own ? lmi.blocks[k] : bounds.blocks[k - lmi.blocks.size()];
  const std::vector<int> kept = own ? formulation.free_variables.kept[k] : all_rows(block);
  numbers::Matrix whole = numbers::Matrix::Zero(block.size, block.size);
  for (Eigen::Index i = 0; i < y.rows(); ++i)
    for (Eigen::Index j = 0; j < y.cols(); ++j) {
      const int r = kept[static_cast<std::size_t>(i)];
      const int c = kept[static_cast<std::size_t>(j)];
      whole(r, c) = y(i, j) * formulation.balance.row(k, r) * formulation.balance.row(k, c);
    }
  return whole;
}

std::vector<numbers::Matrix> multipliers(const Lmi& lmi, const GainBounds& bounds,
                                         const Formulation& formulation,
                                         const sdp::Solution& solution) {
  std::vector<numbers::Matrix> result;
  for (std::size_t k = 0;
       k < solution.Y.values.size() && k < lmi.blocks.size() + bounds.blocks.size(); ++k) {
    const int n = formulation.sizes[k];
    result.push_back(
        in_data_units(lmi, bounds, formulation, k,
                      Eigen::Map<const numbers::Matrix>(solution.Y.values[k].data(), n, n)));
  }
  return result;
}

std::vector<double> multiplier_sizes(const Lmi& lmi, const Formulation& formulation,
                                     const sdp::Solution& solution, const std::string& inequality,
                                     std::size_t points) {
  std::vector<double> sizes(points, 0.0);
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const Block& block = lmi.blocks[k];
    if (!model::is_comparison_of(block.name, inequality)) continue;
    const std::size_t n = formulation.free_variables.kept[k].size();
    for (std::size_t i = 0; i < n; ++i) sizes.at(block.at) += solution.Y.values[k][i * n + i];
  }
  return sizes;
}

}  // namespace gainsmith::lmi
