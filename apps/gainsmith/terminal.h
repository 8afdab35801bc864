// The standard files, what is shown only to a person at a terminal, and Ctrl-C.
#pragma once

#include <optional>
#include <string>

#include "base/stop.h"

namespace gainsmith::app {

/// Opens each standard file that the caller has closed such that the file that is opened next does
/// not take its place: reading or writing it fails, but for standard error, which takes all.
void open_standard_files();

/// Writes to standard error. Where that fails nobody can be told, and the result stays the
/// same.
void say(const std::string& text);

/// Ends the writing to standard output. InputError, with the cause, when something could not be
/// written.
void finish_output();

/// Whether standard error is a terminal: only then is a line of progress shown, and colour.
bool is_terminal();

/// How long a command may take, and how it says what it does.
struct Patience {
  std::optional<double> seconds;  ///< none: as long as it takes
  bool progress = false;  ///< a line of JSON every 10 s, where standard error is no terminal
};

/// From now on Ctrl-C, SIGTERM, or the end of the patience, requests a stop (base/stop.h). Where the command
/// does not begin to tell what is known within a second of processor time, the program ends with exit code 3. One
/// more Ctrl-C after some seconds ends it too.
void begin_work(const Patience& patience);

/// Nothing is stopped or shown any more.
void end_work();

/// What a command knows is told, as long as this object lives: nothing stops it, and no progress is
/// shown. One at a time.
class Telling : Concluding {
 public:
  Telling();
  ~Telling();
};

/// How a stop came about, as a sentence; empty without one.
std::string stop_text();

}  // namespace gainsmith::app
