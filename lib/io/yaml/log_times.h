// Internal to io: the times of the rows of a log, in seconds from the one at which a run begins.
//
// A time is a decimal number or a date, 2026-11-29T08:30:00.25Z (ISO 8601; without Z or +hh:mm it
// is UTC). Differences of times are taken in decimals, so that 1700000000.15 is 0.1 after
// 1700000000.05.
#pragma once

#include <optional>
#include <string>

#include "io/matrix/csv_table.h"

namespace gainsmith::io {

class LogTimes {
 public:
  /// `scale`: the unit of the numbers in seconds. `from`: where a run begins, in the file's units:
  /// a time as in a row, or "first row"; none for 0, or for the first row where it is a date or
  /// more than 1e6 s away. InputError at `place`.
  LogTimes(const CsvTable& table, std::size_t column, double scale,
           const std::optional<std::string>& from, const Place& place);

  /// None where the cell is empty.
  std::optional<double> at(std::size_t row) const;
  Place place(std::size_t row) const { return table_.place(row, column_); }
  /// Whether the run begins at the first row although nothing says so.
  bool begins_by_itself() const { return begins_by_itself_; }

 private:
  /// Seconds, or the units of the file, with so many decimals.
  struct Time {
    long double value = 0;
    int decimals = 0;
    bool is_date = false;
  };
  static std::optional<Time> parsed(const std::string& text);
  std::optional<Time> time_of(std::size_t row) const;

  const CsvTable& table_;
  std::size_t column_;
  double scale_;
  Time from_;
  bool begins_by_itself_ = false;
};

}  // namespace gainsmith::io
