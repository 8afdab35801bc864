#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>

#include "export/files.h"
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

/// "int, int": of a parameter whose elements stand row by row.
std::vector<std::string> flat_elements(const std::string& name, expr::Shape shape) {
  return elements_of(shape, [&](int row, int column) {
    return shape.is_scalar() ? name : fmt::format("{}[{}]", name, row * shape.cols + column);
  });
}

/// A function that returns a number, or writes a matrix to `out`.
std::string function(const std::string& comment, const std::string& name, const std::string& parameters,
                     expr::Shape shape, const Code& made, const Dialect& dialect,
                     const std::function<std::string(const std::string& body)>& before) {
  std::string body = lines_text(made.lines, "  ");
  const std::string type = type_of(dialect);
  if (shape.is_scalar()) {
    body += "  return " + made.results[0][0] + ";\n";
    return fmt::format("/* {} */\nstatic inline {} {}({})\n{{\n{}{}}}\n\n", comment, type, name, parameters,
                       before(body), body);
  }
  const auto to = c_elements("out", shape);
  for (std::size_t e = 0; e < to.size(); ++e)
    body += fmt::format("  {} = {};\n", to[e], made.results[0][e]);
  return fmt::format("/* {} */\nstatic inline void {}({}, {} out{})\n{{\n{}{}}}\n\n", comment, name, parameters,
                     type, extent(shape), before(body), body);
}

/// A statement for each parameter that a body does not read: folding may have left out all of it.
std::string unread(const std::vector<std::string>& parameters, const std::string& body) {
  const auto is_part = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::string text;
  for (const std::string& name : parameters) {
    bool read = false;
    for (std::size_t k = 0; !read && (k = body.find(name, k)) != std::string::npos; k += name.size())
      read = !is_part(body[k + name.size()]) && (k == 0 || !is_part(body[k - 1]));
    if (!read) text += "  (void)" + name + ";\n";
  }
  return text;
}

/// One observer, under a name of its own.
class CObserver {
 public:
  CObserver(const Content& content, const Observer& observer, const std::string& prefix,
            const ElementNames& gains, const Dialect& dialect, std::set<std::string>& helpers,
            Identifiers& names, std::vector<std::string>& notes)
      : content_(content),
        observer_(observer),
        prefix_(prefix),
        names_(gains),
        dialect_(dialect),
        helpers_(helpers),
        taken_(names),
        notes_(notes) {
    Identifiers fields(Language::c);
    for (const State& state : observer.states) fields_.push_back(fields(state.name));
    Identifiers parameters(Language::c, {"state", "rate", "dt", "out", "z", "d", "w", "s", "k", "i",
                                         "j", "h", "steps", "M", "Phi", "Psi", "c"});
    for (const Variable& input : observer.inputs) {
      parameters_[input.key] = parameters(input.name);
      names_[input.key] = flat_elements(parameters_[input.key], input.shape);
    }
    for (std::size_t k = 0; k < fields_.size(); ++k)
      names_[observer.states[k].key] = c_elements("state->" + fields_[k], observer.states[k].shape);
  }

  std::string text() {
    std::string text = structure() + start();
    if (!observer_.rate.empty()) text += attempt("the flow", [&] { return rate(); });
    if (observer_.linear && !observer_.rate.empty())
      text += attempt("the exact flow", [&] { return flow(); });
    for (const Jump& jump : observer_.jumps)
      text += attempt("the map at " + jump.event, [&] { return this->jump(jump); });
    for (const Output& output : observer_.outputs)
      text += attempt("the output " + output.name, [&] { return this->output(output); });
    return text;
  }

 private:
  template <class Work>
  std::string attempt(const std::string& what, const Work& work) {
    try {
      return work();
    } catch (const NoCode& none) {
      notes_.push_back("observer " + observer_.name + ": " + what + " is left out: " + none.what());
      return "";
    }
  }

  std::string type() const { return type_of(dialect_); }
  std::string state_type() const { return prefix_ + "state"; }

