// Observers and gains as one header in C99: no memory is allocated, and nothing but <math.h> is
// needed.
//
// The linear flow is Taylor's series of exp(M h) z + h phi_1(M h) c over N equal steps h = dt / N:
//   d_1 = h (M z + c),   d_{k+1} = h / (k + 1) M d_k,   z(t + h) = z(t) + d_1 + ... + d_K       (1)
// with N = 1 + floor(|M|_1 dt), so that |M|_1 h <= 1 and the terms fall as 1 / k!.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>

#include "export/files.h"
#include "export/observer_writer.h"
#include "export/shared_text.h"

namespace gainsmith::exports {

namespace {

/// "[2][3]"; nothing for a number.
std::string extent(expr::Shape shape) {
  if (shape.is_scalar()) return "";
  if (shape.rows == 1 || shape.cols == 1) return fmt::format("[{}]", shape.size());
  return fmt::format("[{}][{}]", shape.rows, shape.cols);
}

/// The elements of a variable of this shape.
std::vector<std::string> c_elements(const std::string& name, expr::Shape shape) {
  return elements_of(shape, [&](int row, int column) {
    if (shape.is_scalar()) return name;
    if (shape.rows == 1 || shape.cols == 1) return fmt::format("{}[{}]", name, row + column);
    return fmt::format("{}[{}][{}]", name, row, column);
  });
}

/// "int, int": of a parameter whose elements are stored row by row.
std::vector<std::string> flat_elements(const std::string& name, expr::Shape shape) {
  return elements_of(shape, [&](int row, int column) {
    return shape.is_scalar() ? name : fmt::format("{}[{}]", name, row * shape.cols + column);
  });
}

/// A function that returns a number, or writes a matrix to `out`.
std::string function(const std::string& comment, const std::string& name,
                     const std::string& parameters, expr::Shape shape, const Code& made,
                     const Dialect& dialect,
                     const std::function<std::string(const std::string& body)>& before) {
  std::string body = lines_text(made.lines, "  ");
  const std::string type = type_of(dialect);
  if (shape.is_scalar()) {
    body += "  return " + made.results[0][0] + ";\n";
    return fmt::format("/* {} */\nstatic inline {} {}({})\n{{\n{}{}}}\n\n", comment, type, name,
                       parameters, before(body), body);
  }
  const auto to = c_elements("out", shape);
  for (std::size_t e = 0; e < to.size(); ++e)
    body += fmt::format("  {} = {};\n", to[e], made.results[0][e]);
  return fmt::format("/* {} */\nstatic inline void {}({}, {} out{})\n{{\n{}{}}}\n\n", comment, name,
                     parameters, type, extent(shape), before(body), body);
}

/// A statement for each parameter that a body does not read: folding may have left out all of it.
std::string unread(const std::vector<std::string>& parameters, const std::string& body) {
  const auto is_part = [](char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  std::string text;
  for (const std::string& name : parameters) {
    bool read = false;
    for (std::size_t k = 0; !read && (k = body.find(name, k)) != std::string::npos;
         k += name.size())
      read = !is_part(body[k + name.size()]) && (k == 0 || !is_part(body[k - 1]));
    if (!read) text += "  (void)" + name + ";\n";
  }
  return text;
}

/// One observer, under a name of its own.
class CObserver : public ObserverWriter {
 public:
  /// Fields have their own scope; parameters share theirs with the variables of the functions.
  CObserver(const Content& content, const Observer& observer, std::string prefix,
            const ElementNames& gains, const Dialect& dialect, Identifiers& names, Remarks& remarks)
      : ObserverWriter(content, observer, dialect, gains, remarks),
        prefix_(std::move(prefix)),
        taken_(names) {
    Identifiers fields(Language::c);
    for (const State& state : observer.states) fields_.push_back(fields(state.name));
    Identifiers parameters(
        Language::c, {"state", "rate", "dt", "out", "now", "term", "next", "rest", "row", "col",
                      "order", "count", "step", "steps", "M", "Phi", "Psi"});
    for (const Variable& input : observer.inputs) {
      parameters_[input.key] = parameters(input.name);
      names_[input.key] = flat_elements(parameters_[input.key], input.shape);
    }
    for (std::size_t k = 0; k < fields_.size(); ++k)
      names_[observer.states[k].key] = c_elements("state->" + fields_[k], observer.states[k].shape);
  }

  std::string text() { return structure() + start() + maps(); }

 private:
  std::string type() const { return type_of(dialect_); }
  std::string state_type() const { return prefix_ + "state"; }

  /// The structure of the states: numbers and arrays with at most two dimensions.
  std::string structure() const {
    std::string text = fmt::format("/* The observer {}. */\ntypedef struct {{\n", observer_.name);
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const State& state = observer_.states[k];
      const std::string unit = state.unit.empty() ? "" : " /* " + state.unit + " */";
      text += fmt::format("  {} {}{};{}\n", type(), fields_[k], extent(state.shape), unit);
    }
    return text + "} " + state_type() + ";\n\n";
  }

  /// The function that sets the states to where they start.
  std::string start() const {
    std::string text = fmt::format(
        "/* Where it starts: 0 where the problem does not say. */\nstatic inline void {}start({} "
        "*state)\n{{\n",
        prefix_, state_type());
    for (const State& state : observer_.states)
      for (int k = 0; k < state.shape.size(); ++k)
        text += fmt::format("  {} = {};\n", names_.at(state.key)[static_cast<std::size_t>(k)],
                            number_text(state.start(k), dialect_));
    return text + "}\n\n";
  }

  /// ", double y, const double u[2]".
  std::string parameters(const std::vector<const Variable*>& inputs) const {
    std::string text;
    for (const Variable* input : inputs)
      text += input->shape.is_scalar()
                  ? fmt::format(", {} {}", type(), parameters_.at(input->key))
                  : fmt::format(", const {} {}[{}]", type(), parameters_.at(input->key),
                                input->shape.size());
    return text;
  }

  /// The same for a function of the states and these inputs.
  std::string unread_of(const std::vector<const Variable*>& inputs, const std::string& body) const {
    std::vector<std::string> parameters = {"state"};
    for (const Variable* input : inputs) parameters.push_back(parameters_.at(input->key));
    return unread(parameters, body);
  }

  /// target = value, for the states of a list.
  std::string assignments(const std::vector<Assigned>& list, const Code& made,
                          const std::string& target) const {
    std::string text;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::size_t state = list[k].state;
      const auto to = c_elements(target + fields_[state], observer_.states[state].shape);
      for (std::size_t e = 0; e < to.size(); ++e)
        text += fmt::format("  {} = {};\n", to[e], made.results[k][e]);
    }
    return text;
  }

