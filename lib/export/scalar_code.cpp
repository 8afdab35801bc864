// Code of programs by the graph of their scalar operations.
//
// A node that several others read, or whose formula is longer than a line, gets a variable gs<k>;
// all others are written where they are read. Inverses and large products are blocks with an array
// gsb<k> and keep their matrix form. Constants were folded when the graph was made.
#include "export/scalar_code.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

#include "base/number.h"
#include "expr/program/operations.h"
#include "model/gains.h"
#include "numbers/graph/scalar_graph.h"
#include "numbers/graph/scalar_trace.h"

namespace gainsmith::exports {

namespace {

using numbers::ScalarGraph;
using numbers::ScalarOp;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// A formula with how tightly its outermost operation binds.
struct Term {
  enum Binding { loose, sum, product, atom };
  std::string text;
  Binding binding = atom;
};

/// The text, in parentheses where it binds less tightly than its place needs.
std::string within(const Term& term, Term::Binding least) {
  return term.binding >= least ? term.text : "(" + term.text + ")";
}

/// Writes the nodes of one graph in the order in which they were made, operands first.
class Writer {
 public:
  Writer(const ScalarGraph& graph, const std::vector<std::string>& inputs, const Dialect& dialect)
      : graph_(graph), inputs_(inputs), dialect_(dialect), terms_(graph.nodes().size()) {}

  /// The code of these nodes, one list for each program. The writer is of no use after it.
  Code write(const std::vector<std::vector<int>>& results) {
    count(results);
    for (std::size_t k = 0; k < uses_.size(); ++k)
      if (uses_[k] > 0) add(static_cast<int>(k));
    for (const std::vector<int>& nodes : results) {
      code_.results.emplace_back();
      for (const int node : nodes) code_.results.back().push_back(terms_[at(node)].text);
    }
    return std::move(code_);
  }

 private:
  using Node = ScalarGraph::Node;
  const Node& node(int k) const { return graph_.nodes()[at(k)]; }

  /// Whether a, b, c of the node are nodes: others have an index or nothing there.
  static bool has_operands(const Node& node) {
    return node.op != ScalarOp::input && node.op != ScalarOp::constant &&
           node.op != ScalarOp::element;
  }

  /// How often each node is read.
  void count(const std::vector<std::vector<int>>& results) {
    uses_.assign(graph_.nodes().size(), 0);
    for (const auto& nodes : results)
      for (const int one : nodes) ++uses_[at(one)];
    // Operands precede what reads them: from the last node on all readers of a node are counted.
    for (std::size_t k = uses_.size(); k-- > 0;) {
      if (uses_[k] == 0) continue;
      const Node& node = graph_.nodes()[k];
      if (node.op == ScalarOp::element)
        for (const auto& operand : graph_.blocks()[at(node.a)].operands)
          for (const int read : operand) ++uses_[at(read)];
      if (has_operands(node))
        for (const int read : {node.a, node.b, node.c})
          if (read >= 0) ++uses_[at(read)];
    }
  }

  /// The term of a node, and a variable for it where it needs one.
  void add(int k) {
    // Characters: a longer formula gets a variable even where it is read once.
    constexpr std::size_t kLine = 72;
    const Node& one = node(k);
    Term& term = terms_[at(k)];
    if (one.op == ScalarOp::input) {
      term = {inputs_[at(one.a)], Term::atom};
    } else if (one.op == ScalarOp::constant) {
      const double value = graph_.value(k);
      // A negative number binds like a sign: 2 - (-1).
      term = {number_text(value, dialect_), value < 0 ? Term::loose : Term::atom};
    } else if (one.op == ScalarOp::element) {
      add_block(one.a);
      const int element = k - graph_.blocks()[at(one.a)].first;
      term = {dialect_.language == Language::matlab ? fmt::format("gsb{}({})", one.a, element + 1)
                                                    : fmt::format("gsb{}[{}]", one.a, element),
              Term::atom};
    } else {
      term = formula(one);
      // It is written where it is read.
      if (uses_[at(k)] == 1 && term.text.size() <= kLine) return;
      const std::string name = "gs" + std::to_string(k);
      define(name, term.text);
      term = {name, Term::atom};
    }
  }

  /// A statement that gives a variable its value.
  void define(const std::string& name, const std::string& value) {
    if (dialect_.language == Language::c)
      code_.lines.push_back("const " + type_of(dialect_) + " " + name + " = " + value + ";");
    else
      code_.lines.push_back(name + " = " + value +
                            (dialect_.language == Language::matlab ? ";" : ""));
  }

