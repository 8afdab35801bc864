// Progress on standard error (base/progress.h), by a thread of its own.
#pragma once

namespace gainsmith::app {

/// On a terminal one line that is updated; elsewhere a line every 10 s.
void show_progress(bool terminal);
/// The line of a terminal goes, and comes again when it is next due.
void clear_progress();
/// Whether it is hidden for a while.
void hide_progress(bool hidden);
/// Ends it; nothing without it.
void end_progress();

}  // namespace gainsmith::app
