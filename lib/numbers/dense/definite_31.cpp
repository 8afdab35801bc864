#include "numbers/dense/definite_rules.h"

namespace gainsmith::numbers {

template Definite definite<DoubleDouble>(const Enclosed<DoubleDouble>&);
template bool is_positive_definite<DoubleDouble>(const Enclosed<DoubleDouble>&, const Matrix&);

}  // namespace gainsmith::numbers
