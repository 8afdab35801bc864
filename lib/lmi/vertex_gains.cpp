#include "lmi/vertex_gains.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/number.h"
#include "forall/hull.h"

namespace gainsmith::lmi {

namespace {

using forall::Atom;
using forall::Box;
using forall::MonomialTable;
using model::Over;

/// A program with every unknown function held as its coefficient i.
expr::Program held_at(const expr::Program& program, const std::vector<model::Function>& functions,
                      std::size_t i) {
  model::Bodies bodies;
  for (const model::Function& function : functions) {
    expr::Composer composer(function.place);
    const int coefficient =
        composer.input(model::coefficient_name(function.name, i), function.shape);
    bodies.set(function.name, {function.variable, composer.take(coefficient)});
  }
  return bodies.link(program);
}

/// The one interval of an inequality.
const forall::Variable& interval_of(const forall::Domain& domain,
                                    const model::Design::Inequality& stated) {
  const auto found = forall::intervals(domain);
  if (found.size() == 1) return *found.front();
  throw InputError(stated.place,
                   "gains at the vertices of a box need one variable over an interval in every "
                   "inequality that uses them; '" +
                       stated.name + "' has " + std::to_string(found.size()));
}

/// Symbolic in intervals and polytopes.
forall::Domain symbolic_part(const forall::Domain& domain) {
  forall::Domain symbolic;
  for (const forall::Variable& variable : domain)
    if (variable.over != Over::set) symbolic.push_back(variable);
  return symbolic;
}

/// Searches the inequalities for the functions of tau.
class AtomSearch {
 public:
  explicit AtomSearch(const model::Instance& instance)
      : instance_(instance),
        functions_(model::polynomials(*instance.design)),
        unknowns_(model::unknown_matrices(*instance.design, functions_)) {}

  /// Adds the atoms of the interval that occur in an inequality. Polytopes stay symbolic, so that
  /// what is not affine in them is refused.
  void collect(const model::Design::Inequality& stated, const forall::Domain& domain,
               const std::string& variable, std::vector<Atom>& atoms) const {
    for (const forall::Point& point : forall::combinations(domain, Over::set)) {
      for (const model::Design::Comparison& comparison : stated.comparisons) {
        MonomialTable monomials(symbolic_part(domain));
        const int tau = monomials.find_variable(variable);
        AffineForm form = evaluate_at(held_at(comparison.difference, functions_, 0), unknowns_,
                                      monomials, instance_.values, point);
        remove_noise(form, monomials);
        for (const int monomial : monomials_in(form))
          for (const forall::Factor& factor : monomials[monomial])
            if (factor.variable == tau &&
                std::find(atoms.begin(), atoms.end(), factor.atom) == atoms.end())
              atoms.push_back(factor.atom);
      }
    }
  }

  /// InputError when a function is called with anything but the variable: the weights of the box
  /// are those of its value at the variable.
  void check_arguments(const model::Design::Inequality& stated, const forall::Domain& domain,
                       const std::string& variable) const {
    for (const model::Design::Comparison& comparison : stated.comparisons)
      for (const expr::Instruction* call : expr::calls_in(comparison.difference))
        for (const forall::Point& point : forall::combinations(domain, Over::set))
          if (!is_variable(expr::argument_of(comparison.difference, *call), domain, variable,
                           point))
            throw InputError(stated.place, "gains at the vertices of a box are functions of " +
                                               variable + " alone; '" + stated.name +
                                               "' calls one with another argument");
  }

 private:
  bool is_variable(const expr::Program& argument, const forall::Domain& domain,
                   const std::string& variable, const forall::Point& point) const {
    MonomialTable monomials(symbolic_part(domain));
    const AffineForm form = evaluate_at(held_at(argument, functions_, 0), unknowns_, monomials,
                                        instance_.values, point);
    return is_same(form, variable_form(monomials, monomials.find_variable(variable)));
  }

