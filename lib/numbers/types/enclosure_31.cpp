#include "numbers/types/enclosure_rules.h"
#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template struct Enclosure<DoubleDouble>;
template Enclosed<DoubleDouble> enclose<DoubleDouble>(const expr::Program&,
                                                      const EnclosedValues<DoubleDouble>&);

}  // namespace gainsmith::numbers