  /// a o b. The right operand binds more tightly: a - (b - c) and a / (b / c) keep their
  /// parentheses.
  Term binary(const Node& node, const char* sign, Term::Binding own) const {
    const auto tighter = static_cast<Term::Binding>(own + 1);
    return {within(terms_[at(node.a)], own) + sign + within(terms_[at(node.b)], tighter), own};
  }

  /// f(a), or f(a, b).
  Term call(const std::string& function, const Node& node) const {
    std::string text = function + "(" + terms_[at(node.a)].text;
    if (node.b >= 0) text += ", " + terms_[at(node.b)].text;
    return {text + ")", Term::atom};
  }

  /// A function of the language's library.
  Term library(const std::string& name, const Node& node) {
    code_.library = true;
    switch (dialect_.language) {
      case Language::c:
        return call(name + (dialect_.single ? "f" : ""), node);
      case Language::python:
        return call("math." + name, node);
      case Language::matlab:
        break;
    }
    return call(name, node);
  }

  /// A function of helper_text().
  Term helper(const std::string& name, const Node& node) {
    code_.helpers.insert(name);
    code_.library = code_.library || name == "mod";
    return call(dialect_.prefix + name, node);
  }

  /// A function that the language has under this name, and C has not.
  Term own(const std::string& name, const Node& node) {
    return dialect_.language == Language::c ? helper(name, node) : call(name, node);
  }

  /// b where a > 0, or a >= 0, and otherwise c. MATLAB has no such expression and gets a function.
  Term choice(const Node& node, const char* sign) {
    const std::string condition =
        within(terms_[at(node.a)], Term::sum) + sign + number_text(0, dialect_);
    const std::string yes = within(terms_[at(node.b)], Term::sum);
    const std::string no = within(terms_[at(node.c)], Term::sum);
    switch (dialect_.language) {
      case Language::c:
        return {condition + " ? " + yes + " : " + no, Term::loose};
      case Language::python:
        return {yes + " if " + condition + " else " + no, Term::loose};
      case Language::matlab:
        break;
    }
    code_.helpers.insert("choose");
    return {"choose(" + condition + ", " + yes + ", " + no + ")", Term::atom};
  }

