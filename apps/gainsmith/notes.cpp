#include "gainsmith/notes.h"

namespace gainsmith::app {

std::string counted(const std::string& what, const std::vector<std::string>& names) {
  std::string text = "the " + what + (names.size() == 1 ? " " : "s ");
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "'" : k + 1 == names.size() ? " and '" : ", '") + names[k] + "'";
  return text;
}

std::vector<std::string> notes_on_observers(const std::vector<std::string>& idle) {
  std::vector<std::string> notes;
  for (const std::string& observer : idle)
    notes.push_back((observer == "observer" ? "the observer" : "the observer '" + observer + "'") +
                    " never changes: it has no flow, and no map at an event");
  return notes;
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

std::vector<std::string> notes_on(const verify::Report& report) {
  std::vector<std::string> notes = notes_on_observers(report.idle_observers);
  if (const std::string drawn = note_on_runs(report.different); !drawn.empty())
    notes.push_back(drawn);
  if (!report.silent_events.empty())
    notes.push_back(note_on_events(report.silent_events) +
                    (report.runs == 1 ? " in this run" : " in these runs"));
  return notes;
}

}  // namespace gainsmith::app
