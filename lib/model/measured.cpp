#include "model/measured.h"

#include <algorithm>

namespace gainsmith::model {

std::size_t Series::after(double t, double slack) const {
  return static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t + slack) -
                                  times.begin());
}

std::size_t Series::not_before(double t, double slack) const {
  return static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t - slack) -
                                  times.begin());
}

Course course_at(const Series& series, Between between, double t) {
  const std::size_t next = std::max<std::size_t>(series.after(t), 1);
  const auto row = [&](std::size_t k) -> numbers::Matrix {
    return series.values.row(static_cast<Eigen::Index>(k)).transpose();
  };
  Course course{row(next - 1), numbers::Matrix::Zero(series.values.cols(), 1)};
  if (between == Between::hold || next == series.times.size()) return course;
  const double from = series.times[next - 1];
  course.rate = (row(next) - course.value) / (series.times[next] - from);
  if (t != from) course.value += (t - from) * course.rate;
  return course;
}

}  // namespace gainsmith::model
