// Content of an export: which maps of a bound design are functions of one observer's states and of
// its inputs.
//
// A map that reads the state of another component is left out with a note, unless that state enters
// through an output of the plant: such a signal becomes an input.
#include "export/content.h"

#include <algorithm>
#include <utility>

#include "base/hash.h"
#include "base/named.h"
#include "export/shared_text.h"
#include "expr/binding/substitute.h"
#include "model/estimate_name.h"
#include "numbers/types/degree.h"

namespace gainsmith::exports {

namespace {

using model::Dynamics;
using Kind = Dynamics::VariableKind;

/// "xh" of "nominal.xh" for the component nominal.
std::string own_name(const std::string& component, const std::string& name) {
  const std::string prefix = component + ".";
  return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
}

/// "u" of "u of nominal".
std::string signal_name(const std::string& component, const std::string& name) {
  const std::string ending = " of " + component;
  return name.ends_with(ending) ? name.substr(0, name.size() - ending.size())
                                : own_name(component, name);
}

/// Whether a component owns the variable: its states and modes.
bool is_own(Kind kind) { return kind == Kind::state || kind == Kind::mode; }

/// "rad, rad/s" of the first of the names that has units for such a shape; empty: none has.
std::string unit_text(const Units& units, const std::vector<std::string>& names,
                      expr::Shape shape) {
  for (const std::string& name : names) {
    const auto found = units.find(name);
    if (found == units.end()) continue;
    const std::vector<std::string>& each = found->second;
    if (each.size() != 1 && each.size() != static_cast<std::size_t>(shape.size())) continue;
    std::string list;
    for (const std::string& unit : each) list += (list.empty() ? "" : ", ") + unit;
    return comment_text(list);
  }
  return "";
}

/// A map that is left out, and why.
struct LeftOut {
  std::string why;
};

/// Adds one observer after the other. Signals that depend on the plant alone are `measured_`:
/// programs that contain them read them by name instead of the plant's states.
class Collector {
 public:
  Collector(const model::RunTexts& texts, const Units& units, Content& content)
      : dynamics_(texts.dynamics), values_(texts.stated.values), units_(units), content_(content) {
    for (const Dynamics::Variable& variable : dynamics_.variables)
      variables_[variable.name] = &variable;
    for (const Dynamics::Signal& signal : dynamics_.signals)
      if (is_measured(signal.value.program))
        measured_.emplace_back(signal.name, signal.value.program);
  }

  /// The observer of a component; none where it has no state.
  void add(std::size_t component) {
    observer_ = {};
    place_.clear();
    component_ = component;
    observer_.name = dynamics_.components[component].name;
    add_states();
    if (observer_.states.empty()) return;
    add_rate();
    for (const Dynamics::Reaction& reaction : dynamics_.reactions)
      if (reaction.component == component_)
        attempt(
            "the map at " + dynamics_.events[reaction.event].name, [&] { add_jump(reaction); },
            kWithoutJump);
    for (const Dynamics::Signal& signal : dynamics_.signals) add_output(signal);
    content_.observers.push_back(std::move(observer_));
  }

 private:
  /// Whether a signal depends on what moves, and on no observer.
  bool is_measured(const expr::Program& program) const {
    bool moves = false;
    for (const expr::Input& input : program.inputs) {
      const auto found = variables_.find(input.name);
      if (found == variables_.end()) continue;
      moves = true;
      if (is_own(found->second->kind) && dynamics_.components[found->second->component].observer)
        return false;
    }
    return moves;
  }

  /// Does the work, or undoes what it added to the observer and notes why: maps are all or nothing.
  template <class Work>
  void attempt(const std::string& what, const Work& work, const std::string& consequence) {
    const Observer before = observer_;
    try {
      work();
    } catch (const LeftOut& left) {
      observer_ = before;
      content_.notes.push_back("observer " + observer_.name + ": " + what +
                               " is left out: " + left.why + consequence);
    }
  }

  /// The unit of a quantity of the observer. An estimate without one has that of what it estimates.
  std::string unit_of(const std::string& key, const std::string& name, expr::Shape shape) const {
    std::vector<std::string> names = {key, observer_.name + "." + name, name};
    const auto add_estimated = [&](const std::string& what) {
      if (model::is_estimate_name(name, what)) names.push_back(what);
    };
    for (const Dynamics::Variable& variable : dynamics_.variables)
      if (is_own(variable.kind) && !dynamics_.components[variable.component].observer)
        add_estimated(variable.name);
    for (const auto& [measured, program] : measured_) add_estimated(measured);
    return unit_text(units_, names, shape);
  }

