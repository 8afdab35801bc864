// What a scan says: its rows as a table, as CSV, as JSON and as a picture.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "design/scan.h"

namespace gainsmith::app {

/// What the rows are of, apart from the problem.
struct ScanFacts {
  struct Axis {
    std::string name;
    std::string title;  ///< with its unit
    std::vector<double> values;
    bool logarithmic = false;
  };
  std::string title;
  std::vector<Axis> axes;
  std::string objective;             ///< its title; empty: there is none
  std::vector<std::string> figures;  ///< as they were asked for
  std::vector<std::string> titles;   ///< of the figures, with their units
  std::string note;                  ///< below the table
};

/// Where a scan is told.
struct ScanOutputs {
  std::string table;    ///< CSV; "-": standard output
  std::string picture;  ///< empty: none
  bool json = false;
};

/// The points of the grid, in the order of the rows.
std::vector<std::vector<double>> points_of(const ScanFacts& facts);

/// 3 when some point was not finished; 0 when some point is feasible, 1 when every point is excluded.
ExitCode tell_scan(const ScanFacts& facts, const std::vector<design::ScanRow>& rows,
                   const ScanOutputs& outputs);

}  // namespace gainsmith::app
