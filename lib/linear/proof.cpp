#include "linear/proof.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "linear/tolerances.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::times;

/// S of flows as a polynomial in sigma.
std::vector<Wide> along_flows(const std::vector<FallingTerm>& terms, const Wide& A,
                              const WideTable& factors) {
  std::vector<Wide> S(1, Wide::Zero(A.rows(), A.cols()));
  for (const FallingTerm& term : terms) {
    const Wide along = times<Decimal100>(A.transpose(), term.Q) + times<Decimal100>(term.Q, A);
    const std::vector<Decimal100>& g = factors.powers[term.factor];
    if (S.size() < g.size()) S.resize(g.size(), Wide::Zero(A.rows(), A.cols()));
    for (std::size_t k = 0; k < g.size(); ++k) {
      S[k] += along * g[k];
      if (k > 0) S[k - 1] -= term.Q * Decimal100(g[k] * Decimal100(factors.scale) * Decimal100(k));
    }
  }
  return S;
}

/// S of jumps.
std::vector<Wide> at_jumps(const std::vector<FallingTerm>& terms, const Wide& J,
                           const WideTable& factors, const std::vector<Decimal100>& at_0) {
  std::vector<Wide> S(1, Wide::Zero(J.cols(), J.cols()));
  for (const FallingTerm& term : terms) {
    const Wide after = times<Decimal100>(J.transpose(), times<Decimal100>(term.Q, J));
    const std::vector<Decimal100>& g = factors.powers[term.factor];
    if (S.size() < g.size()) S.resize(g.size(), Wide::Zero(J.cols(), J.cols()));
    for (std::size_t k = 0; k < g.size(); ++k) S[k] += after * g[k];
    S[0] -= term.Q * at_0[term.factor];
  }
  return S;
}

/// Without rows that are 0: nothing depends on these.
std::vector<Wide> without_zeros(const std::vector<Wide>& S) {
  double most = 0;
  const auto size_of = [](const Decimal100& x) { return std::abs(static_cast<double>(x)); };
  for (const Wide& coefficient : S)
    for (Index e = 0; e < coefficient.size(); ++e) most = std::max(most, size_of(coefficient(e)));
  std::vector<Index> kept;
  for (Index i = 0; i < S.front().rows(); ++i)
    if (std::any_of(S.begin(), S.end(), [&](const Wide& coefficient) {
          for (Index j = 0; j < coefficient.cols(); ++j)
            if (size_of(coefficient(i, j)) > kLengthNoise * most) return true;
          return false;
        }))
      kept.push_back(i);
  std::vector<Wide> result;
  for (const Wide& coefficient : S) result.emplace_back(coefficient(kept, kept));
  return result;
}

/// The polynomial around `middle`, in t = (sigma - middle)/half, rounded once.
std::vector<Matrix> around(std::vector<Wide> S, double middle, double half) {
  // The shift of Horner: coefficients in sigma - middle; then powers of half scale to t.
  for (std::size_t first = 0; first + 1 < S.size(); ++first)
    for (std::size_t k = S.size() - 1; k-- > first;) S[k] += Decimal100(middle) * S[k + 1];
  std::vector<Matrix> result;
  Decimal100 power(1);
  for (const Wide& coefficient : S) {
    result.push_back(Wide(coefficient * power).unaryExpr([](const Decimal100& x) {
      return static_cast<double>(x);
    }));
    power *= Decimal100(half);
  }
  return result;
}

/// S_0 + sum_k S_k t^k < 0 for |t| <= 1, by one Cholesky factor of -S_0 less kFlowMargin I in units
/// with diagonal 1.
bool is_negative(const std::vector<Matrix>& S) {
  const Matrix middle = -(S.front() + S.front().transpose()) / 2;
  // In units in which the diagonal is 1, so that rounding has one size.
  Eigen::VectorXd unit = middle.diagonal();
  if (!(unit.minCoeff() > 0)) return false;
  unit = unit.cwiseSqrt().cwiseInverse();
  const auto scaled = [&](const Matrix& matrix) {
    return Matrix(unit.asDiagonal() * ((matrix + matrix.transpose()) / 2) * unit.asDiagonal());
  };
  const Matrix whole =
      scaled(middle) - kFlowMargin * Matrix::Identity(middle.rows(), middle.cols());
  const Eigen::LLT<Matrix> factor(whole);
  if (factor.info() != Eigen::Success) return false;
  double sum = 0;
  for (std::size_t k = 1; k < S.size(); ++k) {
    const Matrix half = factor.matrixL().solve(scaled(S[k]));
    sum += factor.matrixL().solve(Matrix(half.transpose())).norm();
  }
  return sum < 1 - kFlowMargin;
}

/// On |sigma - middle| <= half, or on both halves.
bool is_negative_on(const std::vector<Wide>& S, double middle, double half, int halvings) {
  if (is_negative(around(S, middle, half))) return true;
  if (halvings == 0) return false;
  return is_negative_on(S, middle - half / 2, half / 2, halvings - 1) &&
         is_negative_on(S, middle + half / 2, half / 2, halvings - 1);
}

/// For sigma in [-1, 1].
bool is_negative(const std::vector<Wide>& exact) {
  const std::vector<Wide> S = without_zeros(exact);
  constexpr int halvings = 8;
  return S.front().size() == 0 || is_negative_on(S, 0, 1, halvings);
}

}  // namespace

bool falls_along_flows(const std::vector<FallingTerm>& terms, const Wide& A,
                       const WideTable& factors) {
  return is_negative(along_flows(terms, A, factors));
}

bool falls_at_jumps(const std::vector<FallingTerm>& terms, const Wide& J, const WideTable& factors,
                    const std::vector<Decimal100>& at_0) {
  return is_negative(at_jumps(terms, J, factors, at_0));
}

/// Powers of two, then halving the interval.
std::optional<double> growth_along_flows(const Wide& Q, const Wide& A, double length) {
  constexpr double kLeast = 0x1p-6, kMost = 32;  // of kappa length
  constexpr int kHalvings = 5;
  const Wide S = times<Decimal100>(A.transpose(), Q) + times<Decimal100>(Q, A);
  const auto bounds = [&](double part) {
    return is_semidefinite(Q * Decimal100(part / length) - S);
  };
  if (bounds(0)) return 0;
  double low = 0, high = kLeast;
  for (; !bounds(high); high *= 2) {
    if (high >= kMost) return std::nullopt;
    low = high;
  }
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (bounds(middle) ? high : low) = middle;
  }
  return high / length;
}

}  // namespace gainsmith::linear
