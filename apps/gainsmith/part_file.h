// Parts of work that was made in shards, as files.
//
// A part is a sealed document (sealed.h). It says of what it is: the kind, and key by key a
// statement of all that the results follow from.
#pragma once

#include <string>

#include "gainsmith/shard_option.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

enum class PartKind { campaign, scan };

/// What the results of all work follow from: the version, and how the machine rounds. `kind`: of
/// the work, "campaign", "scan", "search" or "problem".
io::Json begin_statement(const char* kind);
/// The key of the kind.
inline constexpr const char* kWork = "work";

/// The beginning of a part's document.
io::Json part_head(PartKind kind, const Shard& shard, const io::Json& statement);

/// The document of a part. InputError with the file when it is none, damaged, or of another
/// version.
io::Json read_part(const std::string& file);
PartKind kind_of(const io::Json& part);
Shard shard_of(const io::Json& part);

/// InputError that says what differs when two parts are not of the same work.
void require_same_work(const io::Json& part, const std::string& file, const io::Json& first,
                       const std::string& first_file);

/// Of the keys of two statements, the first for which they say different things: "seed 7, not 1";
/// empty when they are equal. `found` is 7.
std::string difference_of(const io::Json& found, const io::Json& expected);

/// InputError for --shard without the file that it needs.
void require_part_name(const std::string& shard, const std::string& output);

/// Writes a whole part and says so: "wrote part3.json: part 3/8, 1250 of 10000 runs".
void write_part(const io::Json& document, const std::string& output, const std::string& what);

/// Says that a part is not whole, and was not written. `done`: "3 of 8 points".
void say_unwritten(const Shard& shard, const std::string& done);

}  // namespace gainsmith::app
