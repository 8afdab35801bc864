#include "numbers/extremum_rules.h"
#include "numbers/real_wide.h"

namespace gainsmith::numbers {

template MatrixOf<DoubleDouble> extremum<DoubleDouble>(const expr::Instruction&,
                                                       expr::Operands<MatrixOf<DoubleDouble>>);

}  // namespace gainsmith::numbers
