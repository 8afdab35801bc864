#include <memory>
#include <string>
#include <vector>

#include "gainsmith/campaign_parts.h"
#include "gainsmith/commands.h"
#include "gainsmith/output.h"

namespace gainsmith::app {

namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  std::string output;
  bool json = false;
};

ExitCode merge(const MergeOptions& options) {
  for (const std::string& part : options.parts) prepare_outputs(part, {options.output});
  return tell_campaign(merged_parts(options.parts), options.output, options.json);
}

}  // namespace

Command merge_command() {
  auto options = std::make_shared<MergeOptions>();
  return {"merge",
          "Put together the parts of a campaign that was made in shards",
          {Option("parts", options->parts,
                  "files that 'verify --shard' wrote: all parts of one campaign, in any order")
               .required(),
           Option("-o,--output", options->output,
                  "write the report as JSON here; - for standard output"),
           Option("--json", options->json, "print the report as JSON")},
          "The report has the bytes of the campaign in one piece.\n"
          "Exit code: 0 held, 1 violated, 2 wrong input or a part is missing, 3 undecided.\n"
          "Examples:\n"
          "  gainsmith merge part*.json -o campaign.json",
          [options] { return merge(*options); },
          false};
}

}  // namespace gainsmith::app
