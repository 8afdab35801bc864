#include "numbers/types/extremum_rules.h"
#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template MatrixOf<Decimal100> extremum<Decimal100>(const expr::Instruction&,
                                                   expr::Operands<MatrixOf<Decimal100>>);

}  // namespace gainsmith::numbers
