// How a picture is presented, as the command line says: its title, size, part and names.
#pragma once

#include <string>
#include <vector>

#include "gainsmith/command_line.h"
#include "drawing/figure.h"

namespace gainsmith::app {

struct Presentation {
  std::string title;               ///< --title; empty: the usual one
  std::string size;                ///< --size 600x400
  std::string window;              ///< --window 0:5
  std::string jump_width;          ///< --jump-width 0.1
  std::vector<std::string> names;  ///< --name x1=position

  bool empty() const {
    return title.empty() && size.empty() && window.empty() && jump_width.empty() && names.empty();
  }
};

/// The options; of hybrid time where runs are drawn.
std::vector<Option> presentation_options(Presentation& presentation, bool runs);

/// The figures of one command as they are wanted. InputError, with the option as its place, for texts
/// of another form and for a name that no figure has.
void present(const Presentation& presentation, const std::vector<drawing::Figure*>& figures);

}  // namespace gainsmith::app
