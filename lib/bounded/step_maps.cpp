#include "bounded/step_maps.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

#include "bounded/small_size.h"

namespace gainsmith::bounded {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::times;
using Wide = numbers::MatrixOf<Decimal100>;
constexpr double wide_unit = unit_roundoff<Decimal100>();

template <class Scalar>
numbers::MatrixOf<Scalar> rounded_to(const Wide& matrix) {
  return matrix.unaryExpr([](const Decimal100& value) { return as<Scalar>(value); });
}

/// |matrix| from above.
Matrix upper_sizes(const Wide& matrix) {
  return sizes_of(rounded_to<double>(matrix)) * kBoundSlack;
}

/// sum_k of terms that `next(term, k)` makes one of the other, to 100 digits.
template <class Next>
Wide series(Wide term, Next next) {
  Wide sum = term;
  for (int k = 1; k <= degree::wide_exponential; ++k) {
    term = next(term, k);
    sum += term;
  }
  return sum;
}

/// R_0 of expm(step) by `series`: the rounding of its terms, and those that it leaves out.
Matrix series_errors(const Wide& step) {
  const Matrix sizes = upper_sizes(step);
  Matrix term = Matrix::Identity(step.rows(), step.cols());
  Matrix sum = term;
  for (int k = 1; k <= degree::wide_exponential; ++k) {
    term = times<double>(term, sizes) / k;
    sum += term;
  }
  const double left_out = term.size() == 0 ? 0 : 2 * term.maxCoeff();
  const double unit = wide_unit * static_cast<double>(step.rows() + 1) * kBoundSlack;
  return sum.unaryExpr([=](double size) { return size > 0 ? unit * size + left_out : 0; });
}

/// R_(k+1) of X_k and R_k.
Matrix squared_errors(const Matrix& sizes, const Matrix& errors) {
  const double unit = wide_unit * static_cast<double>(sizes.rows() + 1);
  return kBoundSlack * (times<double>(sizes, errors) + times<double>(errors, sizes) +
                        times<double>(errors, errors) + unit * times<double>(sizes, sizes));
}

/// The tails of a series whose terms are at most `term` and what `next` makes of it, k = 1, 2, ...
/// The terms fall at least like those of an exponential of 1/2. So what is left after them all is
/// below the last one, at elements that any term reaches.
template <class Next>
std::vector<Matrix> tails_of(Matrix term, std::size_t most, Next next) {
  const std::size_t all = most + static_cast<std::size_t>(term.rows()) + 20;
  std::vector<Matrix> terms;
  for (std::size_t k = 1; k <= all; ++k) {
    terms.push_back(term * kBoundSlack);
    term = next(term, static_cast<double>(k + 1));
  }
  Matrix reached = Matrix::Zero(term.rows(), term.cols());
  for (const Matrix& one : terms) reached = reached.cwiseMax(one);
  const double last = terms.back().size() == 0 ? 0 : terms.back().maxCoeff();
  Matrix sum = reached.unaryExpr([&](double size) { return size > 0 ? 2 * last : 0; });
  std::vector<Matrix> tails(most + 1);
  for (std::size_t k = all; k-- > 0;) {
    sum += terms[k];
    if (k <= most) tails[k] = sum;
  }
  return tails;
}

/// The series of the flow, and of the forms' integrals over it, for lengths up to `shortest`.
void add_rests(const Wide& G, double shortest, const std::vector<Wide>& forms, ExactSteps& exact) {
  int exponent = 0;
  std::frexp(shortest, &exponent);
  const Decimal100 unit(std::ldexp(1.0, exponent));
  const Wide step = G * unit;
  const Matrix sizes = sizes_of(rounded_to<double>(step));
  const Index n = G.rows() - 1;
  exact.rest.exponent = exponent;
  Wide power = step;
  for (int k = 1; k <= degree::wide_rest; ++k) {
    exact.rest.powers.emplace_back(power.topRows(n));
    power = times<Decimal100>(power, step) / Decimal100(k + 1);
  }
  exact.rest.tails = tails_of(sizes, degree::wide_rest, [&](const Matrix& term, double k) {
    return Matrix(times<double>(term, sizes) / k);
  });
  for (Matrix& tail : exact.rest.tails) tail = tail.topRows(n).eval();
  for (const Wide& Q : forms) {
    ExactSeries series;
    series.exponent = exponent;
    Wide form = Q * unit;
    for (int k = 1; k <= degree::wide_rest; ++k) {
      series.powers.push_back(form);
      form = Wide(times<Decimal100>(step.transpose(), form) + times<Decimal100>(form, step)) /
             Decimal100(k + 1);
    }
    series.tails = tails_of(
        sizes_of(rounded_to<double>(series.powers.front())), degree::wide_rest,
        [&](const Matrix& term, double k) {
          return Matrix((times<double>(sizes.transpose(), term) + times<double>(term, sizes)) / k);
        });
    exact.rest_integrals.push_back(std::move(series));
  }
}

/// value_of for x of N rows; 0: of any number.
template <class Scalar, int N>
Bounded<Scalar> value_of_form(const Form<Scalar>& form, Index size, const Scalar* x,
                              const double* r) {
  constexpr int rows_and_one = N > 0 ? N + 1 : Eigen::Dynamic;
  const Index n = N > 0 ? N : size;
  Eigen::Matrix<Scalar, rows_and_one, 1> sum(n + 1);
  Eigen::Matrix<double, rows_and_one, 1> absolute(n + 1), spread(n + 1);
  const Scalar* q = form.matrix.data() + n * (n + 1);
  const double* s = form.sizes.data() + n * (n + 1);
  for (Index i = 0; i <= n; ++i) {
    sum(i) = q[i];
    absolute(i) = s[i];
    spread(i) = 0;
  }
  q = form.matrix.data();
  s = form.sizes.data();
  for (Index k = 0; k < n; ++k, q += n + 1, s += n + 1) {
    const double b = size_of(x[k]);
    for (Index i = 0; i <= n; ++i) {
      sum(i) += q[i] * x[k];
      absolute(i) += s[i] * b;
      spread(i) += s[i] * r[k];
    }
  }
  const double unit = unit_roundoff<Scalar>();
  const double rows = (static_cast<double>(n) + 3) * unit;
  Bounded<Scalar> result{sum(n), 0};
  double sizes = absolute(n);
  for (Index i = 0; i < n; ++i) {
    result.value += x[i] * sum(i);
    sizes += size_of(x[i]) * absolute(i);
    // Symmetric: the change of the form is 2 (Q x)' dx + dx' Q dx.
    result.bound += r[i] * (2 * (size_of(sum(i)) + rows * absolute(i)) + spread(i));
  }
  result.bound += (2 * static_cast<double>(n) + 8) * unit * sizes;
  return result;
}

}  // namespace

