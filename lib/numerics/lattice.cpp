#include "numerics/lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stop.h"
#include "numerics/matrix.h"

namespace gainsmith::numerics {

namespace {

using std::size_t;

Integer dot(const IntegerVector& a, const IntegerVector& b) {
  Integer sum = 0;
  for (size_t i = 0; i < a.size(); ++i)
    if (a[i] != 0 && b[i] != 0) sum += a[i] * b[i];
  return sum;
}

/// Cohen's algorithm: d_i are the Gram determinants, d(0) = 1, lambda_ij = d_j mu_ij.
class Reduction {
 public:
  explicit Reduction(std::vector<IntegerVector> basis)
      : b_(std::move(basis)), d_(b_.size() + 1, Integer(1)), lambda_(b_.size()) {
    for (auto& row : lambda_) row.assign(b_.size(), Integer(0));
  }

  std::vector<IntegerVector> run() {
    if (b_.size() < 2) return std::move(b_);
    orthogonalise(0);
    size_t known = 0;
    for (size_t k = 1; k < b_.size();) {
      if (k > known) orthogonalise(known = k);
      reduce(k, k - 1);
      const Integer& l = lambda_[k][k - 1];
      if (4 * (d_[k + 1] * d_[k - 1] + l * l) < 3 * d_[k] * d_[k]) {
        swap(k, known);
        k = std::max<size_t>(1, k - 1);
        continue;
      }
      for (size_t j = k - 1; j-- > 0;) reduce(k, j);
      ++k;
    }
    return std::move(b_);
  }

 private:
  /// lambda_k0 to lambda_k,k-1 and d_k: Gram and Schmidt in whole numbers. All divisions are exact.
  void orthogonalise(size_t k) {
    for (size_t j = 0; j <= k; ++j) {
      Integer u = dot(b_[k], b_[j]);
      for (size_t i = 0; i < j; ++i) u = (d_[i + 1] * u - lambda_[k][i] * lambda_[j][i]) / d_[i];
      (j < k ? lambda_[k][j] : d_[k + 1]) = u;
    }
  }

  /// Makes |mu_kl| <= 1/2, by subtracting the nearest multiple of b_l from b_k.
  void reduce(size_t k, size_t l) {
    if (2 * abs(lambda_[k][l]) <= d_[l + 1]) return;
    const Integer q = nearest_integer(Rational(lambda_[k][l], d_[l + 1]));
    for (size_t i = 0; i < b_[k].size(); ++i) b_[k][i] -= q * b_[l][i];
    lambda_[k][l] -= q * d_[l + 1];
    for (size_t i = 0; i < l; ++i) lambda_[k][i] -= q * lambda_[l][i];
  }

  /// Exchanges b_k and b_{k-1}: Lovasz' condition |b*_k|^2 >= (3/4 - mu^2) |b*_{k-1}|^2 fails.
  void swap(size_t k, size_t known) {
    std::swap(b_[k], b_[k - 1]);
    for (size_t j = 0; j + 1 < k; ++j) std::swap(lambda_[k][j], lambda_[k - 1][j]);
    const Integer l = lambda_[k][k - 1];
    const Integer B = (d_[k - 1] * d_[k + 1] + l * l) / d_[k];
    for (size_t i = k + 1; i <= known; ++i) {
      const Integer t = lambda_[i][k];
      lambda_[i][k] = (d_[k + 1] * lambda_[i][k - 1] - l * t) / d_[k];
      lambda_[i][k - 1] = (B * t + l * lambda_[i][k]) / d_[k + 1];
    }
    d_[k] = B;
  }

  std::vector<IntegerVector> b_;
  std::vector<Integer> d_;
  std::vector<IntegerVector> lambda_;
};

/// An equation a x = beta in whole numbers without a common factor of a.
struct WholeEquation {
  IntegerVector a;
  Integer beta;
};

/// None when there are no whole solutions of a row.
std::optional<WholeEquation> whole_equation(const RationalMatrix& A, const Rational& b,
                                            Eigen::Index row) {
  Integer common = denominator(b);
  for (Eigen::Index c = 0; c < A.cols(); ++c)
    if (A(row, c) != 0) common = lcm(common, denominator(A(row, c)));
  WholeEquation result{IntegerVector(static_cast<size_t>(A.cols()), Integer(0)),
                       numerator(Rational(b * Rational(common)))};
  Integer shared = 0;
  for (Eigen::Index c = 0; c < A.cols(); ++c) {
    if (A(row, c) == 0) continue;
    Integer& element = result.a[static_cast<size_t>(c)];
    element = numerator(Rational(A(row, c) * Rational(common)));
    shared = gcd(shared, element);
  }
  if (shared == 0) return result.beta == 0 ? std::optional(std::move(result)) : std::nullopt;
  if (result.beta % shared != 0) return std::nullopt;
  for (Integer& element : result.a)
    if (element != 0) element /= shared;
  result.beta /= shared;
  return result;
}

/// A basis in doubles, which hold whole numbers below 2^53 exactly: the steps that shorten it are
/// exact, what rounding does is to choose them (Schnorr & Euchner 1994).
class QuickReduction {
 public:
  /// None when a number is too large.
  static std::optional<QuickReduction> of(const std::vector<IntegerVector>& basis) {
    QuickReduction result;
    for (const IntegerVector& vector : basis) {
      Vector row(std::ssize(vector));
      for (size_t i = 0; i < vector.size(); ++i)
        row(static_cast<Eigen::Index>(i)) = static_cast<double>(vector[i]);
      if (!is_exact(row)) return std::nullopt;
      result.b_.push_back(std::move(row));
    }
    result.mu_.resize(basis.size());
    result.squares_.resize(basis.size());
    result.orthogonal_.resize(basis.size());
    return result;
  }

