#include "numbers/tape.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "numbers/real.h"
#include "numbers/scalar_functions.h"
#include "numbers/small_inverse.h"
#include "numbers/small_svd.h"

namespace gainsmith::numbers {

/// Lays out registers: inputs, constants, then what is computed, in the order of the graph.
class Tape::Maker {
 public:
  Maker(const ScalarGraph& graph, Tape& tape) : graph_(graph), nodes_(graph.nodes()), tape_(tape) {}

  void make(const std::vector<std::vector<int>>& results, int inputs) {
    count_uses(results);
    registers_.assign(nodes_.size(), 0);
    tape_.registers_.assign(static_cast<std::size_t>(inputs), 0);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (nodes_[k].op == ScalarOp::input) {
        registers_[k] = static_cast<std::uint32_t>(nodes_[k].a);
        if (uses_[k] > 0) tape_.reads_.push_back(registers_[k]);
      }
      if (nodes_[k].op != ScalarOp::constant || uses_[k] == 0) continue;
      registers_[k] = static_cast<std::uint32_t>(tape_.registers_.size());
      tape_.registers_.push_back(graph_.value(static_cast<int>(k)));
    }
    tape_.first_ = tape_.registers_.size();
    for (std::size_t k = 0; k < nodes_.size(); ++k) add(k);
    for (const std::vector<int>& result : results) {
      auto& list = tape_.results_.emplace_back();
      for (const int node : result) list.push_back(registers_[index(node)]);
    }
  }

 private:
  static std::size_t index(int at) { return static_cast<std::size_t>(at); }

  void use(int node) {
    if (node >= 0) ++uses_[index(node)];
  }

  /// From the last node to the first: what a node that is used needs.
  void count_uses(const std::vector<std::vector<int>>& results) {
    uses_.assign(nodes_.size(), 0);
    is_fused_.assign(nodes_.size(), false);
    for (const std::vector<int>& result : results)
      for (const int node : result) uses_[index(node)] += 2;  // read after the run: never fused
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (graph_.is_partial(static_cast<int>(k))) ++uses_[k];
    auto block = graph_.blocks().rbegin();
    for (std::size_t k = nodes_.size(); k-- > 0;) {
      const ScalarGraph::Node& node = nodes_[k];
      for (; block != graph_.blocks().rend() && index(block->first) >= k + 1; ++block)
        for (const std::vector<int>& operand : block->operands)
          for (const int one : operand) uses_[index(one)] += 2;
      if (is_leaf(node.op) || uses_[k] == 0) continue;
      use(node.a);
      use(node.b);
      use(node.c);
    }
    for (; block != graph_.blocks().rend(); ++block)
      for (const std::vector<int>& operand : block->operands)
        for (const int one : operand) uses_[index(one)] += 2;
  }

  static bool is_leaf(ScalarOp op) {
    return op == ScalarOp::input || op == ScalarOp::constant || op == ScalarOp::element;
  }

  std::uint32_t push() {
    tape_.registers_.push_back(0);
    return static_cast<std::uint32_t>(tape_.registers_.size() - 1);
  }

  void add(std::size_t k) {
    while (next_block_ < graph_.blocks().size() && index(graph_.blocks()[next_block_].first) <= k)
      add_block();
    const ScalarGraph::Node& node = nodes_[k];
    if (is_leaf(node.op) || uses_[k] == 0) return;
    // A product for one sum alone is computed with it.
    if (node.op == ScalarOp::multiply && uses_[k] == 1 && is_summand(k)) return;
    const auto at = [&](int one) { return one < 0 ? 0 : registers_[index(one)]; };
    Step step{node.op, 0, at(node.a), at(node.b), at(node.c)};
    if (node.op == ScalarOp::add)
      for (const auto& [product, rest] : {std::pair(node.b, node.a), std::pair(node.a, node.b)}) {
        if (!is_fused_[index(product)]) continue;
        const ScalarGraph::Node& factors = nodes_[index(product)];
        // Both may be products: the other one is computed now.
        if (is_fused_[index(rest)]) {
          const ScalarGraph::Node& other = nodes_[index(rest)];
          registers_[index(rest)] = push();
          tape_.steps_.push_back(
              {ScalarOp::multiply, registers_[index(rest)], at(other.a), at(other.b), 0});
        }
        step = {ScalarOp::multiply_add, 0, at(factors.a), at(factors.b), at(rest)};
        break;
      }
    step.out = registers_[k] = push();
    tape_.steps_.push_back(step);
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
    auto made = std::make_unique<Block>();
    made->instruction = block.instruction;
    for (std::size_t k = 0; k < block.operands.size(); ++k) {
      auto& from = made->from.emplace_back();
      for (const int node : block.operands[k]) from.push_back(registers_[index(node)]);
      made->operands.push_back(Matrix::Zero(block.shapes[k].rows, block.shapes[k].cols));
    }
    for (const Matrix& operand : made->operands) made->pointers.push_back(&operand);
    if (block.instruction.op == expr::Op::jacobian)
      made->jacobian = std::make_unique<JacobianEvaluator<double>>(made->instruction);
    if (block.instruction.op == expr::Op::flow_map)
      made->flow_map = std::make_unique<FlowMapEvaluator>(made->instruction);
    Step step{ScalarOp::block, static_cast<std::uint32_t>(tape_.registers_.size()),
              static_cast<std::uint32_t>(tape_.blocks_.size()), 0, 0};
    for (int k = 0; k < block.instruction.shape.size(); ++k)
      registers_[index(block.first + k)] = push();
    tape_.steps_.push_back(step);
    tape_.blocks_.push_back(std::move(made));
  }

