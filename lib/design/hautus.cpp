#include "design/hautus.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number.h"
#include "numbers/dense.h"

namespace gainsmith::design {

namespace {

constexpr double kRank = 1e-11;  // relative, of [A - lambda I; C] with rows of size 1

/// 2n x 2n or 2(n+p) x 2n: the complex matrix X + iY as [X, -Y; Y, X].
numbers::Matrix real_form(const numbers::Matrix& X, const numbers::Matrix& Y) {
  numbers::Matrix whole(2 * X.rows(), 2 * X.cols());
  whole << X, -Y, Y, X;
  return whole;
}

numbers::Matrix hautus_matrix(const numbers::Matrix& A, const numbers::Matrix& C,
                              std::complex<double> lambda) {
  const Eigen::Index n = A.rows();
  numbers::Matrix X(n + C.rows(), n);
  X << A - lambda.real() * numbers::Matrix::Identity(n, n), C;
  numbers::Matrix Y = numbers::Matrix::Zero(n + C.rows(), n);
  Y.topRows(n) = -lambda.imag() * numbers::Matrix::Identity(n, n);
  return real_form(X, Y);
}

/// With the digits that are known, one at least; what may as well be 0 says to what.
std::string known_part(double value, double accuracy) {
  constexpr int kDigits = 4;
  if (value == 0) return "0";
  const double digits = std::ceil(std::log10(std::abs(value) / accuracy));
  if (!(digits >= 1)) return "0 (to " + brief(accuracy, 1) + ")";
  return brief(value, static_cast<int>(std::min<double>(digits, kDigits)));
}

/// "0.25 +- 3i".
std::string eigenvalue_text(const HiddenMode& mode) {
  const double imaginary = mode.eigenvalue.imag();
  return known_part(mode.eigenvalue.real(), mode.accuracy) +
         (imaginary > 0 ? " +- " + known_part(imaginary, mode.accuracy) + "i" : "");
}

/// "[1; 0; -0.5]".
std::string direction_text(const HiddenMode& mode) {
  std::string text;
  for (const double element : mode.direction)
    text += (text.empty() ? "[" : "; ") + brief(std::abs(element) < kRank ? 0 : element, 4);
  return text + "]";
}

bool is_declared(const model::Design& design, const std::string& name, bool square) {
  return std::any_of(design.data.begin(), design.data.end(), [&](const auto& datum) {
    return datum.name == name && (!square || datum.shape.rows == datum.shape.cols);
  });
}

}  // namespace

std::optional<HiddenMode> hidden_mode(const numbers::Matrix& A, const numbers::Matrix& C,
                                      Modes modes) {
  constexpr double kStable = 1e-12;  // of |A|: an eigenvalue on the axis is known to that
  const Eigen::Index n = A.rows();
  const double size = A.cwiseAbs().rowwise().sum().maxCoeff();
  if (n == 0 || !A.allFinite() || !C.allFinite() || size == 0) return std::nullopt;
  numbers::Matrix rows = C;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double largest = rows.row(i).cwiseAbs().maxCoeff();
    if (largest > 0) rows.row(i) /= largest;
  }
  std::optional<HiddenMode> found;
  const numbers::ComplexVector eigenvalues = numbers::eigenvalues(A / size);
  for (const std::complex<double>& lambda : eigenvalues) {
    if (lambda.imag() < 0) continue;
    if (modes == Modes::not_decaying && lambda.real() < -kStable) continue;
    const numbers::Svd svd = numbers::full_svd(hautus_matrix(A / size, rows, lambda));
    const double residual = svd.s.tail(1)(0) / svd.s(0);
    if (!(residual <= kRank)) continue;
    if (found && found->eigenvalue.real() >= lambda.real() * size) continue;
    numbers::Vector v = svd.V.col(2 * n - 1).head(n);
    const numbers::Vector imaginary = svd.V.col(2 * n - 1).tail(n);
    if (imaginary.norm() > v.norm()) v = imaginary;
    Eigen::Index at = 0;
    v.cwiseAbs().maxCoeff(&at);
    found = HiddenMode{lambda * size, v / v(at), residual, kStable * size};
  }
  return found;
}

std::string hidden_mode_text(const model::Instance& instance) {
  const model::Design& design = *instance.design;
  if (!is_declared(design, "A", true) || !is_declared(design, "C", false)) return "";
  const auto A = instance.values.find("A");
  const auto C = instance.values.find("C");
  if (A == instance.values.end() || C == instance.values.end() ||
      A->second.cols() != C->second.cols() || design.states.empty())
    return "";
  const auto mode = hidden_mode(A->second, C->second);
  if (!mode) return "";
  return "the output does not show a mode of the plant that does not decay: eigenvalue " +
         eigenvalue_text(*mode) + " in the direction " + direction_text(*mode) +
         ", where [A - lambda*I; C] loses rank (Hautus); no gain changes it, so another "
         "output is needed";
}

std::vector<std::string> fixed_mode_texts(const model::Instance& instance) {
  std::vector<std::string> texts;
  const auto a = instance.values.find("A");
  if (a == instance.values.end() || !is_declared(*instance.design, "A", true)) return texts;
  const numbers::Matrix& A = a->second;
  for (const char* name : {"C", "C2"}) {
    const auto c = instance.values.find(name);
    if (c == instance.values.end() || c->second.cols() != A.cols()) continue;
    if (const auto mode = hidden_mode(A, c->second, Modes::all))
      texts.push_back("no gain moves the mode " + eigenvalue_text(*mode) + ": " + name +
                      " does not show the direction " + direction_text(*mode));
  }
  for (const char* name : {"B", "B2"}) {
    const auto b = instance.values.find(name);
    if (b == instance.values.end() || b->second.rows() != A.rows()) continue;
    if (const auto mode = hidden_mode(A.transpose(), b->second.transpose(), Modes::all))
      texts.push_back("no gain moves the mode " + eigenvalue_text(*mode) + ": " + name +
                      " does not reach the combination " + direction_text(*mode) +
                      " of the states");
  }
  return texts;
}

}  // namespace gainsmith::design
