#include "numbers/types/dual_rules.h"
#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template Dual<DoubleDouble> constant_dual<DoubleDouble>(const MatrixOf<DoubleDouble>&);
template Dual<DoubleDouble> variable_dual<DoubleDouble>(const MatrixOf<DoubleDouble>&);
template struct DualNumbers<DoubleDouble>;
template MatrixOf<DoubleDouble> jacobian<DoubleDouble>(const expr::Instruction&,
                                                       expr::Operands<MatrixOf<DoubleDouble>>);
template MatrixOf<DoubleDouble> flow_map<DoubleDouble>(const expr::Instruction&,
                                                       expr::Operands<MatrixOf<DoubleDouble>>);

}  // namespace gainsmith::numbers
