#include "numbers/types/dual_rules.h"
#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template Dual<Decimal100> constant_dual<Decimal100>(const MatrixOf<Decimal100>&);
template Dual<Decimal100> variable_dual<Decimal100>(const MatrixOf<Decimal100>&);
template struct DualNumbers<Decimal100>;
template MatrixOf<Decimal100> jacobian<Decimal100>(const expr::Instruction&,
                                                   expr::Operands<MatrixOf<Decimal100>>);
template MatrixOf<Decimal100> flow_map<Decimal100>(const expr::Instruction&,
                                                   expr::Operands<MatrixOf<Decimal100>>);

}  // namespace gainsmith::numbers
