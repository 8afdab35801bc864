#include "lmi/compile.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

#include "base/number.h"
#include "expr/compile.h"

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

AffineForm evaluate_affine(const expr::Program& program, const Unknowns& unknowns, AtomTable& atoms,
                           const expr::Values& values, const std::string& interval_variable) {
  expr::Evaluator<AffineAlgebra> evaluator(program, {&atoms, &unknowns});
  std::deque<AffineForm> inputs;
  for (const expr::Input& input : program.inputs) {
    if (input.name == interval_variable) {
      inputs.push_back(variable_form(atoms));
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

/// The values of the variables of `forall` and how a message names them.
struct Point {
  expr::Values values;
  std::string label;
};

/// All combinations of the elements of the finite sets.
std::vector<Point> finite_points(const model::Instance& instance,
                                 const model::Requirement& requirement) {
  std::vector<Point> points = {{instance.known_values(), ""}};
  for (const model::Forall& forall : requirement.forall) {
    if (forall.interval) continue;
    std::vector<Point> next;
    for (const Point& point : points) {
      for (const expr::Expression& element : forall.points) {
        const double value = model::scalar_value(element, instance.scope, point.values);
        Point extended = point;
        extended.values[forall.variable] = expr::Matrix::Constant(1, 1, value);
        extended.label +=
            (extended.label.empty() ? "" : ", ") + forall.variable + " = " + brief(value);
        next.push_back(std::move(extended));
      }
    }
    points = std::move(next);
  }
  return points;
}

struct Interval {
  std::string variable;
  double low = 0;
  double high = 0;
};

/// The interval of the requirement, if it has one. At most one variable may run over an interval.
Interval interval_of(const model::Instance& instance, const model::Requirement& requirement) {
  Interval result;
  const expr::Values values = instance.known_values();
  for (const model::Forall& forall : requirement.forall) {
    if (!forall.interval) continue;
    if (!result.variable.empty())
      throw InputError(forall.place, "only one variable of 'forall' may run over an interval");
    result.variable = forall.variable;
    result.low = model::scalar_value(forall.points[0], instance.scope, values);
    result.high = model::scalar_value(forall.points[1], instance.scope, values);
    if (!(result.low <= result.high))
      throw InputError(forall.place, "the interval [" + brief(result.low) + ", " +
                                         brief(result.high) + "] is empty");
  }
  return result;
}

/// The atoms that stand in a form, but for the constant.
std::vector<int> atoms_in(const AffineForm& form) {
  std::set<int> found;
  for (const auto& [key, matrix] : form.terms)
    if (key.first != 0) found.insert(key.first);
  return {found.begin(), found.end()};
}

/// The form with the given values for its atoms.
AffineForm at_vertex(const AffineForm& form, const std::map<int, double>& values) {
  AffineForm result{form.shape, {}};
  for (const auto& [key, matrix] : form.terms) {
    const double factor = key.first == 0 ? 1.0 : values.at(key.first);
    const auto [found, fresh] = result.terms.try_emplace({0, key.second}, factor * matrix);
    if (!fresh) found->second = found->second + factor * matrix;
  }
  return result;
}

std::string vertex_label(const AtomTable& atoms, const Interval& interval,
                         const std::map<int, double>& values) {
  if (values.size() == 1) {
    const auto& [atom, value] = *values.begin();
    for (const double end : {interval.low, interval.high})
      if (evaluate(atoms[atom], end) == value) return interval.variable + " = " + brief(end);
  }
  std::string label;
  for (const auto& [atom, value] : values)
    label += (label.empty() ? "" : ", ") + to_string(atoms[atom], interval.variable) + " = " +
             brief(value);
  return label;
}

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

/// Adds the blocks of one form: itself, or its vertices over the interval.
void add_vertices(const AffineForm& form, const AtomTable& atoms, const Interval& interval,
                  const Block& frame, const Place& place, std::vector<Block>& blocks) {
  constexpr std::size_t kMostAtoms = 12;
  const std::vector<int> used = atoms_in(form);
  if (used.size() > kMostAtoms)
    throw InputError(place, "the inequality '" + frame.name + "' has " +
                                std::to_string(used.size()) + " scalar functions of " +
                                interval.variable + "; the box of more than " +
                                std::to_string(kMostAtoms) + " has too many vertices");
  std::vector<Range> ranges;
  for (const int atom : used) {
    ranges.push_back(range(atoms[atom], interval.low, interval.high));
    if (!std::isfinite(ranges.back().low) || !std::isfinite(ranges.back().high))
      throw InputError(place, to_string(atoms[atom], interval.variable) +
                                  " is too large for double on [" + brief(interval.low) + ", " +
                                  brief(interval.high) + "]");
  }
  for (std::size_t vertex = 0; vertex < (std::size_t{1} << used.size()); ++vertex) {
    std::map<int, double> values;
    bool repeated = false;
    for (std::size_t k = 0; k < used.size(); ++k) {
      const bool high = ((vertex >> k) & 1U) != 0;
      repeated |= high && ranges[k].low == ranges[k].high;
      values[used[k]] = high ? ranges[k].high : ranges[k].low;
    }
    if (repeated) continue;
    const std::string label = used.empty() ? "" : vertex_label(atoms, interval, values);
    blocks.push_back(block_of(at_vertex(form, values), frame.name, joined(frame.point, label),
                              frame.strict, place));
  }
}

void add_requirement(const model::Instance& instance, const model::Requirement& requirement,
                     Lmi& lmi) {
  expr::Scope scope = instance.design_scope();
  for (const model::Forall& forall : requirement.forall)
    scope.symbols[forall.variable] = {{}, std::nullopt};
  const auto relations = expr::compile_relations(requirement.that, scope);
  const Interval interval = interval_of(instance, requirement);
  const Place place = requirement.that.place(*requirement.that.root);
  for (std::size_t k = 0; k < relations.size(); ++k) {
    Block frame;
    frame.name = requirement.name + (relations.size() > 1 ? "." + std::to_string(k + 1) : "");
    frame.strict = relations[k].strict;
    for (const Point& point : finite_points(instance, requirement)) {
      AtomTable atoms;
      const AffineForm form = evaluate_affine(relations[k].difference, lmi.unknowns, atoms,
                                              point.values, interval.variable);
      frame.point = point.label;
      add_vertices(form, atoms, interval, frame, place, lmi.blocks);
    }
  }
}

void set_objective(const model::Instance& instance, Lmi& lmi) {
  const auto& minimize = instance.method->minimize;
  if (!minimize) return;
  AtomTable atoms;
  const auto program = expr::compile(*minimize, instance.design_scope(), expr::Shape{});
  const AffineForm form =
      evaluate_affine(program, lmi.unknowns, atoms, instance.known_values(), "");
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

Lmi compile(const model::Instance& instance) {
  Lmi lmi(instance);
  for (const model::Requirement& requirement : instance.method->require)
    add_requirement(instance, requirement, lmi);
  set_objective(instance, lmi);
  return lmi;
}

}  // namespace gainsmith::lmi
