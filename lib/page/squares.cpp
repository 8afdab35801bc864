#include "page/squares.h"

#include <algorithm>
#include <vector>

#include "base/number.h"
#include "page/element.h"
#include "page/mathml.h"
#include "page/rows.h"
#include "page/symbol.h"
#include "drawing/text.h"

namespace gainsmith::page {

namespace {

using Record = model::SumOfSquaresRecord;

std::string of_text(const std::string& text, const Notation& notation) {
  return mathml(expr::parse(expr::Text::generated(text, {})), notation);
}

std::string below(const char* letter, std::size_t k) {
  return symbol(letter, {"<mn>" + std::to_string(k) + "</mn>"});
}

std::string column(const std::vector<std::string>& polynomials, const Notation& notation) {
  return table(static_cast<int>(polynomials.size()), 1, [&](int i, int) {
    return of_text(polynomials[static_cast<std::size_t>(i)], notation);
  });
}

/// "1/3" or a decimal.
std::string fraction(const std::string& text) {
  const std::size_t bar = text.find('/');
  const auto above = parse_decimal(text.substr(0, bar));
  const auto below = bar == std::string::npos ? 1 : parse_decimal(text.substr(bar + 1));
  return above && below ? value(*above / *below) : drawing::escaped(text);
}

/// A symmetric matrix from the rows of its lower triangle.
std::string gram(const std::vector<std::vector<std::string>>& rows) {
  const int n = static_cast<int>(rows.size());
  return table(n, n, [&](int i, int j) {
    const auto row = static_cast<std::size_t>(std::max(i, j));
    return fraction(rows[row][static_cast<std::size_t>(std::min(i, j))]);
  });
}

/// One inequality: the sum, then what each of its letters is.
std::string of_record(const Record& record, const Notation& notation) {
  std::string sum, parts;
  const auto add = [&](const std::string& term) { sum += (sum.empty() ? "" : mo("+")) + term; };
  for (std::size_t k = 0; k < record.squares.size(); ++k) {
    const Record::Square& square = record.squares[k];
    const std::string z = below("z", k), Q = below("Q", k);
    // times 0 is the square without a factor: g_0 = 1.
    add((square.times > 0 ? below("g", static_cast<std::size_t>(square.times)) : "") +
        element("msup", row(z) + mo("⊤")) + Q + z);
    parts += formula_row("", row(equation(z, column(square.basis, notation)) + mo(",") +
                                 equation(Q, gram(square.gram))));
  }
  for (const Record::Free& free : record.free) {
    const auto k = static_cast<std::size_t>(free.times);
    add(below("h", k) + below("t", k));
    parts += formula_row("", equation(below("t", k), of_text(free.polynomial, notation)));
  }
  return formula_row(record.name, row(sum), "") + parts;
}

}  // namespace

std::string squares(const model::Gains& gains, const Notation& notation) {
  std::string rows;
  for (const Record& record : gains.sums_of_squares) rows += of_record(record, notation);
  if (rows.empty()) return "";
  return folded(
      "As sums of squares",
      text_element(
          "p",
          "Beside the name of each inequality is a sum. It is the difference of the two sides, the "
          "larger one first; of matrices M it is row'*M*row. All Q are positive "
          "semidefinite. g_k is the k-th polynomial under where that is not negative, h_k "
          "the k-th that is 0. The gain file has all numbers as fractions.") +
          rows);
}

std::string unknown_functions(const model::Gains& gains, const Notation& notation) {
  std::string rows;
  for (const model::StatedFunction& function : gains.functions)
    if (const auto text = with_values(function, gains))
      rows += formula_row(
          "", equation(of_text(function.signature, notation), of_text(*text, notation)));
  return rows;
}

}  // namespace gainsmith::page
