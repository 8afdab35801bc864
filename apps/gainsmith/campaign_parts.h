// Parts of a campaign as files: what `verify --shard` writes and `merge` reads.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "gainsmith/part_file.h"
#include "io/json/json_text.h"
#include "verify/campaign_part.h"

namespace gainsmith::app {

struct PartFile {
  io::Json statement;  ///< campaign_statement()
  std::string source;  ///< how the gains are called on a command line
  Shard shard;
  verify::CampaignPart part;
};

/// What the bytes of a campaign's report follow from, key by key. `compare`: it has figures.
io::Json campaign_statement(const verify::CampaignFacts& facts, const std::string& gains_hash,
                            bool compare);

/// As write_part() takes it.
io::Json document_of(const PartFile& file);

/// The whole campaign of its parts, in any order. InputError that names the file which is no part,
/// damaged, of another campaign than the first, or has runs that another one has; and where runs
/// are missing.
PartFile merged_campaign(const std::vector<std::string>& files);

/// Concludes a campaign and prints the report; as JSON also into `output`, unless that is empty, or
/// "-" for standard output.
ExitCode tell_campaign(const PartFile& whole, const std::string& output, bool json);

/// Takes what --resume keeps of a part, runs_json(), from `file`.
void take_kept(const io::Json& kept, const std::string& file, verify::CampaignPart& part);

}  // namespace gainsmith::app
