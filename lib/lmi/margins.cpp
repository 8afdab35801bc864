#include "lmi/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number.h"
#include "expr/compile.h"

namespace gainsmith::lmi {

namespace {

/// The smallest eigenvalue met so far, and where.
struct Worst {
  double value = std::numeric_limits<double>::infinity();
  std::string point;

  void meet(const expr::Matrix& block, const std::string& where) {
    const double found = smallest_eigenvalue(block);
    if (!(found < value)) return;
    value = found;
    point = where;
  }
};

/// The largest |element| of a term x_i B_i: what cancels in a block is known to rounding of this.
double term_size(const Block& block, const std::vector<double>& x) {
  double size = 0;
  for (const auto& [i, matrix] : block.terms) {
    const double factor = i == 0 ? 1.0 : std::abs(x[static_cast<std::size_t>(i) - 1]);
    for (int k = 0; k < matrix.outerSize(); ++k)
      for (Sparse::InnerIterator it(matrix, k); it; ++it)
        size = std::max(size, factor * std::abs(it.value()));
  }
  return size;
}

/// Every point of `forall`: elements of sets and, of an interval, equidistant points.
void sample(const model::Instance& instance, const model::Requirement& requirement,
            std::size_t depth, expr::Values& values, const std::string& label,
            const expr::Program& program, Worst& worst) {
  if (depth == requirement.forall.size()) {
    worst.meet(expr::evaluate(program, values), label);
    return;
  }
  const model::Forall& forall = requirement.forall[depth];
  std::vector<double> points;
  for (const expr::Expression& point : forall.points)
    points.push_back(model::scalar_value(point, instance.scope, values));
  if (forall.interval) {
    constexpr int kPieces = 32;
    const double low = points[0];
    const double high = points[1];
    points.clear();
    for (int i = 0; i <= kPieces; ++i)
      points.push_back(i == kPieces ? high : low + (high - low) * i / kPieces);
  }
  for (const double point : points) {
    values[forall.variable] = expr::Matrix::Constant(1, 1, point);
    std::string extended = label;
    extended += label.empty() ? "" : ", ";
    extended += forall.variable + " = " + brief(point);
    sample(instance, requirement, depth + 1, values, extended, program, worst);
  }
}

}  // namespace

std::vector<model::Margin> margins(const model::Instance& instance, const Lmi& lmi,
                                   const std::vector<double>& scales, bool homogeneous,
                                   double required, const std::vector<double>& x) {
  constexpr double kRounding = 1e-11;
  double size = 0;
  for (const double value : x) size = std::max(size, std::abs(value));
  expr::Values values = instance.known_values();
  for (auto& [name, matrix] : lmi.unknowns.values(x)) values[name] = matrix;

  std::vector<model::Margin> result;
  std::size_t at = 0;
  for (const model::Requirement& requirement : instance.method->require) {
    expr::Scope scope = instance.design_scope();
    for (const model::Forall& forall : requirement.forall)
      scope.symbols[forall.variable] = {{}, std::nullopt};
    for (const auto& relation : expr::compile_relations(requirement.that, scope)) {
      model::Margin margin;
      margin.name = lmi.blocks[at].name;
      margin.strict = relation.strict;
      margin.scale = scales[at] * (homogeneous ? size : 1.0);
      margin.required = relation.strict ? required : 0.0;
      Worst worst;
      double terms = 0;
      for (; at < lmi.blocks.size() && lmi.blocks[at].name == margin.name; ++at) {
        worst.meet(lmi.blocks[at].value(x), lmi.blocks[at].point);
        terms = std::max(terms, term_size(lmi.blocks[at], x));
      }
      sample(instance, requirement, 0, values, "", relation.difference, worst);
      margin.smallest_eigenvalue = worst.value;
      margin.worst_point = worst.point;
      margin.reached = margin.scale > 0 ? worst.value / margin.scale : 0.0;
      margin.holds = relation.strict ? worst.value > 0 : worst.value >= -kRounding * terms;
      result.push_back(std::move(margin));
    }
  }
  return result;
}

}  // namespace gainsmith::lmi