  /// The states of the component that have elements. A start that needs what is drawn is 0.
  void add_states() {
    for (std::size_t k = 0; k < dynamics_.variables.size(); ++k) {
      const Dynamics::Variable& variable = dynamics_.variables[k];
      if (!is_own(variable.kind) || variable.component != component_ || variable.shape.size() == 0)
        continue;
      place_[k] = observer_.states.size();
      const std::string name = own_name(observer_.name, variable.name);
      numbers::Matrix start = numbers::Matrix::Zero(variable.shape.rows, variable.shape.cols);
      if (variable.start && model::has_values(variable.start->program, values_))
        start = numbers::evaluate(variable.start->program, values_);
      observer_.states.push_back(
          {{variable.name, name, variable.shape, unit_of(variable.name, name, variable.shape)},
           std::move(start)});
    }
  }

  bool is_state(const std::string& key) const {
    return std::any_of(observer_.states.begin(), observer_.states.end(),
                       [&](const State& state) { return state.key == key; });
  }

  /// The program over states and inputs; its inputs are added to those of the observer.
  expr::Program taken(const expr::Program& program) {
    expr::Program made = expr::with_inputs(program, measured_);
    for (const expr::Input& input : made.inputs) {
      if (is_state(input.name) || input.shape.size() == 0) continue;
      const auto variable = variables_.find(input.name);
      const bool named = std::any_of(measured_.begin(), measured_.end(),
                                     [&](const auto& one) { return one.first == input.name; });
      if (!named && variable == variables_.end()) continue;  // a number
      if (!named && is_own(variable->second->kind))
        throw LeftOut{"it reads " + input.name + ", which is no output of the plant"};
      if (std::none_of(observer_.inputs.begin(), observer_.inputs.end(),
                       [&](const Variable& known) { return known.key == input.name; })) {
        const std::string name = signal_name(observer_.name, input.name);
        observer_.inputs.push_back(
            {input.name, name, input.shape, unit_of(input.name, name, input.shape)});
      }
    }
    return made;
  }

  /// The rate of each state that flows. States that a mode freezes have no rate by one formula.
  void add_rate() {
    attempt(
        "the flow",
        [&] {
          if (dynamics_.components[component_].frozen)
            throw LeftOut{"`frozen` stops it for some modes"};
          for (const Dynamics::Assignment& assignment : dynamics_.flow)
            if (const auto place = place_.find(assignment.variable); place != place_.end())
              observer_.rate.push_back({place->second, taken(assignment.value.program)});
          observer_.linear = linear_flow();
        },
        kWithoutFlow);
  }

  /// Whether an input keeps its value while it is held: the time and what follows it do not.
  bool can_be_held(const std::string& key) const {
    const auto found = variables_.find(key);
    if (found == variables_.end()) return true;
    const Kind kind = found->second->kind;
    return kind != Kind::time && kind != Kind::since && kind != Kind::left;
  }

  /// Formula (1) of content.h applies where every rate is affine in states and inputs together, and
  /// where no input runs with time. None otherwise.
  std::optional<LinearFlow> linear_flow() const {
    if (observer_.rate.empty()) return std::nullopt;
    const auto moves = [&](const std::string& key) {
      return is_state(key) ||
             std::any_of(observer_.inputs.begin(), observer_.inputs.end(),
                         [&](const Variable& variable) { return variable.key == key; });
    };
    for (const Assigned& assigned : observer_.rate) {
      // The degree in states and inputs together: x u is not affine, though it is so in x.
      const auto degrees = numbers::degrees(assigned.value, moves);
      if (degrees[static_cast<std::size_t>(assigned.value.result)] >= numbers::kNotAffine)
        return std::nullopt;
    }
    for (const Variable& input : observer_.inputs)
      if (!can_be_held(input.key)) return std::nullopt;
    return LinearFlow{matrix()};
  }

  /// The rate of all elements with the states as they are in `at`.
  numbers::Vector rate_at(const numbers::Values& at) const {
    numbers::Vector rate = numbers::Vector::Zero(observer_.size());
    for (const Assigned& assigned : observer_.rate) {
      Eigen::Index first = 0;
      for (std::size_t k = 0; k < assigned.state; ++k) first += observer_.states[k].shape.size();
      const numbers::Matrix value = numbers::evaluate(assigned.value, at);
      rate.segment(first, value.size()) = value.reshaped();
    }
    return rate;
  }

  /// M of x' = M x + c, n x n: column k is rate(e_k) - rate(0) with all inputs 0. The difference is
  /// exact up to rounding because the rate is affine.
  numbers::Matrix matrix() const {
    numbers::Values at = values_;
    const auto zero = [](expr::Shape shape) {
      return numbers::Matrix(numbers::Matrix::Zero(shape.rows, shape.cols));
    };
    for (const State& state : observer_.states) at[state.key] = zero(state.shape);
    for (const Variable& input : observer_.inputs) at[input.key] = zero(input.shape);
    // c with the inputs 0, which every column has to lose.
    const numbers::Vector still = rate_at(at);
    numbers::Matrix M(observer_.size(), observer_.size());
    Eigen::Index column = 0;
    for (const State& state : observer_.states)
      for (int k = 0; k < state.shape.size(); ++k) {
        at[state.key](k) = 1;
        M.col(column++) = rate_at(at) - still;
        at[state.key](k) = 0;
      }
    return M;
  }

