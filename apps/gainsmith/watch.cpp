#include "gainsmith/watch.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "base/stop.h"
#include "gainsmith/terminal.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

/// What a problem may read; not pictures, pages and logs, which are written beside it.
bool is_input(const fs::path& path) {
  const std::string ending = path.extension().string();
  for (const char* known : {".yaml", ".yml", ".csv", ".npy", ".mat", ".json"})
    if (ending == known) return true;
  return false;
}

/// Of each file beside those that are watched: when it was written, and its size.
using Seen = std::map<fs::path, std::pair<fs::file_time_type, std::uintmax_t>>;

Seen seen(const std::vector<fs::path>& files, const fs::path& own) {
  Seen all;
  std::error_code none;
  for (const fs::path& file : files) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (fs::equivalent(folder, own, none)) continue;
    for (fs::directory_iterator entry(folder, none), end; !none && entry != end;
         entry.increment(none)) {
      std::error_code gone;
      if (!is_input(entry->path()) || !entry->is_regular_file(gone)) continue;
      const auto time = entry->last_write_time(gone);
      const auto size = entry->file_size(gone);
      if (!gone) all[entry->path()] = {time, size};
    }
  }
  return all;
}

/// The first file that is not as it was.
std::string changed(const Seen& before, const Seen& now) {
  for (const auto& [path, about] : now)
    if (const auto known = before.find(path); known == before.end() || known->second != about)
      return path.filename().string();
  for (const auto& [path, about] : before)
    if (!now.contains(path)) return path.filename().string();
  return {};
}

}  // namespace

void watch(const std::vector<fs::path>& files, const fs::path& own,
           const std::function<void()>& act) {
  constexpr std::chrono::milliseconds kPause(200);
  Seen before = seen(files, own);
  for (;;) {
    act();
    say("waiting for a change; Ctrl-C ends\n");
    std::string what;
    while (!stop_requested && what.empty()) {
      std::this_thread::sleep_for(kPause);
      const Seen now = seen(files, own);
      what = changed(before, now);
      if (!what.empty()) before = now;
    }
    if (stop_requested) return;
    say("\n" + what + " changed\n");
  }
}

}  // namespace gainsmith::app
