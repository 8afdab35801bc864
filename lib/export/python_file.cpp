#include <fmt/format.h>

#include <utility>

#include "export/files.h"
#include "export/shared_text.h"

namespace gainsmith::exports {

namespace {

const Dialect kPython{Language::python, false, ""};

std::string array_text(const numbers::Matrix& value) {
  if (value.size() == 0) return fmt::format("np.zeros(({}, {}))", value.rows(), value.cols());
  std::string text = "np.array([";
  for (Eigen::Index i = 0; i < value.rows(); ++i) {
    text += i > 0 ? ", [" : "[";
    for (Eigen::Index j = 0; j < value.cols(); ++j)
      text += (j > 0 ? ", " : "") + number_text(value(i, j), kPython);
    text += "]";
  }
  return text + "])";
}

/// Numbers are numbers, rows and columns one-dimensional arrays.
std::vector<std::string> python_elements(const std::string& name, expr::Shape shape) {
  return elements_of(shape, [&](int row, int column) {
    if (shape.is_scalar()) return name;
    if (shape.rows == 1 || shape.cols == 1) return fmt::format("{}[{}]", name, row + column);
    return fmt::format("{}[{}, {}]", name, row, column);
  });
}

/// The same from its elements, column by column.
std::string value_text(const std::vector<std::string>& elements, expr::Shape shape) {
  if (shape.is_scalar()) return elements[0];
  std::string list;
  for (const std::string& element : elements) list += (list.empty() ? "" : ", ") + element;
  if (shape.rows == 1 || shape.cols == 1) return "np.array([" + list + "], dtype=float)";
  return fmt::format("np.array([{}], dtype=float).reshape(({}, {}), order='F')", list, shape.rows, shape.cols);
}

class PythonObserver {
 public:
  PythonObserver(const Content& content, const Observer& observer, std::string name,
                 std::set<std::string>& helpers, std::vector<std::string>& notes)
      : content_(content),
        observer_(observer),
        name_(std::move(name)),
        helpers_(helpers),
        notes_(notes),
        members_(Language::python, {"rate", "flow"}) {
    for (const State& state : observer.states) {
      fields_.push_back(members_(state.name));
      names_[state.key] = python_elements("self." + fields_.back(), state.shape);
    }
    Identifiers parameters(Language::python, {"dt", "z", "c", "d", "M", "h", "steps", "k"});
    for (const Variable& input : observer.inputs) {
      parameters_[input.key] = parameters(input.name);
      names_[input.key] = python_elements(parameters_[input.key], input.shape);
    }
  }

  std::string text() {
    std::string text = fmt::format("class {}:\n    \"\"\"The observer {}.\"\"\"\n\n    def __init__(self):\n", name_,
                                   observer_.name);
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const State& state = observer_.states[k];
      std::vector<std::string> start;
      for (int e = 0; e < state.shape.size(); ++e) start.push_back(number_text(state.start(e), kPython));
      text += fmt::format("        self.{} = {}\n", fields_[k], value_text(start, state.shape));
    }
    const auto add = [&](const std::string& what, const std::function<std::string()>& method) {
      try {
        text += "\n" + method();
      } catch (const NoCode& none) {
        notes_.push_back("observer " + observer_.name + ": " + what + " is left out: " + none.what());
      }
    };
    if (!observer_.rate.empty()) add("the flow", [&] { return rate(); });
    if (observer_.linear && !observer_.rate.empty()) add("the exact flow", [&] { return flow(); });
    for (const Jump& jump : observer_.jumps)
      add("the map at " + jump.event, [&] { return this->jump(jump); });
    for (const Output& output : observer_.outputs)
      add("the output " + output.name, [&] { return this->output(output); });
    return text;
  }

 private:
  Code code(const std::vector<expr::Program>& programs) {
    Code made = scalar_code(programs, names_, content_.values, kPython);
    helpers_.insert(made.helpers.begin(), made.helpers.end());
    return made;
  }

  static std::vector<expr::Program> programs_of(const std::vector<Assigned>& list) {
    std::vector<expr::Program> programs;
    for (const Assigned& one : list) programs.push_back(one.value);
    return programs;
  }

  std::string inputs_of(const std::vector<expr::Program>& programs) const {
    std::vector<const expr::Program*> list;
    for (const expr::Program& program : programs) list.push_back(&program);
    std::string text;
    for (const Variable* input : inputs_read(observer_, list)) text += ", " + parameters_.at(input->key);
    return text;
  }

  std::string rate() {
    const auto programs = programs_of(observer_.rate);
    const Code made = code(programs);
    std::string text =
        fmt::format("    def rate(self{}):\n        \"\"\"The rate of the states between events.\"\"\"\n{}        return {{\n",
                    inputs_of(programs), lines_text(made.lines, "        "));
    for (std::size_t k = 0; k < observer_.rate.size(); ++k)
      text += fmt::format("            '{}': {},\n", fields_[observer_.rate[k].state],
                          value_text(made.results[k], observer_.states[observer_.rate[k].state].shape));
    return text + "        }\n";
  }

