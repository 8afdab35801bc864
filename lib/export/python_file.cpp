// Gains and observers as a module of Python that needs NumPy alone. States are attributes, inputs
// are parameters of methods.
//
// NumPy has no matrix exponential: the linear flow is Taylor's series over steps h with |M|_1 h <=
// 1, as in C.
#include <fmt/format.h>

#include <utility>

#include "export/files.h"
#include "export/observer_writer.h"
#include "export/shared_text.h"

namespace gainsmith::exports {

namespace {

const Dialect kPython{Language::python, false, ""};

/// A literal of NumPy, always with two dimensions.
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
  return fmt::format("np.array([{}], dtype=float).reshape(({}, {}), order='F')", list, shape.rows,
                     shape.cols);
}

/// The class of one observer.
class PythonObserver : public ObserverWriter {
 public:
  PythonObserver(const Content& content, const Observer& observer, std::string name,
                 Remarks& remarks)
      : ObserverWriter(content, observer, kPython, {}, remarks), name_(std::move(name)) {
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
    std::string text =
        fmt::format("class {}:\n    \"\"\"The {}.\"\"\"\n\n    def __init__(self):\n", name_,
                    observer_.name == "observer" ? "observer" : "observer " + observer_.name);
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const State& state = observer_.states[k];
      std::vector<std::string> start;
      for (int e = 0; e < state.shape.size(); ++e)
        start.push_back(number_text(state.start(e), kPython));
      text += fmt::format("        self.{} = {}{}\n", fields_[k], value_text(start, state.shape),
                          state.unit.empty() ? "" : "  # " + state.unit);
    }
    return text + maps();
  }

 private:
  /// `units`: " Units: u [V].", or nothing.
  static std::string method(const std::string& name, const std::string& parameters,
                            const std::string& help, const std::string& units,
                            const std::string& body) {
    return fmt::format("\n    def {}(self{}):\n        \"\"\"{}\"\"\"\n{}{}", name, parameters,
                       help, units.empty() ? "" : "        #" + units + "\n", body);
  }

  /// A dictionary by the names of the states that flow.
  std::string rate() override {
    const auto programs = programs_of(observer_.rate);
    const Code made = code(programs);
    std::string body = lines_text(made.lines, "        ") + "        return {\n";
    for (std::size_t k = 0; k < observer_.rate.size(); ++k)
      body +=
          fmt::format("            '{}': {},\n", fields_[observer_.rate[k].state],
                      value_text(made.results[k], observer_.states[observer_.rate[k].state].shape));
    return method("rate", parameter_names(programs), "The rate of the states between events.",
                  units_text(inputs_read(programs)), body + "        }\n");
  }

  /// d is the k-th term h^k / k! M^(k-1) (M z + c) of the series.
  std::string flow() override {
    const auto still = rate_at_rest();
    const Code made = code(still);
    std::string z;
    for (const std::string& field : fields_)
      z += (z.empty() ? "" : ", ") + ("np.ravel(self." + field + ", order='F')");
    std::string text =
        fmt::format("        M = {}\n        z = np.concatenate([{}])\n        c = np.zeros({})\n",
                    array_text(observer_.linear->M), z, observer_.size());
    text += lines_text(made.lines, "        ");
    for (const auto& [element, value] : nonzero_elements(made))
      text += fmt::format("        c[{}] = {}\n", element, value);
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
    return method("flow", parameter_names(still) + ", dt",
                  "The exact flow over the time dt while the inputs are held.",
                  units_text(inputs_read(still), "dt"), text);
  }

  /// A pass is one assignment of a tuple: all of its maps read the states before the pass.
  std::string jump(const Jump& jump) override {
    std::string body;
    for (const auto& pass : jump.passes) {
      const Code made = code(programs_of(pass));
      body += lines_text(made.lines, "        ");
      std::string to, values;
      for (std::size_t k = 0; k < pass.size(); ++k) {
        to += (k > 0 ? ", self." : "self.") + fields_[pass[k].state];
        values += (k > 0 ? ", " : "") +
                  value_text(made.results[k], observer_.states[pass[k].state].shape);
      }
      if (!pass.empty()) body += fmt::format("        {} = {}\n", to, values);
    }
    return method(members_(observer_.jumps.size() == 1 ? "jump" : "jump_" + jump.event),
                  parameter_names(programs_of(jump)),
                  "What happens at the event " + jump.event + ".",
                  units_text(inputs_read(programs_of(jump))), body);
  }

  std::string output(const Output& output) override {
    const Code made = code({output.value});
    return method(members_(output.name), parameter_names({output.value}), output.name,
                  output.unit.empty() ? "" : " Units: " + output.unit,
                  lines_text(made.lines, "        ") + "        return " +
                      value_text(made.results[0], output.value.shape()) + "\n");
  }

  std::string name_;
  Identifiers members_{Language::python, {"rate", "flow"}};
};

}  // namespace

std::string python_file(Content& content, const std::string& name) {
  Identifiers taken(Language::python, {"sign"});
  std::string constants;
  std::string maps;
  Remarks remarks;
  for (const GainMatrix& gain : content.gains)
    constants += fmt::format("{} = {}  # {}\n", taken(gain.name), array_text(gain.value),
                             to_string(numbers::shape_of(gain.value)));
  for (const GainFunction& gain : content.functions) {
    const std::string own = taken(gain.name);
    const std::string variable = Identifiers(Language::python)(gain.variable);
    try {
      const Code made =
          scalar_code({gain.program}, {{gain.variable, {variable}}}, content.values, kPython);
      remarks.add(made);
      const expr::Shape shape = gain.program.shape();
      std::string list;
      for (const std::string& element : made.results[0])
        list += (list.empty() ? "" : ", ") + element;
      maps += fmt::format(
          "\n\ndef {}({}):\n    \"\"\"{}({}) = {}\"\"\"\n{}    return np.array([{}], "
          "dtype=float).reshape(({}, {}), order='F')\n",
          own, variable, gain.name, gain.variable, gain.text, lines_text(made.lines, "    "), list,
          shape.rows, shape.cols);
    } catch (const NoCode& none) {
      remarks.notes.push_back("the gain " + gain.name + " is left out: " + none.what());
    }
  }
  for (const Observer& observer : content.observers) {
    std::string title = observer.name;
    // Classes begin with a capital.
    if (title.front() >= 'a' && title.front() <= 'z')
      title.front() = static_cast<char>(title.front() - 'a' + 'A');
    maps += "\n\n" + PythonObserver(content, observer, taken(title), remarks).text();
  }
  content.notes.insert(content.notes.end(), remarks.notes.begin(), remarks.notes.end());
  std::vector<std::string> lines = head_lines(content, name);
  for (const std::string& note : content.notes) lines.push_back(comment_text("Note: " + note));
  std::string help = helper_text(remarks.helpers, kPython);
  if (!help.empty()) help = "\n\n" + help.substr(0, help.size() - 1);
  return lines_text(lines, "# ") +
         (maps.find("math.") == std::string::npos ? "" : "import math\n\n") +
         "import numpy as np\n\n" + constants + help + maps;
}

}  // namespace gainsmith::exports
