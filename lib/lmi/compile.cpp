#include "lmi/compile.h"

#include <optional>
#include <set>

#include "expr/compile.h"
#include "lmi/hull.h"
#include "lmi/vertex_gains.h"

namespace gainsmith::lmi {

namespace {

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

using Over = model::Forall::Over;

/// One requirement on its way to blocks.
class Compiler {
 public:
  Compiler(const model::Instance& instance, const model::Requirement& requirement,
           const Unknowns& unknowns, int slices)
      : known_(instance.known_values()),
        domain_(domain_of(instance, requirement)),
        relations_(expr::compile_relations(requirement.that, scope_with(instance, domain_))),
        place_(requirement.that.place(*requirement.that.root)),
        name_(requirement.name),
        unknowns_(unknowns),
        slices_(slices) {}

  std::vector<Block> blocks(Imposed& imposed) const {
    if (imposed.way == model::Way::automatic) choose(imposed);
    if (imposed.way == model::Way::exchange && !intervals(domain_).empty()) {
      if (imposed.points.empty()) imposed.points = first_points(domain_);
      return blocks_at(imposed.points, {Over::polytope}, imposed);
    }
    return blocks_at(combinations(domain_, Over::set), {Over::polytope, Over::interval}, imposed);
  }

 private:
  /// The hull when it loses nothing, otherwise exchange. What is wrong in both ways is found, and
  /// said, by exchange.
  void choose(Imposed& imposed) const {
    imposed.way = model::Way::hull;
    if (intervals(domain_).empty()) return;
    try {
      blocks(imposed);
    } catch (const InputError&) {
      imposed.exact = false;
    }
    if (imposed.exact) return;
    imposed.way = model::Way::exchange;
    imposed.exact = true;
  }

  /// Blocks at the given points; variables over the other kinds of domain stay symbolic.
  std::vector<Block> blocks_at(const std::vector<Point>& points, const std::set<Over>& symbolic,
                               Imposed& imposed) const {
    Domain variables;
    for (const Variable& variable : domain_)
      if (symbolic.contains(variable.over)) variables.push_back(variable);
    std::vector<Block> result;
    for (std::size_t k = 0; k < relations_.size(); ++k) {
      const std::string suffix = relations_.size() > 1 ? "." + std::to_string(k + 1) : "";
      for (std::size_t at = 0; at < points.size(); ++at) {
        const Point& point = points[at];
        MonomialTable monomials(variables);
        numbers::Values values = known_;
        for (const auto& [name, value] : point.values) values.insert_or_assign(name, value);
        AffineForm form = evaluate_affine(relations_[k].difference, unknowns_, monomials, values);
        remove_noise(form, monomials);
        const Hull hull = hull_of(form, monomials, slices_, place_);
        imposed.exact &= hull.exact;
        for (const Vertex& vertex : hull.vertices) {
          result.push_back(block_of(at_vertex(form, vertex.values), name_ + suffix,
                                    joined(point.label, vertex.label), relations_[k].strict,
                                    place_));
          result.back().at = at;
        }
      }
    }
    return result;
  }

  numbers::Values known_;
  Domain domain_;
  std::vector<expr::CompiledRelation> relations_;
  Place place_;
  std::string name_;
  const Unknowns& unknowns_;
  int slices_;
};

void set_objective(const model::Instance& instance, Lmi& lmi) {
  const auto& minimize = instance.method->minimize;
  if (!minimize) return;
  MonomialTable none;
  const auto program = expr::compile(*minimize, instance.design_scope(), expr::Shape{});
  const AffineForm form = evaluate_affine(program, lmi.unknowns, none, instance.known_values());
  lmi.has_objective = true;
  lmi.objective.assign(static_cast<std::size_t>(lmi.unknowns.size()), 0.0);
  for (const auto& [key, matrix] : form.terms) {
    const double value = matrix.coeff(0, 0);
    (key.second == 0 ? lmi.objective_constant
                     : lmi.objective[static_cast<std::size_t>(key.second) - 1]) = value;
  }
}

}  // namespace

Lmi compile(const model::Instance& instance, Plan& plan) {
  Lmi lmi(instance);
  std::optional<Box> box;
  if (plan.uses_vertex_gains()) box = vertex_box(instance);
  for (std::size_t k = 0; k < instance.method->require.size(); ++k) {
    const model::Requirement& requirement = instance.method->require[k];
    const Compiler compiler(instance, requirement, lmi.unknowns, plan.slices);
    Imposed& imposed = plan.requirements[k];
    for (Block& block : imposed.way == model::Way::vertex_gains
                            ? vertex_blocks(instance, requirement, lmi.unknowns, *box)
                            : compiler.blocks(imposed))
      lmi.blocks.push_back(std::move(block));
  }
  set_objective(instance, lmi);
  return lmi;
}

Lmi compile(const model::Instance& instance) {
  Plan plan = make_plan(instance);
  return compile(instance, plan);
}

}  // namespace gainsmith::lmi
