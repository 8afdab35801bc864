#include "page/statement.h"

#include "base/named.h"
#include "drawing/text.h"
#include "page/element.h"
#include "page/lines.h"
#include "page/mathml.h"
#include "page/rows.h"
#include "page/symbol.h"

namespace gainsmith::page {

namespace {

using model::Declaration;

std::string help_of(const std::string& help) { return drawing::escaped(help); }

/// "n × p", "symmetric, n × n", "scalar".
std::string shape_text(const model::ShapeText& shape, const Notation& notation) {
  using model::Structure;
  if (shape.system) return "a linear system";
  if (shape.structure == Structure::scalar || !shape.rows) return "a number";
  const std::string rows = mathml(*shape.rows, notation);
  const std::string columns = shape.structure != Structure::full ? rows
                              : shape.cols                       ? mathml(*shape.cols, notation)
                                                                 : "<mn>1</mn>";
  const std::string kind =
      shape.structure == Structure::full ? "" : drawing::escaped(to_string(shape.structure)) + ", ";
  return kind + formula(rows + mo("×") + columns);
}

/// The rows of what is given. A value found by a search precedes that of the problem, and that its
/// default.
class Given {
 public:
  Given(const model::Problem& problem, const model::Gains& gains, const Notation& notation)
      : problem_(problem), gains_(gains), notation_(notation) {}

  std::string text() const {
    std::string data;
    for (const Declaration& datum : problem_.method->data) data += row_of(datum);
    std::string functions;
    for (const model::Let& function : problem_.functions) functions += definition(function);
    std::string parameters;
    for (const auto& parameter : problem_.method->parameters) parameters += row_of(parameter);
    std::string assumed;
    for (const model::Named& named : problem_.method->assume)
      assumed += formula_row(named.name, mathml(named.value, notation_));
    std::string definitions;
    for (const auto* list : {&problem_.method->let, &problem_.let})
      for (const model::Let& let : *list) definitions += definition(let);
    return group("Data", data + functions) + group("Parameters", parameters) +
           group("Assumed", assumed) + group("Definitions", definitions);
  }

 private:
  /// The value that a search found for a scalar.
  std::string searched(const std::string& name) const {
    const auto found = gains_.searched.find(name);
    return found == gains_.searched.end() ? "" : value(found->second);
  }

  std::string row_of(const Declaration& datum) const {
    std::string remark = help_of(datum.help);
    std::string right = searched(datum.name);
    if (!right.empty()) {
      remark += (remark.empty() ? "" : "; ") + std::string("found by the search");
    } else if (const model::Value* given = find_named(problem_.data, datum.name)) {
      right = value_mathml(*given, notation_);
      if (given->flat && datum.shape.is_column())  // a list is written as a row
        right = element("msup", row(right) + mo("⊤"));
    } else if (datum.fallback) {
      right = mathml(*datum.fallback, notation_);
    }
    if (right.empty()) return "";  // a function: it is shown below the data
    // A family that is a list of matrices is A_{1,...} = its members.
    const bool listed_members = !datum.indices.empty() &&
                                find_named(problem_.data, datum.name) != nullptr &&
                                !find_named(problem_.data, datum.name)->value.root;
    const std::string left = listed_members ? symbol(datum.name, {row(mo("1") + mo(",") + mo("…"))})
                                            : declared(datum.name, datum.indices, notation_);
    return formula_row("", equation(left, right), remark);
  }

  /// The value of the result precedes that of the problem, and that the default.
  std::string row_of(const model::Parameter& parameter) const {
    std::string remark = help_of(parameter.help);
    std::string right = searched(parameter.name);
    const numbers::Matrix* found = gains_.find(parameter.name);
    if (!right.empty())
      remark += (remark.empty() ? "" : "; ") + std::string("found by the search");
    else if (found != nullptr)
      right = matrix(*found);
    else if (const model::Value* given = find_named(problem_.parameters, parameter.name))
      right = value_mathml(*given, notation_);
    else if (parameter.fallback)
      right = mathml(*parameter.fallback, notation_);
    if (right.empty()) return "";
    return formula_row("", equation(name_mathml(parameter.name, notation_), right), remark);
  }

  std::string definition(const model::Let& let) const {
    return formula_row(
        "", equation(signature_mathml(let.signature, notation_), mathml(let.body, notation_)));
  }

