// Gains and observers as a function of MATLAB and Octave. States are fields of a structure x,
// inputs are parameters.
//
// The linear flow is one matrix exponential (Van Loan 1978):
//   [z(dt); 1] = expm(dt [M, c; 0, 0]) [z(0); 1]                                                (1)
#include <fmt/format.h>

#include <utility>

#include "export/files.h"
#include "export/observer_writer.h"
#include "export/shared_text.h"

namespace gainsmith::exports {

namespace {

const Dialect kMatlab{Language::matlab, false, ""};

/// A literal of MATLAB, rows separated by semicolons.
std::string matrix_text(const numbers::Matrix& value) {
  if (value.size() == 0) return fmt::format("zeros({}, {})", value.rows(), value.cols());
  if (value.size() == 1) return number_text(value(0, 0), kMatlab);
  std::string text = "[";
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    for (Eigen::Index j = 0; j < value.cols(); ++j)
      text += (j > 0 ? ", " : i > 0 ? "; " : "") + number_text(value(i, j), kMatlab);
  return text + "]";
}

/// "name(1, 2)", counted from 1.
std::vector<std::string> matlab_elements(const std::string& name, expr::Shape shape) {
  return elements_of(shape, [&](int row, int column) {
    return shape.is_scalar() ? name : fmt::format("{}({}, {})", name, row + 1, column + 1);
  });
}

/// The functions of one observer, and the lines that put their handles into the structure.
class MatlabObserver : public ObserverWriter {
 public:
  MatlabObserver(const Content& content, const Observer& observer, std::string name,
                 Remarks& remarks)
      : ObserverWriter(content, observer, kMatlab, {}, remarks), name_(std::move(name)) {
    Identifiers fields(Language::matlab);
    for (const State& state : observer.states) {
      fields_.push_back(fields(state.name));
      names_[state.key] = matlab_elements("x." + fields_.back(), state.shape);
    }
    Identifiers parameters(Language::matlab, {"x", "r", "dt", "z", "c", "M"});
    for (const Variable& input : observer.inputs) {
      parameters_[input.key] = parameters(input.name);
      names_[input.key] = matlab_elements(parameters_[input.key], input.shape);
    }
  }

  /// The lines that put start and handles into the structure, and the local functions.
  std::pair<std::string, std::string> text() {
    std::string start;
    for (std::size_t k = 0; k < fields_.size(); ++k)
      start += (k > 0 ? ", '" : "'") + fields_[k] + "', " + matrix_text(observer_.states[k].start);
    std::string units;
    for (std::size_t k = 0; k < fields_.size(); ++k)
      if (const std::string& unit = observer_.states[k].unit; !unit.empty())
        units += (units.empty() ? "  % " : ", ") + fields_[k] + " [" + unit + "]";
    handles_ = fmt::format("  s.{}.start = struct({});{}\n", name_, start, units);
    const std::string functions = maps();
    return {handles_, functions};
  }

 private:
  /// A function of its own with a handle: its first line and its body.
  std::string function(const std::string& what, const std::string& result,
                       const std::string& parameters, const std::string& body) {
    handles_ += fmt::format("  s.{}.{} = @{}_{};\n", name_, what, name_, what);
    return fmt::format("function {} = {}_{}(x{})\n{}end\n\n", result, name_, what, parameters,
                       body);
  }

  /// "  r.xh = [...];" for the states of a list, through `r`.
  std::string assignments(const std::vector<Assigned>& list, const Code& made) const {
    std::string text;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const expr::Shape shape = observer_.states[list[k].state].shape;
      text += fmt::format("  r.{} = {};\n", fields_[list[k].state], matrix(made.results[k], shape));
    }
    return text;
  }

  /// A matrix of its elements, which are listed column by column, as MATLAB stores them.
  static std::string matrix(const std::vector<std::string>& elements, expr::Shape shape) {
    if (shape.is_scalar()) return elements[0];
    std::string list;
    for (const std::string& element : elements) list += (list.empty() ? "" : "; ") + element;
    return shape.cols == 1 ? "[" + list + "]"
                           : fmt::format("reshape([{}], {}, {})", list, shape.rows, shape.cols);
  }

  /// All states are set to 0 first, so that those that do not flow have a rate too.
  std::string rate() override {
    const auto programs = programs_of(observer_.rate);
    const Code made = code(programs);
    std::string body;
    for (std::size_t k = 0; k < fields_.size(); ++k)
      body += fmt::format("  r.{} = zeros({}, {});\n", fields_[k], observer_.states[k].shape.rows,
                          observer_.states[k].shape.cols);
    body += lines_text(made.lines, "  ") + assignments(observer_.rate, made);
    return "% The rate of the states between events." + units_text(inputs_read(programs)) + "\n" +
           function("rate", "r", parameter_names(programs), body);
  }

