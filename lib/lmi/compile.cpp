#include "lmi/compile.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "base/number.h"
#include "forall/hull.h"
#include "lmi/symmetry.h"
#include "lmi/vertex_gains.h"

namespace gainsmith::lmi {

namespace {

using forall::Imposed;
using model::Over;

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

/// Compiles one inequality to blocks.
class Compiler {
 public:
  Compiler(const Inequalities& of, const Statement& statement, int slices)
      : of_(of), statement_(statement), domain_(statement.domain), slices_(slices) {}

  /// The blocks of all comparisons. Writes the method that was chosen, its points and whether the
  /// hull loses nothing to `imposed`.
  std::vector<Block> blocks(Imposed& imposed) const {
    if (imposed.way == model::Way::automatic) return choose(imposed);
    if (imposed.way == model::Way::exchange && !forall::intervals(domain_).empty()) {
      if (imposed.points.empty()) imposed.points = forall::first_points(domain_);
      return blocks_at(imposed.points, {Over::polytope}, imposed);
    }
    return blocks_at(forall::combinations(domain_, Over::set), {Over::polytope, Over::interval},
                     imposed);
  }

 private:
  /// The hull when it loses nothing, otherwise exchange. What is wrong in both is found, and
  /// said, by exchange.
  std::vector<Block> choose(Imposed& imposed) const {
    imposed.way = model::Way::hull;
    if (forall::intervals(domain_).empty()) return blocks(imposed);
    try {
      std::vector<Block> hull = blocks(imposed);
      if (imposed.exact) return hull;
    } catch (const InputError&) {
      imposed.exact = false;
    }
    imposed.way = model::Way::exchange;
    imposed.exact = true;
    return blocks(imposed);
  }

  /// Blocks at the given points; variables over the other kinds of domain stay symbolic.
  std::vector<Block> blocks_at(const std::vector<forall::Point>& points,
                               const std::set<Over>& symbolic, Imposed& imposed) const {
    forall::Domain variables;
    for (const forall::Variable& variable : domain_)
      if (symbolic.contains(variable.over)) variables.push_back(variable);
    std::vector<Block> result;
    for (std::size_t k = 0; k < statement_.differences.size(); ++k)
      for (std::size_t at = 0; at < points.size(); ++at)
        for (Block& block : blocks_of(k, points[at], variables, imposed)) {
          block.at = at;
          result.push_back(std::move(block));
        }
    return result;
  }

  /// The blocks of comparison k at one point, one a vertex of its hull.
  std::vector<Block> blocks_of(std::size_t k, const forall::Point& point,
                               const forall::Domain& variables, Imposed& imposed) const {
    const model::Design::Inequality& stated = *statement_.stated;
    const model::Design::Comparison& comparison = stated.comparisons[k];
    forall::MonomialTable monomials(variables);
    AffineForm form =
        evaluate_at(statement_.differences[k], of_.unknowns, monomials, of_.instance.values, point);
    remove_noise(form, monomials);
    const forall::Hull hull =
        forall::hull_of(monomials_in(form), monomials, slices_, stated.that_place);
    imposed.exact &= hull.exact;
    std::vector<Block> blocks;
    for (const forall::Vertex& vertex : hull.vertices) {
      Block block =
          block_at(at_vertex(form, vertex.values), comparison, joined(point.label, vertex.label));
      block.comparison = k;
      block.where = vertex.point;
      if (block.where) block.where->values.insert(point.values.begin(), point.values.end());
      blocks.push_back(std::move(block));
    }
    return blocks;
  }

  /// InputError where the unknown at fault is declared, when it is one.
  Block block_at(const AffineForm& form, const model::Design::Comparison& comparison,
                 const std::string& point) const {
    try {
      return block_of(form, comparison.name, point, comparison.strict,
                      statement_.stated->that_place);
    } catch (const InputError&) {
      if (const auto symmetric = symmetric_where(form, stated_equations()))
        return block_of(*symmetric, comparison.name, point, comparison.strict,
                        statement_.stated->that_place);
      const model::Design::Unknown* unknown = needs_symmetric(form, of_);
      if (unknown == nullptr) throw;
      const std::string size = unknown->declared.substr(0, unknown->declared.find(" x "));
      throw InputError(unknown->place, "the unknown " + unknown->name + " is " + unknown->declared +
                                           ", and the inequality '" + comparison.name +
                                           "' is symmetric only where it is; declare " +
                                           unknown->name + ": symmetric " + size);
    }
  }

