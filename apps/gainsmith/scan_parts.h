// Parts of a scan as files: what `scan --shard` writes and `merge` reads.
#pragma once

#include <string>
#include <vector>

#include "design/scan.h"
#include "gainsmith/part_file.h"
#include "gainsmith/scan_table.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

struct ScanPart {
  io::Json statement;
  Shard shard;
  ScanFacts facts;
  std::vector<design::ScanRow> rows;  ///< all; those of other parts have no answer
};

/// The points of part I of N: I - 1, I - 1 + N, ...: neighbours, which take as long, are shared
/// out.
std::vector<std::size_t> points_of_shard(const ScanPart& part);
/// How many of them have no answer.
std::size_t open_points(const ScanPart& part);

/// As write_part() takes it.
io::Json document_of(const ScanPart& part);

/// The rows that have an answer.
io::Json rows_json(const ScanPart& part);
/// Into a part that has its points. InputError for a row that has an answer already.
void take_rows(const io::Json& rows, const std::string& file, ScanPart& part);

/// The whole scan of its parts, in any order. InputError that names the file which is no part,
/// damaged, of another scan than the first, or has points that another one has; and where points
/// are missing.
ScanPart merged_scan(const std::vector<std::string>& files);

}  // namespace gainsmith::app
