#include "lmi/vertex_gains.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/number.h"
#include "expr/compile.h"
#include "expr/parser.h"
#include "lmi/hull.h"

namespace gainsmith::lmi {

namespace {

using Over = model::Forall::Over;

/// The functions as their coefficient i, times `factor`, a text in the function's argument "s".
model::Instance held_at(model::Instance instance, std::size_t i, const std::string& factor = "") {
  for (const model::UnknownFunction& function : instance.functions)
    instance.scope.definitions[function.name] = {
        {"s"},
        expr::parse(expr::Text::generated(function.coefficients.at(i) + factor, function.place))};
  return instance;
}

/// The one interval of a requirement.
Variable interval_of(const Domain& domain, const model::Requirement& requirement) {
  const auto found = intervals(domain);
  if (found.size() == 1) return *found.front();
  throw InputError(requirement.place,
                   "gains at the vertices of a box need one variable over an interval in every "
                   "inequality that uses them; '" +
                       requirement.name + "' has " + std::to_string(found.size()));
}

/// One requirement with its functions held, over symbolic polytopes or their vertices.
struct Held {
  Held(const model::Instance& instance, const model::Requirement& requirement)
      : domain(domain_of(instance, requirement)),
        interval(interval_of(domain, requirement)),
        relations(expr::compile_relations(requirement.that, scope_with(instance, domain))),
        known(instance.known_values()) {}

  /// The affine form of a relation at a point of the variables that do not stay symbolic.
  AffineForm form(std::size_t relation, const Unknowns& unknowns, MonomialTable& monomials,
                  const Point& point) const {
    numbers::Values values = known;
    for (const auto& [name, value] : point.values) values.insert_or_assign(name, value);
    AffineForm result =
        evaluate_affine(relations[relation].difference, unknowns, monomials, values);
    remove_noise(result, monomials);
    return result;
  }

