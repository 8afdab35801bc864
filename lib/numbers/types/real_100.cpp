#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template struct Real<Decimal100>;
template MatrixOf<Decimal100> evaluate<Decimal100>(const expr::Program&,
                                                   const ValuesOf<Decimal100>&);

}  // namespace gainsmith::numbers