  /// Formula (1), with z the columns of all states below each other.
  std::string flow() override {
    const auto still = rate_at_rest();
    const Code made = code(still);
    const int n = observer_.size();
    std::string z;
    for (const std::string& field : fields_) z += (z.empty() ? "" : "; ") + ("x." + field + "(:)");
    std::string body = fmt::format("  M = {};\n  z = [{}];\n  c = zeros({}, 1);\n",
                                   matrix_text(observer_.linear->M), z, n) +
                       lines_text(made.lines, "  ");
    for (const auto& [element, value] : nonzero_elements(made))
      body += fmt::format("  c({}) = {};\n", element + 1, value);
    body += fmt::format("  z = expm(dt*[M, c; zeros(1, {})])*[z; 1];\n", n + 1);
    int first = 1;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const expr::Shape shape = observer_.states[k].shape;
      body += fmt::format("  x.{} = reshape(z({}:{}), {}, {});\n", fields_[k], first,
                          first + shape.size() - 1, shape.rows, shape.cols);
      first += shape.size();
    }
    return "% The exact flow over the time dt while the inputs are held." +
           units_text(inputs_read(still), "dt") + "\n" +
           function("flow", "x", parameter_names(still) + ", dt", body);
  }

  /// Each pass writes to a copy r of x: all of its maps read the states before the pass.
  std::string jump(const Jump& jump) override {
    std::string body;
    for (const auto& pass : jump.passes) {
      const Code made = code(programs_of(pass));
      body += "  r = x;\n" + lines_text(made.lines, "  ") + assignments(pass, made) + "  x = r;\n";
    }
    const std::string name = taken_(observer_.jumps.size() == 1 ? "jump" : "jump_" + jump.event);
    return "% What happens at the event " + jump.event + "." +
           units_text(inputs_read(programs_of(jump))) + "\n" +
           function(name, "x", parameter_names(programs_of(jump)), body);
  }

  std::string output(const Output& output) override {
    const Code made = code({output.value});
    const std::string value = matrix(made.results[0], output.value.shape());
    const std::string unit =
        output.unit.empty() ? "" : "% " + output.name + " [" + output.unit + "]\n";
    return unit + function(taken_(output.name), "r", parameter_names({output.value}),
                           lines_text(made.lines, "  ") + "  r = " + value + ";\n");
  }

  std::string name_;
  std::string handles_;
  Identifiers taken_{Language::matlab, {"start", "rate", "flow"}};
};

}  // namespace

std::string matlab_file(Content& content, const std::string& name) {
  Identifiers taken(Language::matlab, {"s"});
  std::string main;
  std::string functions;
  Remarks remarks;
  for (const GainMatrix& gain : content.gains)
    main += fmt::format("  s.{} = {};  % {}\n", taken(gain.name), matrix_text(gain.value),
                        to_string(numbers::shape_of(gain.value)));
  for (const GainFunction& gain : content.functions) {
    const std::string own = taken(gain.name);
    const std::string variable = Identifiers(Language::matlab, {"r"})(gain.variable);
    try {
      const Code made =
          scalar_code({gain.program}, {{gain.variable, {variable}}}, content.values, kMatlab);
      remarks.add(made);
      functions +=
          fmt::format("% {}({}) = {}\nfunction r = gain_{}({})\n{}", gain.name, gain.variable,
                      gain.text, own, variable, lines_text(made.lines, "  "));
      const auto to = matlab_elements("r", gain.program.shape());
      for (std::size_t e = 0; e < to.size(); ++e)
        functions += fmt::format("  {} = {};\n", to[e], made.results[0][e]);
      functions += "end\n\n";
      main += fmt::format("  s.{} = @gain_{};\n", own, own);
    } catch (const NoCode& none) {
      remarks.notes.push_back("the gain " + gain.name + " is left out: " + none.what());
    }
  }
  for (const Observer& observer : content.observers) {
    const auto [handles, maps] =
        MatlabObserver(content, observer, taken(observer.name), remarks).text();
    main += handles;
    functions += maps;
  }
  content.notes.insert(content.notes.end(), remarks.notes.begin(), remarks.notes.end());
  std::vector<std::string> lines = head_lines(content, name);
  for (const std::string& note : content.notes) lines.push_back(comment_text("Note: " + note));
  return fmt::format("function s = {}()\n{}{}end\n\n{}{}", Identifiers(Language::matlab)(name),
                     lines_text(lines, "% "), main, functions,
                     helper_text(remarks.helpers, kMatlab));
}

}  // namespace gainsmith::exports
