#include "hybrid/doubts.h"

#include <algorithm>
#include <optional>
#include <set>

#include "base/number.h"
#include "expr/program/evaluate.h"
#include "numbers/dense/dense.h"

namespace gainsmith::hybrid {

namespace {

using model::Dynamics;

bool reads(const expr::Condition& condition, const std::string& name) {
  return condition.difference.uses(name) ||
         std::ranges::any_of(condition.parts, [&](const auto& part) { return reads(part, name); });
}

bool reads(const Dynamics::Reaction& reaction, const std::string& name) {
  return std::ranges::any_of(reaction.passes, [&](const auto& pass) {
    return std::ranges::any_of(pass.map,
                               [&](const auto& one) { return one.value.program.uses(name); });
  });
}

bool reads(const Dynamics::Event& event, const std::string& name) {
  return (event.condition && reads(*event.condition, name)) ||
         (event.only_if && reads(*event.only_if, name)) ||
         (event.crossing && event.crossing->program.uses(name));
}

/// How often an operand of the program is an input; in a sum with a matrix, for each element.
std::ptrdiff_t uses(const expr::Program& program, const std::string& name) {
  std::ptrdiff_t count = 0;
  for (std::size_t at = 0; at < program.code.size(); ++at) {
    const expr::Instruction& instruction = program.code[at];
    if (instruction.op != expr::Op::input || program.input_of(instruction).name != name) continue;
    for (const expr::Instruction& user : program.code)
      count += std::count(user.operands.begin(), user.operands.end(), static_cast<int>(at)) *
               (user.op == expr::Op::fill ? user.shape.size() : 1);
  }
  return count;
}

/// Who reads a noise.
class Readers {
 public:
  Readers(const Dynamics& dynamics, const std::string& name) : dynamics_(dynamics), name_(name) {}

  /// Whether an initial value reads it.
  bool starts() const {
    return std::ranges::any_of(dynamics_.variables, [&](const auto& one) {
      return one.start && one.start->program.uses(name_);
    });
  }
  /// Whether a rate of the plant or of an observer reads it.
  bool flows() const {
    return std::ranges::any_of(dynamics_.flow,
                               [&](const auto& one) { return one.value.program.uses(name_); });
  }
  /// The events whose maps read it.
  std::vector<std::size_t> events() const {
    std::set<std::size_t> found;
    for (const Dynamics::Reaction& reaction : dynamics_.reactions)
      if (reads(reaction, name_)) found.insert(reaction.event);
    return {found.begin(), found.end()};
  }
  /// Whether an event reads it in `when`, `if` or a crossing.
  bool conditions() const {
    return std::ranges::any_of(dynamics_.events,
                               [&](const auto& event) { return reads(event, name_); });
  }
  std::vector<const Dynamics::Signal*> outputs() const {
    std::vector<const Dynamics::Signal*> found;
    for (const Dynamics::Signal& signal : dynamics_.signals)
      if (signal.output && signal.value.program.uses(name_)) found.push_back(&signal);
    return found;
  }
  /// Whether a flow or a map of an observer reads it, or the condition of an event with such a map.
  bool observers() const {
    const auto observes = [&](std::size_t component) {
      return dynamics_.components[component].observer;
    };
    const auto flows = [&](const Dynamics::Assignment& assignment) {
      return observes(dynamics_.variables[assignment.variable].component) &&
             assignment.value.program.uses(name_);
    };
    return std::ranges::any_of(dynamics_.flow, flows) ||
           std::ranges::any_of(dynamics_.reactions, [&](const auto& one) {
             return observes(one.component) &&
                    (reads(one, name_) || reads(dynamics_.events[one.event], name_));
           });
  }
  bool any() const {
    return starts() || flows() || !events().empty() || conditions() || !outputs().empty();
  }

 private:
  const Dynamics& dynamics_;
  const std::string& name_;
};

using VariableKind = Dynamics::VariableKind;

std::string quoted(const std::string& name) { return "'" + name + "'"; }

/// One sentence for each thing that is allowed and probably not meant. It judges the texts and the
/// constants alone, and runs nothing.
class Doubts {
 public:
  Doubts(const Dynamics& dynamics, const numbers::Values& constants)
      : dynamics_(dynamics), constants_(constants) {}

