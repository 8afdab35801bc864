#include <fmt/format.h>

#include <utility>

#include "export/files.h"
#include "export/shared_text.h"

namespace gainsmith::exports {

namespace {

const Dialect kMatlab{Language::matlab, false, ""};

std::string matrix_text(const numbers::Matrix& value) {
  if (value.size() == 0) return fmt::format("zeros({}, {})", value.rows(), value.cols());
  if (value.size() == 1) return number_text(value(0, 0), kMatlab);
  std::string text = "[";
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    for (Eigen::Index j = 0; j < value.cols(); ++j)
      text += (j > 0 ? ", " : i > 0 ? "; " : "") + number_text(value(i, j), kMatlab);
  return text + "]";
}

std::vector<std::string> matlab_elements(const std::string& name, expr::Shape shape) {
  return elements_of(shape, [&](int row, int column) {
    return shape.is_scalar() ? name : fmt::format("{}({}, {})", name, row + 1, column + 1);
  });
}

/// The functions of one observer, and the lines that put their handles into the structure.
class MatlabObserver {
 public:
  MatlabObserver(const Content& content, const Observer& observer, std::string name,
                 std::set<std::string>& helpers, std::vector<std::string>& notes)
      : content_(content),
        observer_(observer),
        name_(std::move(name)),
        helpers_(helpers),
        notes_(notes) {
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

  /// Adds to the body of the main function, and the local functions.
  void write(std::string& main, std::string& functions) {
    std::string start;
    for (std::size_t k = 0; k < fields_.size(); ++k)
      start += (k > 0 ? ", '" : "'") + fields_[k] + "', " + matrix_text(observer_.states[k].start);
    main += fmt::format("  s.{}.start = struct({});\n", name_, start);
    const auto add = [&](const std::string& what, const std::string& function,
                         const std::function<std::string()>& text) {
      try {
        functions += text() + "\n";
        main += fmt::format("  s.{}.{} = @{}_{};\n", name_, what, name_, function);
      } catch (const NoCode& none) {
        notes_.push_back("observer " + observer_.name + ": " + what + " is left out: " + none.what());
      }
    };
    if (!observer_.rate.empty()) add("rate", "rate", [&] { return rate(); });
    if (observer_.linear && !observer_.rate.empty()) add("flow", "flow", [&] { return flow(); });
    Identifiers taken(Language::matlab, {"start", "rate", "flow"});
    for (const Jump& jump : observer_.jumps) {
      const std::string name = taken(observer_.jumps.size() == 1 ? "jump" : "jump_" + jump.event);
      add(name, name, [&] { return this->jump(jump, name); });
    }
    for (const Output& output : observer_.outputs) {
      const std::string name = taken(output.name);
      add(name, name, [&] { return this->output(output, name); });
    }
  }

 private:
  std::string parameters(const std::vector<const Variable*>& inputs) const {
    std::string text;
    for (const Variable* input : inputs) text += ", " + parameters_.at(input->key);
    return text;
  }

  Code code(const std::vector<expr::Program>& programs) {
    Code made = scalar_code(programs, names_, content_.values, kMatlab);
    helpers_.insert(made.helpers.begin(), made.helpers.end());
    return made;
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

  static std::string matrix(const std::vector<std::string>& elements, expr::Shape shape) {
    if (shape.is_scalar()) return elements[0];
    std::string list;
    for (const std::string& element : elements) list += (list.empty() ? "" : "; ") + element;
    return shape.cols == 1 ? "[" + list + "]"
                           : fmt::format("reshape([{}], {}, {})", list, shape.rows, shape.cols);
  }

  static std::vector<expr::Program> programs_of(const std::vector<Assigned>& list) {
    std::vector<expr::Program> programs;
    for (const Assigned& one : list) programs.push_back(one.value);
    return programs;
  }

  std::string inputs_of(const std::vector<expr::Program>& programs) const {
    std::vector<const expr::Program*> list;
    for (const expr::Program& program : programs) list.push_back(&program);
    return parameters(inputs_read(observer_, list));
  }

  std::string rate() {
    const auto programs = programs_of(observer_.rate);
    const Code made = code(programs);
    std::string text = fmt::format("% The rate of the states between events.\nfunction r = {}_rate(x{})\n",
                                   name_, inputs_of(programs));
    for (std::size_t k = 0; k < fields_.size(); ++k)
      text += fmt::format("  r.{} = zeros({}, {});\n", fields_[k], observer_.states[k].shape.rows,
                          observer_.states[k].shape.cols);
    return text + lines_text(made.lines, "  ") + assignments(observer_.rate, made) + "end\n";
  }

  std::string flow() {
    const auto still = rate_at_rest(observer_);
    const Code made = code(still);
    const int n = observer_.size();
    std::string z;
    for (const std::string& field : fields_) z += (z.empty() ? "" : "; ") + ("x." + field + "(:)");
    std::string text = fmt::format(
        "% The exact flow over the time dt while the inputs are held.\nfunction x = {}_flow(x{}, dt)\n"
        "  M = {};\n  z = [{}];\n  c = zeros({}, 1);\n",
        name_, inputs_of(still), matrix_text(observer_.linear->M), z, n);
    text += lines_text(made.lines, "  ");
    for (std::size_t k = 0; k < observer_.rate.size(); ++k) {
      int at = 1;
      for (std::size_t s = 0; s < observer_.rate[k].state; ++s) at += observer_.states[s].shape.size();
      for (const std::string& value : made.results[k]) text += fmt::format("  c({}) = {};\n", at++, value);
    }
    text += fmt::format("  z = expm(dt*[M, c; zeros(1, {})])*[z; 1];\n", n + 1);
    int first = 1;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const expr::Shape shape = observer_.states[k].shape;
      text += fmt::format("  x.{} = reshape(z({}:{}), {}, {});\n", fields_[k], first,
                          first + shape.size() - 1, shape.rows, shape.cols);
      first += shape.size();
    }
    return text + "end\n";
  }

  std::string jump(const Jump& jump, const std::string& name) {
    std::vector<expr::Program> all;
    std::string body;
    for (const auto& pass : jump.passes) {
      const auto programs = programs_of(pass);
      all.insert(all.end(), programs.begin(), programs.end());
      const Code made = code(programs);
      body += "  r = x;\n" + lines_text(made.lines, "  ") + assignments(pass, made) + "  x = r;\n";
    }
    return fmt::format("% What happens at the event {}.\nfunction x = {}_{}(x{})\n{}end\n", jump.event, name_,
                       name, inputs_of(all), body);
  }

  std::string output(const Output& output, const std::string& name) {
    const Code made = code({output.value});
    return fmt::format("function r = {}_{}(x{})\n{}  r = {};\nend\n", name_, name, inputs_of({output.value}),
                       lines_text(made.lines, "  "), matrix(made.results[0], output.value.shape()));
  }

  const Content& content_;
  const Observer& observer_;
  std::string name_;
  std::set<std::string>& helpers_;
  std::vector<std::string>& notes_;
  std::vector<std::string> fields_;
  std::map<std::string, std::string> parameters_;
  ElementNames names_;
};

}  // namespace

std::string matlab_file(Content& content, const std::string& name) {
  Identifiers taken(Language::matlab, {"s"});
  std::string main;
  std::string functions;
  std::set<std::string> helpers;
  for (const GainMatrix& gain : content.gains)
    main += fmt::format("  s.{} = {};  % {}\n", taken(gain.name), matrix_text(gain.value),
                        to_string(numbers::shape_of(gain.value)));
  for (const GainFunction& gain : content.functions) {
    const std::string own = taken(gain.name);
    const std::string variable = Identifiers(Language::matlab, {"r"})(gain.variable);
    try {
      const Code made =
          scalar_code({gain.program}, {{gain.variable, {variable}}}, content.values, kMatlab);
      helpers.insert(made.helpers.begin(), made.helpers.end());
      functions += fmt::format("% {}({}) = {}\nfunction r = gain_{}({})\n{}", gain.name, gain.variable, gain.text,
                               own, variable, lines_text(made.lines, "  "));
      const auto to = matlab_elements("r", gain.program.shape());
      for (std::size_t e = 0; e < to.size(); ++e)
        functions += fmt::format("  {} = {};\n", to[e], made.results[0][e]);
      functions += "end\n\n";
      main += fmt::format("  s.{} = @gain_{};\n", own, own);
    } catch (const NoCode& none) {
      content.notes.push_back("the gain " + gain.name + " is left out: " + none.what());
    }
  }
  for (const Observer& observer : content.observers)
    MatlabObserver(content, observer, taken(observer.name), helpers, content.notes)
        .write(main, functions);
  std::vector<std::string> lines = head_lines(content, name);
  for (const std::string& note : content.notes) lines.push_back("Note: " + note);
  return fmt::format("function s = {}()\n{}{}end\n\n{}{}", Identifiers(Language::matlab)(name),
                     lines_text(lines, "% "), main, functions, helper_text(helpers, kMatlab));
}

}  // namespace gainsmith::exports