  std::string flow() {
    const auto still = rate_at_rest(observer_);
    const Code made = code(still);
    std::string z;
    for (const std::string& field : fields_)
      z += (z.empty() ? "" : ", ") + ("np.ravel(self." + field + ", order='F')");
    std::string text = fmt::format(
        "    def flow(self{}, dt):\n        \"\"\"The exact flow over the time dt while the inputs are held.\"\"\"\n"
        "        M = {}\n        z = np.concatenate([{}])\n        c = np.zeros({})\n{}",
        inputs_of(still), array_text(observer_.linear->M), z, observer_.size(),
        lines_text(made.lines, "        "));
    for (std::size_t k = 0; k < observer_.rate.size(); ++k) {
      int at = 0;
      for (std::size_t s = 0; s < observer_.rate[k].state; ++s) at += observer_.states[s].shape.size();
      for (const std::string& value : made.results[k])
        text += fmt::format("        c[{}] = {}\n", at++, value);
    }
    text += fmt::format(
        "        steps = 1 + int({} * dt)\n        h = dt / steps\n        for _ in range(steps):\n"
        "            d = h * (M @ z + c)\n            for k in range(2, {}):\n"
        "                z = z + d\n                d = h / k * (M @ d)\n            z = z + d\n",
        number_text(one_norm(observer_.linear->M), kPython), terms_of_series(false) + 1);
    int first = 0;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const expr::Shape shape = observer_.states[k].shape;
      std::vector<std::string> elements;
      for (int e = 0; e < shape.size(); ++e) elements.push_back(fmt::format("z[{}]", first + e));
      text += fmt::format("        self.{} = {}\n", fields_[k], value_text(elements, shape));
      first += shape.size();
    }
    return text;
  }

  std::string jump(const Jump& jump) {
    std::vector<expr::Program> all;
    std::string body;
    for (const auto& pass : jump.passes) {
      const auto programs = programs_of(pass);
      all.insert(all.end(), programs.begin(), programs.end());
      const Code made = code(programs);
      body += lines_text(made.lines, "        ");
      std::string to, values;
      for (std::size_t k = 0; k < pass.size(); ++k) {
        to += (k > 0 ? ", self." : "self.") + fields_[pass[k].state];
        values += (k > 0 ? ", " : "") +
                  value_text(made.results[k], observer_.states[pass[k].state].shape);
      }
      if (!pass.empty()) body += fmt::format("        {} = {}\n", to, values);
    }
    const std::string name = members_(observer_.jumps.size() == 1 ? "jump" : "jump_" + jump.event);
    return fmt::format("    def {}(self{}):\n        \"\"\"What happens at the event {}.\"\"\"\n{}", name,
                       inputs_of(all), jump.event, body);
  }

  std::string output(const Output& output) {
    const Code made = code({output.value});
    return fmt::format("    def {}(self{}):\n{}        return {}\n", members_(output.name),
                       inputs_of({output.value}), lines_text(made.lines, "        "),
                       value_text(made.results[0], output.value.shape()));
  }

  const Content& content_;
  const Observer& observer_;
  std::string name_;
  std::set<std::string>& helpers_;
  std::vector<std::string>& notes_;
  Identifiers members_;
  std::vector<std::string> fields_;
  std::map<std::string, std::string> parameters_;
  ElementNames names_;
};

}  // namespace

std::string python_file(Content& content, const std::string& name) {
  Identifiers taken(Language::python, {"sign"});
  std::string constants;
  std::string maps;
  std::set<std::string> helpers;
  for (const GainMatrix& gain : content.gains)
    constants += fmt::format("{} = {}  # {}\n", taken(gain.name), array_text(gain.value),
                             to_string(numbers::shape_of(gain.value)));
  for (const GainFunction& gain : content.functions) {
    const std::string own = taken(gain.name);
    const std::string variable = Identifiers(Language::python)(gain.variable);
    try {
      const Code made =
          scalar_code({gain.program}, {{gain.variable, {variable}}}, content.values, kPython);
      helpers.insert(made.helpers.begin(), made.helpers.end());
      const expr::Shape shape = gain.program.shape();
      std::string list;
      for (const std::string& element : made.results[0]) list += (list.empty() ? "" : ", ") + element;
      maps += fmt::format(
          "\n\ndef {}({}):\n    \"\"\"{}({}) = {}\"\"\"\n{}    return np.array([{}], dtype=float).reshape(({}, {}), order='F')\n",
          own, variable, gain.name, gain.variable, gain.text, lines_text(made.lines, "    "), list,
          shape.rows, shape.cols);
    } catch (const NoCode& none) {
      content.notes.push_back("the gain " + gain.name + " is left out: " + none.what());
    }
  }
  for (const Observer& observer : content.observers) {
    std::string title = observer.name;
    if (title.front() >= 'a' && title.front() <= 'z') title.front() = static_cast<char>(title.front() - 'a' + 'A');
    maps += "\n\n" + PythonObserver(content, observer, taken(title), helpers, content.notes).text();
  }
  std::vector<std::string> lines = head_lines(content, name);
  for (const std::string& note : content.notes) lines.push_back("Note: " + note);
  std::string help = helper_text(helpers, kPython);
  if (!help.empty()) help = "\n\n" + help.substr(0, help.size() - 1);
  return lines_text(lines, "# ") +
         (maps.find("math.") == std::string::npos ? "" : "import math\n\n") + "import numpy as np\n\n" +
         constants + help + maps;
}

}  // namespace gainsmith::exports
