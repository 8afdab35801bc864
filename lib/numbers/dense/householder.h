// Internal to numbers: the orthogonal complement of the columns of a matrix, over numbers, balls
// and numbers with a slope alike.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/stop.h"

namespace gainsmith::numbers {

/// A matrix by its columns.
template <class Number>
using Columns = std::vector<std::vector<Number>>;

/// y <- H y = y - v (v'y) / half on the last rows of y, as many as v has.
template <class Number>
void reflect(const std::vector<Number>& v, const Number& half, std::vector<Number>& y) {
  const std::size_t first = y.size() - v.size();
  Number along{};
  for (std::size_t i = 0; i < v.size(); ++i) along = along + v[i] * y[first + i];
  along = along / half;
  for (std::size_t i = 0; i < v.size(); ++i) y[first + i] = y[first + i] - v[i] * along;
}

/// The last k columns of Q = H_1 H_2 ... in M = Q R:
///
///   H = I - v v' / (v'v/2),  v = x + s |x| e,  s = 1 for x_1 >= 0 and -1 otherwise,
///
/// where x is what the reflections before have left of a column below the diagonal, e = (1, 0,
/// ...); H = I for x = 0. It is the Q of LAPACK. `of` has root(x), is_zero(x) and
/// is_negative(x), none when nobody knows; then there is no result.
template <class Number, class Arithmetic>
std::optional<Columns<Number>> complement(Columns<Number> M, std::size_t rows, std::size_t k,
                                          const Number& one, const Arithmetic& of) {
  struct Reflection {
    std::vector<Number> v;
    Number half;
  };
  std::vector<Reflection> reflections;
  for (std::size_t j = 0; j < M.size(); ++j) {
    check_stop();
    std::vector<Number> v(M[j].begin() + static_cast<std::ptrdiff_t>(j), M[j].end());
    Number squares{};
    for (const Number& x : v) squares = squares + x * x;
    if (of.is_zero(squares)) continue;
    const Number size = of.root(squares);
    const std::optional<bool> negative = of.is_negative(v[0]);
    if (!negative) return std::nullopt;
    const Number half = *negative ? squares - v[0] * size : squares + v[0] * size;
    v[0] = *negative ? v[0] - size : v[0] + size;
    for (std::size_t i = j + 1; i < M.size(); ++i) reflect(v, half, M[i]);
    reflections.push_back({std::move(v), half});
  }
  Columns<Number> basis(k, std::vector<Number>(rows));
  for (std::size_t j = 0; j < k; ++j) {
    basis[j][rows - k + j] = one;
    for (auto at = reflections.rbegin(); at != reflections.rend(); ++at)
      reflect(at->v, at->half, basis[j]);
  }
  return basis;
}

/// What complement() asks of plain numbers.
template <class S>
struct PlainNumbers {
  static S root(const S& x) {
    using std::sqrt;
    return sqrt(x);
  }
  static bool is_zero(const S& x) { return x == S(0); }
  static std::optional<bool> is_negative(const S& x) { return x < S(0); }
};

}  // namespace gainsmith::numbers
