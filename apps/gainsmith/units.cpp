#include "gainsmith/units.h"

#include "model/problem.h"

namespace gainsmith::app {

std::string with_unit(const model::Design& design, const std::string& name) {
  if (design.source)
    for (const model::UnitText& text : design.source->units)
      if (text.name == name && text.units.size() == 1)
        return name + " [" + text.units.front() + "]";
  return name;
}

}  // namespace gainsmith::app
