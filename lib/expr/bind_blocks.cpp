#include <algorithm>
#include <optional>

#include "expr/binder.h"

namespace gainsmith::expr {

namespace {

/// The heights of block rows and widths of block columns, as far as they are known.
struct Partition {
  std::vector<int> heights;
  std::vector<int> widths;
};

constexpr int kUnknown = -1;

}  // namespace

int Binder::assemble(const Expression& expression, const Node& node, std::vector<int> entries,
                     int columns, const std::vector<int>& heights, const std::vector<int>& widths) {
  Shape total{0, 0};
  for (const int height : heights) total.rows += height;
  for (const int width : widths) total.cols += width;
  return emit(expression, node, Op::blocks, std::move(entries), total, {columns});
}

Bound Binder::bind_block(const Expression& expression, const Node& node) {
  const int columns = node.columns;
  const int rows = static_cast<int>(node.children.size()) / columns;
  const auto place = [&](int i, int j) {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(j);
  };
  bool mirrored = false;
  for (const NodePtr& child : node.children) mirrored |= child->kind == NodeKind::mirror;
  if (mirrored && rows != columns)
    fail(expression, node,
         "a block with '*' needs as many rows as columns, not " + std::to_string(rows) + " by " +
             std::to_string(columns));

  std::vector<Bound> entries(node.children.size());
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (node.children[k]->kind != NodeKind::mirror)
      entries[k] = bind(expression, *node.children[k]);
  if (entries.size() == 1 && !mirrored) return entries.front();

  Partition partition{std::vector<int>(static_cast<std::size_t>(rows), kUnknown),
                      std::vector<int>(static_cast<std::size_t>(columns), kUnknown)};
  const auto learn = [&](int& size, int found, const Node& entry, Bound value, const char* what) {
    if (size == kUnknown) size = found;
    if (size != found)
      fail(expression, entry,
           describe(expression, entry, value) + " does not fit: this block " + what + " has size " +
               std::to_string(size));
  };
  const auto is_free = [&](Bound value) { return value.identity || is_zero(value); };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const Bound value = entries[place(i, j)];
      if (value.at < 0 || is_free(value)) continue;
      const Node& entry = *node.children[place(i, j)];
      learn(partition.heights[static_cast<std::size_t>(i)], shape(value.at).rows, entry, value,
            "row");
      learn(partition.widths[static_cast<std::size_t>(j)], shape(value.at).cols, entry, value,
            "column");
    }
  }
  // An identity carries a known size across the diagonal of its entry; a mirrored block is cut
  // alike both ways. Repeated until nothing more is learnt.
  const auto equate = [](int& a, int& b) {
    if (a == b || (a != kUnknown && b != kUnknown)) return false;
    (a == kUnknown ? a : b) = a == kUnknown ? b : a;
    return true;
  };
  for (bool learnt = true; learnt;) {
    learnt = false;
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) {
        const bool square = entries[place(i, j)].identity || (mirrored && i == j);
        if (square)
          learnt |= equate(partition.heights[static_cast<std::size_t>(i)],
                           partition.widths[static_cast<std::size_t>(j)]);
      }
    }
  }
  for (int i = 0; i < rows && mirrored; ++i) {
    const int height = partition.heights[static_cast<std::size_t>(i)];
    const int width = partition.widths[static_cast<std::size_t>(i)];
    if (height != width)
      fail(expression, *node.children[place(i, i)],
           "a block with '*' is cut alike both ways, but this diagonal part would be " +
               to_string(Shape{height, width}));
  }
  // A block without a matrix, a multiple of I or a "*" is a table of numbers: there a 0 is 1 x 1.
  const auto at_most_one = [](int size) { return size == 1 || size == kUnknown; };
  const bool numbers = !mirrored && std::ranges::all_of(partition.heights, at_most_one) &&
                       std::ranges::all_of(partition.widths, at_most_one) &&
                       std::ranges::none_of(entries, &Bound::identity);
  for (auto* sizes : {&partition.heights, &partition.widths})
    if (numbers) std::ranges::replace(*sizes, kUnknown, 1);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      Bound& value = entries[place(i, j)];
      if (value.at < 0) continue;
      int& height = partition.heights[static_cast<std::size_t>(i)];
      int& width = partition.widths[static_cast<std::size_t>(j)];
      const bool row_of_zeros = height == kUnknown;
      if (row_of_zeros || width == kUnknown)
        fail(expression, *node.children[place(i, j)],
             "the size of '" + expression.quote(*node.children[place(i, j)]) +
                 "' cannot be told from the block; write zeros(n, m) or eye(n)");
      value = {materialise(expression, *node.children[place(i, j)], value, {height, width})};
    }
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (node.children[place(i, j)]->kind != NodeKind::mirror) continue;
      const Bound source = entries[place(j, i)];
      if (i == j || node.children[place(j, i)]->kind == NodeKind::mirror)
        fail(expression, *node.children[place(i, j)],
             "the entry mirrored by this '*' is not given");
      entries[place(i, j)] = transpose(expression, *node.children[place(i, j)], source);
    }
  }
  std::vector<int> operands;
  operands.reserve(entries.size());
  for (const Bound& value : entries) operands.push_back(value.at);
  return {assemble(expression, node, std::move(operands), columns, partition.heights,
                   partition.widths)};
}

}  // namespace gainsmith::expr
