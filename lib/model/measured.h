// Measured data: what a file says of a quantity at certain times, the rows.
//
//   hold   the quantity has the value of a row from its time on, up to the next row
//   line   between two rows it runs along the line that joins them
//
// Of rows with one time the first is the value that events at that time see, the last what the flow
// goes on with: so does a table of a run show what jumps. Before the first row there is nothing,
// after the last a held value stays.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "numbers/matrix.h"

namespace gainsmith::model {

enum class Between { hold, line };

struct Series {
  std::string file;            ///< for messages
  std::vector<double> times;   ///< never falling; one at least
  numbers::Matrix values;      ///< a row for each time, a column for each element of the quantity
  std::vector<double> silent;  ///< the times of rows that have no value of it, never falling

  /// The first row after t + slack, and the first one not before t - slack; times.size(): none.
  std::size_t after(double t, double slack = 0) const;
  std::size_t not_before(double t, double slack = 0) const;
};

/// Value and rate of a quantity just after t. `t` lies between the first and, of lines, the last
/// row.
struct Course {
  numbers::Matrix value;  ///< a column
  numbers::Matrix rate;
};
Course course_at(const Series& series, Between between, double t);

/// "u: {csv: run.csv, column: u, between: line}", or an output of a plant that is a log.
struct MeasuredText {
  std::string name;
  Between between = Between::hold;
  std::shared_ptr<const Series> series;
  bool output = false;  ///< of the plant, which has an output of its own for it
  std::string at{};     ///< the event at which alone that exists
  Place place;
};

}  // namespace gainsmith::model
