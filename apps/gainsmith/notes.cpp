#include "gainsmith/notes.h"

#include <fmt/format.h>

#include "base/error.h"

namespace gainsmith::app {

std::string counted(const std::string& what, const std::vector<std::string>& names) {
  std::string text = "the " + what + (names.size() == 1 ? " " : "s ");
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "'" : k + 1 == names.size() ? " and '" : ", '") + names[k] + "'";
  return text;
}

void refuse_notes(const std::string& file, const std::vector<std::string>& notes) {
  if (notes.empty()) return;
  std::string more;
  if (notes.size() > 1) more = fmt::format(" (and {} more)", notes.size() - 1);
  throw InputError({file}, "--strict: " + notes.front() + more);
}

std::string note_on_events(const std::vector<std::string>& events) {
  if (events.empty()) return "";
  return counted("event", events) + (events.size() == 1 ? " never happens" : " never happen");
}

std::string note_on_starts(const std::vector<std::string>& states) {
  std::string initial;
  for (const std::string& state : states)
    initial += (initial.empty() ? "" : ", ") + state + ": ...";
  return "no run can be made: " + counted("state", states) +
         (states.size() == 1 ? " has" : " have") +
         " no start. verify, simulate and the campaign of run will fail: add campaign: {initial: "
         "{" +
         initial + "}} with a value or a {box: [low, high]}";
}

std::string note_on_runs(const std::optional<std::uint64_t>& different) {
  if (!different) return "";
  if (*different == 1) return "nothing is drawn in this campaign: all its runs are equal";
  return "nothing is drawn at random in this campaign: it has " + std::to_string(*different) +
         " different runs";
}

/// Why a campaign is slow: runs that are not made many at once.
std::string note_on_careful_runs(const verify::Report& report) {
  std::uint64_t all = 0;
  std::string reasons;
  for (std::size_t k = 0; k < report.open.size(); ++k) {
    if (report.open[k] == 0) continue;
    all += report.open[k];
    reasons += (reasons.empty() ? "" : ", ") + packs::to_string(static_cast<packs::Why>(k)) + " (" +
               std::to_string(report.open[k]) + ")";
  }
  // A few are no reason for slowness.
  if (!report.careful || all == 0 || 10 * *report.careful < report.runs) return "";
  return std::to_string(*report.careful) + " of " + std::to_string(report.runs) +
         " runs were simulated one by one, which takes longer; of those that were tried many at "
         "once " +
         std::to_string(all) + " stayed open: " + reasons;
}

/// "in this run", "in these runs".
std::string in_runs(const verify::Report& report) {
  return report.runs == 1 ? " in this run" : " in these runs";
}

std::vector<std::string> strict_notes(const verify::Report& report) {
  std::vector<std::string> notes = report.doubts;
  // A run that ended early may have had it later.
  if (!report.silent_events.empty() && report.unfinished == 0)
    notes.push_back(note_on_events(report.silent_events) + in_runs(report));
  if (report.interrupted()) return notes;
  bool all_zero = !report.checks.empty() && report.undecided == 0;
  for (const verify::CheckReport& check : report.checks) {
    if (check.stated && check.measured && !check.worst.sampled)
      notes.push_back("the claim '" + check.name + "' is never checked" + in_runs(report));
    all_zero &= check.stated && check.measured && check.worst.sampled && check.worst.value == 0 &&
                (check.kind == model::ClaimKind::below || check.worst.bound == 0);
  }
  if (all_zero)
    notes.push_back("the value of every claim is 0" + in_runs(report) +
                    ": perhaps the observers start at the state of the plant, or nothing that "
                    "moves is measured");
  return notes;
}

std::vector<std::string> notes_on(const verify::Report& report) {
  std::vector<std::string> notes = strict_notes(report);
  if (report.ended && report.runs < report.asked)
    notes.push_back(fmt::format("ended by the first run that violates a claim, of at most {} runs",
                                report.asked));
  if (const std::string drawn = note_on_runs(report.different); !drawn.empty())
    notes.push_back(drawn);
  if (report.different && !report.ended && !report.interrupted() && report.runs < *report.different)
    notes.push_back(
        fmt::format("only {} of the {} different runs were made", report.runs, *report.different));
  if (const std::string careful = note_on_careful_runs(report); !careful.empty())
    notes.push_back(careful);
  return notes;
}

}  // namespace gainsmith::app
