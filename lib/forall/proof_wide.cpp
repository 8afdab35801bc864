#include "forall/proof_rules.h"

namespace gainsmith::forall {

template DomainProof prove_on_domain<DoubleDouble>(const expr::Program&, const Domain&,
                                                   const numbers::EnclosedValues<DoubleDouble>&,
                                                   bool, const EnclosedElements<DoubleDouble>&,
                                                   const ProofOptions&);
template DomainProof prove_on_domain<Decimal100>(const expr::Program&, const Domain&,
                                                 const numbers::EnclosedValues<Decimal100>&, bool,
                                                 const EnclosedElements<Decimal100>&,
                                                 const ProofOptions&);

}  // namespace gainsmith::forall
