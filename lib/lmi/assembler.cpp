#include "lmi/assembler.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace gainsmith::lmi {

namespace {

void merge(std::vector<sdp::Entry>& entries) {
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

}  // namespace

std::vector<int> all_rows(const Block& block) {
  std::vector<int> rows(static_cast<std::size_t>(block.size));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

Assembler::Assembler(int variables, const Balance& balance) : balance_(balance) {
  problem_.c.assign(static_cast<std::size_t>(variables), 0.0);
  problem_.f.resize(static_cast<std::size_t>(variables) + 1);
}

int Assembler::add_block(int size, bool diagonal) {
  problem_.blocks.push_back({size, diagonal});
  return static_cast<int>(problem_.blocks.size()) - 1;
}

int Assembler::add(const Block& block, std::size_t at, const std::vector<int>& kept, int constant,
                   double diagonal) {
  constexpr int kDropped = -1;
  std::vector<int> moved(static_cast<std::size_t>(block.size), kDropped);
  for (std::size_t k = 0; k < kept.size(); ++k)
    moved[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
  const int added = add_block(static_cast<int>(kept.size()));
  for (const auto& [i, matrix] : block.terms) {
    for (int k = 0; k < matrix.outerSize(); ++k) {
      for (Sparse::InnerIterator it(matrix, k); it; ++it) {
        const auto r = static_cast<int>(it.row());
        const auto c = static_cast<int>(it.col());
        const int row = moved[static_cast<std::size_t>(r)];
        const int column = moved[static_cast<std::size_t>(c)];
        if (row == kDropped || column == kDropped || row > column) continue;
        const double value = it.value() * balance_.factor(at, r, c, i);
        add_entry(i == 0 ? constant : i, added, row, column,
                  row == column ? diagonal * value : value);
      }
    }
  }
  return added;
}

void Assembler::add_entry(int i, int block, int row, int column, double value) {
  if (value == 0) return;
  problem_.f[static_cast<std::size_t>(i)].push_back({block, row, column, i == 0 ? -value : value});
}

void Assembler::set_cost(int i, double cost) { problem_.c[static_cast<std::size_t>(i) - 1] = cost; }

sdp::Problem Assembler::take() {
  for (auto& entries : problem_.f) merge(entries);
  return std::move(problem_);
}

}  // namespace gainsmith::lmi
