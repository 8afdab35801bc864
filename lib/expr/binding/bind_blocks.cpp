// Block matrices [a, b; c, d], whose entries may have no size of their own: 0, I and "*".
#include <algorithm>
#include <utility>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

namespace {

constexpr int kUnknown = -1;

}  // namespace

/// One block matrix: its entries and how it is cut.
/// Heights of block rows and widths of block columns are unknowns. They are learnt from entries
/// with a shape, then carried across multiples of I, which are square. What is unknown at last is
/// an error.
class BlockBinding {
 public:
  BlockBinding(Binder& binder, const Expression& expression, const Node& node)
      : binder_(binder),
        expression_(expression),
        node_(node),
        columns_(node.columns),
        rows_(static_cast<int>(node.children.size()) / node.columns),
        entries_(node.children.size()),
        heights_(static_cast<std::size_t>(rows_), kUnknown),
        widths_(static_cast<std::size_t>(columns_), kUnknown) {
    for (const NodePtr& child : node.children) mirrored_ |= child->kind == NodeKind::mirror;
  }

  Bound bind() {
    if (mirrored_ && rows_ != columns_)
      binder_.fail(expression_, node_,
                   "a block with '*' needs as many rows as columns, not " + std::to_string(rows_) +
                       " by " + std::to_string(columns_));
    for (std::size_t k = 0; k < entries_.size(); ++k)
      if (node_.children[k]->kind != NodeKind::mirror)
        entries_[k] = binder_.bind(expression_, *node_.children[k]);
    if (entries_.size() == 1 && !mirrored_) return entries_.front();
    learn_from_entries();
    carry_across();
    check_diagonal();
    settle_numbers();
    materialise_entries();
    mirror_entries();
    std::vector<int> operands;
    operands.reserve(entries_.size());
    for (const Bound& value : entries_) operands.push_back(value.at);
    return {binder_.assemble(expression_, node_, std::move(operands), columns_, heights_, widths_)};
  }

 private:
  std::size_t place(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(j);
  }
  const Node& entry(int i, int j) const { return *node_.children[place(i, j)]; }
  int& height(int i) { return heights_[static_cast<std::size_t>(i)]; }
  int& width(int j) { return widths_[static_cast<std::size_t>(j)]; }

  template <class Visit>
  void for_each(Visit visit) const {
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < columns_; ++j) visit(i, j);
  }

  /// A size that is learnt twice must be the same. `what`: "row" or "column", for the message.
  void learn(int& size, int found, const Node& from, Bound value, const char* what) const {
    if (size == kUnknown) size = found;
    if (size != found)
      binder_.fail(expression_, from,
                   binder_.describe(expression_, from, value) + " does not fit: this block " +
                       what + " has size " + std::to_string(size));
  }

  /// An entry with a shape fixes the height of its row and the width of its column; two must agree.
  void learn_from_entries() {
    for_each([&](int i, int j) {
      const Bound value = entries_[place(i, j)];
      if (value.at < 0 || value.identity || binder_.is_zero(value)) return;
      learn(height(i), binder_.shape(value.at).rows, entry(i, j), value, "row");
      learn(width(j), binder_.shape(value.at).cols, entry(i, j), value, "column");
    });
  }

  /// An identity carries a known size across the diagonal of its entry; a mirrored block is cut
  /// alike in both directions. Repeated until nothing more is learnt.
  void carry_across() {
    const auto equate = [](int& a, int& b) {
      if (a == b || (a != kUnknown && b != kUnknown)) return false;
      (a == kUnknown ? a : b) = a == kUnknown ? b : a;
      return true;
    };
    for (bool learnt = true; learnt;) {
      learnt = false;
      for_each([&](int i, int j) {
        if (entries_[place(i, j)].identity || (mirrored_ && i == j))
          learnt |= equate(height(i), width(j));
      });
    }
  }

  /// Blocks with "*" are cut alike in rows and columns.
  void check_diagonal() {
    for (int i = 0; i < rows_ && mirrored_; ++i)
      if (height(i) != width(i))
        binder_.fail(expression_, entry(i, i),
                     "a block with '*' is cut alike both ways, but this diagonal part would be " +
                         to_string(Shape{height(i), width(i)}));
  }

  /// A block without a matrix, a multiple of I or a "*" is a table of numbers: there a 0 is 1 x 1.
  void settle_numbers() {
    const auto at_most_one = [](int size) { return size == 1 || size == kUnknown; };
    const bool numbers = !mirrored_ && std::ranges::all_of(heights_, at_most_one) &&
                         std::ranges::all_of(widths_, at_most_one) &&
                         std::ranges::none_of(entries_, &Bound::identity);
    for (auto* sizes : {&heights_, &widths_})
      if (numbers) std::ranges::replace(*sizes, kUnknown, 1);
  }

  /// Zeros and identities get the shapes that their rows and columns have.
  void materialise_entries() {
    for_each([&](int i, int j) {
      Bound& value = entries_[place(i, j)];
      if (value.at < 0) return;
      if (height(i) == kUnknown || width(j) == kUnknown)
        binder_.fail(expression_, entry(i, j),
                     "the size of '" + expression_.quote(entry(i, j)) +
                         "' cannot be told from the block; write zeros(n, m) or eye(n)");
      value = {binder_.materialise(expression_, entry(i, j), value, {height(i), width(j)})};
    });
  }

  /// Entry (i, j) = transpose of entry (j, i).
  void mirror_entries() {
    for_each([&](int i, int j) {
      if (entry(i, j).kind != NodeKind::mirror) return;
      if (i == j || entry(j, i).kind == NodeKind::mirror)
        binder_.fail(expression_, entry(i, j), "the entry mirrored by this '*' is not given");
      entries_[place(i, j)] = binder_.transpose(expression_, entry(i, j), entries_[place(j, i)]);
    });
  }

  Binder& binder_;
  const Expression& expression_;
  const Node& node_;
  int columns_;
  int rows_;
  bool mirrored_ = false;
  std::vector<Bound> entries_;
  std::vector<int> heights_;  ///< of the block rows, as far as they are known
  std::vector<int> widths_;   ///< of the block columns
};

int Binder::assemble(const Expression& expression, const Node& node, std::vector<int> entries,
                     int columns, const std::vector<int>& heights, const std::vector<int>& widths) {
  Shape total{0, 0};
  for (const int height : heights) total.rows += height;
  for (const int width : widths) total.cols += width;
  return emit(expression, node, Op::blocks, std::move(entries), total, {columns});
}

Bound Binder::bind_block(const Expression& expression, const Node& node) {
  return BlockBinding(*this, expression, node).bind();
}

}  // namespace gainsmith::expr
