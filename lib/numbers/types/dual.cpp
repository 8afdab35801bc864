#include "numbers/types/dual.h"

#include "numbers/dense/foundation.h"
#include "numbers/types/dual_rules.h"

namespace gainsmith::numbers {

template Dual<double> constant_dual<double>(const Matrix&);
template Dual<double> variable_dual<double>(const Matrix&);
template struct DualNumbers<double>;
template class JacobianEvaluator<double>;
template Matrix jacobian<double>(const expr::Instruction&, expr::Operands<Matrix>);
template Matrix flow_map<double>(const expr::Instruction&, expr::Operands<Matrix>);

}  // namespace gainsmith::numbers
