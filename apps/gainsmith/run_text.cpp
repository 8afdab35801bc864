#include "gainsmith/run_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "base/number.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/notes.h"
#include "hybrid/doubts.h"

namespace gainsmith::app {

namespace {

/// `early`: the run ends before its horizon for a reason that decides nothing.
std::string claims_text(const std::vector<claims::NamedFinding>& claims, bool early) {
  std::string text;
  for (const claims::NamedFinding& claim : claims) {
    const claims::Finding& finding = claim.finding;
    if (finding.ended) {
      text += fmt::format("  {:<12} {}: the run {}\n", claim.name, to_string(finding.judgement),
                          end_text(finding));
      continue;
    }
    if (!finding.sampled) {
      text +=
          fmt::format("  {:<12} {}\n", claim.name,
                      early ? "undecided: never checked, as the run ends before"
                            : "held: never checked, as the run does not reach the time or event "
                              "of the claim");
      continue;
    }
    const bool so_far = early && finding.judgement == claims::Judgement::held;
    const std::string tolerance =
        finding.tolerance > 0 ? ", tolerance " + brief(finding.tolerance) : "";
    text += fmt::format("  {:<12} {}{}: {} against {} at (t, j) = ({}, {}){}\n", claim.name,
                        to_string(finding.judgement), so_far ? " so far" : "", brief(finding.value),
                        brief(finding.bound), brief(finding.t), finding.j, tolerance);
  }
  return text;
}

/// Which of the runs these are: "this run", "any of these runs", "the runs 0 and 3".
std::string which_runs(const std::vector<std::uint64_t>& some,
                       const std::vector<std::uint64_t>& all) {
  if (all.size() == 1) return "this run";
  if (some.size() == all.size()) return "any of these runs";
  std::string text = some.size() == 1 ? "run " : "the runs ";
  for (std::size_t k = 0; k < some.size(); ++k)
    text += (k == 0 ? "" : k + 1 == some.size() ? " and " : ", ") + std::to_string(some[k]);
  return text;
}

/// "44 jumps (touch 24, off 20)": of each event, where there are several, in the order of their first.
std::string jumps_text(const std::vector<std::string>& events) {
  std::vector<std::pair<std::string, int>> counts;
  int jumps = 0;
  for (const std::string& event : events) {
    if (event.empty()) continue;
    ++jumps;
    const auto known = std::find_if(counts.begin(), counts.end(),
                                    [&](const auto& count) { return count.first == event; });
    if (known == counts.end())
      counts.emplace_back(event, 1);
    else
      ++known->second;
  }
  std::string text = fmt::format("{} jumps", jumps);
  if (counts.size() < 2) return text;
  for (std::size_t k = 0; k < counts.size(); ++k)
    text += fmt::format("{}{} {}", k == 0 ? " (" : ", ", counts[k].first, counts[k].second);
  return text + ")";
}

}  // namespace

std::string notes_text(const model::Instance& instance, const std::vector<std::uint64_t>& runs,
                       const std::vector<verify::Replay>& replays) {
  const model::Design& design = *instance.design;
  const std::size_t events = design.dynamics->events.size();
  std::vector<std::vector<std::uint64_t>> silent(events);  // of each event the runs without it
  for (std::size_t k = 0; k < replays.size(); ++k) {
    const hybrid::Trajectory& run = replays[k].run;
    if (!is_complete(run.ending)) continue;
    std::vector<char> happened(events, 0);
    for (const auto& part : run.parts)
      if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) happened[jump->event] = 1;
    for (std::size_t e = 0; e < events; ++e)
      if (happened[e] == 0) silent[e].push_back(runs[k]);
  }
  std::vector<std::string> notes =
      hybrid::doubts_about(*design.dynamics, design.claims, instance.values);
  std::map<std::vector<std::uint64_t>, std::vector<std::string>> alike;
  for (std::size_t e = 0; e < events; ++e)
    if (!silent[e].empty() && !design.dynamics->events[e].is_built_in())
      alike[silent[e]].push_back(design.dynamics->events[e].name);
  for (const auto& [some, names] : alike)
    notes.push_back(note_on_events(names) + " in " + which_runs(some, runs));
  std::string text;
  for (const std::string& note : notes) text += "  note: " + note + "\n";
  return text;
}

std::string run_text(std::uint64_t seed, std::uint64_t run, const verify::Replay& replay) {
  std::string text = fmt::format("run {} of seed {}: {} points, {}, ended at t = {}: {}\n", run,
                                 seed, replay.table.rows(), jumps_text(replay.events),
                                 brief(replay.run.end), to_string(replay.run.ending));
  if (!replay.run.message.empty()) text += "  " + replay.run.message + "\n";
  for (const std::string& note : replay.run.notes) text += "  " + note + "\n";
  return text + claims_text(replay.claims, !is_complete(replay.run.ending));
}

}  // namespace gainsmith::app