  /// Writes `rate`, a structure like the states; states that do not flow have the rate 0.
  std::string rate() override {
    const auto programs = programs_of(observer_.rate);
    const auto inputs = inputs_read(programs);
    const Code made = code(programs);
    std::string body;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const bool flows = std::any_of(observer_.rate.begin(), observer_.rate.end(),
                                     [&](const Assigned& assigned) { return assigned.state == k; });
      if (flows) continue;
      for (const std::string& element :
           c_elements("rate->" + fields_[k], observer_.states[k].shape))
        body += fmt::format("  {} = {};\n", element, number_text(0, dialect_));
    }
    body += lines_text(made.lines, "  ") + assignments(observer_.rate, made, "rate->");
    return fmt::format(
        "/* The rate of the states between events.{} */\n"
        "static inline void {}rate(const {} *state{}, {} *rate)\n{{\n{}{}}}\n\n",
        units_text(inputs), prefix_, state_type(), parameters(inputs), state_type(),
        unread_of(inputs, body), body);
  }

  /// A constant table of M, rows first.
  std::string matrix(const std::string& name, const numbers::Matrix& M) const {
    std::string text =
        fmt::format("  static const {} {}[{}][{}] = {{\n", type(), name, M.rows(), M.cols());
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
      text += "    {";
      for (Eigen::Index j = 0; j < M.cols(); ++j)
        text += (j > 0 ? ", " : "") + number_text(M(i, j), dialect_);
      text += i + 1 < M.rows() ? "},\n" : "}};\n";
    }
    return text;
  }

  /// rest = the rate where the states are 0, and now = the states.
  std::string constant_part(const Code& made) const {
    std::string text;
    int first = 0;
    for (const State& state : observer_.states)
      for (const std::string& element : names_.at(state.key))
        text += fmt::format("  now[{}] = {};\n", first++, element);
    text += lines_text(made.lines, "  ");
    for (const auto& [element, value] : nonzero_elements(made))
      text += fmt::format("  rest[{}] = {};\n", element, value);
    return text;
  }

  /// The states from the vector `now`, in which each matrix has its columns below each other.
  std::string put_back() const {
    std::string text;
    int first = 0;
    for (const State& state : observer_.states)
      for (const std::string& element : names_.at(state.key))
        text += fmt::format("  {} = now[{}];\n", element, first++);
    return text;
  }

  /// Formula (1) for any dt >= 0: `term` is d_k, `next` is M d_k, `rest` is c.
  std::string flow() override {
    const auto still = rate_at_rest();
    const auto inputs = inputs_read(still);
    const Code made = code(still);
    const int n = observer_.size();
    std::string text = fmt::format(
        "/* The exact flow over the time dt >= 0{}: x' = M x + rest, by Taylor's series over\n"
        "   steps with |M| step <= 1.{} */\nstatic inline void {}flow({} *state{}, {} dt)\n{{\n",
        inputs.empty() ? "" : " while the inputs are held", units_text(inputs, "dt"), prefix_,
        state_type(), parameters(inputs), type());
    text += matrix("M", observer_.linear->M);
    text += fmt::format(
        "  const int steps = 1 + (int)({} * dt);\n  const {} step = dt / ({})steps;\n"
        "  {} now[{}], term[{}], next[{}];\n  {} rest[{}] = {{{}}};\n",
        number_text(one_norm(observer_.linear->M), dialect_), type(), type(), type(), n, n, n,
        type(), n, number_text(0, dialect_));
    const std::string constant = constant_part(made);
    text += unread_of(inputs, constant) + constant;
    text += fmt::format(
        "  for (int count = 0; count < steps; ++count) {{\n"
        "    for (int row = 0; row < {0}; ++row) {{\n      term[row] = rest[row];\n"
        "      for (int col = 0; col < {0}; ++col) term[row] += M[row][col] * now[col];\n"
        "      term[row] *= step;\n    }}\n"
        "    for (int order = 2; order <= {1}; ++order) {{\n"
        "      for (int row = 0; row < {0}; ++row) {{\n        now[row] += term[row];\n        "
        "next[row] = 0;\n"
        "        for (int col = 0; col < {0}; ++col) next[row] += M[row][col] * term[col];\n      "
        "}}\n"
        "      for (int row = 0; row < {0}; ++row) term[row] = next[row] * step / ({2})order;\n    "
        "}}\n"
        "    for (int row = 0; row < {0}; ++row) now[row] += term[row];\n  }}\n",
        n, terms_of_series(dialect_.single), type());
    return text + put_back() + "}\n\n" + flow_period(made, inputs);
  }

  /// The flow over the period T of the first event that has one: Phi and Psi of step_matrices() are
  /// tables, so that a step costs one product. Nothing without such an event.
  std::string flow_period(const Code& made, const std::vector<const Variable*>& inputs) const {
    const auto jump =
        std::find_if(observer_.jumps.begin(), observer_.jumps.end(),
                     [](const Jump& candidate) { return candidate.period.has_value(); });
    if (jump == observer_.jumps.end()) return "";
    const auto [Phi, Psi] = step_matrices(observer_.linear->M, *jump->period);
    const int n = observer_.size();
    std::string text = fmt::format(
        "/* The same from one {} to the next, {}{} later.{} */\nstatic inline void "
        "{}flow_period({} "
        "*state{})\n{{\n",
        jump->event, model::printed(*jump->period),
        content_.time_unit.empty() ? "" : " " + content_.time_unit, units_text(inputs), prefix_,
        state_type(), parameters(inputs));
    // Without a constant part Psi and `rest` are left out.
    const bool moved = !nonzero_elements(made).empty();
    text += matrix("Phi", Phi);
    if (moved) text += matrix("Psi", Psi);
    text += fmt::format("  {} now[{}], next[{}];\n", type(), n, n);
    if (moved)
      text += fmt::format("  {} rest[{}] = {{{}}};\n", type(), n, number_text(0, dialect_));
    const std::string constant = constant_part(made);
    text += unread_of(inputs, constant) + constant;
    text += fmt::format(
        "  for (int row = 0; row < {0}; ++row) {{\n    next[row] = 0;\n"
        "    for (int col = 0; col < {0}; ++col) next[row] += Phi[row][col] * now[col]{1};\n  }}\n"
        "  for (int row = 0; row < {0}; ++row) now[row] = next[row];\n",
        n, moved ? " + Psi[row][col] * rest[col]" : "");
    return text + put_back() + "}\n\n";
  }

  /// Each pass computes all its new values before it stores the first one: maps of a pass read the
  /// states before it. Elements that keep their value are not written.
  std::string jump(const Jump& jump) override {
    std::string body;
    for (const auto& pass : jump.passes) {
      const Code made = code(programs_of(pass));
      body += "  {\n" + lines_text(made.lines, "    ");
      std::vector<std::string> stores;
      for (std::size_t k = 0; k < pass.size(); ++k) {
        const auto& to = names_.at(observer_.states[pass[k].state].key);
        for (std::size_t e = 0; e < to.size(); ++e) {
          if (to[e] == made.results[k][e]) continue;
          body += fmt::format("    const {} next_{} = {};\n", type(), stores.size(),
                              made.results[k][e]);
          stores.push_back(fmt::format("    {} = next_{};\n", to[e], stores.size()));
        }
      }
      for (const std::string& store : stores) body += store;
      body += "  }\n";
    }
    const std::string name = observer_.jumps.size() == 1 ? taken_(prefix_ + "jump")
                                                         : taken_(prefix_ + "jump_" + jump.event);
    const auto inputs = inputs_read(programs_of(jump));
    return fmt::format(
        "/* What happens at the event {}.{} */\nstatic inline void {}({} "
        "*state{})\n{{\n{}{}}}\n\n",
        jump.event, units_text(inputs), name, state_type(), parameters(inputs),
        unread_of(inputs, body), body);
  }

  /// A function that returns a number, or writes to `out`.
  std::string output(const Output& output) override {
    const Code made = code({output.value});
    const auto inputs = inputs_read({output.value});
    std::string comment = output.name + (output.unit.empty() ? "" : " [" + output.unit + "]");
    if (const std::string units = units_text(inputs); !units.empty()) comment += "." + units;
    return function(comment, taken_(prefix_ + output.name),
                    "const " + state_type() + " *state" + parameters(inputs), output.value.shape(),
                    made, dialect_,
                    [&](const std::string& body) { return unread_of(inputs, body); });
  }

  std::string prefix_;
  Identifiers& taken_;
};

