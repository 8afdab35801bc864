#include "lmi/formulation.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace gainsmith::lmi {

namespace {

/// On unknowns when nothing else bounds them, relative to the size that the data set.
constexpr double kLimit = 1e6;

/// kappa; 1 when no block has constant data.
double data_size(const Lmi& lmi) {
  double kappa = std::numeric_limits<double>::infinity();
  for (const Block& block : lmi.blocks)
    if (block.constant_size > 0 && block.coefficient_size > 0)
      kappa = std::min(kappa, block.constant_size / block.coefficient_size);
  return kappa == std::numeric_limits<double>::infinity() ? 1 : kappa;
}

std::vector<double> scales_of(const Lmi& lmi, bool homogeneous) {
  const double kappa = data_size(lmi);
  std::vector<double> scales;
  for (const Block& block : lmi.blocks) {
    const double scale = homogeneous
                             ? block.coefficient_size
                             : std::max(block.constant_size, kappa * block.coefficient_size);
    scales.push_back(scale > 0 ? scale : 1);
  }
  // The points of one inequality share the largest scale among them, so that it has one margin.
  for (std::size_t first = 0; first < scales.size();) {
    std::size_t end = first;
    while (end < scales.size() && lmi.blocks[end].name == lmi.blocks[first].name) ++end;
    const auto from = scales.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = scales.begin() + static_cast<std::ptrdiff_t>(end);
    std::fill(from, to, *std::max_element(from, to));
    first = end;
  }
  return scales;
}

/// Fills an SDP in the SDPA form X = sum x_i F_i - F_0 from blocks B(x) = B_0 + sum x_i B_i >=
/// shift, all constants divided by `unit`.
class Assembler {
 public:
  Assembler(int variables, double unit) : unit_(unit) {
    problem_.c.assign(static_cast<std::size_t>(variables), 0.0);
    problem_.f.resize(static_cast<std::size_t>(variables) + 1);
  }

  int add_block(int size, bool diagonal) {
    problem_.blocks.push_back({size, diagonal});
    return static_cast<int>(problem_.blocks.size()) - 1;
  }

