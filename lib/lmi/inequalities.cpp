#include "lmi/inequalities.h"

#include "lmi/vertex_gains.h"

namespace gainsmith::lmi {

Inequalities::Inequalities(const model::Instance& of)
    : instance(of), functions(model::polynomials(*of.design)) {
  // A function is a sum over the vertices, with the weights of the box for its basis.
  if (design().synthesis.way == model::Way::vertex_gains) {
    box = vertex_box(instance);
    for (model::Function& function : functions)
      function.basis = forall::weights(*box, function.variable, function.place);
  }
  bodies = model::Bodies(functions);
  unknowns = Unknowns(model::unknown_matrices(design(), functions));
  for (const model::Design::Inequality& inequality : design().inequalities) {
    Statement statement{&inequality, forall::domain_of(inequality, instance.values), {}};
    for (const model::Design::Comparison& comparison : inequality.comparisons)
      statement.differences.push_back(bodies.link(comparison.difference));
    statements.push_back(std::move(statement));
  }
}

}  // namespace gainsmith::lmi