/// A constant array, rows first; a number or a vector without inner braces.
std::string constant_text(const std::string& name, const numbers::Matrix& value,
                          const Dialect& dialect) {
  const expr::Shape shape = numbers::shape_of(value);
  std::string text = fmt::format("static const {} {}{} = ", type_of(dialect), name, extent(shape));
  if (shape.is_scalar()) return text + number_text(value(0, 0), dialect) + ";\n";
  const bool matrix = shape.rows > 1 && shape.cols > 1;
  text += "{";
  for (int i = 0; i < shape.rows; ++i) {
    if (matrix) text += i > 0 ? ",\n  {" : "\n  {";
    for (int j = 0; j < shape.cols; ++j)
      text += (j > 0 || (!matrix && i > 0) ? ", " : "") + number_text(value(i, j), dialect);
    if (matrix) text += "}";
  }
  return text + "};\n";
}

/// A gain that is a function of a scalar.
std::string function_text(const Content& content, const GainFunction& gain, const std::string& name,
                          const ElementNames& gains, const Dialect& dialect, Remarks& remarks) {
  Identifiers parameters(Language::c, {"out"});
  const std::string variable = parameters(gain.variable);
  ElementNames names = gains;
  names[gain.variable] = {variable};
  const Code made = scalar_code({gain.program}, names, content.values, dialect);
  remarks.add(made);
  return function(fmt::format("{}({}) = {}", gain.name, gain.variable, gain.text), name,
                  type_of(dialect) + " " + variable, gain.program.shape(), made, dialect,
                  [&](const std::string& body) { return unread({variable}, body); });
}

