// What the writers share: the order of maps, parameters for the inputs that a map reads, units, and
// the constant part of a linear flow.
#include "export/observer_writer.h"

#include <algorithm>

#include "expr/binding/substitute.h"
#include "expr/program/rewrite.h"

namespace gainsmith::exports {

void Remarks::add(const Code& code) {
  helpers.insert(code.helpers.begin(), code.helpers.end());
  library = library || code.library;
}

std::string ObserverWriter::attempt(const std::string& what,
                                    const std::function<std::string()>& map,
                                    const std::string& consequence) {
  try {
    return map();
  } catch (const NoCode& none) {
    remarks_.notes.push_back("observer " + observer_.name + ": " + what +
                             " is left out: " + none.what() + consequence);
    return "";
  }
}

std::string ObserverWriter::maps() {
  std::string text;
  if (!observer_.rate.empty()) {
    text += attempt(
        "the flow", [&] { return rate(); }, kWithoutFlow);
    if (observer_.linear) text += attempt("the exact flow", [&] { return flow(); });
  }
  for (const Jump& one : observer_.jumps)
    text += attempt(
        "the map at " + one.event, [&] { return jump(one); }, kWithoutJump);
  for (const Output& one : observer_.outputs)
    text += attempt("the output " + one.name, [&] { return output(one); });
  return text;
}

Code ObserverWriter::code(const std::vector<expr::Program>& programs) {
  Code made = scalar_code(programs, names_, content_.values, dialect_);
  remarks_.add(made);
  return made;
}

std::vector<expr::Program> ObserverWriter::programs_of(const std::vector<Assigned>& list) {
  std::vector<expr::Program> programs;
  for (const Assigned& assigned : list) programs.push_back(assigned.value);
  return programs;
}

std::vector<expr::Program> ObserverWriter::programs_of(const Jump& jump) {
  std::vector<expr::Program> programs;
  for (const auto& pass : jump.passes)
    for (const Assigned& assigned : pass) programs.push_back(assigned.value);
  return programs;
}

std::vector<const Variable*> ObserverWriter::inputs_read(
    const std::vector<expr::Program>& programs) const {
  std::vector<const Variable*> read;
  for (const Variable& input : observer_.inputs)
    if (std::any_of(programs.begin(), programs.end(),
                    [&](const expr::Program& program) { return program.uses(input.key); }))
      read.push_back(&input);
  return read;
}

std::string ObserverWriter::parameter_names(const std::vector<expr::Program>& programs) const {
  std::string text;
  for (const Variable* input : inputs_read(programs)) text += ", " + parameters_.at(input->key);
  return text;
}

std::string ObserverWriter::units_text(const std::vector<const Variable*>& inputs,
                                       const std::string& time) const {
  std::string text;
  const auto add = [&](const std::string& name, const std::string& unit) {
    if (!unit.empty()) text += (text.empty() ? " Units: " : ", ") + name + " [" + unit + "]";
  };
  for (const Variable* input : inputs) add(parameters_.at(input->key), input->unit);
  if (!time.empty()) add(time, content_.time_unit);
  return text.empty() ? text : text + ".";
}

std::vector<expr::Program> ObserverWriter::rate_at_rest() const {
  // f(0, inputs) is c where the rate is affine: x' = M x + c.
  expr::Replacements zero;
  for (const State& state : observer_.states) {
    expr::Composer compose({});
    zero.inputs.emplace(state.key, compose.take(compose.apply(expr::Op::zeros, {}, state.shape)));
  }
  std::vector<expr::Program> rates;
  for (const Assigned& assigned : observer_.rate)
    rates.push_back(expr::substitute(assigned.value, zero));
  return rates;
}

std::vector<std::pair<int, std::string>> ObserverWriter::nonzero_elements(const Code& made) const {
  std::vector<std::pair<int, std::string>> elements;
  for (std::size_t k = 0; k < observer_.rate.size(); ++k) {
    int at = 0;
    for (std::size_t s = 0; s < observer_.rate[k].state; ++s)
      at += observer_.states[s].shape.size();
    for (const std::string& value : made.results[k]) {
      if (value != number_text(0, dialect_)) elements.emplace_back(at, value);
      ++at;
    }
  }
  return elements;
}

}  // namespace gainsmith::exports