  /// False when a number became too large. A basis that is not reduced after many steps is left as
  /// it is then: shorter than it was.
  bool run() {
    constexpr double kLovasz = 0.99;
    const size_t most = 200 * (b_.size() + 10);
    size_t visits = 0;
    for (size_t k = 0; k < b_.size();) {
      check_stop();
      if (!shorten(k)) return false;
      if (++visits > most) {
        ++k;
        continue;
      }
      if (k > 0) {
        const double m = mu_[k][k - 1];
        if (squares_[k] < (kLovasz - m * m) * squares_[k - 1]) {
          std::swap(b_[k], b_[k - 1]);
          --k;
          continue;
        }
      }
      ++k;
    }
    return true;
  }

  std::vector<IntegerVector> basis() const {
    std::vector<IntegerVector> result;
    for (const Vector& row : b_) result.emplace_back(row.begin(), row.end());
    return result;
  }

  /// How often to add each vector to come from `away` near 0: Babai's nearest plane, from the last
  /// vector to the first.
  std::vector<double> steps_towards(Vector away) const {
    std::vector<double> steps(b_.size(), 0.0);
    for (size_t j = b_.size(); j-- > 0;) {
      const double step = std::round(away.dot(orthogonal_[j]) / squares_[j]);
      if (step == 0 || !std::isfinite(step)) continue;
      steps[j] = step;
      away -= step * b_[j];
    }
    return steps;
  }

 private:
  static bool is_exact(const Vector& row) {
    constexpr double kLargest = 1e15;
    return row.lpNorm<Eigen::Infinity>() <= kLargest;
  }

  void orthogonalise(size_t k) {
    mu_[k].assign(k, 0.0);
    orthogonal_[k] = b_[k];
    for (size_t j = 0; j < k; ++j) {
      mu_[k][j] = orthogonal_[k].dot(orthogonal_[j]) / squares_[j];
      if (mu_[k][j] != 0) orthogonal_[k] -= mu_[k][j] * orthogonal_[j];
    }
    squares_[k] = orthogonal_[k].squaredNorm();
  }

  /// Brings b_k near 0 along the vectors before it, and orthogonalises it.
  bool shorten(size_t k) {
    constexpr int kMostPasses = 20;
    constexpr double kFar = 1e4;  // shorter steps leave mu and the orthogonal part as they are
    for (int pass = 0; pass < kMostPasses; ++pass) {
      orthogonalise(k);
      bool far = false;
      for (size_t j = k; j-- > 0;) {
        // A half and a little: at a half rounding would go to and fro.
        if (std::abs(mu_[k][j]) <= 0.501) continue;
        const double step = std::round(mu_[k][j]);
        b_[k] -= step * b_[j];
        for (size_t i = 0; i < j; ++i) mu_[k][i] -= step * mu_[j][i];
        mu_[k][j] -= step;
        far |= std::abs(step) > kFar;
      }
      if (!is_exact(b_[k])) return false;
      if (!far) return squares_[k] > 0;
    }
    return false;
  }

  std::vector<Vector> b_;
  std::vector<Vector> orthogonal_;
  std::vector<std::vector<double>> mu_;
  std::vector<double> squares_;
};

/// The whole solutions of equations that are taken one by one: a point near `near`, and a basis of
/// the moves that change none of the equations.
class WholeSolutions {
 public:
  explicit WholeSolutions(const std::vector<Rational>& near) : near_(near) {
    for (size_t i = 0; i < near.size(); ++i) {
      point_.push_back(nearest_integer(near[i]));
      moves_.emplace_back(near.size(), Integer(0));
      moves_.back()[i] = 1;
    }
  }

