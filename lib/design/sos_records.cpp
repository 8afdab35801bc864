#include "design/sos_records.h"

#include <algorithm>

namespace gainsmith::design {

namespace {

/// Monomials times rows of one statement.
class Texts {
 public:
  Texts(const SosStatements& stated, std::size_t at)
      : names_(stated.variables[at]), has_rows_(stated.statements[at].matrix.rows() > 1) {
    const auto is_taken = [&](const std::string& name) {
      return name == row_ || name.starts_with(row_ + "(");
    };
    while (std::ranges::any_of(names_, is_taken)) row_ += '_';
  }

  /// "row(1)*row(2)*x(1)^2", and of a polynomial "x(1)^2".
  std::string operator()(const std::vector<int>& rows, const sos::Monomial& monomial) const {
    std::string text;
    for (const int row : rows)
      if (has_rows_) text += (text.empty() ? "" : "*") + row_ + "(" + std::to_string(row + 1) + ")";
    if (text.empty()) return to_string(monomial, names_);
    return monomial.degree() == 0 ? text : text + "*" + to_string(monomial, names_);
  }

 private:
  const std::vector<std::string>& names_;
  const bool has_rows_;
  std::string row_ = "row";  ///< row_ where a variable has this name
};

/// sum + c*term.
void add(std::string& sum, const Rational& c, const std::string& term) {
  if (sum.empty())
    sum = c == 1 ? term : exact_text(c) + "*" + term;
  else
    sum +=
        (c < 0 ? " - " : " + ") + (abs(c) == 1 ? term : exact_text(Rational(abs(c))) + "*" + term);
}

}  // namespace

std::vector<model::SumOfSquaresRecord> identity_records(const sos::Decision& decision,
                                                        const SosStatements& stated) {
  const sos::Program& program = decision.program;
  std::vector<model::SumOfSquaresRecord> result;
  for (std::size_t s = 0; s < program.statements.size(); ++s)
    result.push_back({program.statements[s].name, stated.variables[s], {}, {}});
  for (std::size_t g = 0; g < program.grams.size(); ++g) {
    const sos::Gram& gram = program.grams[g];
    if (gram.size() == 0) continue;
    const Texts texts(stated, gram.statement);
    model::SumOfSquaresRecord::Square square{static_cast<int>(gram.multiplier), {}, {}};
    for (const sos::BasisPolynomial& polynomial : gram.basis) {
      std::string& text = square.basis.emplace_back();
      for (const auto& [element, c] : polynomial)
        add(text, c, texts({element.row}, element.monomial));
    }
    const numbers::RationalMatrix& Q = decision.identity.grams[g];
    for (Eigen::Index r = 0; r < Q.rows(); ++r) {
      auto& row = square.gram.emplace_back();
      for (Eigen::Index c = 0; c <= r; ++c) row.push_back(exact_text(Q(r, c)));
    }
    result[gram.statement].squares.push_back(std::move(square));
  }
  for (std::size_t k = 0; k < program.free.size(); ++k) {
    const sos::FreeTerm& free = program.free[k];
    const Rational& c = decision.identity.free[static_cast<std::size_t>(program.unknowns) + k];
    if (c == 0) continue;
    auto& list = result[free.statement].free;
    const int times = static_cast<int>(free.equation) + 1;
    if (list.empty() || list.back().times != times) list.push_back({times, ""});
    add(list.back().polynomial, c,
        Texts(stated, free.statement)({free.row, free.column}, free.monomial));
  }
  return result;
}

std::vector<std::map<std::string, std::string>> moment_records(
    const std::map<sos::Key, Rational>& moments, const SosStatements& stated) {
  if (moments.empty()) return {};
  std::vector<std::map<std::string, std::string>> result(stated.statements.size());
  for (const auto& [key, value] : moments)
    result[key.statement][Texts(stated, key.statement)({key.row, key.column}, key.monomial)] =
        exact_text(value);
  return result;
}

}  // namespace gainsmith::design
