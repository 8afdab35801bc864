#include "model/gains.h"

#include <cmath>

#include "base/hash.h"
#include "base/number.h"
#include "base/words.h"
#include "model/function.h"
#include "numbers/types/real.h"

namespace gainsmith::model {

using numbers::Matrix;

const numbers::Matrix* Gains::find(const std::string& name) const {
  for (const NamedMatrices* list : {&gains, &unknowns})
    for (const auto& [key, matrix] : *list)
      if (key == name) return &matrix;
  return nullptr;
}

std::string to_string(GainFunction::Kind kind) {
  return word_of<GainFunction::Kind::formula>(kind, {"polynomial", "vertices", "formula"});
}

std::string subject_of(const CertificateRecord& certificate) {
  if (certificate.is_about_problem()) return "the decimals of the file";
  if (certificate.about == "hull") return "the hull";
  return certificate.is_about_squares() ? "sums of squares of these degrees" : "the vertex test";
}

std::string shown_by(const CertificateRecord& certificate) {
  const std::string of = certificate.is_about_problem() ? "" : " of " + subject_of(certificate);
  if (certificate.is_about_squares()) return "no " + subject_of(certificate) + " exist";
  if (certificate.exact) return "no solution" + of + " exists";
  return "no solution" + of + " survives a relative change of " +
         brief(certificate.backward_error, 2) + " of the coefficients";
}

int AlgebraicRecord::steps() const {
  int last = 1;
  for (const Term& term : terms) last = std::max(last, term.step);
  return last;
}

std::string to_string(const AlgebraicRecord& algebraic) {
  if (const int steps = algebraic.steps(); steps > 1)
    return "rational multipliers in " + std::to_string(steps) + " steps";
  if (algebraic.of.empty()) return "rational multipliers";
  std::string text = "multipliers at the eigenvalue " + brief(algebraic.re);
  if (algebraic.im != 0) text += " + " + brief(std::abs(algebraic.im)) + "i";
  return text + " of " + algebraic.of;
}

std::string limits_of(const CertificateRecord& certificate) {
  if (certificate.is_about_problem()) return "";
  if (certificate.is_about_squares()) return " as " + subject_of(certificate);
  return " for " + subject_of(certificate) + " only";
}

std::string statement_hash(const Statement& statement) {
  std::string text = statement.method_text + '\0' + statement.problem_text;
  const auto add = [&](const std::string& part) { (text += '\0') += part; };
  for (const Setting& setting : statement.settings)
    for (const std::string& part : {std::string("set"), setting.name, setting.value}) add(part);
  for (const StatedFile& file : statement.files) {
    for (const std::string& part : {std::string("file"), file.name, file.sha256, file.text})
      add(part);
    for (const StatedMatrix& matrix : file.matrices) {
      add(matrix.key);
      add(matrix.flat ? "list" : std::to_string(matrix.rows) + " x " + std::to_string(matrix.cols));
      for (const std::string& element : matrix.elements) add(element);
    }
  }
  return sha256(text);
}

std::string coefficient_key(const std::string& gain, std::size_t k) {
  return "gain_functions." + gain + ".coefficients[" + std::to_string(k) + "]";
}

std::string printed(double value) {
  return value == 0 && std::signbit(value) ? "-0.0" : shortest(value);
}

Decimals decimals_at(const Gains& gains, const std::string& key, const numbers::Matrix& matrix) {
  Decimals result{key, numbers::shape_of(matrix), {}};
  const auto read = gains.decimals.find(key);
  const bool fits = read != gains.decimals.end() && std::ssize(read->second) == matrix.size();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const double value = matrix(i, j);
      const std::size_t at = result.elements.size();
      const bool holds = fits && parse_decimal(read->second[at]) == value;
      result.elements.push_back(holds ? read->second[at] : printed(value));
    }
  }
  return result;
}

