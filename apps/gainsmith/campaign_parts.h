// Parts of a campaign as files: what `verify --shard` writes and `merge` reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "gainsmith/part_file.h"
#include "io/json_text.h"
#include "model/figure_record.h"
#include "verify/campaign_part.h"

namespace gainsmith::app {

struct PartFile {
  io::Json statement;  ///< campaign_statement()
  std::string source;  ///< how the gains are called on a command line
  Shard shard;
  verify::CampaignPart part;
};

/// What the bytes of a campaign's report follow from, key by key.
io::Json campaign_statement(const verify::CampaignFacts& facts, const std::string& gains_hash);

/// As write_part() takes it.
io::Json document_of(const PartFile& file);

/// The whole campaign of its parts, in any order. InputError that names the file which is no part,
/// damaged, of another campaign than the first, or has runs that another one has; and where runs are
/// missing.
PartFile merged_campaign(const std::vector<std::string>& files);

/// Concludes a campaign and prints the report; as JSON also into `output`, unless that is empty, or
/// "-" for standard output.
/// `figures`: over its runs, where they were asked for.
ExitCode tell_campaign(const PartFile& whole, const std::string& output, bool json,
                       const std::optional<model::FiguresRecord>& figures = {});

/// What --resume keeps of a part: its runs. Those that `kept`, from `file`, has.
io::Json kept_json(const verify::RunSet& runs, const verify::Tally& tally);
void take_kept(const io::Json& kept, const std::string& file, verify::CampaignPart& part);

}  // namespace gainsmith::app
