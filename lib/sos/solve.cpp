#include "sos/solve.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>

#include "base/stop.h"
#include "numbers/dense/residue.h"

namespace gainsmith::sos {

namespace {

/// Behind all columns: the value, and nothing.
constexpr int kNothing = std::numeric_limits<int>::max(), kValue = kNothing - 1;

/// A column of each equation that the others leave, by their images modulo a prime: one that no
/// other has, or else the first of what those before it leave. kNothing for an equation that
/// follows from others, kValue for one that contradicts them.
std::vector<int> leads_of(const std::vector<Equation>& equations) {
  using numbers::kPrime;
  using Row = std::map<int, std::uint64_t>;
  std::map<int, int> uses;
  for (const Equation& equation : equations)
    for (const auto& [column, c] : equation.terms) ++uses[column];
  std::map<int, Row> pivots;  // by the column where a row has 1 and those before it 0
  std::vector<int> result;
  for (const Equation& equation : equations) {
    check_stop();
    const auto own = std::ranges::find_if(
        equation.terms, [&](const auto& term) { return uses.at(term.first) == 1; });
    if (own != equation.terms.end()) {
      result.push_back(own->first);
      continue;
    }
    Row row;
    const auto add = [&](int column, const Rational& c) {
      if (const auto residue = numbers::residue_of(c); residue && *residue != 0)
        row[column] = *residue;
    };
    for (const auto& [column, c] : equation.terms) add(column, c);
    add(kValue, equation.value);
    while (!row.empty()) {
      const auto [column, factor] = *row.begin();
      const auto pivot = pivots.find(column);
      if (pivot == pivots.end()) break;
      for (const auto& [k, value] : pivot->second) {
        std::uint64_t& left = row[k];
        left = (left + (kPrime - factor) * value) % kPrime;
        if (left == 0) row.erase(k);
      }
    }
    result.push_back(row.empty() ? kNothing : row.begin()->first);
    if (row.empty()) continue;
    const std::uint64_t inverse = numbers::inverse_modulo(row.begin()->second);
    for (auto& [k, value] : row) value = value * inverse % kPrime;
    pivots[result.back()] = std::move(row);
  }
  return result;
}

/// The place of each Gram matrix among the blocks; -1 of one without rows.
std::vector<int> blocks_of(const Program& program) {
  std::vector<int> result;
  int next = 0;
  for (const Gram& gram : program.grams) result.push_back(gram.size() > 0 ? next++ : -1);
  return result;
}

/// `sum` over Y is the sum over the elements of the upper triangles.
std::vector<sdp::Entry> entries_of(const Program& program, const Columns& columns,
                                   const std::vector<int>& blocks,
                                   const std::map<int, Rational>& sum, int sign) {
  std::vector<sdp::Entry> entries;
  for (const auto& [column, c] : sum) {
    const Columns::Place place = columns.place(column);
    // An off-diagonal entry stands for two places; Q is in the units of its scales.
    const Rational value = c * sign / (place.row == place.column ? 1 : 2);
    const std::vector<double>& scale = program.grams[place.gram].scale;
    const double unit =
        scale[static_cast<std::size_t>(place.row)] * scale[static_cast<std::size_t>(place.column)];
    const DoubleDouble both = DoubleDouble(unit) * nearest_double_double(value);
    entries.push_back({blocks[place.gram], place.row, place.column, both.hi(), both.lo()});
  }
  return entries;
}

/// t = t' - kBelow with t' >= 0, since the solver's Y has no elements below 0.
constexpr double kBelow = 10;

/// F_i . Z + (tr F_i - c_i) t - c_i s' = 0 with Y = Z + t I, s = s' + t, and the trace.
void add_margin(const Program& program, sdp::Problem& problem) {
  const int of_size = static_cast<int>(problem.blocks.size()), of_margin = of_size + 1;
  problem.blocks.push_back({1, false});
  problem.blocks.push_back({1, false});
  problem.f.front().push_back({of_margin, 0, 0, 1, 0});
  int rows = 1;
  for (const Gram& gram : program.grams) rows += gram.size();
  for (std::size_t i = 0; i < problem.c.size(); ++i) {
    std::vector<sdp::Entry>& f = problem.f[i + 1];
    const DoubleDouble c = DoubleDouble(problem.c[i]) + DoubleDouble(problem.c_rest[i]);
    DoubleDouble slope = -c;
    for (const sdp::Entry& entry : f)
      if (entry.row == entry.column) slope += DoubleDouble(entry.value) + DoubleDouble(entry.rest);
    if (c != DoubleDouble(0)) f.push_back({of_size, 0, 0, -c.hi(), -c.lo()});
    if (slope != DoubleDouble(0)) f.push_back({of_margin, 0, 0, slope.hi(), slope.lo()});
    const DoubleDouble below = DoubleDouble(kBelow) * slope;
    problem.c[i] = below.hi();
    problem.c_rest[i] = below.lo();
  }
  std::vector<sdp::Entry>& trace = problem.f.emplace_back();
  for (int b = 0; b <= of_size; ++b)
    for (int r = 0; r < problem.blocks[static_cast<std::size_t>(b)].size; ++r)
      trace.push_back({b, r, r, 1, 0});
  trace.push_back({of_margin, 0, 0, static_cast<double>(rows), 0});
  problem.c.push_back((1 + kBelow) * rows);
  problem.c_rest.push_back(0);
}

}  // namespace

Semidefinite semidefinite_program(const Program& program, const Eliminated& eliminated,
                                  const std::optional<Equation>& objective) {
  const Columns columns(program);
  const std::vector<int> blocks = blocks_of(program);
  Semidefinite result;
  sdp::Problem& problem = result.problem;
  for (const Gram& gram : program.grams)
    if (gram.size() > 0) problem.blocks.push_back({gram.size(), false});
  problem.f.emplace_back();
  if (objective) problem.f.front() = entries_of(program, columns, blocks, objective->terms, -1);
  const std::vector<int> leads = leads_of(eliminated.equations);
  for (std::size_t i = 0; i < eliminated.equations.size(); ++i) {
    if (leads[i] >= kValue) continue;
    const Equation& equation = eliminated.equations[i];
    const DoubleDouble value = nearest_double_double(equation.value);
    problem.c.push_back(value.hi());
    problem.c_rest.push_back(value.lo());
    problem.f.push_back(entries_of(program, columns, blocks, equation.terms, 1));
    result.equations.push_back(i);
  }
  result.has_margin = !objective;
  if (result.has_margin) add_margin(program, problem);
  const auto is_finite = [](const sdp::Entry& entry) { return std::isfinite(entry.value); };
  for (const std::vector<sdp::Entry>& f : problem.f)
    if (!std::ranges::all_of(f, is_finite)) throw std::overflow_error("a coefficient");
  for (const double c : problem.c)
    if (!std::isfinite(c)) throw std::overflow_error("a coefficient");
  return result;
}

bool agree(const Eliminated& eliminated) {
  return !eliminated.contradiction &&
         std::ranges::count(leads_of(eliminated.equations), kValue) == 0;
}

namespace {

/// An element of Y in all its digits.
DoubleDouble element_of(const sdp::Solution& solution, std::size_t block, std::size_t at) {
  DoubleDouble value(solution.Y.values[block][at]);
  if (!solution.rest.Y.values.empty()) value += DoubleDouble(solution.rest.Y.values[block][at]);
  return value;
}

}  // namespace

double margin_of(const sdp::Solution& solution) {
  return (element_of(solution, solution.Y.values.size() - 1, 0) - DoubleDouble(kBelow)).hi();
}

std::optional<Point> point_of(const Program& program, const Eliminated& eliminated,
                              const Semidefinite& posed, const sdp::Solution& solution) {
  constexpr double kNothing = 1e-9;
  DoubleDouble t(0), size(1);
  if (posed.has_margin) {
    t = element_of(solution, solution.Y.values.size() - 1, 0) - DoubleDouble(kBelow);
    size = element_of(solution, solution.Y.values.size() - 2, 0) + t;
  }
  if (!(size.hi() > kNothing)) return std::nullopt;
  const Columns columns(program);
  const std::vector<int> blocks = blocks_of(program);
  Point point;
  for (std::size_t g = 0; g < program.grams.size(); ++g) {
    const std::vector<double>& scale = program.grams[g].scale;
    const Eigen::Index n = program.grams[g].size();
    numbers::MatrixOf<DoubleDouble> Q(n, n);
    numbers::Matrix own(n, n);
    for (Eigen::Index c = 0; c < n; ++c)
      for (Eigen::Index r = 0; r < n; ++r) {
        const auto at = static_cast<std::size_t>(r + c * n);
        Q(r, c) = element_of(solution, static_cast<std::size_t>(blocks[g]), at) / size;
        if (r == c) Q(r, c) += t / size;
        own(r, c) =
            scale[static_cast<std::size_t>(r)] * scale[static_cast<std::size_t>(c)] * Q(r, c).hi();
      }
    point.grams.push_back(std::move(own));
    point.balanced.push_back(std::move(Q));
  }
  point.free.assign(static_cast<std::size_t>(columns.frees()), 0.0);
  const auto value_of = [&](int column) {
    if (!columns.is_element(column)) return point.free[static_cast<std::size_t>(column)];
    const Columns::Place place = columns.place(column);
    return point.grams[place.gram](place.row, place.column);
  };
  for (auto pivot = eliminated.pivots.rbegin(); pivot != eliminated.pivots.rend(); ++pivot) {
    double rest = nearest_double(pivot->equation.value);
    for (const auto& [column, c] : pivot->equation.terms)
      if (column != pivot->column) rest -= nearest_double(c) * value_of(column);
    point.free[static_cast<std::size_t>(pivot->column)] =
        rest / nearest_double(pivot->equation.terms.at(pivot->column));
  }
  return point;
}

}  // namespace gainsmith::sos