  const ScalarGraph& graph_;
  const std::vector<ScalarGraph::Node>& nodes_;
  Tape& tape_;
  std::vector<int> uses_;
  std::vector<bool> is_fused_;  ///< by node: a product without a register of its own
  std::vector<bool> summand_of_;
  std::vector<std::uint32_t> registers_;  ///< by node
  std::size_t next_block_ = 0;
};

Tape::Tape(const ScalarGraph& graph, const std::vector<std::vector<int>>& results, int inputs) {
  Maker(graph, *this).make(results, inputs);
}

/// Singular values, and the norm of a matrix, without the rules' allocations. False: for these.
bool Tape::find_small_values(Block& block) {
  const bool norm = block.instruction.op == expr::Op::norm;
  if (!norm && block.instruction.op != expr::Op::singular_values) return false;
  const Matrix& operand = block.operands[0];
  block.out.resize(norm ? std::min(operand.rows(), operand.cols()) : block.instruction.shape.rows,
                   1);
  if (!small_singular_values(operand, block.out.data())) return false;
  if (norm) block.out.conservativeResize(1, 1);
  return true;
}

/// What a block made of the same operands last is its value still.
bool Tape::run_block(Block& block, double* out) {
  for (std::size_t k = 0; k < block.from.size(); ++k) {
    double* to = block.operands[k].data();
    for (const std::uint32_t from : block.from[k]) {
      block.is_known = block.is_known && *to == registers_[from];
      *to++ = registers_[from];
    }
  }
  if (block.instruction.op == expr::Op::inverse && small_inverse(block.operands[0], out))
    return true;
  if (!block.is_known && find_small_values(block)) block.is_known = true;
  if (!block.is_known) {
    try {
      if (block.jacobian != nullptr) {
        block.out = (*block.jacobian)(block.pointers);
      } else if (block.flow_map != nullptr) {
        block.out = (*block.flow_map)(block.pointers);
      } else {
        RealAlgebra{}.apply(block.instruction, block.pointers, block.out);
      }
    } catch (const expr::EvaluationError&) {
      return false;
    }
    block.is_known = true;
  }
  std::copy_n(block.out.data(), block.out.size(), out);
  return true;
}

bool Tape::is_finite() const {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000U;
  std::uint64_t found = 0;
  for (std::size_t k = first_; k < registers_.size(); ++k)
    found |= (std::bit_cast<std::uint64_t>(registers_[k]) & kExponent) == kExponent ? 1U : 0U;
  return found == 0;
}

bool Tape::run() {
  double* const r = registers_.data();
  for (const Step& step : steps_) {
    const double a = r[step.a];
    const double b = r[step.b];
    double& out = r[step.out];
    switch (step.op) {
      case ScalarOp::add:
        out = a + b;
        break;
      case ScalarOp::subtract:
        out = a - b;
        break;
      case ScalarOp::multiply:
        out = a * b;
        break;
      case ScalarOp::multiply_add:
        out = a * b + r[step.c];
        break;
      case ScalarOp::divide:
        out = a / b;
        break;
      case ScalarOp::negate:
        out = -a;
        break;
      case ScalarOp::minimum:
        out = b < a ? b : a;
        break;
      case ScalarOp::maximum:
        out = a < b ? b : a;
        break;
      case ScalarOp::where_positive:
        out = a > 0 ? b : r[step.c];
        break;
      case ScalarOp::where_nonnegative:
        out = a >= 0 ? b : r[step.c];
        break;
      case ScalarOp::abs:
        out = std::abs(a);
        break;
      case ScalarOp::sqrt:
        out = std::sqrt(a);
        break;
      case ScalarOp::block:
        if (!run_block(*blocks_[step.a], &out)) return false;
        break;
      default:
        out = apply(step.op, a, b, r[step.c]);
        break;
    }
  }
  return is_finite();
}

}  // namespace gainsmith::numbers