  /// False when there is none with this equation.
  bool impose(const WholeEquation& equation) {
    const Integer residual = equation.beta - dot(equation.a, point_);
    std::vector<Move> changing = take_changing(equation.a);
    if (changing.empty()) return residual == 0;
    // The vector that is left of a group goes into the next one.
    std::vector<Move> group;
    std::vector<IntegerVector> kept;
    for (Move& move : changing) {
      group.push_back(std::move(move));
      if (group.size() == kGroup) keep_one(group, kept);
    }
    if (group.size() > 1) keep_one(group, kept);
    const Move& left = group.front();
    if (residual % left.change != 0) return false;
    const Integer steps = residual / left.change;
    for (size_t i = 0; i < point_.size(); ++i) point_[i] += steps * left.vector[i];
    move_near(kept);
    moves_.insert(moves_.end(), kept.begin(), kept.end());
    return true;
  }

  const IntegerVector& point() const { return point_; }

 private:
  /// So many vectors are reduced at once: the longer, the shorter they become.
  static constexpr size_t kGroup = 10;

  struct Move {
    IntegerVector vector;
    Integer change;  ///< a times the vector
    Integer square;  ///< its length
  };

  /// The moves that change a x, the shortest first.
  std::vector<Move> take_changing(const IntegerVector& a) {
    std::vector<Move> changing;
    std::vector<IntegerVector> others;
    for (IntegerVector& vector : moves_) {
      Integer change = dot(a, vector);
      if (change == 0) {
        others.push_back(std::move(vector));
        continue;
      }
      Integer square = dot(vector, vector);
      changing.push_back({std::move(vector), std::move(change), std::move(square)});
    }
    moves_ = std::move(others);
    std::stable_sort(changing.begin(), changing.end(),
                     [](const Move& x, const Move& y) { return x.square < y.square; });
    return changing;
  }

  /// Shortens the moves, and brings the point near along them.
  void move_near(std::vector<IntegerVector>& moves) {
    constexpr int kTimes = 3;  // a step far away is exact to double only
    auto quick = QuickReduction::of(moves);
    if (!quick || !quick->run()) return;
    moves = quick->basis();
    for (int k = 0; k < kTimes; ++k) {
      Vector away(std::ssize(point_));
      for (size_t i = 0; i < point_.size(); ++i)
        away(static_cast<Eigen::Index>(i)) = nearest_double(near_[i] - Rational(point_[i]));
      const std::vector<double> steps = quick->steps_towards(std::move(away));
      for (size_t j = 0; j < steps.size(); ++j) {
        if (steps[j] == 0) continue;
        const Integer step(steps[j]);
        for (size_t i = 0; i < point_.size(); ++i)
          if (moves[j][i] != 0) point_[i] += step * moves[j][i];
      }
    }
  }

  /// Of a group's lattice a short basis in which one vector alone changes a x: that one is left,
  /// the others are moves again.
  void keep_one(std::vector<Move>& group, std::vector<IntegerVector>& kept) {
    check_stop();
    Integer largest = 1;
    Integer longest = 1;
    for (const Move& move : group) {
      largest = std::max(largest, Integer(abs(move.change)));
      longest = std::max(longest, move.square);
    }
    // Two vectors of the group make one that keeps a x and is at most so long; a reduced basis is
    // longer than these by less than 2^size.
    const auto bits = static_cast<unsigned>(group.size() + msb(largest) + msb(longest) / 2 + 4);
    const Integer K = Integer(1) << bits;
    std::vector<IntegerVector> basis;
    for (Move& move : group) {
      basis.push_back(std::move(move.vector));
      basis.back().push_back(K * move.change);
    }
    basis = reduced_basis(std::move(basis));
    group.clear();
    for (IntegerVector& vector : basis) {
      const Integer change = vector.back() / K;
      vector.pop_back();
      if (change == 0) {
        kept.push_back(std::move(vector));
        continue;
      }
      const Integer square = dot(vector, vector);
      group.push_back({std::move(vector), change, square});
    }
  }

  const std::vector<Rational>& near_;
  IntegerVector point_;
  std::vector<IntegerVector> moves_;
};

}  // namespace

std::vector<IntegerVector> reduced_basis(std::vector<IntegerVector> basis) {
  return Reduction(std::move(basis)).run();
}

std::optional<IntegerVector> whole_solution(const RationalMatrix& A, const RationalMatrix& b,
                                            const std::vector<Rational>& near) {
  WholeSolutions solutions(near);
  for (Eigen::Index row = 0; row < A.rows(); ++row) {
    const auto equation = whole_equation(A, b(row), row);
    if (!equation || !solutions.impose(*equation)) return std::nullopt;
  }
  return solutions.point();
}

}  // namespace gainsmith::numerics