template <class Scalar>
BoundedMap<Scalar> bounded_map(const Wide& linear, const Wide& constant, const Matrix& errors) {
  const Index n = linear.rows();
  BoundedMap<Scalar> map;
  map.linear = rounded_to<Scalar>(linear);
  map.constant = rounded_to<Scalar>(constant).col(0);
  map.rounded = rounded_to<double>(linear);
  map.sizes = sizes_of(map.rounded);
  map.constant_sizes = sizes_of(rounded_to<double>(constant)).col(0);
  map.errors = errors;
  map.gamma.resize(n);
  for (Index i = 0; i < n; ++i) {
    Wide row = linear.row(i);
    row(i) = row(i) - Decimal100(1);
    const bool unchanged = row.isZero(0) && constant(i) == Decimal100(0);
    map.unchanged.push_back(unchanged);
    map.gamma(i) = unchanged ? 0 : (static_cast<double>(n) + 5) * unit_roundoff<Scalar>();
    for (Index k = 0; k <= n; ++k)
      if (const double size = k < n ? map.sizes(i, k) : map.constant_sizes(i);
          !(errors(i, k) <= unit_roundoff<Scalar>() * size))
        map.coarse = true;
  }
  return map;
}

template <class Scalar>
Form<Scalar> form_of(const Wide& Q) {
  return {rounded_to<Scalar>(Q), sizes_of(rounded_to<double>(Q))};
}

template <class Scalar>
void Series<Scalar>::sum(double sigma, numbers::MatrixOf<Scalar>& out) const {
  const Index size = powers.front().size();
  out = powers.back();
  for (std::size_t k = powers.size(); k-- > 0;) {
    Scalar* const value = out.data();
    if (k == 0) {
      for (Index e = 0; e < size; ++e) value[e] = value[e] * sigma;
    } else {
      const Scalar* const more = powers[k - 1].data();
      for (Index e = 0; e < size; ++e) value[e] = value[e] * sigma + more[e];
    }
  }
}

