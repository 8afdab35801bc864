// From a graph to steps: registers by a linear scan over last uses, and fewer steps by fusion. A
// sum or product may have a constant operand, take the result of the step before from vector
// registers, or be part of a polynomial in one step.
#include "lanes/machine.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <optional>

namespace gainsmith::lanes {

using numbers::ScalarOp;
using numbers::TapeCode;

namespace {

/// The vector form of an operation; none: it is computed lane by lane.
std::optional<LaneOp> lane_op(ScalarOp op) {
  switch (op) {
#define LANE_OP(op, operands, ...) \
  case ScalarOp::op:               \
    return LaneOp::op;
#include "numbers/graph/scalar_ops.def"
    default:
      return std::nullopt;
  }
}

int operands_of(ScalarOp op) {
  switch (op) {
#define SCALAR_OP(op, operands, ...) \
  case ScalarOp::op:                 \
    return operands;
#include "numbers/graph/scalar_ops.def"
    default:
      return 0;
  }
}

/// Whether finite operands may have a result that is not finite; it is then a fault of the lane.
bool is_partial(ScalarOp op) {
  return op == ScalarOp::divide || op == ScalarOp::sqrt || op == ScalarOp::exp;
}

}  // namespace

/// Gives registers to what is computed for as long as it is needed, so that few serve.
class LaneCode::Maker {
 public:
  Maker(TapeCode tape, LaneCode& code) : tape_(std::move(tape)), code_(code) {}

  /// `feed_back`: the input that takes the place of the first result.
  void make(std::optional<std::uint32_t> feed_back) {
    if (feed_back)
      for (std::uint32_t k = 0; k < tape_.results.front().size(); ++k)
        fed_.emplace(tape_.results.front()[k], *feed_back + k);
    first_ = tape_.inputs + static_cast<std::uint32_t>(tape_.constants.size());
    code_.constants_ = tape_.constants;
    code_.registers_ = tape_.inputs;
    find_last_uses();
    at_.assign(tape_.registers, kNone);
    for (std::uint32_t k = 0; k < tape_.inputs; ++k) at_[k] = k;
    for (std::size_t k = 0; k < tape_.steps.size();) k += add_from(k);
    for (const auto& result : tape_.results) {
      auto& list = code_.results_.emplace_back();
      for (const std::uint32_t value : result) list.push_back(place(value));
    }
    code_.blocks_ = std::move(tape_.blocks);
  }

