#include "lanes/series.h"

#include <algorithm>

namespace gainsmith::lanes {

using numbers::ScalarGraph;
using numbers::ScalarOp;

namespace {

std::optional<SeriesOp> series_op(ScalarOp op) {
  switch (op) {
    case ScalarOp::add:
      return SeriesOp::add;
    case ScalarOp::subtract:
      return SeriesOp::subtract;
    case ScalarOp::multiply:
      return SeriesOp::multiply;
    case ScalarOp::divide:
      return SeriesOp::divide;
    case ScalarOp::negate:
      return SeriesOp::negate;
    case ScalarOp::minimum:
      return SeriesOp::minimum;
    case ScalarOp::maximum:
      return SeriesOp::maximum;
    case ScalarOp::where_positive:
      return SeriesOp::where_positive;
    case ScalarOp::where_nonnegative:
      return SeriesOp::where_nonnegative;
    case ScalarOp::power:
      return SeriesOp::power;
    case ScalarOp::angle:
      return SeriesOp::angle;
    case ScalarOp::abs:
      return SeriesOp::abs;
    case ScalarOp::sign:
      return SeriesOp::sign;
    case ScalarOp::exp:
      return SeriesOp::exp;
    case ScalarOp::log:
      return SeriesOp::log;
    case ScalarOp::sqrt:
      return SeriesOp::sqrt;
    case ScalarOp::sin:
    case ScalarOp::cos:
      return SeriesOp::sine_cosine;
    case ScalarOp::tanh:
      return SeriesOp::tanh;
    default:
      return std::nullopt;
  }
}

}  // namespace

class SeriesCode::Maker {
 public:
  Maker(const ScalarGraph& graph, std::size_t inputs, SeriesCode& code)
      : graph_(graph), code_(code), place_(graph.nodes().size()), rests_(place_.size()) {
    code.inputs_ = inputs;
    code.input_places_.resize(inputs);
    for (SeriesPlace& one : code.input_places_) one = fresh(true);
  }