  std::vector<std::string> all(const std::vector<model::Design::Claim>& claims) {
    about_observers();
    for (const model::Design::Claim& claim : claims) about(claim);
    for (const Dynamics::Noise& noise : dynamics_.noise) about(noise);
    return std::move(found_);
  }

 private:
  /// Observers that never change, events whose loss changes nothing, observers without an output.
  void about_observers() {
    std::vector<char> has_states(dynamics_.components.size(), 0), changes(has_states);
    for (const Dynamics::Variable& variable : dynamics_.variables)
      if (is_own(variable)) has_states[variable.component] = 1;
    for (const Dynamics::Assignment& flow : dynamics_.flow)
      changes[dynamics_.variables[flow.variable].component] = 1;
    for (const Dynamics::Reaction& reaction : dynamics_.reactions) changes[reaction.component] = 1;
    for (std::size_t k = 0; k < dynamics_.components.size(); ++k) {
      const Dynamics::Component& component = dynamics_.components[k];
      if (component.observer && has_states[k] != 0 && changes[k] == 0)
        found_.push_back((component.name == "observer" ? "the observer"
                                                       : "the observer " + quoted(component.name)) +
                         " never changes: it has no flow, and no map at an event");
    }
    for (std::size_t k = 0; k < dynamics_.events.size(); ++k)
      if (dynamics_.events[k].lost > 0 &&
          std::ranges::none_of(dynamics_.reactions, [&](const Dynamics::Reaction& reaction) {
            return reaction.event == k && dynamics_.components[reaction.component].observer;
          }))
        found_.push_back("the event " + quoted(dynamics_.events[k].name) +
                         " may be lost, and no observer has a map there: a loss changes nothing");
    if (std::any_of(dynamics_.components.begin(), dynamics_.components.end(),
                    [](const auto& one) { return one.observer; }) &&
        has_states[0] != 0 && !observers_read_plant())
      found_.push_back("no observer reads the plant: their estimates do not depend on an output");
  }

  bool observers_read_plant() const {
    return std::ranges::any_of(dynamics_.variables, [&](const auto& one) {
      const bool of_plant =
          one.kind == VariableKind::measured || (is_own(one) && one.component == 0);
      return of_plant && Readers(dynamics_, one.name).observers();
    });
  }

  static bool is_own(const Dynamics::Variable& variable) {
    return variable.kind == VariableKind::state || variable.kind == VariableKind::mode;
  }

  /// A `shrinks` whose factor exceeds 1.
  void about(const model::Design::Claim& claim) {
    if (const auto factor = value_of(claim.factor); factor && (*factor)(0, 0) > 1)
      found_.push_back("the claim " + quoted(claim.name) + " lets a value above 0 grow: `to` is " +
                       brief((*factor)(0, 0)));
  }

  /// None where the formula is not of constants.
  std::optional<numbers::Matrix> value_of(const std::optional<model::Formula>& formula) const {
    const auto is_known = [&](const auto& one) { return constants_.contains(one.name); };
    if (!formula || !formula->program.functions.empty() ||
        !std::ranges::all_of(formula->program.inputs, is_known))
      return std::nullopt;
    try {
      return numbers::evaluate(formula->program, constants_);
    } catch (const expr::EvaluationError&) {
      return std::nullopt;
    }
  }

  /// As it is written: a datum that is 0 is meant.
  bool is_zero(const model::Formula& formula) const {
    const auto value = value_of(formula);
    return value && value->isZero(0) && formula.program.inputs.empty();
  }

