// Times of a log. With d decimals at most, of a time t and the origin t_0, their difference is
// taken in whole numbers of 10^-d:
//   round((t - t_0) 10^d) / (10^d / scale)                                                     (1)
// The divisor is made whole where it is nearly so: where the scale is a power of ten. Beyond
// kMostDecimals it is (t - t_0) scale.
#include "io/yaml/log_times.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/number.h"

namespace gainsmith::io {

namespace {

/// In seconds, some 12 days. No run begins so long before its measurements: these are Unix times.
constexpr double kFarFromZero = 1e6;
constexpr double kNoSeconds = 1e11;  // of Unix times the year 5138
/// With more, whole numbers of 10^-d have no room in a long double.
constexpr int kMostDecimals = 18;

/// Digits behind the point.
int decimals_of(const std::string& text) {
  const std::size_t point = text.find('.');
  if (point == std::string::npos) return 0;
  const std::size_t end = text.find_first_not_of("0123456789", point + 1);
  return static_cast<int>(std::min(end, text.size()) - point) - 1;
}

}  // namespace

/// A decimal, or a date as seconds since 1970-01-01 UTC without leap seconds; none of other texts.
std::optional<LogTimes::Time> LogTimes::parsed(const std::string& text) {
  if (parse_decimal(text)) {
    int decimals = decimals_of(text);
    if (const std::size_t e = text.find_first_of("eE"); e != std::string::npos)
      decimals -= static_cast<int>(*parse_decimal(text.substr(e + 1)));
    return Time{std::strtold(text.c_str(), nullptr), std::max(decimals, 0), false};
  }
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, length = 0;
  if (std::sscanf(text.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d:%n", &year, &month, &day, &hour, &minute,
                  &length) != 5 ||
      length == 0)
    return std::nullopt;
  std::size_t end = text.find_first_not_of("0123456789.", static_cast<std::size_t>(length));
  const std::string seconds =
      text.substr(static_cast<std::size_t>(length), end - static_cast<std::size_t>(length));
  const std::string zone = end == std::string::npos ? "Z" : text.substr(end);
  int east_hours = 0, east_minutes = 0, zone_length = 0;
  const bool is_offset = std::sscanf(zone.c_str(), "%*1[+-]%2d:%2d%n", &east_hours, &east_minutes,
                                     &zone_length) == 2 &&
                         zone_length == static_cast<int>(zone.size());
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || !parse_decimal(seconds) || (zone != "Z" && !is_offset)) return std::nullopt;
  // The end of a day is 24:00:00; a leap second is second 60.
  const long double second = std::strtold(seconds.c_str(), nullptr);
  const bool is_end = hour == 24 && minute == 0 && second == 0;
  if (hour < 0 || (hour > 23 && !is_end) || minute < 0 || minute > 59 || second >= 61)
    return std::nullopt;
  const int east = (zone[0] == '-' ? -1 : 1) * (60 * east_hours + east_minutes);
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return Time{86400.0L * days + 60.0L * (60 * hour + minute - east) + second, decimals_of(seconds),
              true};
}

std::optional<LogTimes::Time> LogTimes::time_of(std::size_t row) const {
  const std::string text = table_.text(row, column_);
  if (text.empty()) return std::nullopt;
  if (const auto time = parsed(text)) return time;
  throw InputError(table_.place(row, column_),
                   "expected a time: a decimal number, or a date such as 2026-11-29T08:30:00.25Z; "
                   "found '" +
                       text + "'");
}

LogTimes::LogTimes(const CsvTable& table, std::size_t column, double scale,
                   const std::optional<std::string>& from, const Place& place)
    : table_(table), column_(column), scale_(scale) {
  std::optional<Time> first;
  for (std::size_t row = 0; row < table.rows() && !first; ++row) first = time_of(row);
  // Dates are in seconds already.
  if (first && first->is_date) scale_ = 1;
  if (first && std::abs(first->value) * scale_ > kNoSeconds)
    throw InputError(place, "the times of " + table.path() + " begin at " +
                                brief(static_cast<double>(first->value), 4) +
                                ", which cannot be seconds; give their unit by scale: 1e-3 for ms, "
                                "1e-6 for us, 1e-9 for ns");
  if (!first || (from && *from != "first row")) {
    const auto stated = parsed(from.value_or("0"));
    if (!stated || (first && stated->is_date != first->is_date))
      throw InputError(place, "from: expected 'first row' or a time as in " + table.path() +
                                  ", found '" + *from + "'");
    from_ = *stated;
    return;
  }
  // Dates and Unix times count from their first row unless something else is said.
  begins_by_itself_ = !from && (first->is_date || std::abs(first->value) * scale_ > kFarFromZero);
  if (from || begins_by_itself_) from_ = *first;
}

std::optional<double> LogTimes::at(std::size_t row) const {
  const auto time = time_of(row);
  if (!time) return std::nullopt;
  const int decimals = std::max(time->decimals, from_.decimals);
  // The decimal of the cell, rounded once.
  if (from_.value == 0 && scale_ == 1 && !time->is_date)
    return parse_decimal(table_.text(row, column_));
  if (decimals > kMostDecimals) return static_cast<double>((time->value - from_.value) * scale_);
  // A quotient of whole numbers, where the scale is a power of ten.
  const long double steps = std::pow(10.0L, decimals);
  long double divisor = steps / scale_;
  if (std::abs(divisor - std::round(divisor)) < 1e-12L * divisor) divisor = std::round(divisor);
  return static_cast<double>(std::round((time->value - from_.value) * steps) / divisor);
}

}  // namespace gainsmith::io
