// The standard files, what is shown only to a person at a terminal, and Ctrl-C.
#pragma once

#include <string>

namespace gainsmith::app {

/// Opens each standard file that the caller has closed such that the file that is opened next does
/// not take its place: reading or writing it fails, but for standard error, which takes all.
void open_standard_files();

/// Writes to standard error. Where that fails nobody can be told, and the result stands all the
/// same.
void say(const std::string& text);

/// Ends the writing to standard output. InputError, with the cause, when something could not be
/// written.
void finish_output();

/// Whether standard error is a terminal: only then are progress and colour shown.
bool progress_wanted();

/// From now on Ctrl-C sets a flag instead of ending the program; one more after some seconds ends
/// it.
void catch_interrupts();
bool interrupted();

}  // namespace gainsmith::app