  const model::Instance& instance_;
  std::vector<model::Function> functions_;
  Unknowns unknowns_;
};

/// Values of all monomials of a table of one variable at a vertex.
std::vector<double> values_at(const MonomialTable& monomials, const Box& box, std::size_t vertex) {
  std::vector<double> values(1, 1.0);
  for (int index = 1; index < monomials.size(); ++index) {
    const int atom = box.find(monomials[index].front().atom);
    // An atom outside of the box does not occur in the form without noise: its value is unused.
    values.push_back(atom < 0 ? 0.0 : box.vertices[vertex][static_cast<std::size_t>(atom)]);
  }
  return values;
}

/// (a + b)/2.
AffineForm average(AffineForm a, const AffineForm& b) {
  for (auto& [key, matrix] : a.terms) matrix *= 0.5;
  for (const auto& [key, matrix] : b.terms) {
    const auto [found, fresh] = a.terms.try_emplace(key, 0.5 * matrix);
    if (!fresh) found->second = found->second + 0.5 * matrix;
  }
  for (Product& product : a.products) product.right *= 0.5;
  for (const Product& product : b.products) add_product(a.products, product, 0.5);
  return a;
}

/// "k = 1, cos(2*tau) = 1 with cos(2*tau) = 0": the point and both vertices.
std::string label_of(const std::string& point, const std::string& first,
                     const std::string& second) {
  std::string label = point;
  if (!first.empty()) label += (label.empty() ? "" : ", ") + first;
  return first == second ? label : label + " with " + second;
}

}  // namespace

Box vertex_box(const model::Instance& instance) {
  const model::Design& design = *instance.design;
  if (model::polynomials(design).empty())
    throw InputError(design.method_place,
                     "gains at the vertices of a box need an unknown that is a function "
                     "(of: tau); the method '" +
                         design.method + "' has none");
  const AtomSearch search(instance);
  std::vector<Atom> atoms;
  std::optional<forall::Variable> interval;
  const model::Design::Inequality* at_points = nullptr;  // at values of the functions
  for (const model::Design::Inequality& stated : design.inequalities) {
    if (!stated.calls_functions()) continue;
    const forall::Domain domain = forall::domain_of(stated, instance.values);
    if (forall::intervals(domain).empty()) {
      at_points = &stated;
      continue;
    }
    const forall::Variable& own = interval_of(domain, stated);
    if (!interval) interval = own;
    if (own.low != interval->low || own.high != interval->high)
      throw InputError(own.place, "gains at the vertices of a box need one interval; found [" +
                                      brief(own.low) + ", " + brief(own.high) + "] and [" +
                                      brief(interval->low) + ", " + brief(interval->high) + "]");
    search.check_arguments(stated, domain, own.name);
    search.collect(stated, domain, own.name, atoms);
  }
  if (!interval && at_points != nullptr)
    interval_of(forall::domain_of(*at_points, instance.values), *at_points);
  if (!interval) return forall::box_of({}, "", 0, 0, {});
  return forall::box_of(std::move(atoms), interval->name, interval->low, interval->high,
                        interval->place);
}

std::vector<Block> vertex_blocks(const Inequalities& of, const Statement& statement) {
  const model::Design::Inequality& stated = *statement.stated;
  const Box& box = *of.box;
  const std::size_t count = box.vertices.size();
  const auto points = forall::finite_points(statement.domain);
  const std::size_t pairs = count * (count + 1) / 2;
  if (points.size() * pairs > forall::kMostVertices) forall::refuse_vertices(stated.place);

  const forall::Variable& interval = interval_of(statement.domain, stated);
  std::vector<Block> blocks;
  for (const model::Design::Comparison& comparison : stated.comparisons) {
    std::vector<expr::Program> held;
    for (std::size_t i = 0; i < count; ++i)
      held.push_back(held_at(comparison.difference, of.functions, i));
    for (const forall::Point& point : points) {
      MonomialTable monomials({interval});
      std::vector<AffineForm> forms;
      forms.reserve(count);
      for (const expr::Program& program : held) {
        forms.push_back(evaluate_at(program, of.unknowns, monomials, of.instance.values, point));
        remove_noise(forms.back(), monomials);
      }
      // M_ij: the functions at coefficient i, theta at vertex j.
      const auto at = [&](std::size_t i, std::size_t j) {
        return at_vertex(forms[i], values_at(monomials, box, j));
      };
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i; j < count; ++j)
          blocks.push_back(block_of(i == j ? at(i, i) : average(at(i, j), at(j, i)),
                                    comparison.name,
                                    label_of(point.label, box.labels[i], box.labels[j]),
                                    comparison.strict, stated.that_place));
    }
  }
  return blocks;
}

}  // namespace gainsmith::lmi
