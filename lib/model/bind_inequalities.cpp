// The inequalities and the objective.
#include <algorithm>

#include "model/binding.h"

namespace gainsmith::model {

namespace {

/// Whether a program reads the unknown: the matrix, a coefficient of the function or the function.
bool uses(const expr::Program& program, const Design::Unknown& unknown) {
  const auto is_named = [&](const expr::Input& input) {
    if (input.name == unknown.name) return true;
    if (unknown.variable.empty()) return false;
    if (input.name == expr::derivative_name(unknown.name)) return true;
    for (int k = 0; k <= unknown.degree; ++k)
      if (input.name == coefficient_name(unknown.name, static_cast<std::size_t>(k))) return true;
    return false;
  };
  return std::any_of(program.inputs.begin(), program.inputs.end(), is_named) ||
         std::any_of(program.functions.begin(), program.functions.end(), is_named);
}

}  // namespace

Design::Variable Binding::variable(const Forall& forall) const {
  Design::Variable bound{forall.variable, forall.over, {}, {}, forall.place};
  const expr::Scope& scope = names_->known;
  if (forall.over == Over::interval) {
    for (const expr::Expression& end : forall.points) bound.points.push_back(scalar(end, scope));
    return bound;
  }
  for (const expr::Expression& element : forall.points) {
    bound.points.push_back(formula(element, scope));
    const expr::Shape shape = bound.points.back().program.shape();
    if (bound.points.size() == 1) bound.shape = shape;
    if (shape != bound.shape)
      throw InputError(element.place(*element.root),
                       "the elements of " + forall.variable + " must have one shape; found " +
                           to_string(bound.shape) + " and " + to_string(shape));
    bound.points.back().text = element.quote(*element.root);
  }
  return bound;
}

void Binding::bind_inequalities() {
  for (const Requirement& requirement : method().require) {
    Design::Inequality bound;
    bound.name = requirement.name;
    bound.place = requirement.place;
    bound.that_place = requirement.that.place(*requirement.that.root);
    expr::Scope scope = names_->design;
    for (const Forall& forall : requirement.forall) {
      bound.domain.push_back(variable(forall));
      scope.symbols[forall.variable] = {bound.domain.back().shape};
    }
    const auto relations = expr::compile_relations(requirement.that, scope);
    for (std::size_t k = 0; k < relations.size(); ++k)
      bound.comparisons.push_back(
          {relations.size() > 1 ? bound.name + "." + std::to_string(k + 1) : bound.name,
           relations[k].difference, relations[k].strict});
    design_->inequalities.push_back(std::move(bound));
  }
  if (method().minimize) design_->objective = scalar(*method().minimize, names_->design);
}

void refuse_free_unknowns(const Design& design) {
  const auto is_bound = [&](const Design::Unknown& unknown) {
    for (const Design::Inequality& inequality : design.inequalities)
      for (const Design::Comparison& comparison : inequality.comparisons)
        if (uses(comparison.difference, unknown)) return true;
    return unknown.shape.size() == 0;
  };
  for (const Design::Unknown& unknown : design.unknowns) {
    if (is_bound(unknown)) continue;
    const auto user =
        std::find_if(design.gains.begin(), design.gains.end(),
                     [&](const Design::Gain& gain) { return uses(gain.formula.program, unknown); });
    throw InputError(
        unknown.place,
        "the unknown " + unknown.name +
            " stands in no inequality under 'require', so nothing determines it" +
            (user == design.gains.end() ? "" : "; the gain " + user->name + " needs it") +
            ": require something of it, or remove it");
  }
}

}  // namespace gainsmith::model