  Domain domain;
  Variable interval;
  std::vector<expr::CompiledRelation> relations;
  numbers::Values known;
};

/// Symbolic in intervals and polytopes.
Domain symbolic_part(const Domain& domain) {
  Domain symbolic;
  for (const Variable& variable : domain)
    if (variable.over != Over::set) symbolic.push_back(variable);
  return symbolic;
}

/// Adds the atoms of the interval that stand in a requirement. Polytopes stay symbolic, so that
/// what is not affine in them is refused.
void collect_atoms(const Held& held, const Unknowns& unknowns, std::vector<Atom>& atoms) {
  for (const Point& point : combinations(held.domain, Over::set)) {
    for (std::size_t k = 0; k < held.relations.size(); ++k) {
      MonomialTable monomials(symbolic_part(held.domain));
      const int tau = monomials.find_variable(held.interval.name);
      const AffineForm form = held.form(k, unknowns, monomials, point);
      for (const auto& [key, matrix] : form.terms)
        for (const Factor& factor : monomials[key.first])
          if (factor.variable == tau &&
              std::find(atoms.begin(), atoms.end(), factor.atom) == atoms.end())
            atoms.push_back(factor.atom);
    }
  }
}

/// InputError when a function is called with anything but the variable: the weights of the box are
/// those of its value at the variable.
void check_arguments(const model::Instance& instance, const model::Requirement& requirement,
                     const Unknowns& unknowns, const std::string& variable) {
  // A function that gives its argument back, and one that gives the variable whatever it is given.
  const Held own(held_at(instance, 0, "*s"), requirement);
  const Held fixed(held_at(instance, 0, "*" + variable), requirement);
  for (const Point& point : combinations(own.domain, Over::set)) {
    for (std::size_t k = 0; k < own.relations.size(); ++k) {
      MonomialTable monomials(symbolic_part(own.domain));
      if (is_same(own.form(k, unknowns, monomials, point),
                  fixed.form(k, unknowns, monomials, point)))
        continue;
      throw InputError(requirement.place, "gains at the vertices of a box are functions of " +
                                              variable + " alone; '" + requirement.name +
                                              "' calls one with another argument");
    }
  }
}

std::string number(double value) {
  return value < 0 ? "(" + decimal17(value) + ")" : decimal17(value);
}

/// alpha_i as text; empty when it is 1.
std::string weight_text(const Box& box, const std::vector<double>& vertex,
                        const std::string& variable) {
  constexpr int kAllDigits = 17;
  std::string text;
  for (std::size_t k = 0; k < box.atoms.size(); ++k) {
    const auto& [low, high] = box.ranges[k];
    if (low == high) continue;
    const std::string atom = to_string(box.atoms[k], variable, kAllDigits);
    text += vertex[k] == high ? "(" + atom + " - " + number(low) + ")"
                              : "(" + number(high) + " - " + atom + ")";
    text += "/" + number(high - low) + "*";
  }
  return text;
}

std::string function_text(const Box& box, const model::UnknownFunction& function) {
  std::string text;
  for (std::size_t i = 0; i < box.vertices.size(); ++i)
    text += (text.empty() ? "" : " + ") + weight_text(box, box.vertices[i], function.variable) +
            model::coefficient_name(function.name, i);
  return text;
}

/// Values of all monomials of a table of one variable at a vertex.
std::vector<double> values_at(const MonomialTable& monomials, const Box& box, std::size_t vertex) {
  std::vector<double> values(1, 1.0);
  for (int index = 1; index < monomials.size(); ++index) {
    const int atom = box.find(monomials[index].front().atom);
    // An atom outside of the box does not stand in the form without noise: its value is unused.
    values.push_back(atom < 0 ? 0.0 : box.vertices[vertex][static_cast<std::size_t>(atom)]);
  }
  return values;
}

AffineForm average(AffineForm a, const AffineForm& b) {
  for (auto& [key, matrix] : a.terms) matrix *= 0.5;
  for (const auto& [key, matrix] : b.terms) {
    const auto [found, fresh] = a.terms.try_emplace(key, 0.5 * matrix);
    if (!fresh) found->second = found->second + 0.5 * matrix;
  }
  return a;
}

std::string label_of(const std::string& point, const std::string& first,
                     const std::string& second) {
  std::string label = point;
  if (!first.empty()) label += (label.empty() ? "" : ", ") + first;
  return first == second ? label : label + " with " + second;
}

}  // namespace

bool has_vertex_gains(const model::Instance& instance) {
  return instance.problem->synthesis.way == model::Way::vertex_gains;
}

bool uses_functions(const model::Instance& instance, const model::Requirement& requirement) {
  const expr::Scope scope = scope_with(instance, domain_of(instance, requirement));
  for (const auto& relation : expr::compile_relations(requirement.that, scope))
    for (const model::UnknownFunction& function : instance.functions)
      for (const std::string& coefficient : function.coefficients)
        if (relation.difference.uses(coefficient)) return true;
  return false;
}

Box vertex_box(const model::Instance& instance) {
  if (instance.functions.empty())
    throw InputError(instance.problem->method_place,
                     "gains at the vertices of a box need an unknown that is a function "
                     "(of: tau); the method '" +
                         instance.method->name + "' has none");
  const model::Instance held_instance = held_at(instance, 0);
  const Unknowns unknowns(held_instance);
  std::vector<Atom> atoms;
  std::optional<Variable> interval;
  for (const model::Requirement& requirement : instance.method->require) {
    if (!uses_functions(instance, requirement)) continue;
    const Held held(held_instance, requirement);
    if (!interval) interval = held.interval;
    if (held.interval.low != interval->low || held.interval.high != interval->high)
      throw InputError(held.interval.place,
                       "gains at the vertices of a box need one interval; found [" +
                           brief(held.interval.low) + ", " + brief(held.interval.high) + "] and [" +
                           brief(interval->low) + ", " + brief(interval->high) + "]");
    check_arguments(instance, requirement, unknowns, held.interval.name);
    collect_atoms(held, unknowns, atoms);
  }
  if (!interval) return box_of({}, "", 0, 0, {});
  return box_of(std::move(atoms), interval->name, interval->low, interval->high, interval->place);
}

model::Instance with_vertex_gains(model::Instance instance) {
  if (!has_vertex_gains(instance)) return instance;
  const Box box = vertex_box(instance);
  const std::vector<model::UnknownFunction> functions = instance.functions;
  for (const model::UnknownFunction& function : functions)
    model::redefine(instance, function.name, box.vertices.size(), function_text(box, function),
                    function.place);
  return instance;
}

std::vector<Block> vertex_blocks(const model::Instance& instance,
                                 const model::Requirement& requirement, const Unknowns& unknowns,
                                 const Box& box) {
  const std::size_t count = box.vertices.size();
  std::vector<Held> held;
  for (std::size_t i = 0; i < count; ++i) held.emplace_back(held_at(instance, i), requirement);
  const Held& first = held.front();
  const auto points = finite_points(first.domain);
  const std::size_t pairs = count * (count + 1) / 2;
  if (points.size() * pairs > kMostVertices) refuse_vertices(requirement.place);

  std::vector<Block> blocks;
  const Place place = requirement.that.place(*requirement.that.root);
  for (std::size_t k = 0; k < first.relations.size(); ++k) {
    const std::string suffix = first.relations.size() > 1 ? "." + std::to_string(k + 1) : "";
    for (const Point& point : points) {
      MonomialTable monomials({first.interval});
      std::vector<AffineForm> forms;
      forms.reserve(count);
      for (const Held& h : held) forms.push_back(h.form(k, unknowns, monomials, point));
      const auto at = [&](std::size_t i, std::size_t j) {
        return at_vertex(forms[i], values_at(monomials, box, j));
      };
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i; j < count; ++j)
          blocks.push_back(block_of(i == j ? at(i, i) : average(at(i, j), at(j, i)),
                                    requirement.name + suffix,
                                    label_of(point.label, box.labels[i], box.labels[j]),
                                    first.relations[k].strict, place));
    }
  }
  return blocks;
}

}  // namespace gainsmith::lmi