  const model::Problem& problem_;
  const model::Gains& gains_;
  const Notation& notation_;
};

/// An unknown with its arguments, shape, degree, family and help.
std::string unknown_row(const model::UnknownDeclaration& unknown, const Notation& notation) {
  std::string left = declared(unknown.name, unknown.indices, notation);
  if (!unknown.variable.empty()) left = row(left + fenced(symbol(unknown.variable)));
  std::string arguments;
  for (const model::Argument& argument : unknown.arguments)
    arguments += (arguments.empty() ? "" : mo(",")) + symbol(argument.name);
  if (!arguments.empty()) left = row(left + fenced(row(arguments)));
  std::string remark = shape_text(unknown.shape, notation);
  if (unknown.degree)
    remark += ", a polynomial of degree " +
              (unknown.least ? formula(mathml(*unknown.least, notation)) + " to " : std::string()) +
              formula(mathml(*unknown.degree, notation));
  const std::string members = for_all_text(unknown.indices, notation);
  if (!members.empty()) remark += ", " + members;
  if (!unknown.help.empty()) remark += "; " + help_of(unknown.help);
  return formula_row("", left, remark);
}

/// tau ∈ [a, b], {a, b}, conv{A, B} or R^n.
std::string domain(const model::Forall& forall, const Notation& notation) {
  if (forall.over == model::Over::reals) {
    const std::string reals = "<mi>ℝ</mi>";
    const std::string space =
        forall.points.empty()
            ? reals
            : "<msup>" + reals + row(mathml(forall.points.front(), notation)) + "</msup>";
    return formula(row(symbol(forall.variable) + mo("∈") + space));
  }
  const bool set = forall.over == model::Over::set;
  std::string points = forall.of_vector && forall.points.size() == 1
                           ? mathml(forall.points.front(), notation)
                           : range_mathml(forall.points, notation,
                                          set || forall.over == model::Over::polytope ? "{" : "[",
                                          set || forall.over == model::Over::polytope ? "}" : "]");
  if (forall.over == model::Over::polytope) points = row("<mi>conv</mi>" + points);
  return formula(row(symbol(forall.variable) + mo("∈") + points));
}

}  // namespace

std::string given(const model::Problem& problem, const model::Gains& gains,
                  const Notation& notation) {
  return Given(problem, gains, notation).text();
}

std::string holds_for(const model::Requirement& requirement, const Notation& notation) {
  std::string text;
  const auto add = [&](const std::string& part) {
    text += (text.empty() ? "for all " : ", ") + part;
  };
  for (const expr::Index& index : requirement.indices) add(formula(index_mathml(index, notation)));
  for (const expr::Expression& condition : requirement.conditions)
    add(formula(mathml(condition, notation)));
  for (const model::Forall& forall : requirement.forall) add(domain(forall, notation));
  const char* before = " where ";
  for (const expr::Expression& condition : requirement.where) {
    text += before + formula(inequality_mathml(condition, notation));
    before = ", ";
  }
  return text;
}

/// A gain that is a function of a scalar has it in parentheses at its left side.
std::string wanted(const model::Problem& problem, const Notation& notation) {
  const model::Method& method = *problem.method;
  std::string unknowns;
  for (const auto& unknown : method.unknowns) unknowns += unknown_row(unknown, notation);
  const auto rows_of = [&](const std::vector<model::Requirement>& list) {
    std::string rows;
    for (const model::Requirement& requirement : list)
      rows += formula_row(requirement.name, inequality_mathml(requirement.that, notation),
                          holds_for(requirement, notation));
    return rows;
  };
  std::string objective;
  if (method.minimize) objective = formula_row("", mathml(*method.minimize, notation));
  std::string gains;
  for (const model::Gain& gain : method.gains) {
    std::string left = declared(gain.name, gain.indices, notation);
    if (!gain.variable.empty()) left = row(left + fenced(symbol(gain.variable)));
    gains += formula_row("", equation(left, mathml(gain.value, notation)),
                         for_all_text(gain.indices, notation));
  }
  return group("Unknowns", unknowns) + group("Inequalities", rows_of(method.require)) +
         group("Necessary for any gains", rows_of(method.necessary)) +
         group("Minimised", objective) + group("Gains", gains);
}

}  // namespace gainsmith::page