  /// False: an operation has no recurrence.
  bool make(const std::vector<int>& rows, const std::vector<int>& rates,
            const std::vector<int>& followed) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      SeriesPlace& place = code_.input_places_[index(rows[k])];
      give_slot(place);
      place.rests = graph_.is_zero(rates[k]);
    }
    const std::vector<bool> needed = needed_for(rates, followed);
    in_flow_ = needed_for(rates, {});
    find_what_rests();
    mark_slots(needed, followed);
    for (std::size_t at = 0; at < needed.size(); ++at)
      if (needed[at] && !add(at)) return false;
    // First: an order of the rows follows from the order before of their rates.
    std::vector<SeriesStep> integrals;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const SeriesPlace& to = code_.input_places_[index(rows[k])];
      code_.rows_.push_back(to.slot);
      if (!to.rests) integrals.push_back(step_of(SeriesOp::integral, to, rate_of(rates[k])));
    }
    code_.flow_.insert(code_.flow_.begin(), integrals.begin(), integrals.end());
    for (const int node : followed) code_.followed_.push_back(place_[index(node)].slot);
    return true;
  }

 private:
  static std::size_t index(int at) { return static_cast<std::size_t>(at); }
  static SeriesStep step_of(SeriesOp op, const SeriesPlace& out, const SeriesPlace& a) {
    SeriesStep step;
    step.op = op;
    step.out = out;
    step.a = a;
    return step;
  }

  /// The register of what rests keeps its value, and that of another row may hold order k already.
  SeriesPlace rate_of(int rate) {
    const SeriesPlace& place = place_[index(rate)];
    if (!place.rests && graph_.nodes()[index(rate)].op != ScalarOp::input) return place;
    const SeriesPlace copy = fresh(false);
    SeriesStep step = step_of(SeriesOp::add, copy, place);
    step.b = zero();
    code_.flow_.push_back(step);
    return copy;
  }

  SeriesPlace zero() {
    if (!zero_) {
      zero_ = fresh(true);
      code_.constants_.emplace_back(*zero_, 0.0);
    }
    return *zero_;
  }

  std::vector<bool> needed_for(const std::vector<int>& results,
                               const std::vector<int>& others) const {
    const auto& nodes = graph_.nodes();
    std::vector<bool> marked(nodes.size(), false);
    for (const auto* list : {&results, &others})
      for (const int node : *list) marked[index(node)] = true;
    for (std::size_t at = nodes.size(); at-- > 0;)
      if (marked[at]) each_operand(at, [&](int one) { marked[index(one)] = true; });
    return marked;
  }

  template <class Visit>
  void each_operand(std::size_t at, const Visit& visit) const {
    const ScalarGraph::Node& node = graph_.nodes()[at];
    if (node.op == ScalarOp::input || node.op == ScalarOp::constant || node.op == ScalarOp::element)
      return;
    for (const int one : {node.a, node.b, node.c})
      if (one >= 0) visit(one);
  }

  void find_what_rests() {
    for (std::size_t at = 0; at < rests_.size(); ++at) {
      const ScalarGraph::Node& node = graph_.nodes()[at];
      rests_[at] = node.op != ScalarOp::input || code_.input_places_[index(node.a)].rests;
      each_operand(at, [&](int one) { rests_[at] = rests_[at] && rests_[index(one)]; });
    }
  }

  /// Those of which later orders read all orders before, and all that follows a flow.
  void mark_slots(const std::vector<bool>& needed, const std::vector<int>& followed) {
    has_slot_.assign(needed.size(), false);
    for (const int node : followed) has_slot_[index(node)] = true;
    for (std::size_t at = 0; at < needed.size(); ++at) {
      if (!needed[at]) continue;
      if (!in_flow_[at]) has_slot_[at] = true;
      if (in_flow_[at] && is_linear(graph_.nodes()[at])) continue;
      if (graph_.nodes()[at].op != ScalarOp::multiply) has_slot_[at] = true;
      each_operand(at, [&](int one) { has_slot_[index(one)] = true; });
    }
  }

  /// Whether order k of it needs nothing but order k of what moves.
  bool is_linear(const ScalarGraph::Node& node) const {
    switch (node.op) {
      case ScalarOp::input:
      case ScalarOp::constant:
      case ScalarOp::add:
      case ScalarOp::subtract:
      case ScalarOp::negate:
        return true;
      case ScalarOp::multiply:
        return rests_[index(node.a)] || rests_[index(node.b)];
      case ScalarOp::divide:
        return rests_[index(node.b)];
      default:
        return false;
    }
  }

  SeriesPlace fresh(bool rests) {
    SeriesPlace place;
    place.at = static_cast<std::uint32_t>(code_.registers_++);
    place.rests = rests;
    return place;
  }

  void give_slot(SeriesPlace& place) {
    if (place.slot == kNoSlot) place.slot = static_cast<std::uint32_t>(code_.slots_++);
  }

  bool add(std::size_t at) {
    const ScalarGraph::Node& node = graph_.nodes()[at];
    SeriesPlace& place = place_[at];
    if (node.op == ScalarOp::input) {
      SeriesPlace& input = code_.input_places_[index(node.a)];
      if (has_slot_[at]) give_slot(input);
      place = input;
      return true;
    }
    if (node.op == ScalarOp::constant) {
      place = fresh(true);
      if (has_slot_[at]) give_slot(place);
      code_.constants_.emplace_back(place, graph_.value(static_cast<int>(at)));
      return true;
    }
    const auto op = series_op(node.op);
    if (!op) return false;
    SeriesPlace operands[3];
    int count = 0;
    each_operand(at, [&](int one) { operands[count++] = place_[index(one)]; });
    SeriesStep step;
    step.op = *op;
    step.a = operands[0];
    step.b = operands[1];
    step.c = operands[2];
    if (*op == SeriesOp::multiply) {
      if (step.a.rests) std::swap(step.a, step.b);
      if (step.b.rests)
        step.op = SeriesOp::multiply_still;
      else if (node.a == node.b)
        step.op = SeriesOp::square;
    }
    if (*op == SeriesOp::divide && step.b.rests) step.op = SeriesOp::divide_still;
    if (*op == SeriesOp::power && !step.b.rests) return false;
    if (in_flow_[at] && changes_branch(step)) return false;
    if (*op == SeriesOp::sine_cosine) return add_sine(at, step);
    step.out = place = fresh(rests_[at]);
    if (has_slot_[at]) {
      give_slot(place);
      step.out = place;
    }
    if (*op == SeriesOp::tanh || *op == SeriesOp::angle) {
      step.beside = fresh(rests_[at]);
      give_slot(step.beside);
    }
    push(at, step);
    return true;
  }

  /// Both at once; one that follows a flow may read that of the flow.
  bool add_sine(std::size_t at, SeriesStep step) {
    const bool rests = rests_[at];
    const ScalarGraph::Node& node = graph_.nodes()[at];
    auto pair = std::ranges::find(sines_, node.a, &Sines::of);
    if (pair == sines_.end()) {
      step.out = fresh(rests);
      step.beside = fresh(rests);
      give_slot(step.out);
      give_slot(step.beside);
      pair = sines_.insert(sines_.end(), {node.a, step.out, step.beside, in_flow_[at]});
      push(at, step);
    } else if (in_flow_[at] && !pair->in_flow) {
      // Nodes that follow come first where they are older.
      step.out = pair->sine;
      step.beside = pair->cosine;
      pair->in_flow = true;
      push(at, step);
    }
    place_[at] = node.op == ScalarOp::cos ? pair->cosine : pair->sine;
    return true;
  }

  void push(std::size_t at, const SeriesStep& step) {
    if (step.out.rests) {
      code_.still_.push_back(step);
    } else if (in_flow_[at]) {
      code_.flow_.push_back(step);
    } else {
      const bool two = step.op == SeriesOp::minimum || step.op == SeriesOp::maximum;
      code_.later_.push_back({step, step.a.slot, step.b.slot, changes_branch(step), !two});
    }
  }

  /// Whether the branch of an operation may change along a flow.
  static bool changes_branch(const SeriesStep& step) {
    switch (step.op) {
      case SeriesOp::abs:
      case SeriesOp::sign:
      case SeriesOp::where_positive:
      case SeriesOp::where_nonnegative:
        return !step.a.rests;
      case SeriesOp::minimum:
      case SeriesOp::maximum:
        return !step.a.rests || !step.b.rests;
      default:
        return false;
    }
  }

  struct Sines {
    int of = 0;
    SeriesPlace sine, cosine;
    bool in_flow = false;
  };

  const ScalarGraph& graph_;
  SeriesCode& code_;
  std::vector<SeriesPlace> place_;
  std::vector<bool> in_flow_, rests_, has_slot_;
  std::vector<Sines> sines_;
  std::optional<SeriesPlace> zero_;
};

std::optional<SeriesCode> SeriesCode::make(const ScalarGraph& graph, std::size_t inputs,
                                           const std::vector<int>& rows,
                                           const std::vector<int>& rates,
                                           const std::vector<int>& followed) {
  SeriesCode code;
  if (!Maker(graph, inputs, code).make(rows, rates, followed)) return std::nullopt;
  return code;
}

}  // namespace gainsmith::lanes
