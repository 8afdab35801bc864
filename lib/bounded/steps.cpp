#include "bounded/steps.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number.h"
#include "bounded/tolerances.h"
#include "numbers/dense.h"

namespace gainsmith::bounded {

namespace {

// Squaring k times multiplies the rounding error of the first map by 2^k; the wider type pays for
// it.
using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

Extended augmented(const hybrid::AffineMap& flow) {
  const Eigen::Index n = flow.linear.rows();
  Extended generator = Extended::Zero(n + 1, n + 1);
  generator.topLeftCorner(n, n) = flow.linear.cast<long double>();
  generator.topRightCorner(n, 1) = flow.constant.cast<long double>();
  return generator;
}

/// expm(length * generator) for a linear part of norm at most 1/4; 20 terms leave less than 1e-31.
Extended short_exponential(const Extended& generator, long double length) {
  Extended term = Extended::Identity(generator.rows(), generator.cols());
  Extended sum = term;
  for (int k = 1; k <= degree::short_exponential; ++k) {
    term = (term.lazyProduct(generator) * (length / k)).eval();
    sum += term;
  }
  return sum;
}

/// How fast the flow may swing or grow, per unit of time.
double fastest_rate(const numbers::Matrix& matrix) {
  double rate = 0;
  for (const auto& lambda : numbers::eigenvalues(matrix))
    rate = std::max({rate, std::abs(lambda.imag()), lambda.real()});
  return rate;
}

double one_norm(const numbers::Matrix& matrix) {
  return matrix.cwiseAbs().colwise().sum().maxCoeff();
}

}  // namespace

FlowSteps::FlowSteps(const hybrid::AffineMap& flow, double longest, const Place& place)
    : flow_(flow) {
  const Eigen::Index n = flow.linear.rows();
  const double norm = n > 0 ? one_norm(flow.linear) : 0;
  if (!std::isfinite(norm) || !flow.constant.allFinite() ||
      !(norm * longest <= std::ldexp(1, kMostLevels)))
    throw InputError(place, "the flow is too fast to be stepped: norm of its matrix " +
                                brief(norm) + ", longest interval " + brief(longest));
  const double rate = n > 0 ? fastest_rate(flow.linear) : 0;
  const double top = std::min(std::ldexp(longest, -kFewestLevels), rate > 0 ? 1 / rate : longest);
  int last = kFewestLevels;
  while (norm * std::ldexp(top, -last) > degree::norm) ++last;
  shortest_ = std::ldexp(top, -last);

  Extended map = short_exponential(augmented(flow), shortest_);
  for (int level = 0; level <= last; ++level) {
    const numbers::Matrix rounded = map.cast<double>();
    maps_.push_back({rounded.topLeftCorner(n, n), rounded.topRightCorner(n, 1)});
    map = map.lazyProduct(map).eval();
  }
}

void FlowSteps::cut(double interval, std::vector<FlowStep>& steps) const {
  double units = std::floor(interval / shortest_);  // of s_0; whole numbers below 2^53
  double rest = std::fma(-units, shortest_, interval);
  if (rest < 0) {
    units -= 1;
    rest += shortest_;
  }
  const int top = levels() - 1;
  const auto take = [&](int level) {
    steps.push_back({level, std::ldexp(shortest_, level)});
    units -= std::ldexp(1, level);
  };
  const auto fits = [&](int level) { return units >= std::ldexp(1, level); };
  for (int level = 0; level < top && fits(level); ++level) take(level);
  while (fits(top)) take(top);
  for (int level = top - 1; level >= 0; --level)
    while (fits(level)) take(level);
  if (rest > 0) steps.push_back({FlowStep::kRest, rest});
}

numbers::Matrix FlowSteps::taylor_terms(double length,
                                        const Eigen::Ref<const Eigen::VectorXd>& x) const {
  numbers::Matrix terms(x.size(), degree::rest + 1);
  terms.col(0) = x;
  for (int k = 1; k <= degree::rest; ++k) {
    terms.col(k).noalias() = flow_.linear.lazyProduct(terms.col(k - 1));
    if (k == 1) terms.col(k) += flow_.constant;
    terms.col(k) *= length / k;
  }
  return terms;
}

void FlowSteps::advance(const FlowStep& step, const Eigen::Ref<const Eigen::VectorXd>& x,
                        Eigen::Ref<Eigen::VectorXd> out) const {
  if (step.level == FlowStep::kRest) {
    out = taylor_terms(step.length, x).rowwise().sum();
    return;
  }
  const hybrid::AffineMap& map = maps_[static_cast<std::size_t>(step.level)];
  out = map.constant;
  out.noalias() += map.linear.lazyProduct(x);
}

}  // namespace gainsmith::bounded