  Term formula(const Node& node) {
    switch (node.op) {
      case ScalarOp::add:
        return binary(node, " + ", Term::sum);
      case ScalarOp::subtract:
        return binary(node, " - ", Term::sum);
      case ScalarOp::multiply:
        return binary(node, "*", Term::product);
      case ScalarOp::divide:
        return binary(node, "/", Term::product);
      case ScalarOp::negate:
        return {"-" + within(terms_[at(node.a)], Term::atom), Term::loose};
      case ScalarOp::minimum:
        return own("min", node);
      case ScalarOp::maximum:
        return own("max", node);
      case ScalarOp::where_positive:
        return choice(node, " > ");
      case ScalarOp::where_nonnegative:
        return choice(node, " >= ");
      case ScalarOp::real_power:
        return dialect_.language == Language::matlab ? call("power", node) : library("pow", node);
      case ScalarOp::mod:
        return dialect_.language == Language::python
                   ? Term{within(terms_[at(node.a)], Term::atom) + " % " +
                              within(terms_[at(node.b)], Term::atom),
                          Term::loose}
                   : own("mod", node);
      case ScalarOp::atan2:
        return angle(node);
      case ScalarOp::abs:
        return dialect_.language == Language::c ? library("fabs", node) : call("abs", node);
      case ScalarOp::sign:
        return dialect_.language == Language::matlab ? call("sign", node) : helper("sign", node);
      default:
        break;
    }
    // All languages have the others under the name of the table.
    switch (node.op) {
#define NUMBERS(op, ...) \
  case ScalarOp::op:     \
    return library(#op, node);
#include "expr/operations.def"
      default:
        throw std::logic_error("a node that is no operation");
    }
  }

  /// Zeros lose their signs, which do not count.
  Term angle(const Node& node) {
    code_.library = true;
    const std::string zero = " + " + number_text(0, dialect_);
    const Term both{within(terms_[at(node.a)], Term::sum) + zero + ", " +
                        within(terms_[at(node.b)], Term::sum) + zero,
                    Term::atom};
    const std::string name = dialect_.language == Language::python ? "math.atan2"
                             : dialect_.single                     ? "atan2f"
                                                                   : "atan2";
    return {name + "(" + both.text + ")", Term::atom};
  }

  /// An inverse, or a product with many terms.
  void add_block(int k) {
    if (!known_blocks_.insert(k).second) return;
    const ScalarGraph::Block& block = graph_.blocks()[at(k)];
    // Of the operations on whole matrices these two alone have code.
    const bool inverse = block.instruction.op == expr::Op::inverse;
    if (!inverse && block.instruction.op != expr::Op::multiply)
      throw NoCode("'" + expr::to_string(block.instruction.op) + "' has no formula on numbers");
    std::vector<std::string> names;
    for (std::size_t i = 0; i < block.operands.size(); ++i)
      names.push_back(
          add_operand(fmt::format("gsb{}_{}", k, i), block.operands[i], block.shapes[i]));
    const std::string name = "gsb" + std::to_string(k);
    if (dialect_.language == Language::c) {
      code_.helpers.insert(inverse ? "inverse" : "product");
      code_.library = code_.library || inverse;
      code_.lines.push_back(
          fmt::format("{} {}[{}];", type_of(dialect_), name, block.instruction.shape.size()));
      code_.lines.push_back(inverse
                                ? fmt::format("{}inverse({}, {}, {});", dialect_.prefix,
                                              block.shapes[0].rows, names[0], name)
                                : fmt::format("{}product({}, {}, {}, {}, {}, {});", dialect_.prefix,
                                              block.shapes[0].rows, block.shapes[0].cols,
                                              block.shapes[1].cols, names[0], names[1], name));
    } else if (dialect_.language == Language::python) {
      code_.lines.push_back(
          name + " = " +
          (inverse ? "np.linalg.inv(" + names[0] + ")" : names[0] + " @ " + names[1]) + "");
      code_.lines.push_back(name + " = " + name + ".ravel(order='F')");
    } else {
      code_.lines.push_back(name + " = " +
                            (inverse ? "inv(" + names[0] + ")" : names[0] + "*" + names[1]) + ";");
    }
  }

  /// An operand of a block as an array, column by column; of Python and MATLAB as a matrix. Its
  /// name.
  std::string add_operand(const std::string& name, const std::vector<int>& nodes,
                          expr::Shape shape) {
    std::string list;
    for (const int one : nodes) list += (list.empty() ? "" : ", ") + terms_[at(one)].text;
    if (dialect_.language == Language::c)
      code_.lines.push_back(
          fmt::format("{} {}[{}] = {{{}}};", type_of(dialect_), name, nodes.size(), list));
    else if (dialect_.language == Language::python)
      code_.lines.push_back(fmt::format("{} = np.array([{}]).reshape(({}, {}), order='F')", name,
                                        list, shape.rows, shape.cols));
    else
      code_.lines.push_back(
          fmt::format("{} = reshape([{}], {}, {});", name, list, shape.rows, shape.cols));
    return name;
  }

  const ScalarGraph& graph_;
  const std::vector<std::string>& inputs_;
  const Dialect& dialect_;
  std::vector<int> uses_;
  std::vector<Term> terms_;
  std::set<int> known_blocks_;
  Code code_;
};

}  // namespace

Code scalar_code(const std::vector<expr::Program>& programs, const ElementNames& names,
                 const numbers::Values& values, const Dialect& dialect) {
  // One graph for all programs, so that equal parts are computed once.
  ScalarGraph graph;
  std::vector<std::string> inputs;
  std::map<std::string, int, std::less<>> first;
  const auto input = [&](const expr::Input& named) -> numbers::TracedMatrix {
    if (named.shape.size() == 0) return {named.shape, {}};
    const auto found = names.find(named.name);
    if (found == names.end()) return numbers::traced(values.at(named.name), graph);
    const auto [place, fresh] = first.emplace(named.name, static_cast<int>(inputs.size()));
    if (fresh) inputs.insert(inputs.end(), found->second.begin(), found->second.end());
    numbers::TracedMatrix made{named.shape, {}};
    for (int k = 0; k < named.shape.size(); ++k)
      made.value.push_back(graph.input(place->second + k));
    return made;
  };
  std::vector<std::vector<int>> results;
  for (const expr::Program& program : programs)
    results.push_back(numbers::trace(program, input, graph).value);
  return Writer(graph, inputs, dialect).write(results);
}

std::string type_of(const Dialect& dialect) { return dialect.single ? "float" : "double"; }

std::string number_text(double value, const Dialect& dialect) {
  if (dialect.language != Language::c) return model::printed(value);
  // Nine digits are read back as the same number of single precision.
  constexpr int kSingleDigits = 9;
  std::string text = dialect.single
                         ? brief(static_cast<double>(static_cast<float>(value)), kSingleDigits)
                         : model::printed(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return dialect.single ? text + "f" : text;
}

std::string helper_text(const std::set<std::string>& helpers, const Dialect& dialect) {
  // $T: the type, $N: the prefix, $S: the end of names in the library.
  static const std::map<std::string, std::string> in_c = {
      {"min", "static inline $T $Nmin($T a, $T b) { return b < a ? b : a; }\n"},
      {"max", "static inline $T $Nmax($T a, $T b) { return a < b ? b : a; }\n"},
      {"sign",
       "static inline $T $Nsign($T a) { return a > 0 ? ($T)1 : a < 0 ? ($T)-1 : ($T)0; }\n"},
      {"mod",
       "/* a - b floor(a/b) */\n"
       "static inline $T $Nmod($T a, $T b)\n{\n"
       "  const $T rest = fmod$S(a, b);\n"
       "  return (rest < 0 && b > 0) || (rest > 0 && b < 0) ? rest + b : rest;\n}\n"},
      {"product",
       "/* c = a b, n x m by m x k, columns below each other */\n"
       "static inline void $Nproduct(int n, int m, int k, const $T *a, const $T *b, $T *c)\n{\n"
       "  for (int i = 0; i < n; ++i)\n    for (int j = 0; j < k; ++j) {\n      $T sum = 0;\n"
       "      for (int l = 0; l < m; ++l) sum += a[i + n * l] * b[l + m * j];\n"
       "      c[i + n * j] = sum;\n    }\n}\n"},
      {"inverse",
       "/* The inverse of the n x n matrix a, which is overwritten, by Gauss and Jordan with "
       "pivots in the\n"
       "   columns. Of a singular matrix it is not finite. */\n"
       "static inline void $Ninverse(int n, $T *a, $T *inverse)\n{\n"
       "  for (int i = 0; i < n * n; ++i) inverse[i] = i % (n + 1) == 0 ? ($T)1 : ($T)0;\n"
       "  for (int k = 0; k < n; ++k) {\n    int pivot = k;\n"
       "    for (int i = k + 1; i < n; ++i)\n"
       "      if (fabs$S(a[i + n * k]) > fabs$S(a[pivot + n * k])) pivot = i;\n"
       "    for (int j = 0; j < n; ++j) {\n"
       "      const $T one = a[k + n * j], other = inverse[k + n * j];\n"
       "      a[k + n * j] = a[pivot + n * j];\n      a[pivot + n * j] = one;\n"
       "      inverse[k + n * j] = inverse[pivot + n * j];\n      inverse[pivot + n * j] = "
       "other;\n    }\n"
       "    const $T scale = ($T)1 / a[k + n * k];\n"
       "    for (int j = 0; j < n; ++j) {\n      a[k + n * j] *= scale;\n      inverse[k + n * j] "
       "*= scale;\n    }\n"
       "    for (int i = 0; i < n; ++i) {\n      const $T factor = a[i + n * k];\n"
       "      if (i == k) continue;\n"
       "      for (int j = 0; j < n; ++j) {\n        a[i + n * j] -= factor * a[k + n * j];\n"
       "        inverse[i + n * j] -= factor * inverse[k + n * j];\n      }\n    }\n  }\n}\n"}};
  static const std::map<std::string, std::string> in_matlab = {
      {"choose", "function r = choose(c, a, b)\n  if c, r = a; else, r = b; end\nend\n"}};
  static const std::map<std::string, std::string> in_python = {
      {"sign", "def sign(a):\n    return float(a > 0) - float(a < 0)\n"}};
  const auto& all = dialect.language == Language::c        ? in_c
                    : dialect.language == Language::matlab ? in_matlab
                                                           : in_python;
  std::string text;
  for (const std::string& name : helpers) text += all.at(name) + "\n";
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t k = 0; (k = text.find(from, k)) != std::string::npos; k += to.size())
      text.replace(k, from.size(), to);
  };
  replace("$T", type_of(dialect));
  replace("$N", dialect.prefix);
  replace("$S", dialect.single ? "f" : "");
  return text;
}

}  // namespace gainsmith::exports
