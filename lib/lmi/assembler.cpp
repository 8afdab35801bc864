#include "lmi/assembler.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/double_double.h"
#include "base/stop.h"

namespace gainsmith::lmi {

namespace {

/// Sorts and adds up entries of one place. Those with a finer part stay as they are: the solver
/// adds them in 100 digits.
void merge(std::vector<sdp::Entry>& entries) {
  const auto key = [](const sdp::Entry& e) { return std::tuple(e.block, e.row, e.column); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const sdp::Entry& a, const sdp::Entry& b) { return key(a) < key(b); });
  std::vector<sdp::Entry> merged;
  for (const sdp::Entry& entry : entries) {
    const bool same = !merged.empty() && key(merged.back()) == key(entry);
    if (same && merged.back().finer == 0 && entry.finer == 0) {
      const DoubleDouble sum = DoubleDouble(merged.back().value, merged.back().rest) +
                               DoubleDouble(entry.value, entry.rest);
      merged.back().value = sum.hi();
      merged.back().rest = sum.lo();
    } else {
      merged.push_back(entry);
    }
  }
  std::erase_if(merged, [](const sdp::Entry& entry) { return entry.value == 0; });
  entries = std::move(merged);
}

}  // namespace

std::vector<int> all_rows(const Block& block) {
  std::vector<int> rows(static_cast<std::size_t>(block.size));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

BalancedBlock balanced(const Block& block, const Balance& balance, std::size_t at,
                       const std::vector<int>& kept) {
  BalancedBlock result{static_cast<int>(kept.size()), {}, {}};
  for_each_balanced(block, balance, at, kept, [&](int i, int row, int column, double value) {
    result.elements.push_back({i, row, column, value, 0});
  });
  return result;
}

numbers::Matrix value_of(const BalancedBlock& block, const std::vector<double>& y, double one) {
  numbers::Matrix value = numbers::Matrix::Zero(block.size, block.size);
  for (const BalancedBlock::Element& e : block.elements)
    value(e.row, e.column) +=
        e.value * (e.unknown == 0 ? one : y[static_cast<std::size_t>(e.unknown) - 1]);
  value.triangularView<Eigen::StrictlyLower>() = value.transpose();
  return value;
}

Assembler::Assembler(int variables) {
  problem_.c.assign(static_cast<std::size_t>(variables), 0.0);
  problem_.f.resize(static_cast<std::size_t>(variables) + 1);
}

int Assembler::add_block(int size, bool diagonal) {
  problem_.blocks.push_back({size, diagonal});
  return static_cast<int>(problem_.blocks.size()) - 1;
}

int Assembler::add(const BalancedBlock& block, int constant, double diagonal) {
  const int added = add_block(block.size);
  for (std::size_t k = 0; k < block.elements.size(); ++k) {
    const BalancedBlock::Element& e = block.elements[k];
    const double factor = e.row == e.column ? diagonal : 1;
    // Only what is not multiplied keeps its digits.
    const Finer* finer = block.finer.empty() || factor != 1 ? nullptr : &block.finer[k];
    add_entry(e.unknown == 0 ? constant : e.unknown, added, e.row, e.column, factor * e.value,
              factor * e.rest, finer);
  }
  return added;
}

void Assembler::add_entry(int i, int block, int row, int column, double value, double rest,
                          const Finer* finer) {
  // F_0 is the constant part with the opposite sign.
  if (value == 0) return;
  const double sign = i == 0 ? -1 : 1;
  int place = 0;
  if (finer != nullptr &&
      std::any_of(finer->begin(), finer->end(), [](double x) { return x != 0; })) {
    Finer& own = problem_.finer.emplace_back(*finer);
    for (double& part : own) part *= sign;
    place = static_cast<int>(problem_.finer.size());
  }
  problem_.f[static_cast<std::size_t>(i)].push_back(
      {block, row, column, sign * value, sign * rest, place});
}

void Assembler::set_cost(int i, double cost) { problem_.c[static_cast<std::size_t>(i) - 1] = cost; }

sdp::Problem Assembler::take() {
  for (auto& entries : problem_.f) {
    check_stop();
    merge(entries);
  }
  return std::move(problem_);
}

}  // namespace gainsmith::lmi
