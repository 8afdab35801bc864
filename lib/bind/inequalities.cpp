// A requirement is a chain of comparisons of symmetric matrices, A < B < C, over domains of its
// variables:
//
//   forall: x in [a, b]    an interval, or a box of columns, element by element
//   forall: x in {a, b}    a finite set, or the elements of a vector
//   forall: x in R^n       all real columns: a sum of squares, with `where` as side conditions
//
// Each comparison becomes larger side - smaller side > 0 or >= 0. Indices are expanded before.
#include "bind/inequalities.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "base/nearest.h"
#include "base/number.h"
#include "bind/bind.h"
#include "bind/convex_terms.h"
#include "bind/estimates.h"
#include "bind/families.h"
#include "bind/formulas.h"

namespace gainsmith::bind {

namespace {

/// Whether a program reads the unknown: the matrix, a coefficient of the function or the function.
bool uses(const expr::Program& program, const model::Design::Unknown& unknown) {
  const auto is_named = [&](const expr::Input& input) {
    if (input.name == unknown.name) return true;
    if (unknown.variable.empty()) return false;
    if (input.name == expr::derivative_name(unknown.name)) return true;
    for (int k = 0; k <= unknown.degree; ++k)
      if (input.name == model::coefficient_name(unknown.name, static_cast<std::size_t>(k)))
        return true;
    return false;
  };
  return std::any_of(program.inputs.begin(), program.inputs.end(), is_named) ||
         std::any_of(program.functions.begin(), program.functions.end(), is_named);
}

/// "vector(k)".
expr::Expression element_of(const expr::Expression& vector, int k) {
  auto number = std::make_shared<expr::Node>(*vector.root);
  number->kind = expr::NodeKind::number;
  number->text = std::to_string(k);
  number->children.clear();
  auto element = std::make_shared<expr::Node>(*vector.root);
  element->kind = expr::NodeKind::index;
  element->children = {vector.root, number};
  return {vector.text, element};
}

/// "; 'p' in 'flow' is another name, as case counts": where a dimension or a datum may have been
/// meant for the unknown.
std::string in_another_case(const model::Design& design, const std::string& unknown) {
  for (const model::Requirement& requirement : design.source->method->require)
    for (const std::string& name : expr::names_in(requirement.that))
      if (differs_in_case(name, unknown))
        return "; '" + name + "' in '" + requirement.name + "' is another name, as case counts";
  return "";
}

/// The ends, elements or vertices as they are written, or the elements of a vector.
std::vector<expr::Expression> points_of(const Binding& binding, const model::Forall& forall,
                                        const Member& member) {
  std::vector<expr::Expression> points;
  for (const expr::Expression& point : forall.points)
    points.push_back(instantiate(point, member, binding.names->known));
  if (!forall.of_vector) return points;
  const expr::Expression& vector = points.front();
  const expr::Shape shape = expr::compile(vector, binding.names->known).shape();
  if (shape.rows != 1 && shape.cols != 1)
    throw InputError(vector.place(*vector.root),
                     "'" + vector.quote(*vector.root) + "' is " + to_string(shape) + ": " +
                         forall.variable +
                         " runs over the elements of a vector, an interval "
                         "[low, high], or a set {a, b, ...}");
  std::vector<expr::Expression> elements;
  for (int k = 1; k <= shape.size(); ++k) elements.push_back(element_of(vector, k));
  return elements;
}

/// n of "x in R^n", a whole number of known values.
int length_of(const Binding& binding, const model::Forall& forall, const Member& member) {
  if (forall.points.empty()) return 1;
  constexpr double kMost = 100;
  const expr::Expression text = instantiate(forall.points.front(), member, binding.names->known);
  const model::Formula formula = scalar(text, binding.names->known);
  const double length = scalar_value(formula, binding.recorder->values);
  if (!(length >= 1 && length <= kMost) || std::trunc(length) != length)
    throw InputError(
        formula.place,
        forall.variable + " in R^n: n must be a whole number from 1 to 100, not " + brief(length));
  return static_cast<int>(length);
}

/// "h in R" where R is a vector of the data runs over its elements.
model::Forall meant(const Binding& binding, const model::Forall& forall) {
  const bool is_vector = forall.over == model::Over::reals && forall.points.empty() &&
                         binding.names->known.symbols.contains("R");
  if (!is_vector) return forall;
  const expr::Text text = expr::Text::generated("R", forall.place);
  return {forall.variable, model::Over::set, {expr::parse(text)}, forall.place, true};
}

/// The variable with its points: both ends of an interval, or the elements of a set, all of one
/// shape.
model::Design::Variable variable(const Binding& binding, const model::Forall& forall,
                                 const Member& member) {
  model::Design::Variable bound{forall.variable, forall.over, {}, {}, forall.place};
  const expr::Scope& scope = binding.names->known;
  if (forall.over == model::Over::reals) {
    const int length = length_of(binding, forall, member);
    bound.shape = {length, 1};
    return bound;
  }
  const std::vector<expr::Expression> points = points_of(binding, forall, member);
  if (forall.over == model::Over::interval) {
    for (const expr::Expression& end : points) bound.points.push_back(scalar(end, scope));
    return bound;
  }
  for (const expr::Expression& element : points) {
    bound.points.push_back(formula(element, scope));
    const expr::Shape shape = bound.points.back().program.shape();
    if (bound.points.size() == 1) bound.shape = shape;
    if (shape != bound.shape)
      throw InputError(element.place(*element.root),
                       "the elements of " + forall.variable + " must have one shape; found " +
                           to_string(bound.shape) + " and " + to_string(shape));
    bound.points.back().text = element.quote(*element.root);
    if (forall.of_vector)
      bound.points.back().text += "(" + std::to_string(bound.points.size()) + ")";
  }
  return bound;
}

/// "x in [lo, hi]" with columns: its elements are the variables x_1, x_2, ..., each in its
/// interval, and x is the column of them. An end may be a number for all elements.
void add_box(const Binding& binding, const model::Forall& forall, const Member& member,
             int elements, model::Design::Inequality& bound, expr::Scope& scope) {
  std::string column;
  for (int k = 1; k <= elements; ++k) {
    const std::string name = expr::member_name(forall.variable, {k});
    if (scope.symbols.contains(name) || scope.definitions.contains(name))
      throw InputError(forall.place, "'" + name + "' is an element of " + forall.variable +
                                         " here, but it already has a meaning");
    model::Design::Variable element{name, forall.over, {}, {}, forall.place};
    for (const expr::Expression& point : forall.points) {
      const expr::Expression end = instantiate(point, member, binding.names->known);
      const bool number = expr::compile(end, binding.names->known).shape().size() == 1;
      element.points.push_back(scalar(number ? end : element_of(end, k), binding.names->known));
    }
    bound.domain.push_back(std::move(element));
    scope.symbols[name] = {bound.domain.back().shape};
    column += (k == 1 ? "" : "; ") + name;
  }
  const std::string text = elements == 0 ? "zeros(0, 1)" : "[" + column + "]";
  scope.definitions[forall.variable] = {{}, expr::parse(expr::Text::generated(text, forall.place))};
}

/// How many elements the ends of an interval have, when it is one of columns; none otherwise.
std::optional<int> elements_of_box(const Binding& binding, const model::Forall& forall,
                                   const Member& member) {
  if (forall.over != model::Over::interval) return std::nullopt;
  int rows = 1;
  for (const expr::Expression& point : forall.points) {
    const expr::Expression end = instantiate(point, member, binding.names->known);
    const expr::Shape shape = expr::compile(end, binding.names->known).shape();
    if (shape.cols != 1 || (shape.rows != 1 && rows != 1 && shape.rows != rows))
      throw InputError(end.place(*end.root), "the ends of " + forall.variable +
                                                 " are numbers, or columns of one length; found " +
                                                 to_string(shape));
    if (shape.rows != 1) rows = shape.rows;
  }
  return rows == 1 ? std::nullopt : std::optional(rows);
}

/// A number that is affine after bounding its convex terms; or lambda_max(M, N), the least l with M
/// <= l N, which is quasiconvex: it is minimised as a generalised eigenvalue.
void bind_objective(Binding& binding, const expr::Expression& text) {
  const expr::Node& root = *text.root;
  const bool quotient =
      root.kind == expr::NodeKind::call && root.text == "lambda_max" && root.children.size() == 2;
  if (!quotient) {
    binding.design->objective = scalar(affine_objective(binding, text), binding.names->design);
    refuse_estimate(*binding.design, binding.design->objective->program, "a minimum");
    return;
  }
  const expr::Expression first{text.text, root.children[0]};
  const expr::Expression second{text.text, root.children[1]};
  // The smaller one may be a multiple of I.
  const auto square = [&](const expr::Expression& part, std::optional<expr::Shape> expected) {
    expr::Program program = expr::compile(part, binding.names->design, expected);
    if (!program.shape().is_square())
      throw InputError(part.place(*part.root),
                       "lambda_max takes symmetric matrices; found " + to_string(program.shape()));
    return program;
  };
  model::Design::Quotient bound;
  bound.numerator = square(first, std::nullopt);
  bound.denominator = square(second, bound.numerator.shape());
  for (const expr::Program* side : {&bound.numerator, &bound.denominator})
    refuse_estimate(*binding.design, *side, "a minimum");
  bound.text = text.quote(root);
  bound.denominator_text = text.quote(*second.root);
  bound.place = text.place(root);
  binding.design->quotient = std::move(bound);
}

/// InputError where a comparison under `where` has an unknown.
void refuse_unknowns_in(const Binding& binding, const expr::CompiledRelation& relation,
                        const Place& place) {
  for (const model::Design::Unknown& unknown : binding.design->unknowns)
    if (uses(relation.difference, unknown))
      throw InputError(place,
                       "'where' has the unknown " + unknown.name +
                           ": its product with an unknown multiplier is bilinear; fix it as a "
                           "datum, search a scalar of it, or solve in turn for the one and the "
                           "other (docs/sums-of-squares.md)");
}

/// None where the requirement is no sum of squares. `where` gives g_i(x) >= 0, `degree` that of
/// multipliers.
std::optional<model::Design::Inequality::SumOfSquares> sum_of_squares(
    const Binding& binding, const model::Requirement& requirement, const Member& member,
    const std::vector<model::Design::Variable>& domain, const expr::Scope& scope) {
  const bool is_over_reals = std::ranges::any_of(
      domain, [](const auto& variable) { return variable.over == model::Over::reals; });
  if (!requirement.sos && !is_over_reals) {
    if (!requirement.where.empty() || requirement.degree)
      throw InputError(requirement.place,
                       "'where' and 'degree' are of sums of squares: add by: sos, or forall: x in "
                       "R^n");
    return std::nullopt;
  }
  model::Design::Inequality::SumOfSquares result{{}, requirement.degree, requirement.adds_degree};
  for (const expr::Expression& text : requirement.where)
    for (const expr::Expression& part : expr::conjuncts(instantiate(text, member, scope))) {
      const Place place = part.place(*part.root);
      for (expr::CompiledRelation& relation : expr::compile_relations(part, scope)) {
        refuse_unknowns_in(binding, relation, place);
        refuse_estimate(*binding.design, relation.difference, "'" + requirement.name + "'");
        result.where.push_back({std::move(relation.difference), relation.equation, place});
      }
    }
  return result;
}

/// One member of a requirement. Variables of `forall` are names of its own scope alone.
model::Design::Inequality inequality(Binding& binding, const model::Requirement& requirement,
                                     const Member& member) {
  model::Design::Inequality bound;
  bound.name = member.title_of(requirement.name);
  bound.place = requirement.place;
  const bool adds = !requirement.forall.empty();  // names; otherwise nothing is copied
  expr::Scope own = adds ? binding.names->design : expr::Scope{};
  expr::Scope& scope = adds ? own : binding.names->design;
  const expr::Expression that = instantiate(requirement.that, member, scope);
  bound.that_place = that.place(*that.root);
  for (const model::Forall& written : requirement.forall) {
    const model::Forall forall = meant(binding, written);
    if (const auto elements = elements_of_box(binding, forall, member)) {
      add_box(binding, forall, member, *elements, bound, scope);
      continue;
    }
    bound.domain.push_back(variable(binding, forall, member));
    scope.symbols[forall.variable] = {bound.domain.back().shape};
  }
  std::vector<expr::Expression> comparisons;
  bound.sos = sum_of_squares(binding, requirement, member, bound.domain, scope);
  for (const expr::Expression& part : expr::conjuncts(that)) {
    if (bound.sos) {
      comparisons.push_back(part);
      continue;
    }
    for (expr::Expression& comparison : affine_comparisons(binding, part, scope, adds))
      comparisons.push_back(std::move(comparison));
  }
  add_comparisons(comparisons, bound, requirement.name, member.label, scope);
  for (const auto& comparison : bound.comparisons)
    refuse_estimate(*binding.design, comparison.difference, "'" + requirement.name + "'");
  for (const model::Design::Variable& variable : bound.domain)
    for (const model::Formula& point : variable.points)
      refuse_estimate(*binding.design, point.program, "'" + requirement.name + "'");
  return bound;
}

/// One inequality for each member of the indices that fulfils the conditions.
void add_inequalities(Binding& binding, const std::vector<model::Requirement>& requirements,
                      std::vector<model::Design::Inequality>& out) {
  for (const model::Requirement& requirement : requirements)
    for (const Member& member :
         members(requirement.indices, requirement.conditions, binding.names->design))
      out.push_back(inequality(binding, requirement, member));
}

bool uses(const std::vector<model::Design::Inequality>& inequalities,
          const model::Design::Unknown& unknown) {
  for (const model::Design::Inequality& inequality : inequalities)
    for (const model::Design::Comparison& comparison : inequality.comparisons)
      if (uses(comparison.difference, unknown)) return true;
  return false;
}

/// The unknowns that only necessary inequalities use go with them.
void set_unknowns_aside(model::Design& design) {
  const auto others = std::ranges::stable_partition(design.unknowns, [&](const auto& unknown) {
    return uses(design.inequalities, unknown) || !uses(design.necessary.inequalities, unknown);
  });
  std::ranges::move(others, std::back_inserter(design.necessary.unknowns));
  design.unknowns.erase(others.begin(), others.end());
}

}  // namespace

/// All comparisons of the chains, numbered where there are several.
void add_comparisons(const std::vector<expr::Expression>& comparisons,
                     model::Design::Inequality& bound, const std::string& stem,
                     const std::string& member, const expr::Scope& scope) {
  std::vector<expr::CompiledRelation> relations;
  for (const expr::Expression& comparison : comparisons)
    for (expr::CompiledRelation& relation : expr::compile_relations(comparison, scope))
      relations.push_back(std::move(relation));
  const std::string at = member.empty() ? "" : " at " + member;
  for (std::size_t k = 0; k < relations.size(); ++k) {
    const std::string end = (relations.size() > 1 ? "." + std::to_string(k + 1) : "") + at;
    bound.comparisons.push_back(
        {stem + end, std::move(relations[k].difference), relations[k].strict});
  }
}

/// Necessary inequalities are kept apart, with the unknowns that they alone use.
void bind_inequalities(Binding& binding) {
  add_inequalities(binding, binding.method().require, binding.design->inequalities);
  add_inequalities(binding, binding.method().necessary, binding.design->necessary.inequalities);
  set_unknowns_aside(*binding.design);
  if (binding.method().minimize) bind_objective(binding, *binding.method().minimize);
  if (binding.method().minimize && binding.design->inequalities.empty() &&
      !binding.design->quotient)
    throw InputError({binding.method().file}, "the method '" + binding.method().name +
                                                  "' has no inequality under 'require'");
}

/// Unknowns without elements are free of it.
void refuse_free_unknowns(const model::Design& design) {
  const auto is_bound = [&](const model::Design::Unknown& unknown) {
    if (uses(design.inequalities, unknown)) return true;
    if (design.quotient &&
        (uses(design.quotient->numerator, unknown) || uses(design.quotient->denominator, unknown)))
      return true;
    return unknown.shape.size() == 0;
  };
  for (const model::Design::Unknown& unknown : design.unknowns) {
    if (is_bound(unknown)) continue;
    const auto user = std::find_if(
        design.gains.begin(), design.gains.end(),
        [&](const model::Design::Gain& gain) { return uses(gain.formula.program, unknown); });
    throw InputError(
        unknown.place,
        "the unknown " + unknown.name +
            " is used by no inequality under 'require', so nothing determines it" +
            in_another_case(design, unknown.name) +
            (user == design.gains.end() ? "" : "; the gain " + user->name + " needs it") +
            ": require something of it, or remove it");
  }
}

}  // namespace gainsmith::bind
