#include "forall/worst.h"

#include <algorithm>
#include <utility>

#include "base/stop.h"
#include "expr/program/evaluate.h"
#include "forall/minima.h"
#include "numbers/dense/dense.h"

namespace gainsmith::forall {

namespace {

/// The matrix as a function of the interval variables, the others fixed.
class Family {
 public:
  Family(const expr::Program& program, const numbers::Values& known, const Point& fixed,
         const std::vector<const Variable*>& axes, const numbers::Vector& rows, Measure measure)
      : evaluator_(program),
        rows_(rows),
        measure_(measure),
        moving_(axes.size(), numbers::Matrix::Zero(1, 1)) {
    for (const expr::Input& input : program.inputs) {
      const auto chosen = fixed.values.find(input.name);
      if (chosen != fixed.values.end()) {
        evaluator_.fix(input.name, chosen->second);
      } else if (const auto value = known.find(input.name); value != known.end()) {
        evaluator_.fix(input.name, value->second);
      }
    }
    for (std::size_t i = 0; i < axes.size(); ++i) evaluator_.set(axes[i]->name, moving_[i]);
  }

  numbers::Matrix matrix(const std::vector<double>& at) {
    for (std::size_t i = 0; i < at.size(); ++i) moving_[i](0, 0) = at[i];
    const numbers::Matrix& value = evaluator_.run();
    numbers::Matrix symmetric = 0.5 * (value + value.transpose());
    const numbers::Vector own = symmetric.diagonal();
    const numbers::Vector units =
        measure_ == Measure::margin ? (own.array() > 0).select(own.array().rsqrt(), 1.0) : rows_;
    if (units.size() == 0) return symmetric;
    return units.asDiagonal() * symmetric * units.asDiagonal();
  }

  double value(const std::vector<double>& at) {
    check_stop();
    solver_.compute_values(matrix(at));
    return solver_.values()(0);
  }

  /// The derivative of the smallest eigenvalue, v' B'(t) v with its eigenvector v, by differences
  /// of fourth order inside [low, high].
  double slope(double t, double low, double high) {
    const double width = high - low;
    // Steps stay inside the interval; next to an end, where there is no room, one-sided of first
    // order.
    const double h = std::min({1e-3 * width, (t - low) / 2, (high - t) / 2});
    solver_.compute(matrix({t}));
    const Eigen::VectorXd v = solver_.vectors().col(0);
    const auto form = [&](double s) { return v.dot(matrix({s}) * v); };
    if (h < 1e-8 * width) {
      const double inside = t - low < high - t ? 1e-6 * width : -1e-6 * width;
      return (form(t + inside) - form(t)) / inside;
    }
    return (8 * (form(t + h) - form(t - h)) - (form(t + 2 * h) - form(t - 2 * h))) / (12 * h);
  }

 private:
  expr::Evaluator<numbers::RealAlgebra> evaluator_;
  const numbers::Vector& rows_;
  Measure measure_;
  std::vector<numbers::Matrix> moving_;
  numbers::SymmetricEigen solver_;
};

/// No interval: the value itself; one: all minima of the curve; several: a descent from a grid.
void add_minima(Family& family, const Point& fixed, const std::vector<const Variable*>& axes,
                std::vector<Minimum>& minima) {
  if (axes.empty()) {
    minima.push_back({family.value({}), fixed});
    return;
  }
  if (axes.size() == 1) {
    const Variable& axis = *axes.front();
    const Curve curve{[&](double t) { return family.value({t}); },
                      [&](double t) { return family.slope(t, axis.low, axis.high); }};
    for (const CurveMinimum& found : local_minima(curve, axis.low, axis.high))
      minima.push_back({found.value, extended(fixed, axis.name, found.at)});
    return;
  }
  std::vector<double> low;
  std::vector<double> high;
  for (const Variable* axis : axes) {
    low.push_back(axis->low);
    high.push_back(axis->high);
  }
  const auto value = [&](const std::vector<double>& at) { return family.value(at); };
  for (const BoxMinimum& found : local_minima(value, low, high)) {
    Point point = fixed;
    for (std::size_t i = 0; i < axes.size(); ++i)
      point = extended(point, axes[i]->name, found.at[i]);
    minima.push_back({found.value, std::move(point)});
  }
}

}  // namespace

std::vector<Minimum> local_minima(const expr::Program& difference, const Domain& domain,
                                  const numbers::Values& known, const numbers::Vector& rows,
                                  Measure measure) {
  std::vector<Minimum> minima;
  const auto axes = intervals(domain);
  for (const Point& fixed : finite_points(domain)) {
    Family family(difference, known, fixed, axes, rows, measure);
    add_minima(family, fixed, axes, minima);
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [](const Minimum& a, const Minimum& b) { return a.value < b.value; });
  return minima;
}

numbers::Matrix matrix_at(const expr::Program& difference, const Point& point,
                          const numbers::Values& known) {
  numbers::Values values;  // a problem may have thousands
  for (const expr::Input& input : difference.inputs)
    if (const auto found = known.find(input.name); found != known.end()) values.insert(*found);
  for (const auto& [name, matrix] : point.values) values.insert_or_assign(name, matrix);
  const numbers::Matrix value = numbers::evaluate(difference, values);
  return 0.5 * (value + value.transpose());
}

}  // namespace gainsmith::forall
