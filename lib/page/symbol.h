// Names, numbers and matrices as MathML.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "numbers/matrix.h"

namespace gainsmith::page {

/// An operator: "<mo>+</mo>".
std::string mo(std::string_view text);

/// Markup as one operand: an element alone is one as it is.
std::string row(std::string_view markup);

/// Markup between "(" and ")", or other fences, which grow with it.
std::string fenced(const std::string& markup, std::string_view open = "(",
                   std::string_view close = ")");

/// Operands with commas between them.
std::string listed(const std::vector<std::string>& operands);

/// A name as engineers write it: Greek letters by their names (alpha, Omega), figures at the end
/// and what follows "_" below the line (P1, a_max), "x_hat" with a hat, "observer.xh" as it is.
/// `below`: further indices, markup.
std::string symbol(std::string_view name, const std::vector<std::string>& below = {});

/// The name with a hat above it.
std::string hatted(std::string_view name, const std::vector<std::string>& below = {});

/// Whether the symbol begins with a word of several letters, which needs room beside it.
bool is_word(std::string_view name);

/// A decimal as written, its exponent as a power of ten: "-2.5e-07" is -2.5 x 10^-7.
std::string number(std::string_view decimal);

/// Six significant digits; what is not finite by its name.
std::string value(double value);

/// A matrix, of its elements' markup; the style sheet draws its brackets, which no font need
/// stretch. Of more than ten rows or columns the first six and the last one, with dots for the
/// others.
std::string table(int rows, int columns, const std::function<std::string(int, int)>& element);

/// The same of numbers; a 1 x 1 matrix without brackets.
std::string matrix(const numbers::Matrix& matrix);

/// Rows of real and imaginary parts, as eig(M) has them: "-1 ± 2 i, -3", pairs once.
std::string eigenvalues(const numbers::Matrix& rows);

}  // namespace gainsmith::page
