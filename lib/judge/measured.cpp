#include "judge/measured.h"

#include <algorithm>

#include "judge/tolerances.h"

namespace gainsmith::judge {

namespace {

using model::Course;
using model::Dynamics;
using model::Series;
using V = Dynamics::VariableKind;

/// The rows that count as being at t.
std::pair<std::size_t, std::size_t> rows_at(const Series& series, double t) {
  const double slack = time_rounding(t, t);
  return {series.not_before(t, slack), series.after(t, slack)};
}

/// |here - expected| <= kRounding size + time_rounding |rate|.
void compare_with_file(const Texts& texts, std::size_t part, double t, std::size_t v,
                       const numbers::Matrix& here, const Course& course, double sizes,
                       Faults& faults) {
  const numbers::Matrix& expected = texts.is(v, V::measured) ? course.value : course.rate;
  if (expected.size() == 0) return;
  const double largest = std::max(expected.cwiseAbs().maxCoeff(), sizes);
  const double slack =
      kRounding * largest + time_rounding(t, t) * course.rate.cwiseAbs().maxCoeff();
  faults.check(part, t, "is not what its file says: " + texts.layout.slots[v].name,
               (here - expected).cwiseAbs().maxCoeff(), slack);
}

}  // namespace

/// A row inside of the step is a fault. Values and rates are compared at its middle.
void check_measured(const Texts& texts, std::size_t part, const hybrid::DenseStep& step,
                    Faults& faults) {
  for (std::size_t v = 0; v < texts.dynamics.variables.size(); ++v) {
    if (!texts.is_measured(v)) continue;
    const Dynamics::Measured& measured = texts.dynamics.measured[texts.dynamics.variables[v].of];
    const double middle = step.from + (step.to - step.from) / 2;
    const std::size_t first = rows_at(*measured.series, step.from).second;
    if (first < rows_at(*measured.series, step.to).first)
      faults.add(part, measured.series->times[first], "a step leads over a row: " + measured.name);
    const Eigen::VectorXd x = step(middle);
    const double sizes =
        step.coefficients
            .middleRows(texts.layout.slots[v].offset, texts.layout.slots[v].shape.size())
            .cwiseAbs()
            .sum();
    compare_with_file(texts, part, middle, v, texts.part(x, v),
                      course_at(*measured.series, measured.between, middle), sizes, faults);
  }
}

void check_measured(const Texts& texts, std::size_t part, double t, const Eigen::VectorXd& x,
                    Faults& faults) {
  for (std::size_t v = 0; v < texts.dynamics.variables.size(); ++v) {
    if (!texts.is(v, V::measured)) continue;
    const Dynamics::Measured& one = texts.dynamics.measured[texts.dynamics.variables[v].of];
    const auto [first, last] = rows_at(*one.series, t);
    const auto here = texts.part(x, v);
    bool is_row = false;
    for (std::size_t row = first; row < last; ++row)
      is_row = is_row || here == one.series->values.row(static_cast<Eigen::Index>(row)).transpose();
    if (first < last && !is_row) faults.add(part, t, "is not what its file says: " + one.name);
    if (first == last)
      compare_with_file(texts, part, t, v, here, course_at(*one.series, one.between, t), 0, faults);
  }
}

bool Texts::has_row(std::size_t variable, double t) const {
  const auto [first, last] = rows_at(*dynamics.measured[dynamics.variables[variable].of].series, t);
  return first < last;
}

}  // namespace gainsmith::judge
