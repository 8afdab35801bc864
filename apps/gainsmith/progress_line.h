// Progress on standard error (base/progress.h), by a thread of its own.
#pragma once

namespace gainsmith::app {

enum class ProgressKind {
  updated,  ///< one line that changes, for a terminal
  lines,    ///< a line of text after 30 s, and after twice the time each, for a log
  json      ///< a line of JSON every 10 s, for a program
};

void show_progress(ProgressKind kind);
/// The line of a terminal goes, and comes again when it is next due.
void clear_progress();
/// Whether it is hidden for a while.
void hide_progress(bool hidden);
/// Ends it; nothing without it.
void end_progress();

}  // namespace gainsmith::app