  std::string structure() const {
    std::string text = fmt::format("/* The observer {}. */\ntypedef struct {{\n", observer_.name);
    for (std::size_t k = 0; k < fields_.size(); ++k)
      text += fmt::format("  {} {}{};\n", type(), fields_[k], extent(observer_.states[k].shape));
    return text + "} " + state_type() + ";\n\n";
  }

  std::string start() const {
    std::string text = fmt::format(
        "/* Where it starts: 0 where the problem does not say. */\nstatic inline void {}start({} *state)\n{{\n",
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

  std::string unread_of(const std::vector<const Variable*>& inputs, const std::string& body) const {
    std::vector<std::string> parameters = {"state"};
    for (const Variable* input : inputs) parameters.push_back(parameters_.at(input->key));
    return unread(parameters, body);
  }

  Code code(const std::vector<expr::Program>& programs, const ElementNames& names) {
    Code made = scalar_code(programs, names, content_.values, dialect_);
    helpers_.insert(made.helpers.begin(), made.helpers.end());
    return made;
  }

  static std::vector<expr::Program> programs_of(const std::vector<Assigned>& list) {
    std::vector<expr::Program> programs;
    for (const Assigned& one : list) programs.push_back(one.value);
    return programs;
  }

  static std::vector<const expr::Program*> pointers(const std::vector<expr::Program>& programs) {
    std::vector<const expr::Program*> list;
    for (const expr::Program& program : programs) list.push_back(&program);
    return list;
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

  std::string rate() {
    const auto programs = programs_of(observer_.rate);
    const auto inputs = inputs_read(observer_, pointers(programs));
    const Code made = code(programs, names_);
    std::string body;
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const bool flows = std::any_of(observer_.rate.begin(), observer_.rate.end(),
                                     [&](const Assigned& one) { return one.state == k; });
      if (flows) continue;
      for (const std::string& element : c_elements("rate->" + fields_[k], observer_.states[k].shape))
        body += fmt::format("  {} = {};\n", element, number_text(0, dialect_));
    }
    body += lines_text(made.lines, "  ") + assignments(observer_.rate, made, "rate->");
    return fmt::format(
        "/* The rate of the states between events. */\n"
        "static inline void {}rate(const {} *state{}, {} *rate)\n{{\n{}{}}}\n\n",
        prefix_, state_type(), parameters(inputs), state_type(), unread_of(inputs, body), body);
  }

  std::string matrix(const std::string& name, const numbers::Matrix& M) const {
    std::string text = fmt::format("  static const {} {}[{}][{}] = {{\n", type(), name, M.rows(), M.cols());
    for (Eigen::Index i = 0; i < M.rows(); ++i) {
      text += "    {";
      for (Eigen::Index j = 0; j < M.cols(); ++j)
        text += (j > 0 ? ", " : "") + number_text(M(i, j), dialect_);
      text += i + 1 < M.rows() ? "},\n" : "}};\n";
    }
    return text;
  }

  /// c = the rate where the states are 0, and z = the states.
  std::string constant_part(const Code& made) const {
    std::string text;
    int first = 0;
    for (const State& state : observer_.states)
      for (const std::string& element : names_.at(state.key))
        text += fmt::format("  z[{}] = {};\n", first++, element);
    text += lines_text(made.lines, "  ");
    for (std::size_t k = 0; k < observer_.rate.size(); ++k) {
      int at = 0;
      for (std::size_t s = 0; s < observer_.rate[k].state; ++s) at += observer_.states[s].shape.size();
      for (const std::string& value : made.results[k]) {
        if (value != number_text(0, dialect_)) text += fmt::format("  c[{}] = {};\n", at, value);
        ++at;
      }
    }
    return text;
  }

  std::string put_back() const {
    std::string text;
    int first = 0;
    for (const State& state : observer_.states)
      for (const std::string& element : names_.at(state.key))
        text += fmt::format("  {} = z[{}];\n", element, first++);
    return text;
  }

  std::string flow() {
    const auto still = rate_at_rest(observer_);
    const auto inputs = inputs_read(observer_, pointers(still));
    const Code made = code(still, names_);
    const numbers::Matrix& M = observer_.linear->M;
    const int n = observer_.size();
    std::string text = fmt::format(
        "/* The exact flow over the time dt >= 0{}: x' = M x + c, by Taylor's series over\n"
        "   steps h with |M| h <= 1. */\nstatic inline void {}flow({} *state{}, {} dt)\n{{\n",
        inputs.empty() ? "" : " while the inputs are held", prefix_, state_type(),
        parameters(inputs), type());
    text += matrix("M", M);
    text += fmt::format(
        "  const int steps = 1 + (int)({} * dt);\n  const {} h = dt / ({})steps;\n  {} z[{}], d[{}], w[{}];\n"
        "  {} c[{}] = {{{}}};\n",
        number_text(one_norm(M), dialect_), type(), type(), type(), n, n, n, type(), n,
        number_text(0, dialect_));
    const std::string constant = constant_part(made);
    text += unread_of(inputs, constant) + constant;
    text += fmt::format(
        "  for (int s = 0; s < steps; ++s) {{\n"
        "    for (int i = 0; i < {0}; ++i) {{\n      d[i] = c[i];\n"
        "      for (int j = 0; j < {0}; ++j) d[i] += M[i][j] * z[j];\n      d[i] *= h;\n    }}\n"
        "    for (int k = 2; k <= {1}; ++k) {{\n"
        "      for (int i = 0; i < {0}; ++i) {{\n        z[i] += d[i];\n        w[i] = 0;\n"
        "        for (int j = 0; j < {0}; ++j) w[i] += M[i][j] * d[j];\n      }}\n"
        "      for (int i = 0; i < {0}; ++i) d[i] = w[i] * h / ({2})k;\n    }}\n"
        "    for (int i = 0; i < {0}; ++i) z[i] += d[i];\n  }}\n",
        n, terms_of_series(dialect_.single), type());
    text += put_back() + "}\n\n";
    return text + flow_period(made, inputs);
  }

  std::string flow_period(const Code& made, const std::vector<const Variable*>& inputs) const {
    const auto jump = std::find_if(observer_.jumps.begin(), observer_.jumps.end(),
                                   [](const Jump& one) { return one.period.has_value(); });
    if (jump == observer_.jumps.end()) return "";
    const auto [Phi, Psi] = step_matrices(observer_.linear->M, *jump->period);
    const int n = observer_.size();
    std::string text = fmt::format(
        "/* The same from one {} to the next, {} later. */\nstatic inline void {}flow_period({} *state{})\n{{\n",
        jump->event, model::printed(*jump->period), prefix_, state_type(), parameters(inputs));
    const std::string constant = constant_part(made);
    const bool still = constant.find("  c[") == std::string::npos;
    text += matrix("Phi", Phi);
    if (!still) text += matrix("Psi", Psi);
    text += fmt::format("  {} z[{}], w[{}];\n", type(), n, n);
    if (!still) text += fmt::format("  {} c[{}] = {{{}}};\n", type(), n, number_text(0, dialect_));
    text += unread_of(inputs, constant) + constant;
    text += fmt::format(
        "  for (int i = 0; i < {0}; ++i) {{\n    w[i] = 0;\n"
        "    for (int j = 0; j < {0}; ++j) w[i] += Phi[i][j] * z[j]{1};\n  }}\n"
        "  for (int i = 0; i < {0}; ++i) z[i] = w[i];\n",
        n, still ? "" : " + Psi[i][j] * c[j]");
    return text + put_back() + "}\n\n";
  }

  std::string jump(const Jump& jump) {
    std::vector<expr::Program> all;
    for (const auto& pass : jump.passes)
      for (const Assigned& one : pass) all.push_back(one.value);
    std::string body;
    for (const auto& pass : jump.passes) {
      const Code made = code(programs_of(pass), names_);
      body += "  {\n" + lines_text(made.lines, "    ");
      std::vector<std::string> stores;
      for (std::size_t k = 0; k < pass.size(); ++k) {
        const auto& to = names_.at(observer_.states[pass[k].state].key);
        for (std::size_t e = 0; e < to.size(); ++e) {
          if (to[e] == made.results[k][e]) continue;
          body += fmt::format("    const {} next_{} = {};\n", type(), stores.size(), made.results[k][e]);
          stores.push_back(fmt::format("    {} = next_{};\n", to[e], stores.size()));
        }
      }
      for (const std::string& store : stores) body += store;
      body += "  }\n";
    }
    const std::string name =
        observer_.jumps.size() == 1 ? taken_(prefix_ + "jump") : taken_(prefix_ + "jump_" + jump.event);
    const auto inputs = inputs_read(observer_, pointers(all));
    return fmt::format("/* What happens at the event {}. */\nstatic inline void {}({} *state{})\n{{\n{}{}}}\n\n",
                       jump.event, name, state_type(), parameters(inputs), unread_of(inputs, body), body);
  }

  std::string output(const Output& output) {
    const Code made = code({output.value}, names_);
    const auto inputs = inputs_read(observer_, {&output.value});
    return function(output.name, taken_(prefix_ + output.name),
                    "const " + state_type() + " *state" + parameters(inputs), output.value.shape(), made,
                    dialect_, [&](const std::string& body) { return unread_of(inputs, body); });
  }

  const Content& content_;
  const Observer& observer_;
  std::string prefix_;
  ElementNames names_;
  Dialect dialect_;
  std::set<std::string>& helpers_;
  Identifiers& taken_;
  std::vector<std::string>& notes_;
  std::vector<std::string> fields_;
  std::map<std::string, std::string> parameters_;
};

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
                          const ElementNames& gains, const Dialect& dialect,
                          std::set<std::string>& helpers) {
  Identifiers parameters(Language::c, {"out"});
  const std::string variable = parameters(gain.variable);
  ElementNames names = gains;
  names[gain.variable] = {variable};
  const Code made = scalar_code({gain.program}, names, content.values, dialect);
  helpers.insert(made.helpers.begin(), made.helpers.end());
  return function(fmt::format("{}({}) = {}", gain.name, gain.variable, gain.text), name,
                  type_of(dialect) + " " + variable, gain.program.shape(), made, dialect,
                  [&](const std::string& body) { return unread({variable}, body); });
}

/// Without what would end the comment.
std::string commented(const std::vector<std::string>& lines) {
  std::string text = "/* ";
  for (std::size_t k = 0; k < lines.size(); ++k) text += (k > 0 ? "\n   " : "") + lines[k];
  for (std::size_t k = 3; (k = text.find("*/", k)) != std::string::npos;) text.replace(k, 2, "* /");
  for (std::size_t k = 3; (k = text.find("/*", k)) != std::string::npos;) text.replace(k, 2, "/ *");
  return text + " */\n";
}

}  // namespace

