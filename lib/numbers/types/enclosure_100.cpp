#include "numbers/types/enclosure_rules.h"
#include "numbers/types/real_wide.h"

namespace gainsmith::numbers {

template struct Enclosure<Decimal100>;
template Enclosed<Decimal100> enclose<Decimal100>(const expr::Program&,
                                                  const EnclosedValues<Decimal100>&);

}  // namespace gainsmith::numbers