  /// A name `plant.p` is an uncertain datum p. Any other name is noise: constant 0, drawn once and
  /// so a bias, older than the sample that reads it, or shared by outputs.
  void about(const Dynamics::Noise& noise) {
    const std::string& name = noise.name;
    const Readers readers(dynamics_, name);
    if (name.starts_with("plant.")) {
      const std::string datum = name.substr(std::string("plant.").size());
      if (!readers.any())
        found_.push_back("uncertain: the plant does not read " + quoted(datum) +
                         ", so its runs are as without it; data that are computed from it are "
                         "uncertain where they are texts");
      else if (readers.observers())
        found_.push_back("an observer reads " + quoted(name) +
                         ", the value in the plant, which it cannot know; it knows " +
                         quoted(datum));
      about_range(noise, datum);
      return;
    }
    // Amplitudes and frequencies of a sinusoid are drawn once by their meaning.
    if (name.find('.') != std::string::npos) return;
    if (std::ranges::all_of(noise.values, [&](const auto& formula) { return is_zero(formula); }))
      found_.push_back("the noise " + quoted(name) + " is always 0");
    const bool random = noise.has_center() || noise.kind == Dynamics::NoiseKind::uniform;
    const std::vector<std::size_t> events = readers.events();
    if (!noise.event && !noise.every) {
      const bool is_bias = noise.kind == Dynamics::NoiseKind::normal && !readers.outputs().empty();
      if (random && !readers.starts() && (is_bias || !events.empty()))
        found_.push_back("the noise " + quoted(name) + " is drawn once a run, so it is a bias: `" +
                         (events.empty() ? "every: 0.01` draws it anew after each such time"
                                         : "new at: " + dynamics_.events[events[0]].name +
                                               "` draws it anew at each event") +
                         "; a bias that is meant is a state that starts at random");
      return;
    }
    if (!random) return;
    about_samples(noise, events);
    about_outputs(noise, readers.outputs());
  }

  /// Of a datum between low and high.
  void about_range(const Dynamics::Noise& noise, const std::string& datum) {
    const auto known = constants_.find(datum);
    if (noise.values.size() != 2 || noise.has_center() || known == constants_.end()) return;
    const auto low = value_of(noise.values[0]), high = value_of(noise.values[1]);
    if (!low || !high) return;
    if (*low == *high)
      found_.push_back("uncertain: " + quoted(datum) + " has no range, as low is high");
    else if (low->size() == 1 && known->second.size() == 1 &&
             (known->second(0, 0) < (*low)(0, 0) || known->second(0, 0) > (*high)(0, 0)))
      found_.push_back("uncertain: " + quoted(datum) + " is " + brief(known->second(0, 0)) +
                       ", outside of its range [" + brief((*low)(0, 0)) + ", " +
                       brief((*high)(0, 0)) + "], which is of the value, not of a factor");
  }

  /// Of a noise that several samples in a row may have in common.
  void about_samples(const Dynamics::Noise& noise, const std::vector<std::size_t>& events) {
    const auto lasts = value_of(noise.every ? noise.every : dynamics_.events[*noise.event].low);
    for (const std::size_t at : events) {
      const Dynamics::Event& event = dynamics_.events[at];
      const auto next = value_of(event.high);
      if (noise.event == at || !lasts || !next || (*next)(0, 0) >= (*lasts)(0, 0)) continue;
      found_.push_back(
          "the noise " + quoted(noise.name) + " is drawn anew after " + brief((*lasts)(0, 0)) +
          ", and the event " + quoted(event.name) + " reads it after " + brief((*next)(0, 0)) +
          " at the latest: several of them have the same error; `new at: " + event.name +
          "` gives each its own");
    }
  }

  /// Of a scalar noise in several outputs, or in several elements of one: their errors have
  /// correlation 1.
  void about_outputs(const Dynamics::Noise& noise,
                     const std::vector<const Dynamics::Signal*>& outputs) {
    if (!noise.shape.is_scalar() || outputs.empty()) return;
    std::string where;
    if (outputs.size() > 1)
      where = "the outputs " + quoted(outputs[0]->name) + " and " + quoted(outputs[1]->name);
    else if (!outputs[0]->value.program.shape().is_scalar() &&
             uses(outputs[0]->value.program, noise.name) > 1)
      where = "several elements of the output " + quoted(outputs[0]->name);
    if (!where.empty())
      found_.push_back(where + " have the same noise " + quoted(noise.name) +
                       ", so their errors are equal: give each a noise of its own");
  }

  const Dynamics& dynamics_;
  const numbers::Values& constants_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> doubts_about(const Dynamics& dynamics,
                                      const std::vector<model::Design::Claim>& claims,
                                      const numbers::Values& constants) {
  return Doubts(dynamics, constants).all(claims);
}

}  // namespace gainsmith::hybrid
