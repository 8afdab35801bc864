#include "hybrid/step_maps.h"

#include <algorithm>

namespace gainsmith::hybrid {

namespace {

using Eigen::Index;
using numbers::Matrix;
using Wide = numbers::MatrixOf<Decimal100>;

constexpr double kWideUnit = 1e-98;
constexpr int kMostTerms = 400;

template <class Scalar>
numbers::MatrixOf<Scalar> rounded_to(const Wide& matrix) {
  return matrix.unaryExpr([](const Decimal100& value) { return as<Scalar>(value); });
}

double row_norm(const Wide& matrix) {
  if (matrix.size() == 0) return 0;
  return sizes_of(rounded_to<double>(matrix)).rowwise().sum().maxCoeff() * kBoundSlack;
}

/// sum_k of terms that `next(term, k)` makes one of the other, to 100 digits.
template <class Next>
Wide series(Wide term, Next next) {
  Wide sum = term;
  const Decimal100 least = Decimal100(kWideUnit) * Decimal100(1e-4);
  for (int k = 1; k <= kMostTerms; ++k) {
    term = next(term, k);
    sum += term;
    if (largest_of(term) <= least * largest_of(sum)) break;
  }
  return sum;
}

}  // namespace

template <class Scalar>
BoundedMap<Scalar> bounded_map(const Wide& linear, const Wide& constant, double error) {
  BoundedMap<Scalar> map;
  map.linear = rounded_to<Scalar>(linear);
  map.constant = rounded_to<Scalar>(constant).col(0);
  map.rounded = rounded_to<double>(linear);
  map.sizes = sizes_of(map.rounded);
  map.constant_sizes = sizes_of(rounded_to<double>(constant)).col(0);
  map.error = error;
  for (Index i = 0; i < linear.rows(); ++i) {
    Wide row = linear.row(i);
    row(i) = row(i) - Decimal100(1);
    map.unchanged.push_back(row.isZero(0) && constant(i) == Decimal100(0));
  }
  return map;
}

template <class Scalar>
Form<Scalar> form_of(const Wide& Q) {
  return {rounded_to<Scalar>(Q), rounded_to<double>(Q), sizes_of(rounded_to<double>(Q))};
}

template <class Scalar>
Bounded<Scalar> value_of(const Form<Scalar>& form, const Eigen::Ref<const ColumnOf<Scalar>>& x,
                         const Eigen::Ref<const Eigen::VectorXd>& r) {
  const Index n = x.rows();
  Bounded<Scalar> result;
  double sizes = 0;
  double change = 0;
  for (Index i = 0; i <= n; ++i) {
    const Scalar a = i < n ? x(i) : Scalar(1);
    const double ra = i < n ? r(i) : 0;
    Scalar sum(0);
    double absolute = 0;
    double spread = 0;
    for (Index k = 0; k <= n; ++k) {
      const Scalar b = k < n ? x(k) : Scalar(1);
      sum += form.matrix(i, k) * b;
      absolute += form.sizes(i, k) * size_of(b);
      if (k < n) spread += form.sizes(i, k) * r(k);
    }
    result.value += a * sum;
    sizes += size_of(a) * absolute;
    // Symmetric: the change of the form is 2 (Q x)' dx + dx' Q dx.
    const double rounding = (static_cast<double>(n) + 3) * unit_roundoff<Scalar>() * absolute;
    change += ra * (2 * (size_of(sum) + rounding) + spread);
  }
  result.bound = change + (2 * static_cast<double>(n) + 8) * unit_roundoff<Scalar>() * sizes;
  return result;
}

ExactSteps exact_steps(const Coordinates& coordinates, const FlowSteps& steps,
                       const std::vector<Wide>& forms) {
  const Index n = coordinates.layout.size;
  Wide G = Wide::Zero(n + 1, n + 1);
  G.topLeftCorner(n, n) = coordinates.linear;
  G.topRightCorner(n, 1) = coordinates.constant;
  const Decimal100 length(steps.shortest());
  const Wide I = Wide::Identity(n + 1, n + 1);
  ExactSteps exact;
  exact.maps.push_back(series(
      I, [&](const Wide& term, int k) { return Wide(term * G * (length / Decimal100(k))); }));
  const double unit = kWideUnit * static_cast<double>(n + 2);
  exact.errors.push_back(unit * std::exp(std::min(row_norm(G) * steps.shortest(), 100.0)));
  for (const Wide& Q : forms)
    exact.integrals.push_back({series(Wide(Q * length), [&](const Wide& term, int k) {
      return Wide((G.transpose() * term + term * G) * (length / Decimal100(k + 1)));
    })});
  for (int level = 1; level < steps.levels(); ++level) {
    const Wide X = exact.maps.back();
    const double size = row_norm(X);
    const double e = exact.errors.back();
    exact.errors.push_back(2 * size * e + e * e + unit * size * size);
    exact.maps.push_back(X * X);
    for (auto& integral : exact.integrals) {
      const Wide W = integral.back();
      integral.push_back(W + X.transpose() * W * X);
    }
  }
  return exact;
}

template <class Scalar>
StepMaps<Scalar>::StepMaps(const Coordinates& coordinates, const ExactSteps& exact,
                           const std::vector<Wide>& wide_forms) {
  const Index n = coordinates.layout.size;
  for (std::size_t k = 0; k < exact.maps.size(); ++k)
    maps.push_back(bounded_map<Scalar>(exact.maps[k].topLeftCorner(n, n),
                                       exact.maps[k].topRightCorner(n, 1), exact.errors[k]));
  linear = rounded_to<Scalar>(coordinates.linear);
  constant = rounded_to<Scalar>(coordinates.constant).col(0);
  rounded = rounded_to<double>(coordinates.linear);
  sizes = sizes_of(rounded);
  constant_sizes = sizes_of(rounded_to<double>(coordinates.constant)).col(0);
  norm = n == 0 ? 0 : sizes.rowwise().sum().maxCoeff();
  for (const Wide& Q : wide_forms) forms.push_back(form_of<Scalar>(Q));
  for (const auto& integral : exact.integrals) {
    integrals.emplace_back();
    for (const Wide& W : integral) integrals.back().push_back(form_of<Scalar>(W));
  }
}

#define GAINSMITH_STEP_MAPS(Scalar)                                                    \
  template BoundedMap<Scalar> bounded_map<Scalar>(const Wide&, const Wide&, double);   \
  template Form<Scalar> form_of<Scalar>(const Wide&);                                  \
  template Bounded<Scalar> value_of<Scalar>(const Form<Scalar>&,                       \
                                            const Eigen::Ref<const ColumnOf<Scalar>>&, \
                                            const Eigen::Ref<const Eigen::VectorXd>&); \
  template struct StepMaps<Scalar>;
GAINSMITH_STEP_MAPS(double)
GAINSMITH_STEP_MAPS(DoubleDouble)
#undef GAINSMITH_STEP_MAPS

}  // namespace gainsmith::hybrid
