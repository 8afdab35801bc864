#include "verify/smooth_parts.h"

namespace gainsmith::verify {

std::vector<SmoothPart> smooth_parts(RunValue& value, const hybrid::DenseStep& step,
                                     std::vector<double>* near) {
  std::vector<SmoothPart> parts;
  SmoothPart part{step.from, step.to};
  for (const hybrid::Break& one : value.breaks_on(step, near)) {
    part.to = one.left;
    part.before_jump = one.jumps;
    if (part.from < part.to || parts.empty()) parts.push_back(part);
    parts.back().before_jump = one.jumps;
    part = {one.right, step.to, one.jumps};
  }
  if (part.from < part.to || parts.empty()) parts.push_back(part);
  return parts;
}

}  // namespace gainsmith::verify