  /// Those of all requirements without variables.
  std::vector<numbers::Vector> stated_equations() const {
    std::vector<Block> blocks;
    for (const Statement& statement : of_.statements)
      for (std::size_t k = 0; statement.domain.empty() && k < statement.differences.size(); ++k)
        try {
          forall::MonomialTable none;
          blocks.push_back(block_of(
              evaluate_affine(statement.differences[k], of_.unknowns, none, of_.instance.values),
              "", "", statement.stated->comparisons[k].strict, {}));
        } catch (const InputError&) {  // no equation is wrong in itself
        }
    return equations_in(blocks, of_.unknowns.size());
  }

  const Inequalities& of_;
  const Statement& statement_;
  const forall::Domain& domain_;
  int slices_;
};

/// c and c_0 from the affine form of the objective, 1 x 1. InputError at its place where a
/// coefficient is not finite.
void set_objective(const Inequalities& of, Lmi& lmi) {
  const auto& objective = of.design().objective;
  if (!objective) return;
  forall::MonomialTable none;
  const AffineForm form = expanded(
      evaluate_affine(of.bodies.link(objective->program), of.unknowns, none, of.instance.values));
  for (const auto& [key, matrix] : form.terms)
    if (!std::isfinite(matrix.coeff(0, 0)))
      throw InputError(objective->place,
                       "the objective has a coefficient that is not finite: its data are too large "
                       "for double");
  lmi.has_objective = true;
  lmi.objective.assign(static_cast<std::size_t>(lmi.unknowns), 0.0);
  for (const auto& [key, matrix] : form.terms) {
    const double value = matrix.coeff(0, 0);
    (key.second == 0 ? lmi.objective_constant
                     : lmi.objective[static_cast<std::size_t>(key.second) - 1]) = value;
  }
}

/// InputError for sizes that leave double no room for powers of two and sums. `places`: of the
/// blocks.
void check_sizes(const std::vector<Block>& blocks, const std::vector<Place>& places) {
  constexpr double kLargest = 1e200;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Block& block = blocks[k];
    if (std::max(block.constant_size, block.coefficient_size) > kLargest)
      throw InputError(places[k], "the inequality '" + block.name + "' has a constant part of " +
                                      brief(block.constant_size) + " and coefficients of " +
                                      brief(block.coefficient_size) +
                                      ", too large for double; choose other units");
  }
}

}  // namespace

int Lmi::rows() const {
  return std::accumulate(blocks.begin(), blocks.end(), 0,
                         [](int sum, const Block& block) { return sum + block.size; });
}

double Lmi::multiplications() const {
  const double m = unknowns;
  // A factor of m rows; for each block of t terms and n rows 2 t products of n x n matrices and
  // t^2/2 inner products.
  double sum = m * m * m / 6;
  for (const Block& block : blocks) {
    const auto terms = static_cast<double>(block.terms.size());
    const double n = block.size;
    sum += terms * terms * n * n / 2 + 2 * terms * n * n * n;
  }
  return sum;
}

bool Lmi::represents_points() const {
  return std::all_of(blocks.begin(), blocks.end(),
                     [](const Block& block) { return block.where.has_value(); });
}

double Lmi::objective_at(const std::vector<double>& x) const {
  double value = objective_constant;
  for (std::size_t i = 0; i < objective.size(); ++i) value += objective[i] * x[i];
  return value;
}

Lmi compile(const Inequalities& inequalities, forall::Plan& plan) {
  Lmi lmi;
  lmi.unknowns = inequalities.unknowns.size();
  std::vector<Place> places;  ///< of the blocks
  for (std::size_t k = 0; k < inequalities.statements.size(); ++k) {
    const Statement& statement = inequalities.statements[k];
    Imposed& imposed = plan.inequalities[k];
    std::vector<Block> blocks =
        imposed.way == model::Way::vertex_gains
            ? vertex_blocks(inequalities, statement)
            : Compiler(inequalities, statement, plan.slices).blocks(imposed);
    for (Block& block : blocks) {
      block.inequality = k;
      lmi.blocks.push_back(std::move(block));
    }
    places.resize(lmi.blocks.size(), statement.stated->that_place);
  }
  check_sizes(lmi.blocks, places);
  set_objective(inequalities, lmi);
  return lmi;
}

Lmi compile(const Inequalities& inequalities) {
  forall::Plan plan = forall::make_plan(inequalities.design());
  return compile(inequalities, plan);
}

}  // namespace gainsmith::lmi
