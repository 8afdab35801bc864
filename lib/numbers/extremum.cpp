#include "numbers/extremum.h"

#include "numbers/extremum_rules.h"
#include "numbers/foundation.h"

namespace gainsmith::numbers {

template Matrix extremum<double>(const expr::Instruction&, expr::Operands<Matrix>);

}  // namespace gainsmith::numbers