  /// x+ = g(x, inputs) in passes. A loop with `until` has no fixed number of passes: it is left
  /// out.
  void add_jump(const Dynamics::Reaction& reaction) {
    const Dynamics::Event& event = dynamics_.events[reaction.event];
    Jump jump{comment_text(own_name(observer_.name, event.name)), {}, period_of(event)};
    for (const Dynamics::Pass& pass : reaction.passes) {
      if (pass.repeats) throw LeftOut{"it is a loop"};
      jump.passes.emplace_back();
      for (const Dynamics::Assignment& assignment : pass.map)
        if (const auto place = place_.find(assignment.variable); place != place_.end())
          jump.passes.back().push_back({place->second, taken(assignment.value.program)});
    }
    observer_.jumps.push_back(std::move(jump));
  }

  /// The time between two occurrences, where both ends of its range are the same number above 0.
  std::optional<double> period_of(const Dynamics::Event& event) const {
    const auto value = [&](const std::optional<model::Formula>& end) -> std::optional<double> {
      if (!end || !model::has_values(end->program, values_)) return std::nullopt;
      return model::scalar_value(*end, values_);
    };
    const auto low = value(event.low);
    return low && *low > 0 && low == value(event.high) ? low : std::nullopt;
  }

  /// Outputs and signals that states and inputs give.
  void add_output(const Dynamics::Signal& signal) {
    const Observer before = observer_;
    try {
      expr::Program program = taken(signal.value.program);
      // An output of inputs alone, or of another component, is none of this observer.
      const bool reads_states =
          std::any_of(program.inputs.begin(), program.inputs.end(),
                      [&](const expr::Input& input) { return is_state(input.name); });
      if (!reads_states) throw LeftOut{};
      const std::string name = signal_name(observer_.name, signal.name);
      const expr::Shape shape = program.shape();
      observer_.outputs.push_back({name, std::move(program), unit_of(signal.name, name, shape)});
    } catch (const LeftOut&) {
      observer_ = before;  // it is none of this observer
    }
  }

  const Dynamics& dynamics_;
  const numbers::Values& values_;
  const Units& units_;
  Content& content_;
  std::map<std::string, const Dynamics::Variable*, std::less<>> variables_;
  std::vector<std::pair<std::string, expr::Program>> measured_;
  std::size_t component_ = 0;
  std::map<std::size_t, std::size_t> place_;  ///< of a variable among the states
  Observer observer_;
};

}  // namespace

int Observer::size() const {
  int size = 0;
  for (const State& state : states) size += state.shape.size();
  return size;
}

std::vector<GainMatrix> matrices_of(const model::Gains& gains, std::vector<std::string>& notes) {
  std::vector<GainMatrix> matrices;
  for (const auto& [name, value] : gains.gains) matrices.push_back({name, value});
  for (const model::GainFunction& gain : gains.gain_functions) {
    for (std::size_t k = 0; k < gain.coefficients.size(); ++k)
      matrices.push_back({model::coefficient_name(gain.name, k), gain.coefficients[k]});
    if (gain.coefficients.empty())
      notes.push_back("the gain " + gain.name + "(" + gain.variable + ") = " + gain.formula +
                      " is a formula, no matrix: c, matlab and python have it as a function");
  }
  return matrices;
}

Content content_of(const model::Gains& gains, const model::Design& design,
                   const model::Stated& stated, const std::optional<model::RunTexts>& texts,
                   const std::string& file_text, const Units& units) {
  Content content;
  content.problem = gains.problem_name;
  content.method = gains.statement.method_name;
  content.version = gains.version;
  content.statement_hash = gains.statement.hash;
  content.file_hash = sha256(file_text);
  content.margins = gains.margins;
  content.values = stated.values;
  for (const auto& [name, value] : gains.gains) content.gains.push_back({name, value});
  for (const model::Design::Gain& gain : design.gains) {
    const model::GainFunction* function = find_named(gains.gain_functions, gain.name);
    if (function == nullptr) continue;
    if (gain.shape.size() == 0) {
      content.notes.push_back("the gain " + gain.name + " has no elements and is left out");
      continue;
    }
    const expr::Body& body = stated.bodies.body(gain.name, {});
    content.functions.push_back({gain.name, body.variable, stated.bodies.link(body.program),
                                 comment_text(function->formula)});
  }
  if (!texts) return content;
  content.time_unit = unit_text(units, {"t"}, {1, 1});
  Collector collector(*texts, units, content);
  for (std::size_t k = 0; k < texts->dynamics.components.size(); ++k)
    if (texts->dynamics.components[k].observer) collector.add(k);
  return content;
}

}  // namespace gainsmith::exports
