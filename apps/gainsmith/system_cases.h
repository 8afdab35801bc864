// One linear system at several values of its data, and what is worst among them.
#pragma once

#include <string>
#include <vector>

#include "gainsmith/system_figures.h"
#include "gainsmith/system_picture.h"

namespace gainsmith::app {

struct SystemCase {
  std::string where;  ///< "at r = 0.1", "in draw 17"
  DrawnSystem drawn;
};

/// Of a loop whether 1/(1 + L) is stable, otherwise the system itself.
bool is_stable(const DrawnSystem& drawn);

/// One line: the worst margins, gain, overshoot or damping, each with where it is, and how many cases
/// are not stable.
std::string worst_of(const std::vector<SystemCase>& cases, model::SystemPicture kind,
                     const std::string& of);

/// Adds the least margins to the numbers by which designs are compared.
void add_numbers(const std::vector<SystemCase>& cases, SystemResult& result);

/// Of each case whether it is stable, and margins or poles.
io::Json cases_json(const std::vector<SystemCase>& cases, model::SystemPicture kind);

}  // namespace gainsmith::app
