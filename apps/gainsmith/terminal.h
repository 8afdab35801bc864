// What is shown only to a person at a terminal, and Ctrl-C.
#pragma once

namespace gainsmith::app {

/// Whether standard error is a terminal: only then are progress and colour shown.
bool progress_wanted();

/// From now on Ctrl-C sets a flag instead of ending the program; a second one ends it.
void catch_interrupts();
bool interrupted();

}  // namespace gainsmith::app
