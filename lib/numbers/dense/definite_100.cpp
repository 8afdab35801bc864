#include "numbers/dense/definite_rules.h"

namespace gainsmith::numbers {

template Definite definite<Decimal100>(const Enclosed<Decimal100>&);
template bool is_positive_definite<Decimal100>(const Enclosed<Decimal100>&, const Matrix&);

}  // namespace gainsmith::numbers
