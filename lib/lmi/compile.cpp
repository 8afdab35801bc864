#include "lmi/compile.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

#include "expr/compile.h"
#include "lmi/hull.h"

namespace gainsmith::lmi {

double smallest_eigenvalue(const expr::Matrix& matrix) {
  return Eigen::SelfAdjointEigenSolver<expr::Matrix>(0.5 * (matrix + matrix.transpose()),
                                                     Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

expr::Matrix Block::value(const std::vector<double>& x) const {
  expr::Matrix result = expr::Matrix::Zero(size, size);
  for (const auto& [i, matrix] : terms)
    result += (i == 0 ? 1.0 : x[static_cast<std::size_t>(i) - 1]) * expr::Matrix(matrix);
  return result;
}

bool is_homogeneous(const std::vector<Block>& blocks) {
  return std::all_of(blocks.begin(), blocks.end(),
                     [](const Block& block) { return block.constant_size == 0; });
}

AffineForm evaluate_affine(const expr::Program& program, const Unknowns& unknowns,
                           MonomialTable& monomials, const expr::Values& values) {
  expr::Evaluator<AffineAlgebra> evaluator(program, {&monomials, &unknowns});
  std::deque<AffineForm> inputs;
  for (const expr::Input& input : program.inputs) {
    if (const int variable = monomials.find_variable(input.name); variable >= 0) {
      inputs.push_back(variable_form(monomials, variable));
    } else if (const Unknown* unknown = unknowns.find(input.name)) {
      inputs.push_back(unknown_form(*unknown));
    } else {
      inputs.push_back(constant_form(values.at(input.name)));
    }
    evaluator.set(input.name, inputs.back());
  }
  // An input alone is its own result.
  return evaluator.run();
}

namespace {

double largest(const Sparse& matrix) {
  double result = 0;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      result = std::max(result, std::abs(it.value()));
  return result;
}

/// Makes a coefficient exactly symmetric; InputError when it is not so up to rounding.
Sparse symmetric_part(const Sparse& matrix, double scale, const Place& place,
                      const std::string& name) {
  const Sparse mirrored = matrix.transpose();
  const Sparse difference = matrix - mirrored;
  for (int k = 0; k < difference.outerSize(); ++k)
    for (Sparse::InnerIterator it(difference, k); it; ++it)
      if (std::abs(it.value()) > 1e-12 * scale)
        throw InputError(place, "the inequality '" + name + "' is not symmetric: elements (" +
                                    std::to_string(it.row() + 1) + ", " +
                                    std::to_string(it.col() + 1) + ") and (" +
                                    std::to_string(it.col() + 1) + ", " +
                                    std::to_string(it.row() + 1) + ") differ");
  return 0.5 * (matrix + mirrored);
}

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
      for (const Point& point : points) {
        MonomialTable monomials(variables);
        expr::Values values = known_;
        for (const auto& [name, value] : point.values) values.insert_or_assign(name, value);
        AffineForm form = evaluate_affine(relations_[k].difference, unknowns_, monomials, values);
        remove_noise(form, monomials);
        const Hull hull = hull_of(form, monomials, slices_, place_);
        imposed.exact &= hull.exact;
        for (const Vertex& vertex : hull.vertices)
          result.push_back(block_of(at_vertex(form, vertex.values), name_ + suffix,
                                    joined(point.label, vertex.label), relations_[k].strict,
                                    place_));
      }
    }
    return result;
  }

  expr::Values known_;
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

Block block_of(const AffineForm& form, std::string name, std::string point, bool strict,
               const Place& place) {
  Block block;
  block.name = std::move(name);
  block.point = std::move(point);
  block.strict = strict;
  block.size = form.shape.rows;
  for (const auto& [key, matrix] : form.terms) {
    double& size = key.second == 0 ? block.constant_size : block.coefficient_size;
    size = std::max(size, largest(matrix));
  }
  const double scale = std::max(block.constant_size, block.coefficient_size);
  for (const auto& [key, matrix] : form.terms)
    block.terms.emplace_back(key.second, symmetric_part(matrix, scale, place, block.name));
  return block;
}

Lmi compile(const model::Instance& instance, Plan& plan) {
  Lmi lmi(instance);
  for (std::size_t k = 0; k < instance.method->require.size(); ++k) {
    const Compiler compiler(instance, instance.method->require[k], lmi.unknowns, plan.slices);
    for (Block& block : compiler.blocks(plan.requirements[k]))
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
