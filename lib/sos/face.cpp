#include "sos/face.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "base/eigen_scalars.h"
#include "numbers/dense/rational_algebra.h"
#include "numerics/lattice.h"

namespace gainsmith::sos {

using Eigen::Index;
using numbers::RationalMatrix;

namespace {

using Wide = numbers::MatrixOf<DoubleDouble>;

/// Rows i of Q that span the rest, and those d that follow from them: Q_di = N Q_ii and
/// Q_dd = N Q_ii N', so that (-N, I) Q = 0 over the columns (i, d).
struct Dependence {
  std::vector<Index> independent, dependent;
  Wide N;
};

double largest_of(const Wide& Q) {
  double largest = 0;
  for (const DoubleDouble& x : Q.diagonal()) largest = std::max(largest, x.hi());
  return largest;
}

/// By Gauss and Jordan's elimination with the largest pivots of the diagonal, in the units of that
/// of Q; `of_all`: the largest element of all Gram matrices, beside which Q may be 0.
Dependence dependence_of(const Wide& Q, double of_all) {
  // A pivot of this part of its diagonal element is 0; so are a diagonal element beside the largest
  // of Q, and a Q beside the largest of all.
  constexpr double kNothing = 1e-5, kNoRow = 1e-6, kNoMatrix = 1e-7;
  Dependence result;
  result.dependent.resize(static_cast<std::size_t>(Q.rows()));
  std::iota(result.dependent.begin(), result.dependent.end(), Index(0));
  const double largest = largest_of(Q);
  Wide M = Q;
  const auto share = [&](Index i) {
    return Q(i, i).hi() > kNoRow * largest ? M(i, i).hi() / Q(i, i).hi() : 0.0;
  };
  while (!result.dependent.empty() && largest > kNoMatrix * of_all) {
    const auto best = std::ranges::max_element(result.dependent, {}, share);
    const Index k = *best;
    if (!(share(k) > kNothing)) break;
    result.dependent.erase(best);
    result.independent.push_back(k);
    M.row(k) /= DoubleDouble(M(k, k));
    for (Index i = 0; i < M.rows(); ++i)
      if (i != k) M.row(i) -= DoubleDouble(M(i, k)) * M.row(k);
  }
  result.N = M(result.independent, result.dependent).transpose();
  return result;
}

/// W'z, for columns W.
std::vector<BasisPolynomial> combined(const std::vector<BasisPolynomial>& basis,
                                      const RationalMatrix& W) {
  std::vector<BasisPolynomial> result;
  for (Index k = 0; k < W.cols(); ++k) {
    std::map<Element, Rational> sum;
    for (Index a = 0; a < W.rows(); ++a)
      if (W(a, k) != 0)
        for (const auto& [element, c] : basis[static_cast<std::size_t>(a)])
          sum[element] += c * W(a, k);
    BasisPolynomial& polynomial = result.emplace_back();
    for (const auto& [element, c] : sum)
      if (c != 0) polynomial.emplace_back(element, c);
  }
  return result;
}

/// Whole vectors v, short, that are nearly in the kernel: v_i + sum_d N_di v_d = 0 for each
/// independent row i, by a reduced basis of the vectors (v, K times what is left of that). As many
/// as rows are dependent, which are the first columns; none where others are as short.
std::optional<RationalMatrix> whole_kernel(const Dependence& rows, const std::vector<double>& scale,
                                           int digits) {
  const std::size_t r = rows.independent.size(), k = rows.dependent.size(), n = r + k;
  const Rational K = power_of_ten(digits);
  std::vector<numerics::IntegerVector> basis;
  for (std::size_t j = 0; j < n; ++j) basis.emplace_back(n + r, Integer(0)).at(j) = 1;
  for (std::size_t i = 0; i < r; ++i) {
    const auto row = static_cast<std::size_t>(rows.independent[i]);
    basis[row][n + i] = Integer(numerator(K));
    for (std::size_t d = 0; d < k; ++d) {
      const auto other = static_cast<std::size_t>(rows.dependent[d]);
      const DoubleDouble N = rows.N(static_cast<Index>(d), static_cast<Index>(i));
      const DoubleDouble c = DoubleDouble(scale[other] / scale[row]) * N;
      basis[other][n + i] = nearest_integer(Rational(K * (Rational(c.hi()) + Rational(c.lo()))));
    }
  }
  basis = numerics::reduced_basis(std::move(basis));
  const auto square = [](const numerics::IntegerVector& v) {
    return std::inner_product(v.begin(), v.end(), v.begin(), Integer(0));
  };
  std::ranges::stable_sort(basis, {}, square);
  // Kernel vectors have to be so many times shorter than the next vector of the reduced basis.
  constexpr int kShorter = 10;
  if (r > 0 && square(basis[k - 1]) * (kShorter * kShorter) > square(basis[k])) return std::nullopt;
  RationalMatrix result(static_cast<Index>(k), static_cast<Index>(n));
  for (Index v = 0; v < result.rows(); ++v)
    for (std::size_t j = 0; j < n; ++j) {
      const Index row = j < k ? rows.dependent[j] : rows.independent[j - k];
      result(v, static_cast<Index>(j)) =
          basis[static_cast<std::size_t>(v)][static_cast<std::size_t>(row)];
    }
  return result;
}

/// On the face of the kernel, in fractions of so many digits.
std::optional<Gram> restricted(const Gram& gram, const Dependence& rows, int digits) {
  if (rows.dependent.empty()) return gram;
  const auto kernel = whole_kernel(rows, gram.scale, digits);
  if (!kernel) return std::nullopt;
  Gram result = gram;
  std::vector<BasisPolynomial> ordered;
  result.scale.clear();
  for (const Index i : rows.dependent) ordered.push_back(gram.basis[static_cast<std::size_t>(i)]);
  for (const Index i : rows.independent) {
    ordered.push_back(gram.basis[static_cast<std::size_t>(i)]);
    result.scale.push_back(gram.scale[static_cast<std::size_t>(i)]);
  }
  result.basis = combined(ordered, numbers::rational_kernel(*kernel));
  return result;
}

}  // namespace

std::optional<Program> restricted_to_faces(const Program& program, const Point& point) {
  std::vector<Dependence> rows;
  double of_all = 0;
  for (const auto& Q : point.balanced) of_all = std::max(of_all, largest_of(Q));
  for (const auto& Q : point.balanced) rows.push_back(dependence_of(Q, of_all));
  if (std::ranges::all_of(rows, [](const auto& one) { return one.dependent.empty(); }))
    return std::nullopt;
  // K = 10^digits: small ones first, which admit short vectors alone.
  for (const int digits : {4, 7, 11, 16, 21}) {
    Program result = program;
    bool is_found = true;
    for (std::size_t g = 0; g < rows.size() && is_found; ++g) {
      auto gram = restricted(program.grams[g], rows[g], digits);
      is_found = gram.has_value();
      if (gram) result.grams[g] = std::move(*gram);
    }
    if (is_found && agree(eliminate(result, equations_of(result)))) return result;
  }
  return std::nullopt;
}

}  // namespace gainsmith::sos
