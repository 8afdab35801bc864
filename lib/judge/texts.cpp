#include "judge/texts.h"

#include <algorithm>
#include <cmath>

#include "hybrid/rounding_terms.h"

namespace gainsmith::judge {

namespace {

using model::Dynamics;
using Kind = expr::Condition::Kind;

std::unique_ptr<const expr::Program> linked(const expr::Program& program, const Place& place,
                                            const hybrid::StateLayout& layout,
                                            const model::Stated& stated) {
  auto result = std::make_unique<const expr::Program>(stated.bodies.link(program));
  for (const expr::Input& input : result->inputs)
    if (!layout.moves(input.name) && !stated.values.contains(input.name))
      throw InputError(place, "there is no value for " + input.name);
  return result;
}

/// The variables that a program uses, at their places: no others need be copied at each point.
hybrid::StateLayout used_part(const hybrid::StateLayout& layout, const expr::Program& program) {
  hybrid::StateLayout used;
  used.size = layout.size;
  for (const hybrid::Slot& slot : layout.slots)
    if (program.uses(slot.name)) used.slots.push_back(slot);
  return used;
}

/// Of differences that may each be off by their spread.
Truth compare(Kind kind, const numbers::Matrix& difference, const numbers::Matrix& spread) {
  const auto d = difference.array();
  const auto s = spread.array();
  // d == 0 is certain only where nothing is rounded.
  if (kind == Kind::zero) {
    if ((d.abs() > s).any()) return Truth::no;
    return (s == 0).all() ? Truth::yes : Truth::unknown;
  }
  if (kind == Kind::positive) {
    if ((d <= -s).any()) return Truth::no;
    return (d > s).all() ? Truth::yes : Truth::unknown;
  }
  if ((d < -s).any()) return Truth::no;
  return (d >= s).all() ? Truth::yes : Truth::unknown;
}

}  // namespace

Text::Text(const expr::Program& program, const Place& place, const hybrid::StateLayout& layout,
           const model::Stated& stated)
    : program_(linked(program, place, layout, stated)),
      value_(hybrid::stacked({program_.get()}, used_part(layout, *program_), stated.values)) {
  for (const hybrid::Slot& slot : used_part(layout, *program_).slots)
    for (Eigen::Index i = 0; i < slot.shape.size(); ++i) elements_.push_back(slot.offset + i);
}

/// 2 evaluations for each variable that the text uses and that rounding moves.
numbers::Matrix Text::spread(const Eigen::VectorXd& x, const Eigen::VectorXd& rounding) {
  const numbers::Matrix here = value_.at(0, x);
  numbers::Matrix sum = numbers::Matrix::Zero(here.rows(), here.cols());
  Eigen::VectorXd moved = x;
  for (const Eigen::Index i : elements_) {
    if (!(rounding(i) > 0)) continue;
    numbers::Matrix most = sum * 0;
    for (const double side : {-1.0, 1.0}) {
      moved(i) = x(i) + side * rounding(i);
      most = most.cwiseMax((value_.at(0, moved) - here).cwiseAbs());
    }
    sum += most;
    moved(i) = x(i);
  }
  return sum;
}

Guard::Guard(const expr::Condition& condition, const hybrid::StateLayout& layout,
             const model::Stated& stated)
    : kind_(condition.kind) {
  if (condition.is_comparison())
    difference_.emplace(condition.difference, condition.place, layout, stated);
  for (const expr::Condition& part : condition.parts) parts_.emplace_back(part, layout, stated);
}

Guard Guard::negation(Guard guard) {
  Guard result(Kind::none);
  result.parts_.push_back(std::move(guard));
  return result;
}

bool Guard::operator()(const Eigen::VectorXd& x) {
  const auto holds = [&](Guard& part) { return part(x); };
  switch (kind_) {
    case Kind::positive:
      return ((*difference_)(x).array() > 0).all();
    case Kind::nonnegative:
      return ((*difference_)(x).array() >= 0).all();
    case Kind::zero:
      return ((*difference_)(x).array() == 0).all();
    case Kind::all:
      return std::all_of(parts_.begin(), parts_.end(), holds);
    case Kind::any:
      return std::any_of(parts_.begin(), parts_.end(), holds);
    case Kind::none:
      break;
  }
  return !parts_.front()(x);
}

/// Three values are ordered no < unknown < yes: `and` is the least, `or` the largest.
Truth Guard::truth(const Eigen::VectorXd& x, const Eigen::VectorXd& rounding) {
  if (difference_) return compare(kind_, (*difference_)(x), difference_->spread(x, rounding));
  if (kind_ == Kind::none) return opposite(parts_.front().truth(x, rounding));
  Truth result = kind_ == Kind::all ? Truth::yes : Truth::no;
  for (Guard& part : parts_) {
    const Truth one = part.truth(x, rounding);
    result = kind_ == Kind::all ? std::min(result, one) : std::max(result, one);
  }
  return result;
}

/// min over `and`, max over `or`, -depth of `not`; of d == 0 it is -|d|, which is never above 0.
double Guard::depth(const Eigen::VectorXd& x) {
  if (difference_) {
    const numbers::Matrix& difference = (*difference_)(x);
    if (difference.size() == 0) return HUGE_VAL;
    return kind_ == Kind::zero ? -difference.cwiseAbs().maxCoeff() : difference.minCoeff();
  }
  if (kind_ == Kind::none) return -parts_.front().depth(x);
  double result = kind_ == Kind::all ? HUGE_VAL : -HUGE_VAL;
  for (Guard& part : parts_) {
    const double one = part.depth(x);
    result = kind_ == Kind::all ? std::min(result, one) : std::max(result, one);
  }
  return result;
}

Texts::Texts(const Dynamics& dynamics_given, const model::Stated& stated_given,
             const Question& question_given)
    : dynamics(dynamics_given),
      stated(stated_given),
      question(question_given),
      layout(hybrid::layout_of(dynamics_given)) {
  for (const Dynamics::Assignment& entry : dynamics.flow)
    flow_.emplace_back(entry.variable, Text(entry.value.program, entry.place, layout, stated));
  for (const Dynamics::Component& component : dynamics.components) {
    frozen_.emplace_back();
    if (component.frozen) frozen_.back().emplace(*component.frozen, layout, stated);
    for (const Dynamics::Component::FlowSet& flow_set : component.flow_sets)
      flow_sets.push_back({Guard::negation(Guard(flow_set.where, layout, stated)), flow_set.say});
  }
  for (const Dynamics::Event& event : dynamics.events) events.push_back(event_texts(event));
  for (const Dynamics::Reaction& reaction : dynamics.reactions)
    reactions.push_back(reaction_texts(reaction));
  for (const Dynamics::Noise& one : dynamics.noise) noise.push_back(noise_range(one));
}

numbers::Matrix Texts::constant(const model::Formula& formula) const {
  const auto value = stated.value(formula.program);
  if (!value) throw InputError(formula.place, "'" + formula.text + "' has no value");
  return *value;
}

double Texts::scalar(const model::Formula& formula) const { return constant(formula)(0, 0); }

/// Without `first` the first occurrence has the range of the lengths.
EventTexts Texts::event_texts(const Dynamics::Event& event) const {
  EventTexts texts;
  if (event.condition) texts.condition.emplace(*event.condition, layout, stated);
  if (event.crossing)
    texts.crossing.emplace(event.crossing->program, event.crossing->place, layout, stated);
  if (event.only_if) texts.only_if.emplace(*event.only_if, layout, stated);
  if (event.low) texts.low = texts.high = scalar(*event.low);
  if (event.high) texts.high = scalar(*event.high);
  texts.first_low = texts.low;
  texts.first_high = texts.high;
  if (event.first_low) texts.first_low = texts.first_high = scalar(*event.first_low);
  if (event.first_high) texts.first_high = scalar(*event.first_high);
  if (event.low && question.drawn && question.drawn->campaign->first)
    texts.first_low = texts.first_high = scalar(*question.drawn->campaign->first);
  for (const model::Formula& formula : event.times) {
    const numbers::Matrix value = constant(formula);
    texts.times.insert(texts.times.end(), value.reshaped().begin(), value.reshaped().end());
  }
  texts.times.insert(texts.times.end(), event.rows.begin(), event.rows.end());
  std::sort(texts.times.begin(), texts.times.end());
  texts.times.erase(std::unique(texts.times.begin(), texts.times.end()), texts.times.end());
  return texts;
}

MapText Texts::map_text(const Dynamics::Assignment& entry) const {
  MapText text{entry.variable, {entry.value.program, entry.place, layout, stated}, std::nullopt};
  if (const auto terms = hybrid::rounding_terms(stated.bodies.link(entry.value.program)))
    text.terms.emplace(*terms, entry.place, layout, stated);
  return text;
}

ReactionTexts Texts::reaction_texts(const Dynamics::Reaction& reaction) const {
  ReactionTexts texts{reaction.event, reaction.component, {}};
  for (const Dynamics::Pass& pass : reaction.passes) {
    PassTexts pass_texts;
    for (const Dynamics::Assignment& entry : pass.map) pass_texts.map.push_back(map_text(entry));
    pass_texts.repeats = pass.repeats;
    if (pass.until) pass_texts.until.emplace(*pass.until, layout, stated);
    if (pass.at_most) pass_texts.at_most = std::llround(scalar(*pass.at_most));
    pass_texts.go_on = pass.go_on;
    texts.passes.push_back(std::move(pass_texts));
  }
  return texts;
}

/// The least and largest value of box, vertices or corners; 10 deviations around the center of
/// normal noise.
NoiseRange Texts::noise_range(const Dynamics::Noise& source) const {
  const auto fitted = [&](const model::Formula& formula) {
    const numbers::Matrix value = constant(formula);
    if (value.size() != 1) return value;
    return numbers::Matrix(
        numbers::Matrix::Constant(source.shape.rows, source.shape.cols, value(0, 0)));
  };
  NoiseRange range;
  if (source.every) range.every = scalar(*source.every);
  if (!source.has_center()) {
    range.low = range.high = fitted(source.values[0]);
    for (const model::Formula& formula : source.values) {
      range.low = range.low.cwiseMin(fitted(formula));
      range.high = range.high.cwiseMax(fitted(formula));
    }
    return range;
  }
  // A draw from 53 random bits lies within 8.6 deviations; sums and exponentials have no range.
  const numbers::Matrix center = fitted(source.values[0]);
  numbers::Matrix reach = numbers::Matrix::Constant(center.rows(), center.cols(), HUGE_VAL);
  if (source.kind == Dynamics::NoiseKind::normal && !source.covariance)
    reach = 10 * fitted(source.values[1]).cwiseAbs();
  range.low = center - reach;
  range.high = center + reach;
  return range;
}

std::vector<bool> Texts::flowing(const Eigen::VectorXd& x) {
  std::vector<bool> frozen;
  for (auto& condition : frozen_) frozen.push_back(condition && (*condition)(x));
  std::vector<bool> result(dynamics.variables.size(), false);
  for (const auto& [variable, text] : flow_)
    result[variable] = !is(variable, Dynamics::VariableKind::state) ||
                       !frozen[dynamics.variables[variable].component];
  return result;
}

void Texts::rate(const Eigen::VectorXd& x, Eigen::VectorXd& out) {
  set_rate(x, out, [&](Text& text) -> const numbers::Matrix& { return text(x); });
}

void Texts::compiled_rate(const Eigen::VectorXd& x, Eigen::VectorXd& out) {
  set_rate(x, out, [&](Text& text) -> const numbers::Matrix& { return text.compiled(x); });
}

template <class Value>
void Texts::set_rate(const Eigen::VectorXd& x, Eigen::VectorXd& out, const Value& value_of) {
  using V = Dynamics::VariableKind;
  out.setZero(layout.size);
  const std::vector<bool> flows = flowing(x);
  for (auto& [variable, text] : flow_) {
    if (!flows[variable]) continue;
    numbers::Matrix value = value_of(text);
    if (dynamics.variables[variable].structure == model::Structure::symmetric)
      make_symmetric(value);
    part(out, variable) = value.reshaped();
  }
  for (std::size_t v = 0; v < dynamics.variables.size(); ++v) {
    if (is(v, V::time) || is(v, V::since)) part(out, v).setOnes();
    if (is(v, V::left)) part(out, v).setConstant(-1);
  }
}

bool Texts::changes_inside(std::size_t variable) const {
  if (is_measured(variable)) return true;
  if (!is(variable, Dynamics::VariableKind::noise)) return false;
  const Dynamics::Noise& one = dynamics.noise[dynamics.variables[variable].of];
  return one.every || (one.event && dynamics.events[*one.event].only_if);
}

void Texts::settle(const Eigen::VectorXd& start, Eigen::VectorXd& x) {
  using V = Dynamics::VariableKind;
  const std::vector<bool> flows = flowing(start);
  for (std::size_t v = 0; v < dynamics.variables.size(); ++v) {
    const bool is_clock = is(v, V::time) || is(v, V::since) || is(v, V::left);
    if (!flows[v] && !is_clock && !changes_inside(v)) part(x, v) = part(start, v);
  }
}

Eigen::VectorXd Texts::by_variable(const Eigen::VectorXd& sizes) const {
  Eigen::VectorXd result = sizes;
  for (const hybrid::Slot& slot : layout.slots)
    if (slot.shape.size() > 0)
      result.segment(slot.offset, slot.shape.size())
          .setConstant(sizes.segment(slot.offset, slot.shape.size()).maxCoeff());
  return result;
}

std::optional<std::size_t> Texts::find(Dynamics::VariableKind kind, std::size_t of) const {
  for (std::size_t v = 0; v < dynamics.variables.size(); ++v)
    if (is(v, kind) && dynamics.variables[v].of == of) return v;
  return std::nullopt;
}

std::optional<numbers::Matrix> Texts::start(std::size_t variable, const Eigen::VectorXd& x) const {
  const auto& formula = dynamics.variables[variable].start;
  if (!formula) return std::nullopt;
  return Text(formula->program, formula->place, layout, stated)(x);
}

void make_symmetric(numbers::Matrix& value) {
  value = numbers::Matrix(0.5 * (value + value.transpose()));
}

}  // namespace gainsmith::judge
