#include "page/symbol.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/number.h"
#include "page/element.h"

namespace gainsmith::page {

namespace {

constexpr int kMostRows = 10;  // of a table that is shown whole
constexpr int kFirstRows = 6;  // of one that is not

using Letter = std::pair<std::string_view, std::string_view>;
constexpr std::array kGreek = {
    Letter{"alpha", "α"},   Letter{"beta", "β"},   Letter{"gamma", "γ"},  Letter{"delta", "δ"},
    Letter{"epsilon", "ε"}, Letter{"eps", "ε"},    Letter{"zeta", "ζ"},   Letter{"eta", "η"},
    Letter{"theta", "θ"},   Letter{"kappa", "κ"},  Letter{"lambda", "λ"}, Letter{"mu", "μ"},
    Letter{"nu", "ν"},      Letter{"xi", "ξ"},     Letter{"pi", "π"},     Letter{"rho", "ρ"},
    Letter{"sigma", "σ"},   Letter{"tau", "τ"},    Letter{"phi", "φ"},    Letter{"chi", "χ"},
    Letter{"psi", "ψ"},     Letter{"omega", "ω"},  Letter{"Gamma", "Γ"},  Letter{"Delta", "Δ"},
    Letter{"Theta", "Θ"},   Letter{"Lambda", "Λ"}, Letter{"Xi", "Ξ"},     Letter{"Pi", "Π"},
    Letter{"Sigma", "Σ"},   Letter{"Phi", "Φ"},    Letter{"Psi", "Ψ"},    Letter{"Omega", "Ω"}};

const Letter* greek(std::string_view stem) {
  const auto found = std::ranges::find(kGreek, stem, &Letter::first);
  return found == kGreek.end() ? nullptr : &*found;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "P1" is P and 1, "a_max" a and max.
struct Parts {
  std::string_view stem;
  std::string_view below;
};

Parts parts(std::string_view name) {
  const std::size_t line = name.find('_');
  if (line != std::string_view::npos && line > 0 && line + 1 < name.size())
    return {name.substr(0, line), name.substr(line + 1)};
  std::size_t end = name.size();
  while (end > 0 && is_digit(name[end - 1])) --end;
  if (end == 0) return {name, {}};
  return {name.substr(0, end), name.substr(end)};
}

/// Whether markup is one element and nothing beside it.
bool is_one_element(std::string_view markup) {
  int depth = 0;
  for (std::size_t at = markup.find('<'); at != std::string_view::npos;
       at = markup.find('<', at + 1)) {
    const std::size_t end = markup.find('>', at);
    if (markup[at + 1] == '/')
      --depth;
    else if (markup[end - 1] != '/')
      ++depth;
    if (depth == 0) return end + 1 == markup.size();
  }
  return false;
}

/// A Greek letter by its name, any other name as it is.
std::string stem_markup(std::string_view stem) {
  const Letter* letter = greek(stem);
  return text_element("mi", letter == nullptr ? stem : letter->second);
}

/// Figures as a number, a name as a symbol.
std::string index_markup(std::string_view index) {
  if (std::all_of(index.begin(), index.end(), is_digit)) return text_element("mn", index);
  return symbol(index);
}

std::string with_hat(const std::string& markup) { return element("mover", markup + "<mo>^</mo>"); }

/// Indices below the base, the name's own first.
std::string with_indices(const std::string& base, std::vector<std::string> below,
                         std::string_view own) {
  if (!own.empty()) below.insert(below.begin(), index_markup(own));
  if (below.empty()) return base;
  return element("msub", base + row(listed(below)));
}

}  // namespace

std::string mo(std::string_view text) { return text_element("mo", text); }

std::string row(std::string_view markup) {
  return is_one_element(markup) ? std::string(markup) : element("mrow", markup);
}

std::string fenced(const std::string& markup, std::string_view open, std::string_view close) {
  return row(mo(open) + markup + mo(close));
}

std::string listed(const std::vector<std::string>& operands) {
  std::string markup;
  for (const std::string& operand : operands) markup += (markup.empty() ? "" : mo(",")) + operand;
  return markup;
}

std::string symbol(std::string_view name, const std::vector<std::string>& below) {
  if (const std::size_t dot = name.find('.'); dot != std::string_view::npos)
    return row(text_element("mi", name.substr(0, dot)) + mo(".") +
               symbol(name.substr(dot + 1), below));
  const Parts of = parts(name);
  if (of.below == "hat") return hatted(of.stem, below);
  return with_indices(stem_markup(of.stem), below, of.below);
}

std::string hatted(std::string_view name, const std::vector<std::string>& below) {
  const Parts of = parts(name);
  return with_indices(with_hat(stem_markup(of.stem)), below, of.below);
}

bool is_word(std::string_view name) {
  const std::string_view stem = parts(name).stem;
  return stem.size() > 1 && greek(stem) == nullptr;
}

std::string number(std::string_view decimal) {
  std::string markup;
  if (!decimal.empty() && decimal[0] == '-') {
    markup = mo("−");
    decimal.remove_prefix(1);
  }
  const std::size_t e = decimal.find_first_of("eE");
  const std::string_view mantissa = decimal.substr(0, e);
  if (e == std::string_view::npos) {
    markup += text_element("mn", mantissa);
    return markup.starts_with("<mo>") ? row(markup) : markup;
  }
  std::string_view exponent = decimal.substr(e + 1);
  const bool negative = exponent.starts_with('-');
  exponent.remove_prefix(std::min(exponent.size(), exponent.find_first_not_of("+-0")));
  const std::string power = text_element("mn", exponent.empty() ? "0" : exponent);
  if (mantissa != "1") markup += text_element("mn", mantissa) + mo("×");
  return row(markup + element("msup", "<mn>10</mn>" + (negative ? row(mo("−") + power) : power)));
}

std::string value(double value) {
  constexpr int kDigits = 6;
  if (std::isnan(value)) return "<mtext>not a number</mtext>";
  if (std::isinf(value)) return row((value < 0 ? mo("−") : "") + "<mi>∞</mi>");
  return number(brief(value, kDigits));
}

/// Of a long side the indices 0 to 5 and the last one are shown, with a row or column of dots
/// before it.
std::string table(int rows, int columns, const std::function<std::string(int, int)>& element_of) {
  const auto shown = [](int count) {
    std::vector<int> indices;
    for (int k = 0; k < count; ++k)
      if (count <= kMostRows || k < kFirstRows || k + 1 == count) indices.push_back(k);
    return indices;
  };
  const bool tall = rows > kMostRows;
  const bool wide = columns > kMostRows;
  const std::vector<int> across = shown(columns);
  std::string body;
  for (const int i : shown(rows)) {
    const bool after_gap = tall && i + 1 == rows;
    std::string cells;
    std::string dots;
    for (const int j : across) {
      if (wide && j + 1 == columns) {
        cells += "<mtd><mo>⋯</mo></mtd>";
        dots += "<mtd><mo>⋱</mo></mtd>";
      }
      cells += element("mtd", element_of(i, j));
      dots += "<mtd><mo>⋮</mo></mtd>";
    }
    if (after_gap) body += element("mtr", dots);
    body += element("mtr", cells);
  }
  return element("mtable", body, R"(class="m")");
}

std::string matrix(const numbers::Matrix& matrix) {
  if (matrix.size() == 1) return value(matrix(0, 0));
  return table(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()),
               [&](int i, int j) { return value(matrix(i, j)); });
}

std::string eigenvalues(const numbers::Matrix& rows) {
  std::vector<std::string> found;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (rows(i, 1) < 0) continue;  // said with the one before
    std::string one = value(rows(i, 0));
    if (rows(i, 1) > 0) one = row(one + mo("±") + value(rows(i, 1)) + "<mi>i</mi>");
    found.push_back(one);
  }
  return row(listed(found));
}

}  // namespace gainsmith::page
