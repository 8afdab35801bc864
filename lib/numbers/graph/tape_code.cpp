#include "numbers/graph/tape_code.h"

#include <algorithm>
#include <utility>

namespace gainsmith::numbers {

namespace {

/// Lays out registers: inputs, constants, then what is computed, in the order of the graph.
class Maker {
 public:
  Maker(const ScalarGraph& graph, Computed computed, TapeCode& code)
      : graph_(graph), nodes_(graph.nodes()), computed_(computed), code_(code) {}

  void make(const std::vector<std::vector<int>>& results, int inputs) {
    count_uses(results);
    registers_.assign(nodes_.size(), 0);
    code_.inputs = code_.registers = static_cast<std::uint32_t>(inputs);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (nodes_[k].op == ScalarOp::input) {
        registers_[k] = static_cast<std::uint32_t>(nodes_[k].a);
        if (uses_[k] > 0) code_.reads.push_back(registers_[k]);
      }
      if (nodes_[k].op != ScalarOp::constant || uses_[k] == 0) continue;
      registers_[k] = push();
      code_.constants.push_back(graph_.value(static_cast<int>(k)));
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k) add(k);
    for (const std::vector<int>& result : results) {
      auto& list = code_.results.emplace_back();
      for (const int node : result) list.push_back(registers_[index(node)]);
    }
  }

 private:
  static std::size_t index(int at) { return static_cast<std::size_t>(at); }

  void use(int node) {
    if (node >= 0) ++uses_[index(node)];
  }

  /// From the last node to the first: what a node that is used needs. Nodes without uses have no
  /// step (dead code).
  void count_uses(const std::vector<std::vector<int>>& results) {
    uses_.assign(nodes_.size(), 0);
    is_fused_.assign(nodes_.size(), false);
    for (const std::vector<int>& result : results)
      for (const int node : result) uses_[index(node)] += 2;  // read after the run: never fused
    if (computed_ == Computed::partial)
      for (std::size_t k = 0; k < nodes_.size(); ++k)
        if (graph_.is_partial(static_cast<int>(k))) ++uses_[k];
    auto block = graph_.blocks().rbegin();
    for (std::size_t k = nodes_.size(); k-- > 0;) {
      const ScalarGraph::Node& node = nodes_[k];
      for (; block != graph_.blocks().rend() && index(block->first) >= k + 1; ++block)
        use_operands(*block);
      if (is_leaf(node.op) || uses_[k] == 0) continue;
      use(node.a);
      use(node.b);
      use(node.c);
    }
    for (; block != graph_.blocks().rend(); ++block) use_operands(*block);
  }

  /// Whether it is computed: once the uses of its results are counted.
  bool is_used(const ScalarGraph::Block& block) const {
    if (computed_ == Computed::partial) return true;
    const auto first = uses_.begin() + block.first;
    return std::any_of(first, first + block.instruction.shape.size(),
                       [](int uses) { return uses > 0; });
  }

  void use_operands(const ScalarGraph::Block& block) {
    if (!is_used(block)) return;
    for (const std::vector<int>& operand : block.operands)
      for (const int one : operand) uses_[index(one)] += 2;
  }

  static bool is_leaf(ScalarOp op) {
    return op == ScalarOp::input || op == ScalarOp::constant || op == ScalarOp::element;
  }

  std::uint32_t push() { return code_.registers++; }

  /// The step of node k, after those of the blocks that begin before it; none for leaves and nodes
  /// without uses. a b + c is one multiply_add where the product has no other use.
  void add(std::size_t k) {
    while (next_block_ < graph_.blocks().size() && index(graph_.blocks()[next_block_].first) <= k)
      add_block();
    const ScalarGraph::Node& node = nodes_[k];
    if (is_leaf(node.op) || uses_[k] == 0) return;
    // A product for one sum alone is computed with it.
    if (node.op == ScalarOp::multiply && uses_[k] == 1 && is_summand(k)) return;
    const auto at = [&](int one) { return one < 0 ? 0 : registers_[index(one)]; };
    TapeCode::Step step{node.op, 0, at(node.a), at(node.b), at(node.c)};
    if (node.op == ScalarOp::add)
      for (const auto& [product, rest] : {std::pair(node.b, node.a), std::pair(node.a, node.b)}) {
        if (!is_fused_[index(product)]) continue;
        const ScalarGraph::Node& factors = nodes_[index(product)];
        // Both may be products: the other one is computed now.
        if (is_fused_[index(rest)]) {
          const ScalarGraph::Node& other = nodes_[index(rest)];
          registers_[index(rest)] = push();
          code_.steps.push_back(
              {ScalarOp::multiply, registers_[index(rest)], at(other.a), at(other.b), 0});
        }
        step = {ScalarOp::multiply_add, 0, at(factors.a), at(factors.b), at(rest)};
        break;
      }
    step.out = registers_[k] = push();
    code_.steps.push_back(step);
  }

  /// Whether the only use of a product is a sum.
  bool is_summand(std::size_t product) {
    if (summand_of_.empty()) {
      summand_of_.assign(nodes_.size(), false);
      for (std::size_t k = 0; k < nodes_.size(); ++k)
        if (nodes_[k].op == ScalarOp::add && uses_[k] > 0 && nodes_[k].a != nodes_[k].b) {
          summand_of_[index(nodes_[k].a)] = true;
          summand_of_[index(nodes_[k].b)] = true;
        }
    }
    is_fused_[product] = summand_of_[product];
    return summand_of_[product];
  }

  void add_block() {
    const ScalarGraph::Block& block = graph_.blocks()[next_block_++];
    if (!is_used(block)) return;
    TapeCode::Block& made = code_.blocks.emplace_back();
    made.instruction = block.instruction;
    made.shapes = block.shapes;
    made.is_slope = block.is_slope;
    for (const std::vector<int>& operand : block.operands) {
      auto& from = made.operands.emplace_back();
      for (const int node : operand) from.push_back(registers_[index(node)]);
    }
    code_.steps.push_back({ScalarOp::block, code_.registers,
                           static_cast<std::uint32_t>(code_.blocks.size() - 1), 0, 0});
    for (int k = 0; k < block.instruction.shape.size(); ++k)
      registers_[index(block.first + k)] = push();
  }

  const ScalarGraph& graph_;
  const std::vector<ScalarGraph::Node>& nodes_;
  Computed computed_;
  TapeCode& code_;
  /// By node: how often it is read; 2 for one reading that keeps a product from being fused.
  std::vector<int> uses_;
  std::vector<bool> is_fused_;  ///< by node: a product without a register of its own
  /// By node: an operand of a sum that is used. Made at the first question.
  std::vector<bool> summand_of_;
  std::vector<std::uint32_t> registers_;  ///< by node
  std::size_t next_block_ = 0;
};

}  // namespace

TapeCode tape_code(const ScalarGraph& graph, const std::vector<std::vector<int>>& results,
                   int inputs, Computed computed) {
  TapeCode code;
  Maker(graph, computed, code).make(results, inputs);
  return code;
}

}  // namespace gainsmith::numbers