  /// Copies the first result to the inputs from `first` on.
  void feed_back(std::uint32_t first) {
    std::vector<std::uint32_t> from = code_.results_.front();
    // An input that another one takes the place of is read before.
    for (std::uint32_t k = 0; k < from.size(); ++k)
      if (from[k] < tape_.inputs && from[k] != first + k) {
        const auto beside = static_cast<std::uint32_t>(code_.registers_++);
        copy(from[k], beside);
        from[k] = beside;
      }
    for (std::uint32_t k = 0; k < from.size(); ++k)
      if (from[k] != first + k) copy(from[k], first + k);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kFewestTerms = 2;  ///< of a polynomial in one step
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

  template <class Visit>
  void visit_operands(const TapeCode::Step& step, const Visit& visit) const {
    if (step.op == ScalarOp::block) {
      for (const auto& operand : tape_.blocks[step.a].operands)
        for (const std::uint32_t value : operand) visit(value);
      return;
    }
    const int count = operands_of(step.op);
    visit(step.a);
    if (count > 1) visit(step.b);
    if (count > 2) visit(step.c);
  }

  /// last_[v]: the last step that reads value v; 0 of none, kNever of results.
  void find_last_uses() {
    last_.assign(tape_.registers, 0);
    for (std::size_t k = 0; k < tape_.steps.size(); ++k)
      visit_operands(tape_.steps[k], [&](std::uint32_t value) { last_[value] = k; });
    for (const auto& result : tape_.results)
      for (const std::uint32_t value : result) last_[value] = kNever;
  }

  bool is_constant(std::uint32_t value) const { return value >= tape_.inputs && value < first_; }

  /// The register of a value; a constant gets one when it is asked for.
  std::uint32_t place(std::uint32_t value) {
    if (at_[value] == kNone) {
      at_[value] = static_cast<std::uint32_t>(code_.registers_++);
      code_.filled_.emplace_back(at_[value], tape_.constants[value - tape_.inputs]);
      last_[value] = kNever;
    }
    return at_[value];
  }

  /// A free register, or a new one.
  std::uint32_t fresh() {
    if (free_.empty()) return static_cast<std::uint32_t>(code_.registers_++);
    const std::uint32_t last = free_.back();
    free_.pop_back();
    return last;
  }

  /// Frees the registers of operands that step k is the last to read.
  void release(const TapeCode::Step& step, std::size_t k) {
    visit_operands(step, [&](std::uint32_t value) {
      if (value < first_ || last_[value] != k || at_[value] == kNone) return;
      free_.push_back(at_[value]);
      last_[value] = kNever;  // once
    });
  }

  /// A result that nothing uses is there for its fault alone. One that is fed back is written to
  /// the input at once, when nothing reads that any more.
  std::uint32_t give(std::uint32_t out, std::size_t k) {
    const auto input = fed_.find(out);
    at_[out] = input != fed_.end() && last_[input->second] <= k ? input->second : fresh();
    if (last_[out] == 0) last_[out] = k;
    return at_[out];
  }

  /// Adds step k of the tape, with a constant operand where it has one. Operands are released
  /// before the result gets its register, so that both may be the same.
  void add(std::size_t k) {
    const TapeCode::Step& step = tape_.steps[k];
    if (step.op == ScalarOp::block) return add_block(step, k);
    LaneStep made;
    const auto op = lane_op(step.op);
    if (!op) return add_function(step, k);
    made.op = *op;
    made.is_partial = is_partial(step.op);
    std::uint32_t a = step.a, b = step.b;
    const bool fused = step.op == ScalarOp::multiply_add;
    if (fused || step.op == ScalarOp::add || step.op == ScalarOp::multiply) {
      if (is_constant(b)) std::swap(a, b);
      if (is_constant(a) && !is_constant(b))
        made.op = fused                      ? LaneOp::multiply_constant_add
                  : step.op == ScalarOp::add ? LaneOp::add_constant
                                             : LaneOp::multiply_constant;
    }
    const bool by_constant = made.op != *op;
    const int count = operands_of(step.op);
    made.a = by_constant ? a - tape_.inputs : place(a);
    if (count > 1) made.b = place(b);
    if (count > 2) made.c = place(step.c);
    if (!code_.steps_.empty() && k > 0) keep_last(k, made);
    release(step, k);
    made.out = give(step.out, k);
    code_.steps_.push_back(made);
    drop(step.out, k);
  }

  /// Takes an operand from the step before, when nothing else reads it.
  void keep_last(std::size_t k, LaneStep& made) {
    LaneStep& before = code_.steps_.back();
    const std::uint32_t result = tape_.steps[k - 1].out;
    if (before.op == LaneOp::one_by_one || before.is_partial || last_[result] != k) return;
    if (at_[result] != before.out) return;
    switch (made.op) {
      case LaneOp::add:
        if ((made.a == before.out) == (made.b == before.out)) return;
        if (made.a == before.out) made.a = made.b;
        made.op = LaneOp::add_last;
        break;
      case LaneOp::multiply_add:
        if (made.c == before.out && made.a != before.out && made.b != before.out) {
          made.op = LaneOp::multiply_add_last;
        } else if (made.c != before.out && (made.a == before.out) != (made.b == before.out)) {
          if (made.b == before.out) std::swap(made.a, made.b);
          made.op = LaneOp::multiply_last_add;
        } else {
          return;
        }
        break;
      case LaneOp::multiply_constant_add:
        if (made.c != before.out || made.b == before.out) return;
        made.op = LaneOp::multiply_constant_add_last;
        break;
      default:
        return;
    }
    before.stores = false;
  }

  /// Frees the register of a result that nothing reads.
  void drop(std::uint32_t out, std::size_t k) {
    if (last_[out] == k) free_.push_back(at_[out]);
  }

  void copy(std::uint32_t from, std::uint32_t to) {
    LaneStep made;
    made.op = LaneOp::copy;
    made.a = from;
    made.out = to;
    code_.steps_.push_back(made);
  }

  /// Adds step k, or a polynomial that begins there; how many steps these are.
  std::size_t add_from(std::size_t k) {
    const std::size_t length = chain_length(k);
    if (length < kFewestTerms) {
      add(k);
      return 1;
    }
    add_polynomial(k, length);
    return length;
  }

  /// How many steps from k on are Horner's rule with constants: (c a + c') a + c'' ...
  std::size_t chain_length(std::size_t k) const {
    std::size_t length = 0;
    for (; k + length < tape_.steps.size(); ++length) {
      const TapeCode::Step& step = tape_.steps[k + length];
      if (step.op != ScalarOp::multiply_add || !is_constant(step.c)) break;
      if (length == 0 ? is_constant(step.a) == is_constant(step.b) : !continues(k, k + length))
        break;
    }
    return length;
  }

  /// a of the polynomial that begins with this step, whose other factor is a constant.
  std::uint32_t argument_of(const TapeCode::Step& first) const {
    return is_constant(first.a) ? first.b : first.a;
  }

  /// Whether step k multiplies the result before it by the same argument, and nothing else reads
  /// that.
  bool continues(std::size_t first, std::size_t k) const {
    const TapeCode::Step& step = tape_.steps[k];
    const std::uint32_t before = tape_.steps[k - 1].out;
    const std::uint32_t argument = argument_of(tape_.steps[first]);
    const bool takes =
        (step.a == before && step.b == argument) || (step.b == before && step.a == argument);
    return takes && last_[before] == k;
  }

  /// sum_i c_i a^(length-i), i = 0 ... length, as one step: the intermediate values need no
  /// registers.
  void add_polynomial(std::size_t k, std::size_t length) {
    const TapeCode::Step& first = tape_.steps[k];
    LaneStep made;
    made.op = LaneOp::polynomial;
    made.a = place(argument_of(first));
    made.b = static_cast<std::uint32_t>(code_.constants_.size());
    made.c = static_cast<std::uint32_t>(length);
    const auto value = [&](std::uint32_t constant) {
      return tape_.constants[constant - tape_.inputs];
    };
    code_.constants_.push_back(value(is_constant(first.a) ? first.a : first.b));
    for (std::size_t i = 0; i < length; ++i)
      code_.constants_.push_back(value(tape_.steps[k + i].c));
    const std::size_t end = k + length - 1;
    for (std::size_t i = k; i <= end; ++i) release(tape_.steps[i], i);
    made.out = give(tape_.steps[end].out, end);
    code_.steps_.push_back(made);
    drop(tape_.steps[end].out, end);
  }

  /// An operation without a vector form.
  void add_function(const TapeCode::Step& step, std::size_t k) {
    OneByOne one_by_one;
    one_by_one.op = step.op;
    one_by_one.a = place(step.a);
    one_by_one.b = operands_of(step.op) > 1 ? place(step.b) : one_by_one.a;
    one_by_one.c = one_by_one.a;
    release(step, k);
    one_by_one.out = give(step.out, k);
    push(std::move(one_by_one));
    drop(step.out, k);
  }

  void add_block(const TapeCode::Step& step, std::size_t k) {
    OneByOne one_by_one;
    one_by_one.block = step.a;
    TapeCode::Block& block = tape_.blocks[step.a];
    // Its results are not among its operands: these are read once for each lane.
    const auto operands = block.operands;
    for (auto& operand : block.operands)
      for (std::uint32_t& from : operand) from = place(from);
    const auto size = static_cast<std::uint32_t>(block.instruction.shape.size());
    for (std::uint32_t e = 0; e < size; ++e) one_by_one.results.push_back(give(step.out + e, k));
    push(std::move(one_by_one));
    for (const auto& operand : operands)
      for (const std::uint32_t from : operand)
        if (from >= first_ && last_[from] == k) {
          free_.push_back(at_[from]);
          last_[from] = kNever;
        }
    for (std::uint32_t e = 0; e < size; ++e) drop(step.out + e, k);
  }

  void push(OneByOne one_by_one) {
    LaneStep step;
    step.a = static_cast<std::uint32_t>(code_.one_by_one_.size());
    code_.steps_.push_back(step);
    code_.one_by_one_.push_back(std::move(one_by_one));
  }

  TapeCode tape_;
  LaneCode& code_;
  std::uint32_t first_ = 0;                     ///< that is computed
  std::map<std::uint32_t, std::uint32_t> fed_;  ///< the inputs of results that are fed back
  std::vector<std::size_t> last_;
  std::vector<std::uint32_t> at_;
  std::vector<std::uint32_t> free_;
};

LaneCode::LaneCode(const numbers::ScalarGraph& graph, const std::vector<std::vector<int>>& results,
                   std::size_t inputs, std::optional<std::uint32_t> feed_back,
                   numbers::Computed computed) {
  Maker maker(numbers::tape_code(graph, results, static_cast<int>(inputs), computed), *this);
  maker.make(feed_back);
  if (feed_back) maker.feed_back(*feed_back);
  may_fault_ = std::ranges::any_of(steps_, &LaneStep::is_partial);
}

void LaneMachine::Free::operator()(double* registers) const {
  ::operator delete[](registers, std::align_val_t(64));
}

LaneMachine::LaneMachine(const LaneCode& code, const Variant& variant)
    : code_(&code), run_(variant.run) {
  const std::size_t count = std::max<std::size_t>(code.registers_, 1) * kLanes;
  registers_.reset(
      static_cast<double*>(::operator new[](count * sizeof(double), std::align_val_t(64))));
  std::fill_n(registers_.get(), count, 0.0);
  for (const auto& [at, value] : code.filled_) std::fill_n(input(at), kLanes, value);
  for (const TapeCode::Block& block : code.blocks_) {
    auto& lanes = blocks_.emplace_back();
    for (std::size_t l = 0; l < kLanes; ++l) lanes.emplace_back(block);
  }
}

LaneMachine::LaneMachine(LaneMachine&&) noexcept = default;
LaneMachine& LaneMachine::operator=(LaneMachine&&) noexcept = default;
LaneMachine::~LaneMachine() = default;

/// Runs stretches of vector steps, with what is done lane by lane between them. A fault is any sum
/// of 0 * value that is not 0.
void LaneMachine::run(std::uint32_t active) {
  alignas(64) double faults[kLanes] = {};
  faults_ = 0;
  const LaneStep* step = code_->steps_.data();
  const LaneStep* const end = step + code_->steps_.size();
  while ((step = run_(step, end, code_->constants_.data(), registers_.get(), faults)) != end)
    run_one_by_one(code_->one_by_one_[(step++)->a], active);
  if (!code_->may_fault_) return;
  for (std::size_t l = 0; l < kLanes; ++l)
    if (faults[l] != 0 || std::isnan(faults[l])) faults_ |= 1U << l;
}

void LaneMachine::run_one_by_one(const LaneCode::OneByOne& one_by_one, std::uint32_t active) {
  for (std::uint32_t left = active; left != 0; left &= left - 1) {
    const auto l = static_cast<std::size_t>(std::countr_zero(left));
    double* const lane = registers_.get() + l;
    if (one_by_one.op != ScalarOp::block) {
      const double value = numbers::apply(one_by_one.op, lane[one_by_one.a * kLanes],
                                          lane[one_by_one.b * kLanes], lane[one_by_one.c * kLanes]);
      lane[one_by_one.out * kLanes] = value;
      if (!std::isfinite(value)) faults_ |= 1U << l;
      continue;
    }
    const numbers::Matrix* value = blocks_[one_by_one.block][l](lane, kLanes);
    if (value == nullptr || !value->allFinite()) {
      faults_ |= 1U << l;
      continue;
    }
    for (std::size_t e = 0; e < one_by_one.results.size(); ++e)
      lane[one_by_one.results[e] * kLanes] = value->data()[e];
  }
}

}  // namespace gainsmith::lanes
