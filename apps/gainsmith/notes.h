// Lines on what is allowed and perhaps not meant: they change no verdict and no exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "verify/campaign.h"

namespace gainsmith::app {

std::vector<std::string> notes_on(const verify::Report& report);

/// Those of them that --strict refuses: doubts about the text, events that never happen, claims that
/// are never checked, campaigns all of whose claims are 0.
std::vector<std::string> strict_notes(const verify::Report& report);

/// InputError with the first of the notes, for --strict.
void refuse_notes(const std::string& file, const std::vector<std::string>& notes);

/// Of events that do not happen: "the event 'far' never happens"; empty without any.
std::string note_on_events(const std::vector<std::string>& events);

/// Of a campaign with so many different runs (hybrid/idle.h); empty where its runs are drawn.
std::string note_on_runs(const std::optional<std::uint64_t>& different);

/// Of states that start nowhere: no run can be made; what fails, and what to add.
std::string note_on_starts(const std::vector<std::string>& states);

/// "the event 'far'", "the events 'far' and 'near'".
std::string counted(const std::string& what, const std::vector<std::string>& names);

}  // namespace gainsmith::app
