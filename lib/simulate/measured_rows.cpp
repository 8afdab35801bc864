#include "simulate/measured_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hybrid/tolerances.h"

namespace gainsmith::simulate {

namespace {

auto row_of(const model::Series& series, std::size_t row) {
  return series.values.row(static_cast<Eigen::Index>(row)).transpose();
}

}  // namespace

MeasuredRows::MeasuredRows(const hybrid::System& system) {
  using Kind = model::Dynamics::VariableKind;
  for (const model::Dynamics::Measured& one : system.dynamics.measured)
    quantities_.push_back({&one, 0, std::nullopt});
  for (std::size_t k = 0; k < system.dynamics.variables.size(); ++k) {
    const model::Dynamics::Variable& variable = system.dynamics.variables[k];
    const Eigen::Index offset = system.layout.slots[k].offset;
    if (variable.kind == Kind::measured) quantities_[variable.of].value = offset;
    if (variable.kind == Kind::measured_rate) quantities_[variable.of].rate = offset;
  }
}

void MeasuredRows::begin(Eigen::VectorXd& values) {
  for (Quantity& quantity : quantities_) {
    const model::Series& series = *quantity.measured->series;
    quantity.row = series.not_before(0);
    const model::Course course = course_at(series, quantity.measured->between, 0);
    if (quantity.rate) values.segment(*quantity.rate, series.values.cols()) = course.rate;
    if (!is_due(quantity, 0)) values.segment(quantity.value, series.values.cols()) = course.value;
  }
  arrive(0, values);
}

double MeasuredRows::next() const {
  double earliest = std::numeric_limits<double>::infinity();
  for (const Quantity& quantity : quantities_)
    if (quantity.row < quantity.measured->series->times.size())
      earliest = std::min(earliest, quantity.measured->series->times[quantity.row]);
  return earliest;
}

bool MeasuredRows::is_due(const Quantity& quantity, double t) {
  const std::vector<double>& times = quantity.measured->series->times;
  return quantity.row < times.size() &&
         times[quantity.row] <= t + hybrid::kOneInstant * std::abs(t);
}

bool MeasuredRows::arrive(double t, Eigen::VectorXd& values) const {
  bool any = false;
  for (const Quantity& quantity : quantities_) {
    if (!is_due(quantity, t)) continue;
    any = true;
    const model::Series& series = *quantity.measured->series;
    values.segment(quantity.value, series.values.cols()) = row_of(series, quantity.row);
  }
  return any;
}

bool MeasuredRows::leave(double t, Eigen::VectorXd& values) {
  bool any = false;
  for (Quantity& quantity : quantities_) {
    if (!is_due(quantity, t)) continue;
    any = true;
    while (is_due(quantity, t)) ++quantity.row;
    const model::Series& series = *quantity.measured->series;
    values.segment(quantity.value, series.values.cols()) = row_of(series, quantity.row - 1);
    if (!quantity.rate) continue;
    auto rate = values.segment(*quantity.rate, series.values.cols());
    rate.setZero();
    if (quantity.row < series.times.size())
      rate = (row_of(series, quantity.row) - row_of(series, quantity.row - 1)) /
             (series.times[quantity.row] - series.times[quantity.row - 1]);
  }
  return any;
}

}  // namespace gainsmith::simulate
