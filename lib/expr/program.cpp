#include "expr/program.h"

namespace gainsmith::expr {

int Program::input(const std::string& name) const {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace gainsmith::expr
