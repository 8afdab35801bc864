// Texts that files of all languages have: heads, comments, names of elements; and numbers that they
// need of a linear flow.
#include "export/shared_text.h"

#include <utility>

#include "base/number.h"
#include "base/visible.h"
#include "expr/program/rewrite.h"

namespace gainsmith::exports {

std::string comment_text(const std::string& text) {
  std::string line;
  for (const char c : visible(text))
    line += c == '"' ? '\'' : c == '\\' ? '/' : c == '\n' || c == '\t' ? ' ' : c;
  // Python reads an encoding from its first lines: PEP 263.
  for (const std::string_view pair : {"*/", "/*", "g:", "g="})
    for (std::size_t k = 0; (k = line.find(pair, k)) != std::string::npos; ++k)
      if (pair[0] != 'g' || line.substr(0, k).ends_with("codin")) line.insert(k + 1, " ");
  return line;
}

std::vector<std::string> head_lines(const Content& content, const std::string& name) {
  std::vector<std::string> lines = {
      name + ": gains of the problem " + content.problem + ", method " + content.method,
      "Written by gainsmith " + content.version + ".",
      "SHA-256 of the gain file " + content.file_hash,
      "SHA-256 of method and problem " + content.statement_hash};
  if (content.single)
    lines.emplace_back(
        "The gains are rounded to single precision; the inequalities were shown at the rounded "
        "gains.");
  if (!content.margins.empty()) lines.emplace_back("Margins of the inequalities, from 0 to 1:");
  for (const model::Margin& margin : content.margins)
    lines.push_back("  " + margin.name + " " + brief(margin.reached, 3) +
                    (margin.worst_point.empty() ? "" : " at " + margin.worst_point) +
                    (margin.holds ? "" : ", not shown"));
  for (std::string& line : lines) line = comment_text(line);
  return lines;
}

std::string lines_text(const std::vector<std::string>& lines, const std::string& before) {
  std::string text;
  for (const std::string& line : lines) text += before + line + "\n";
  return text;
}

std::vector<std::string> elements_of(expr::Shape shape,
                                     const std::function<std::string(int row, int column)>& name) {
  std::vector<std::string> names;
  for (int column = 0; column < shape.cols; ++column)
    for (int row = 0; row < shape.rows; ++row) names.push_back(name(row, column));
  return names;
}

std::pair<numbers::Matrix, numbers::Matrix> step_matrices(const numbers::Matrix& M, double T) {
  // expm([M, I; 0, 0] T) = [Phi, Psi; 0, I].
  const Eigen::Index n = M.rows();
  numbers::Matrix whole = numbers::Matrix::Zero(2 * n, 2 * n);
  whole.topLeftCorner(n, n) = T * M;
  whole.topRightCorner(n, n) = T * numbers::Matrix::Identity(n, n);
  expr::Composer compose({});
  const expr::Shape shape = numbers::shape_of(whole);
  const expr::Program program =
      compose.take(compose.apply(expr::Op::matrix_exponential, {compose.input("M", shape)}, shape));
  const numbers::Matrix step = numbers::evaluate(program, {{"M", whole}});
  return {step.topLeftCorner(n, n), step.topRightCorner(n, n)};
}

double one_norm(const numbers::Matrix& M) {
  return M.size() == 0 ? 0 : M.cwiseAbs().colwise().sum().maxCoeff();
}

int terms_of_series(bool single) {
  // 1/12! is below 2^-24 of the sum's size, 1/19! below 2^-53.
  return single ? 12 : 19;
}

}  // namespace gainsmith::exports
