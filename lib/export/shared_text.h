// Internal to export: what the files in several languages have in common.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "export/content.h"
#include "export/scalar_code.h"

namespace gainsmith::exports {

/// On one line, without what ends or continues a comment or a text, or says how a file is encoded,
/// in any of the languages.
std::string comment_text(const std::string& text);

/// What is said at the head of a file: lines without the signs of a comment.
std::vector<std::string> head_lines(const Content& content, const std::string& name);

/// The lines, each behind `before`.
std::string lines_text(const std::vector<std::string>& lines, const std::string& before);

/// The names of the elements of a matrix, column by column.
std::vector<std::string> elements_of(expr::Shape shape,
                                     const std::function<std::string(int row, int column)>& name);

/// [Phi, Psi] of x+ = Phi x + Psi c after the time T, where x' = M x + c.
std::pair<numbers::Matrix, numbers::Matrix> step_matrices(const numbers::Matrix& M, double T);

/// The largest sum of absolute values of a column.
double one_norm(const numbers::Matrix& M);

/// How many terms of the series of exp(M) x with |M| <= 1 reach rounding.
int terms_of_series(bool single);

}  // namespace gainsmith::exports
