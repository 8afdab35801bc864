#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "gainsmith/campaign_parts.h"
#include "gainsmith/commands.h"
#include "gainsmith/output.h"
#include "gainsmith/part_file.h"
#include "gainsmith/picture_file.h"
#include "gainsmith/scan_parts.h"
#include "gainsmith/scan_table.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::vector<std::string> parts;
  std::string output;
  std::string plot;
  bool json = false;
};

/// The files, those of folders in the order of their names.
std::vector<std::string> files_of(const std::vector<std::string>& parts) {
  std::vector<std::string> files;
  for (const std::string& part : parts) {
    std::error_code error;
    if (!fs::is_directory(part, error)) {
      files.push_back(part);
      continue;
    }
    std::vector<std::string> found;
    for (fs::directory_iterator entry(part, error), end; !error && entry != end;
         entry.increment(error))
      if (entry->path().extension() == ".json") found.push_back(entry->path().string());
    if (error) throw InputError({part}, "cannot read this folder: " + error.message());
    if (found.empty())
      throw InputError(
          {part},
          "this folder has no parts; expected .json files. Results of 'gainsmith run' are shown by "
          "'gainsmith report'");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

ExitCode merge(const MergeOptions& options) {
  check_picture_name(options.plot);
  const std::vector<std::string> files = files_of(options.parts);
  std::error_code none;
  for (const std::string& part : options.parts)
    if (!options.output.empty() && fs::is_directory(part, none) &&
        fs::equivalent(fs::absolute(options.output, none).parent_path(), part, none))
      throw InputError({options.output}, "expected a file outside the folder of the parts");
  for (const std::string& file : files) prepare_outputs(file, {options.output, options.plot});
  if (kind_of(read_part(files.front())) == PartKind::campaign) {
    if (!options.plot.empty())
      throw InputError({"--plot"}, "a scan is drawn; these are parts of a campaign");
    return tell_campaign(merged_campaign(files), options.output, options.json);
  }
  const ScanPart whole = merged_scan(files);
  design::require_a_point(whole.rows);
  return tell_scan(whole.facts, whole.rows, {options.output, options.plot, options.json});
}

}  // namespace

Command merge_command() {
  auto options = std::make_shared<MergeOptions>();
  return {
      "merge",
      "Put together the parts of a campaign or a scan that was made in shards",
      {Option("parts", options->parts,
              "files that 'verify --shard' or 'scan --shard' wrote: all parts of one campaign or "
              "scan, in any order")
           .required(),
       Option("-o,--output", options->output,
              "write the report as JSON here, or the table as CSV; - for standard output"),
       Option("--plot", options->plot, "draw the table of a scan here (.svg, .pdf, .png)"),
       Option("--json", options->json, "print the report, or the table, as JSON")},
      "The report or table has the bytes of the campaign or scan in one piece.\n"
      "Exit code: as that of verify or scan; 2 also when a part is missing.\n"
      "Examples:\n"
      "  gainsmith merge part*.json -o campaign.json\n"
      "  gainsmith merge parts -o table.csv --plot map.svg",
      [options] { return merge(*options); },
      false};
}

}  // namespace gainsmith::app