  /// B(x) >= shift I, restricted to the rows `kept`.
  void add(const Block& block, const std::vector<int>& kept, double shift) {
    constexpr int kDropped = -1;
    std::vector<int> moved(static_cast<std::size_t>(block.size), kDropped);
    for (std::size_t k = 0; k < kept.size(); ++k)
      moved[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
    const int size = static_cast<int>(kept.size());
    const int at = add_block(size, false);
    for (const auto& [i, matrix] : block.terms) {
      for (int k = 0; k < matrix.outerSize(); ++k) {
        for (Sparse::InnerIterator it(matrix, k); it; ++it) {
          const int row = moved[static_cast<std::size_t>(it.row())];
          const int column = moved[static_cast<std::size_t>(it.col())];
          if (row != kDropped && column != kDropped && row <= column)
            add_entry(i, at, row, column, i == 0 ? it.value() / unit_ : it.value());
        }
      }
    }
    add_identity(0, at, size, -shift / unit_);
  }

  /// The coefficient of variable i (0: the constant B_0) at one place of the upper triangle.
  void add_entry(int i, int block, int row, int column, double value) {
    if (value == 0) return;
    problem_.f[static_cast<std::size_t>(i)].push_back(
        {block, row, column, i == 0 ? -value : value});
  }

  void add_identity(int i, int block, int size, double factor) {
    for (int k = 0; k < size; ++k) add_entry(i, block, k, k, factor);
  }

  void set_cost(int i, double cost) { problem_.c[static_cast<std::size_t>(i) - 1] = cost; }

  /// The problem with entries of one place merged.
  sdp::Problem take() {
    for (auto& entries : problem_.f) merge(entries);
    return std::move(problem_);
  }

 private:
  static void merge(std::vector<sdp::Entry>& entries) {
    const auto key = [](const sdp::Entry& e) { return std::tuple(e.block, e.row, e.column); };
    std::stable_sort(entries.begin(), entries.end(),
                     [&](const sdp::Entry& a, const sdp::Entry& b) { return key(a) < key(b); });
    std::vector<sdp::Entry> merged;
    for (const sdp::Entry& entry : entries) {
      if (!merged.empty() && key(merged.back()) == key(entry)) {
        merged.back().value += entry.value;
      } else {
        merged.push_back(entry);
      }
    }
    std::erase_if(merged, [](const sdp::Entry& entry) { return entry.value == 0; });
    entries = std::move(merged);
  }

  double unit_;
  sdp::Problem problem_;
};

std::vector<int> all_rows(const Block& block) {
  std::vector<int> rows(static_cast<std::size_t>(block.size));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// -r <= x_i <= r with r the variable `size_variable`, or the constant `limit` when it is 0.
void add_limits(Assembler& assembler, int m, int size_variable, double limit) {
  if (m == 0) return;  // a method without unknowns
  const int at = assembler.add_block(2 * m, true);
  for (int i = 1; i <= m; ++i) {
    for (int side = 0; side < 2; ++side) {
      const int row = 2 * (i - 1) + side;
      assembler.add_entry(i, at, row, row, side == 0 ? 1.0 : -1.0);
      assembler.add_entry(size_variable, at, row, row, size_variable == 0 ? limit : 1.0);
    }
  }
}

/// t <= 1.
void add_cap(Assembler& assembler, int variable) {
  const int at = assembler.add_block(1, true);
  assembler.add_entry(0, at, 0, 0, 1.0);
  assembler.add_entry(variable, at, 0, 0, -1.0);
}

}  // namespace

Goal goal_of(const Lmi& lmi, const GainBounds& bounds) {
  const bool homogeneous = is_homogeneous(lmi.blocks) && is_homogeneous(bounds.blocks);
  if (lmi.has_objective) return homogeneous ? Goal::normalised_objective : Goal::bounded_objective;
  return homogeneous ? Goal::homogeneous_feasibility : Goal::feasibility;
}

Formulation formulate(const Lmi& lmi, const GainBounds& bounds,
                      const model::SynthesisOptions& options, Goal goal, double backoff) {
  Formulation result;
  result.goal = goal;
  result.margin = options.margin;
  result.scales = scales_of(lmi, result.homogeneous());
  std::vector<const Block*> bound_blocks;
  for (const Block& block : bounds.blocks) bound_blocks.push_back(&block);
  result.releases = find_releases(lmi, bound_blocks);
  const int m = lmi.unknowns;
  const bool extra = goal == Goal::homogeneous_feasibility || goal == Goal::feasibility;
  const int own = m + bounds.scalars + 1;  // the goal's own variable, when it has one
  result.unit = result.homogeneous() ? 1.0 : data_size(lmi);
  Assembler assembler(extra ? own : own - 1, result.unit);
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const Block& block = lmi.blocks[k];
    const double unit = block.strict ? result.scales[k] : 0.0;
    const bool variable_margin = goal == Goal::feasibility;
    result.shifts.push_back(
        variable_margin ? 0.0 : unit * result.strict_margin() + backoff * result.scales[k]);
    assembler.add(block, result.releases.kept[k], result.shifts.back());
    if (variable_margin && block.strict)
      assembler.add_identity(own, static_cast<int>(k), block.size, -unit / result.unit);
  }
  for (const Block& block : bounds.blocks) assembler.add(block, all_rows(block), 0);
  if (goal == Goal::homogeneous_feasibility) {
    add_limits(assembler, m, own, 0);
    assembler.set_cost(own, 1);
  } else if (goal == Goal::feasibility) {
    add_limits(assembler, m, 0, kLimit);
    add_cap(assembler, own);
    assembler.set_cost(own, -1);
  } else if (goal != Goal::certificate) {
    for (int i = 1; i <= m; ++i)
      assembler.set_cost(i, lmi.objective[static_cast<std::size_t>(i) - 1]);
  }
  result.problem = assembler.take();
  return result;
}

std::vector<double> read_back(const Lmi& lmi, const Formulation& formulation,
                              const sdp::Solution& solution) {
  std::vector<double> x = solution.x;
  x.resize(static_cast<std::size_t>(lmi.unknowns));
  for (double& value : x) value *= formulation.unit;
  std::vector<double> required;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
    required.push_back(lmi.blocks[k].strict ? formulation.scales[k] * formulation.strict_margin()
                                            : 0.0);
  restore(lmi, formulation.releases, required, x);
  return x;
}

double objective_lower_bound(const Lmi& lmi, const Formulation& formulation,
                             const sdp::Solution& solution) {
  // F_0 holds the shifts on the diagonals: take them out again.
  double bound = formulation.unit * solution.dual_objective + lmi.objective_constant;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const std::size_t n = formulation.releases.kept[k].size();
    for (std::size_t i = 0; i < n; ++i)
      bound -= formulation.shifts[k] * solution.Y.values[k][i * n + i];
  }
  return bound;
}

model::NamedMatrices multipliers(const Lmi& lmi, const GainBounds& bounds,
                                 const Formulation& formulation, const sdp::Solution& solution) {
  model::NamedMatrices result;
  const auto add = [&](const Block& block, const std::vector<int>& kept, std::size_t at) {
    const std::string name = block.name + (block.point.empty() ? "" : " at " + block.point);
    const auto n = static_cast<Eigen::Index>(kept.size());
    const Eigen::Map<const numbers::Matrix> y(solution.Y.values[at].data(), n, n);
    // The multiplier of a row that was left out is zero.
    numbers::Matrix whole = numbers::Matrix::Zero(block.size, block.size);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        whole(kept[static_cast<std::size_t>(i)], kept[static_cast<std::size_t>(j)]) = y(i, j);
    result.emplace_back(name, std::move(whole));
  };
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
    add(lmi.blocks[k], formulation.releases.kept[k], k);
  for (std::size_t k = 0; k < bounds.blocks.size(); ++k)
    add(bounds.blocks[k], all_rows(bounds.blocks[k]), lmi.blocks.size() + k);
  return result;
}

std::vector<double> multiplier_sizes(const Lmi& lmi, const Formulation& formulation,
                                     const sdp::Solution& solution, const std::string& inequality,
                                     std::size_t points) {
  std::vector<double> sizes(points, 0.0);
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const Block& block = lmi.blocks[k];
    if (block.name != inequality && !block.name.starts_with(inequality + ".")) continue;
    const std::size_t n = formulation.releases.kept[k].size();
    for (std::size_t i = 0; i < n; ++i) sizes.at(block.at) += solution.Y.values[k][i * n + i];
  }
  return sizes;
}

}  // namespace gainsmith::lmi
