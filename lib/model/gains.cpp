#include "model/gains.h"

#include "base/hash.h"

namespace gainsmith::model {

const numbers::Matrix* Gains::find(const std::string& name) const {
  for (const NamedMatrices* list : {&gains, &unknowns})
    for (const auto& [key, matrix] : *list)
      if (key == name) return &matrix;
  return nullptr;
}

std::string to_string(GainFunction::Kind kind) {
  switch (kind) {
    case GainFunction::Kind::polynomial:
      return "polynomial";
    case GainFunction::Kind::vertices:
      return "vertices";
    case GainFunction::Kind::formula:
      return "formula";
  }
  return "?";
}

std::string limits_of(const CertificateRecord& certificate) {
  if (certificate.exact()) return "";
  return certificate.about == "hull" ? " for the hull only" : " for the vertex test only";
}

std::string statement_hash(const Statement& statement) {
  return sha256(statement.method_text + '\0' + statement.problem_text);
}

}  // namespace gainsmith::model
