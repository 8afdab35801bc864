// What a gain file keeps of sums of squares: identities and moments as texts (docs/gain-file.md).
#pragma once

#include "design/sos_statements.h"
#include "model/gains.h"
#include "sos/decide.h"

namespace gainsmith::design {

/// One for each statement.
std::vector<model::SumOfSquaresRecord> identity_records(const sos::Decision& decision,
                                                        const SosStatements& stated);
/// For each statement the moments by "monomial" or "row(i)*row(j)*monomial"; empty without moments.
std::vector<std::map<std::string, std::string>> moment_records(
    const std::map<sos::Key, Rational>& moments, const SosStatements& stated);

}  // namespace gainsmith::design