std::string results_hash(const Gains& gains) {
  std::string text = gains.statement.hash;
  const auto add = [&](const std::string& key, const Matrix& matrix) {
    (text += '\0') += key;
    for (const std::string& element : decimals_at(gains, key, matrix).elements)
      (text += '\0') += element;
  };
  const auto add_all = [&](const std::string& key, const NamedMatrices& list) {
    for (const auto& [name, matrix] : list) add(key + "." + name, matrix);
  };
  add_all("gains", gains.gains);
  for (const GainFunction& gain : gains.gain_functions)
    for (std::size_t k = 0; k < gain.coefficients.size(); ++k)
      add(coefficient_key(gain.name, k), gain.coefficients[k]);
  add_all("unknowns", gains.unknowns);
  add_all("parameters", gains.parameters);
  add_all("bases", gains.bases);
  for (const auto& [name, value] : gains.searched)
    add("searched." + name, Matrix::Constant(1, 1, value));
  add_all("optimum", gains.optimum_multipliers);
  const auto add_certificate = [&](const CertificateRecord& certificate, const std::string& key) {
    add_all(key + ".multipliers", certificate.multipliers);
    if (!certificate.algebraic) return;
    const auto add_fractions = [&](const AlgebraicRecord::Fractions& fractions) {
      for (const std::string& fraction : fractions) (text += '\0') += fraction;
    };
    add_fractions(certificate.algebraic->polynomial);
    for (const auto& [block, rows, weight, step] : certificate.algebraic->terms) {
      (text += '\0') += block;
      for (const AlgebraicRecord::Fractions& row : rows) add_fractions(row);
      add_fractions(weight);
      if (step > 1) add_fractions({std::to_string(step)});
    }
  };
  if (gains.certificate) add_certificate(*gains.certificate, "certificate");
  if (gains.search && gains.search->certificate)
    add_certificate(*gains.search->certificate, "search.certificate");
  for (const StatedFunction& function : gains.functions)
    (((text += '\0') += function.signature) += '\0') += function.text;
  for (const GainFunction& gain : gains.gain_functions)
    (((text += '\0') += gain.name) += '\0') += gain.formula;
  return sha256(text);
}

std::optional<std::string> with_values(const StatedFunction& function, const Gains& gains) {
  constexpr std::string_view kPlus = " + ";
  std::string sum;
  for (std::string_view rest = function.text; !rest.empty();) {
    const std::string_view term = rest.substr(0, rest.find(kPlus));
    rest.remove_prefix(std::min(rest.size(), term.size() + kPlus.size()));
    const std::string_view name = term.substr(0, term.find('*'));
    const numbers::Matrix* const value = gains.find(std::string(name));
    if (value == nullptr || value->size() != 1) return std::nullopt;
    const double c = (*value)(0, 0);
    if (c == 0) continue;
    sum += sum.empty() ? (c < 0 ? "-" : "") : c < 0 ? " - " : " + ";
    (sum += brief(std::abs(c))) += term.substr(name.size());
  }
  return sum.empty() ? "0" : sum;
}

std::optional<Decimals> decimals_of(const Gains& gains, const std::string& name) {
  const auto find = [&](const NamedMatrices& list, const char* key) -> std::optional<Decimals> {
    for (const auto& [known, matrix] : list)
      if (known == name) return decimals_at(gains, std::string(key) + "." + name, matrix);
    return std::nullopt;
  };
  if (auto found = find(gains.gains, "gains")) return found;
  for (const GainFunction& gain : gains.gain_functions)
    for (std::size_t k = 0; k < gain.coefficients.size(); ++k)
      if (coefficient_name(gain.name, k) == name)
        return decimals_at(gains, coefficient_key(gain.name, k), gain.coefficients[k]);
  if (auto found = find(gains.unknowns, "unknowns")) return found;
  if (auto found = find(gains.parameters, "parameters")) return found;
  const auto searched = gains.searched.find(name);
  if (searched == gains.searched.end()) return std::nullopt;
  return decimals_at(gains, "searched." + name, numbers::Matrix::Constant(1, 1, searched->second));
}

}  // namespace gainsmith::model
