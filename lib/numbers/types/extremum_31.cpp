#include "numbers/types/extremum_rules.h"
#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template MatrixOf<DoubleDouble> extremum<DoubleDouble>(const expr::Instruction&,
                                                       expr::Operands<MatrixOf<DoubleDouble>>);

}  // namespace gainsmith::numbers
