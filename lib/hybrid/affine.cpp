#include "hybrid/affine.h"

#include <algorithm>
#include <vector>

#include "numbers/types/degree.h"

namespace gainsmith::hybrid {

const expr::Instruction* first_not_affine(const expr::Program& program,
                                          const std::function<bool(const std::string&)>& moves) {
  const std::vector<numbers::Degree> degrees = numbers::degrees(program, moves);
  const auto found = std::find(degrees.begin(), degrees.end(), numbers::kNotAffine);
  return found == degrees.end() ? nullptr
                                : &program.code[static_cast<std::size_t>(found - degrees.begin())];
}

}  // namespace gainsmith::hybrid
