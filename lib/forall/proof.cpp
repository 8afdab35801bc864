#include "forall/proof.h"

#include "forall/proof_rules.h"

namespace gainsmith::forall {

template DomainProof prove_on_domain<double>(const expr::Program&, const Domain&,
                                             const numbers::EnclosedValues<double>&, bool,
                                             const EnclosedElements<double>&, const ProofOptions&);

}  // namespace gainsmith::forall