/// A comment of several lines, closed once: comment_text() leaves no sign of its end in them.
std::string commented(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n   ") + line;
  return "/* " + text + " */\n";
}

}  // namespace

std::string c_file(Content& content, const std::string& name) {
  const std::string prefix = Identifiers(Language::c)(name) + "_";
  const Dialect dialect{Language::c, content.single, prefix};
  // Names of gains, maps and outputs avoid those that the file has anyway.
  Identifiers taken(Language::c,
                    {prefix + "state", prefix + "start", prefix + "rate", prefix + "flow",
                     prefix + "flow_period", prefix + "min", prefix + "max", prefix + "mod",
                     prefix + "sign", prefix + "inverse", prefix + "product"});
  std::string constants;
  ElementNames gains;
  for (const GainMatrix& gain : content.gains) {
    if (gain.value.size() == 0) {
      content.notes.push_back("the gain " + gain.name + " has no elements and is left out");
      continue;
    }
    const std::string own = taken(prefix + gain.name);
    const expr::Shape shape = numbers::shape_of(gain.value);
    constants += fmt::format("/* {}, {} */\n", gain.name, to_string(shape)) +
                 constant_text(own, gain.value, dialect) + "\n";
    gains[gain.name] = c_elements(own, shape);
  }
  Remarks remarks;
  std::string maps;
  for (const GainFunction& gain : content.functions) {
    try {
      maps += function_text(content, gain, taken(prefix + gain.name), gains, dialect, remarks);
    } catch (const NoCode& none) {
      remarks.notes.push_back("the gain " + gain.name + " is left out: " + none.what());
    }
  }
  for (const Observer& observer : content.observers) {
    const std::string own =
        content.observers.size() == 1 ? prefix : taken(prefix + observer.name) + "_";
    maps += CObserver(content, observer, own, gains, dialect, taken, remarks).text();
  }
  const std::string guard = Identifiers(Language::c)(prefix + "gains_h");
  content.notes.insert(content.notes.end(), remarks.notes.begin(), remarks.notes.end());
  std::vector<std::string> lines = head_lines(content, name);
  lines.emplace_back(
      "C99; no memory is allocated. Maps hold the numbers of the problem: export again after a "
      "change.");
  for (const std::string& note : content.notes) lines.push_back(comment_text("Note: " + note));
  const std::string code = constants + helper_text(remarks.helpers, dialect) + maps;
  return commented(lines) + fmt::format("#ifndef {0}\n#define {0}\n\n{1}{2}#endif\n", guard,
                                        remarks.library ? "#include <math.h>\n\n" : "", code);
}

}  // namespace gainsmith::exports
