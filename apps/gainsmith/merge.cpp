#include <memory>
#include <string>
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

struct MergeOptions {
  std::vector<std::string> parts;
  std::string output;
  std::string plot;
  bool json = false;
};

ExitCode merge(const MergeOptions& options) {
  check_picture_name(options.plot);
  for (const std::string& part : options.parts)
    prepare_outputs(part, {options.output, options.plot});
  if (kind_of(read_part(options.parts.front())) == PartKind::campaign) {
    if (!options.plot.empty())
      throw InputError({"--plot"}, "a scan is drawn; these are parts of a campaign");
    return tell_campaign(merged_campaign(options.parts), options.output, options.json);
  }
  const ScanPart whole = merged_scan(options.parts);
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
      "  gainsmith merge part*.json -o campaign.json",
      [options] { return merge(*options); },
      false};
}

}  // namespace gainsmith::app