template <class Scalar>
Series<Scalar> series_of(const ExactSeries& exact) {
  // Enough terms that the others are no more than rounding.
  std::size_t terms = 1;
  while (exact.tails[0].size() > 0 && terms + 1 < exact.tails.size() &&
         exact.tails[terms].maxCoeff() > 1e-3 * unit_roundoff<Scalar>() * exact.tails[0].maxCoeff())
    ++terms;
  Series<Scalar> series;
  series.exponent = exact.exponent;
  const Index n = std::max(exact.powers.front().rows(), exact.powers.front().cols());
  Matrix sizes = Matrix::Zero(exact.powers.front().rows(), exact.powers.front().cols());
  for (std::size_t k = 0; k < terms; ++k) {
    series.powers.push_back(rounded_to<Scalar>(exact.powers[k]));
    sizes += sizes_of(rounded_to<double>(exact.powers[k]));
  }
  // 2 K of Horner's rule, 1 of the rounding of P_k, n + 4 of the product with a column.
  const double roundings = 2 * static_cast<double>(terms) + static_cast<double>(n) + 6;
  series.errors = roundings * unit_roundoff<Scalar>() * sizes + exact.tails[terms];
  series.errors_in_double = roundings * unit_roundoff<double>() * sizes + exact.tails[terms];
  for (Index i = 0; i < sizes.rows(); ++i) series.moves.push_back(!series.errors.row(i).isZero(0));
  return series;
}

template <class Scalar>
Bounded<Scalar> value_of(const Form<Scalar>& form, const Eigen::Ref<const ColumnOf<Scalar>>& x,
                         const Eigen::Ref<const Eigen::VectorXd>& r) {
  Bounded<Scalar> result;
  with_size(x.rows(), [&](auto N) {
    result = value_of_form<Scalar, decltype(N)::value>(form, x.rows(), x.data(), r.data());
  });
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
  exact.maps.push_back(series(I, [&](const Wide& term, int k) {
    return Wide(times<Decimal100>(term, G) * (length / Decimal100(k)));
  }));
  exact.errors.push_back(series_errors(G * length));
  for (const Wide& Q : forms)
    exact.integrals.push_back({series(Wide(Q * length), [&](const Wide& term, int k) {
      return Wide(Wide(times<Decimal100>(G.transpose(), term) + times<Decimal100>(term, G)) *
                  (length / Decimal100(k + 1)));
    })});
  for (int level = 1; level < steps.levels(); ++level) {
    const Wide X = exact.maps.back();
    exact.errors.push_back(squared_errors(upper_sizes(X), exact.errors.back()));
    exact.maps.push_back(times<Decimal100>(X, X));
    for (auto& integral : exact.integrals) {
      const Wide W = integral.back();
      integral.push_back(W + times<Decimal100>(times<Decimal100>(X.transpose(), W), X));
    }
  }
  add_rests(G, steps.shortest(), forms, exact);
  return exact;
}

template <class Scalar>
StepMaps<Scalar>::StepMaps(const ExactSteps& exact) : rest(series_of<Scalar>(exact.rest)) {
  const Index n = exact.maps.front().rows() - 1;
  for (std::size_t k = 0; k < exact.maps.size(); ++k)
    maps.push_back(bounded_map<Scalar>(exact.maps[k].topLeftCorner(n, n),
                                       exact.maps[k].topRightCorner(n, 1),
                                       exact.errors[k].topRows(n)));
  for (const auto& integral : exact.integrals) {
    integrals.emplace_back();
    for (const Wide& W : integral) integrals.back().push_back(form_of<Scalar>(W));
  }
  for (const ExactSeries& integral : exact.rest_integrals)
    rest_integrals.push_back(series_of<Scalar>(integral));
}

#define GAINSMITH_STEP_MAPS(Scalar)                                                         \
  template BoundedMap<Scalar> bounded_map<Scalar>(const Wide&, const Wide&, const Matrix&); \
  template Form<Scalar> form_of<Scalar>(const Wide&);                                       \
  template Series<Scalar> series_of<Scalar>(const ExactSeries&);                            \
  template struct Series<Scalar>;                                                           \
  template Bounded<Scalar> value_of<Scalar>(const Form<Scalar>&,                            \
                                            const Eigen::Ref<const ColumnOf<Scalar>>&,      \
                                            const Eigen::Ref<const Eigen::VectorXd>&);      \
  template struct StepMaps<Scalar>;
GAINSMITH_STEP_MAPS(double)
GAINSMITH_STEP_MAPS(DoubleDouble)
#undef GAINSMITH_STEP_MAPS

}  // namespace gainsmith::bounded
