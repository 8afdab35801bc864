#include "model/gains.h"

namespace gainsmith::model {

const expr::Matrix* Gains::find(const std::string& name) const {
  for (const NamedMatrices* list : {&gains, &unknowns})
    for (const auto& [key, matrix] : *list)
      if (key == name) return &matrix;
  return nullptr;
}

}  // namespace gainsmith::model
