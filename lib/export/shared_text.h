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

/// [Phi, Psi], each n x n, of x(T) = Phi x(0) + Psi c where x' = M x + c. By one exponential of 2n
/// x 2n (Van Loan 1978), which holds for a singular M too.
std::pair<numbers::Matrix, numbers::Matrix> step_matrices(const numbers::Matrix& M, double T);

/// |M|_1 = max over j of sum_i |M_ij|, the norm that bounds the steps of the series.
double one_norm(const numbers::Matrix& M);

/// The order K at which Taylor's series of exp(M) x with |M|_1 <= 1 ends: its rest, below 2 / (K +
/// 1)! of |x|, is below the rounding of single or double precision.
int terms_of_series(bool single);

}  // namespace gainsmith::exports