std::string c_file(Content& content, const std::string& name) {
  const std::string prefix = Identifiers(Language::c)(name) + "_";
  const Dialect dialect{Language::c, content.single, prefix};
  Identifiers taken(Language::c, {prefix + "state", prefix + "start", prefix + "rate", prefix + "flow",
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
  std::set<std::string> helpers;
  std::string maps;
  for (const GainFunction& gain : content.functions) {
    try {
      maps += function_text(content, gain, taken(prefix + gain.name), gains, dialect, helpers);
    } catch (const NoCode& none) {
      content.notes.push_back("the gain " + gain.name + " is left out: " + none.what());
    }
  }
  for (const Observer& observer : content.observers) {
    const std::string own =
        content.observers.size() == 1 ? prefix : taken(prefix + observer.name) + "_";
    maps += CObserver(content, observer, own, gains, dialect, helpers, taken, content.notes).text();
  }
  const std::string guard = Identifiers(Language::c)(prefix + "gains_h");
  std::vector<std::string> lines = head_lines(content, name);
  lines.emplace_back("C99; no memory is allocated. Maps hold the numbers of the problem: export again after a change.");
  for (const std::string& note : content.notes) lines.push_back("Note: " + note);
  return commented(lines) +
         fmt::format("#ifndef {0}\n#define {0}\n\n#include <math.h>\n\n{1}{2}{3}#endif\n", guard, constants,
                     helper_text(helpers, dialect), maps);
}

}  // namespace gainsmith::exports
