#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template struct Real<DoubleDouble>;
template MatrixOf<DoubleDouble> evaluate<DoubleDouble>(const expr::Program&,
                                                       const ValuesOf<DoubleDouble>&);

}  // namespace gainsmith::numbers
