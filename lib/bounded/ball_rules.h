// Internal to bounded: the operations of balls.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "bounded/ball_parts.h"
#include "numbers/enclosure.h"

namespace gainsmith::bounded::rules {

using Eigen::Index;
using expr::Is;
using expr::Op;
using numbers::Matrix;
using numbers::MatrixOf;

template <class Scalar>
struct BallRules {
  using Value = Ball<Scalar>;
  using At = expr::Step<Value>;
  static constexpr double unit = unit_roundoff<Scalar>();
  /// Of the rounding of singular values, times the number of elements and unit.
  static constexpr double kFactorOfSvd = 100;

  /// out(e) = f(e) with the radius r(e), element by element.
  template <class F, class R>
  static void each(const At& at, Value& out, F f, R r) {
    shape_like(at.instruction, out);
    for (Index e = 0; e < out.mid.size(); ++e) {
      out.mid(e) = f(e);
      out.rad(e) = r(e);
    }
  }
  /// The same operation on middles and radii: what rounds nothing.
  template <class F>
  static void move(const At& at, Value& out, F f) {
    shape_like(at.instruction, out);
    out.mid = f(at[0].mid);
    out.rad = f(at[0].rad);
  }

  void operator()(Is<Op::constant>, const At& at, Value& out) const {
    const std::string& text = at.instruction.text;
    const auto value =
        text == "pi" ? std::optional(gainsmith::pi<Decimal100>()) : parse_as<Decimal100>(text);
    if (!value) expr::fault::beyond_range(at.instruction);
    out = ball_of<Scalar>(MatrixOf<Decimal100>::Constant(1, 1, *value));
  }
  void operator()(Is<Op::zeros>, const At& at, Value& out) const {
    shape_like(at.instruction, out);
    out.mid.setConstant(Scalar(0));
    out.rad.setZero();
  }
  void operator()(Is<Op::fill>, const At& at, Value& out) const {
    each(
        at, out, [&](Index) { return at[0].mid(0); }, [&](Index) { return at[0].rad(0); });
  }
  void operator()(Is<Op::identity>, const At& at, Value& out) const {
    const Index step = at.shape().rows + 1;
    each(
        at, out, [&](Index e) { return e % step == 0 ? at[0].mid(0) : Scalar(0); },
        [&](Index e) { return e % step == 0 ? at[0].rad(0) : 0; });
  }
  static void sum(const At& at, Value& out, bool minus) {
    shape_like(at.instruction, out);
    for (Index e = 0; e < out.mid.size(); ++e) {
      const Scalar& a = at[0].mid(e);
      const Scalar& b = at[1].mid(e);
      out.mid(e) = minus ? a - b : a + b;
      const bool exact = a == Scalar(0) || b == Scalar(0);
      out.rad(e) = at[0].rad(e) + at[1].rad(e) + (exact ? 0 : unit * size_of(out.mid(e)));
    }
  }
  void operator()(Is<Op::add>, const At& at, Value& out) const { sum(at, out, false); }
  void operator()(Is<Op::subtract>, const At& at, Value& out) const { sum(at, out, true); }
  void operator()(Is<Op::negate>, const At& at, Value& out) const {
    out.mid = -at[0].mid;
    out.rad = at[0].rad;
  }
  void operator()(Is<Op::multiply>, const At& at, Value& out) const { multiply(at[0], at[1], out); }
  void operator()(Is<Op::scale>, const At& at, Value& out) const {
    const Scalar& s = at[0].mid(0);
    const double size = size_of(s);
    const double rad = at[0].rad(0);
    each(
        at, out, [&](Index e) { return s * at[1].mid(e); },
        [&](Index e) {
          const double y = size_of(at[1].mid(e));
          return size * at[1].rad(e) + rad * (y + at[1].rad(e)) + unit * size * y;
        });
  }
  void operator()(Is<Op::divide>, const At& at, Value& out) const {
    const Scalar& by = at[1].mid(0);
    const double rad = at[1].rad(0);
    if (by == Scalar(0) && rad == 0) expr::fault::division_by_zero();
    const double least = size_of(by) * (1 - 4 * unit) - rad;
    each(
        at, out, [&](Index e) { return by == Scalar(0) ? Scalar(0) : at[0].mid(e) / by; },
        [&](Index e) {
          if (!(least > 0)) return no_bound();
          const double quotient = size_of(at[0].mid(e)) / size_of(by);
          return (quotient * rad + at[0].rad(e)) / least + 2 * unit * quotient;
        });
  }
  void operator()(Is<Op::power>, const At& at, Value& out) const {
    Value square = at[0];
    const Index n = square.mid.rows();
    Value result{MatrixOf<Scalar>::Identity(n, n), Matrix::Zero(n, n)};
    bool first = true;
    for (int exponent = at.attribute(0); exponent > 0; exponent /= 2) {
      Value next;
      if (exponent % 2 == 1) {
        if (first) {
          result = square;
        } else {
          multiply(Value(result), square, next);
          result = next;
        }
        first = false;
      }
      if (exponent > 1) {
        multiply(Value(square), Value(square), next);
        square = next;
      }
    }
    out = result;
  }
  void operator()(Is<Op::elementwise_product>, const At& at, Value& out) const {
    each(
        at, out, [&](Index e) { return at[0].mid(e) * at[1].mid(e); },
        [&](Index e) {
          const double x = size_of(at[0].mid(e));
          const double y = size_of(at[1].mid(e));
          return x * at[1].rad(e) + at[0].rad(e) * (y + at[1].rad(e)) + unit * x * y;
        });
  }
  void operator()(Is<Op::real_power>, const At& at, Value& out) const {
    using std::pow;
    shape_like(at.instruction, out);
    for (Index e = 0; e < out.mid.size(); ++e) {
      const Scalar& x = at[0].mid(e);
      const Scalar& y = at[1].mid(e);
      const double rx = at[0].rad(e);
      const double ry = at[1].rad(e);
      const auto value = [&](double dx, double dy) { return pow(x + Scalar(dx), y + Scalar(dy)); };
      out.mid(e) = value(0, 0);
      double rad = kFunctionRounding * unit * size_of(out.mid(e));
      if (rx > 0 || ry > 0) {
        // Monotone in each argument where the base is positive: the corners are the extremes.
        const bool positive = x - Scalar(rx) > Scalar(0);
        for (const double dx : {-rx, rx})
          for (const double dy : {-ry, ry})
            if (positive) {
              const Scalar corner = value(dx, dy);
              rad = std::max(rad, size_of(corner - out.mid(e)) +
                                      2 * kFunctionRounding * unit * size_of(corner));
            }
        if (!positive) rad = no_bound();
      }
      out.rad(e) = rad;
    }
  }
  /// By the number type with directed rounding.
  template <Op op>
  requires expr::OneOf<op, Op::elementwise_quotient, Op::elementwise_power, Op::floor, Op::mod,
                       Op::atan2, Op::complement_basis, Op::jacobian>
  void operator()(Is<op>, const At& at, Value& out) const {
    std::vector<numbers::Enclosed<Scalar>> operands;
    std::vector<const numbers::Enclosed<Scalar>*> pointers;
    for (const Value* operand : at.operands)
      operands.push_back({operand->mid, operand->rad * kBoundSlack});
    for (const auto& operand : operands) pointers.push_back(&operand);
    numbers::Enclosed<Scalar> result;
    numbers::Enclosure<Scalar>{}.apply(at.instruction, pointers, result);
    out = {std::move(result.mid), std::move(result.rad)};
  }
  void operator()(Is<Op::transpose>, const At& at, Value& out) const {
    move(at, out, [](const auto& m) { return m.transpose(); });
  }
  void operator()(Is<Op::blocks>, const At& at, Value& out) const {
    shape_like(at.instruction, out);
    const auto columns = static_cast<std::size_t>(at.attribute(0));
    Index row = 0;
    for (std::size_t first = 0; first < at.operands.size(); first += columns) {
      Index column = 0;
      for (std::size_t j = first; j < first + columns; ++j) {
        const Value& part = at[j];
        out.mid.block(row, column, part.mid.rows(), part.mid.cols()) = part.mid;
        out.rad.block(row, column, part.mid.rows(), part.mid.cols()) = part.rad;
        column += part.mid.cols();
      }
      row += at[first].mid.rows();
    }
  }
  void operator()(Is<Op::index>, const At& at, Value& out) const {
    move(at, out, [&](const auto& m) {
      return m.block(at.attribute(0), at.attribute(2), at.attribute(1) - at.attribute(0),
                     at.attribute(3) - at.attribute(2));
    });
  }
  void operator()(Is<Op::exp>, const At& at, Value& out) const {
    using std::exp;
    each(
        at, out, [&](Index e) { return exp(at[0].mid(e)); },
        [&](Index e) {
          const double size = size_of(out.mid(e));
          const bool one = at[0].mid(e) == Scalar(0);
          return size * std::expm1(at[0].rad(e)) + (one ? 0 : kFunctionRounding * unit * size);
        });
  }
  void operator()(Is<Op::log>, const At& at, Value& out) const {
    using std::log;
    for (Index e = 0; e < at[0].mid.size(); ++e)
      if (!(at[0].mid(e) + Scalar(at[0].rad(e)) > Scalar(0)))
        expr::fault::outside_domain(Op::log, static_cast<double>(at[0].mid(e)));
    each(
        at, out, [&](Index e) { return log(at[0].mid(e)); },
        [&](Index e) {
          const double ratio = at[0].rad(e) / size_of(at[0].mid(e));
          if (!(ratio < 1)) return no_bound();
          return -std::log1p(-ratio) + kFunctionRounding * unit * size_of(out.mid(e));
        });
  }
  void operator()(Is<Op::sqrt>, const At& at, Value& out) const {
    using std::sqrt;
    const auto low = [&](Index e) { return at[0].mid(e) - Scalar(at[0].rad(e)); };
    for (Index e = 0; e < at[0].mid.size(); ++e)
      if (at[0].mid(e) + Scalar(at[0].rad(e)) < Scalar(0))
        expr::fault::outside_domain(Op::sqrt, static_cast<double>(at[0].mid(e)));
    const auto positive = [](const Scalar& x) { return x > Scalar(0) ? x : Scalar(0); };
    each(
        at, out, [&](Index e) { return Scalar(sqrt(positive(at[0].mid(e)))); },
        [&](Index e) {
          const double root = size_of(out.mid(e));
          const double least = std::sqrt(size_of(positive(low(e))));
          const double top = size_of(at[0].mid(e)) + at[0].rad(e);
          const double change = root + least > 0 ? at[0].rad(e) / (root + least) : std::sqrt(top);
          return std::min(change, std::sqrt(top)) + 2 * unit * root;
        });
  }
  template <Op op>
  requires expr::OneOf<op, Op::sin, Op::cos, Op::tanh>
  void operator()(Is<op>, const At& at, Value& out) const {
    using std::cos;
    using std::sin;
    using std::tanh;
    each(
        at, out,
        [&](Index e) -> Scalar {
          if (op == Op::sin) return sin(at[0].mid(e));
          return op == Op::cos ? cos(at[0].mid(e)) : tanh(at[0].mid(e));
        },
        [&](Index e) {
          return std::min(at[0].rad(e), 2.0) + kFunctionRounding * unit * size_of(out.mid(e));
        });
  }
  void operator()(Is<Op::abs>, const At& at, Value& out) const {
    each(
        at, out,
        [&](Index e) { return at[0].mid(e) < Scalar(0) ? Scalar(-at[0].mid(e)) : at[0].mid(e); },
        [&](Index e) { return at[0].rad(e); });
  }
  void operator()(Is<Op::sign>, const At& at, Value& out) const {
    const auto open = [&](Index e) {
      return at[0].rad(e) > 0 && size_of(at[0].mid(e)) <= at[0].rad(e) * kBoundSlack;
    };
    each(
        at, out,
        [&](Index e) {
          if (open(e) || at[0].mid(e) == Scalar(0)) return Scalar(0);
          return at[0].mid(e) > Scalar(0) ? Scalar(1) : Scalar(-1);
        },
        [&](Index e) { return open(e) ? 1.0 : 0.0; });
  }
  template <Op op>
  requires expr::OneOf<op, Op::minimum, Op::maximum>
  void operator()(Is<op>, const At& at, Value& out) const {
    const double sign = op == Op::maximum ? 1 : -1;
    shape_like(at.instruction, out);
    for (Index e = 0; e < out.mid.size(); ++e) {
      const double apart = sign * static_cast<double>(at[0].mid(e) - at[1].mid(e));
      const Value& first = at[apart >= 0 ? 0 : 1];
      const double other = at[apart >= 0 ? 1 : 0].rad(e) - std::abs(apart) * (1 - 4 * unit);
      out.mid(e) = first.mid(e);
      out.rad(e) = std::max(first.rad(e), other);
    }
  }
  void operator()(Is<Op::where>, const At& at, Value& out) const {
    const bool strict = at.attribute(0) != 0;
    shape_like(at.instruction, out);
    for (Index e = 0; e < out.mid.size(); ++e) {
      const Scalar& d = at[0].mid(e);
      const bool holds = strict ? d > Scalar(0) : d >= Scalar(0);
      const Value& chosen = at[holds ? 1 : 2];
      const Value& other = at[holds ? 2 : 1];
      out.mid(e) = chosen.mid(e);
      out.rad(e) = chosen.rad(e);
      if (!(at[0].rad(e) > 0 && size_of(d) <= at[0].rad(e) * kBoundSlack)) continue;
      // Half-way between the two, which reaches over both.
      const Scalar half = (other.mid(e) - chosen.mid(e)) / Scalar(2);
      out.mid(e) = chosen.mid(e) + half;
      out.rad(e) = size_of(half) * (1 + 8 * unit) + unit * size_of(out.mid(e)) +
                   std::max(chosen.rad(e), other.rad(e));
    }
  }
  void operator()(Is<Op::trace>, const At& at, Value& out) const {
    const Index n = at[0].mid.rows();
    out.mid = MatrixOf<Scalar>::Constant(1, 1, at[0].mid.trace());
    const double sizes = sizes_of(at[0].mid.diagonal()).sum();
    out.rad = Matrix::Constant(1, 1, at[0].rad.trace() + static_cast<double>(n) * unit * sizes);
  }
  void operator()(Is<Op::norm>, const At& at, Value& out) const {
    const MatrixOf<Scalar>* operands[] = {&at[0].mid};
    MatrixOf<Scalar> result;
    numbers::Real<Scalar>{}.apply(at.instruction, operands, result);
    out.mid = result;
    const bool vector = at[0].mid.rows() == 1 || at[0].mid.cols() == 1;
    const double rounding =
        (vector ? 1 : kFactorOfSvd) * (static_cast<double>(at[0].mid.size()) + 4);
    out.rad = Matrix::Constant(1, 1, at[0].rad.norm() + rounding * unit * size_of(result(0)));
  }
  void operator()(Is<Op::inverse>, const At& at, Value& out) const {
    const Value& a = at[0];
    const MatrixOf<Scalar>* operands[] = {&a.mid};
    MatrixOf<Scalar> X;
    numbers::Real<Scalar>{}.apply(at.instruction, operands, X);
    const Index n = X.rows();
    const Value inverse{X, Matrix::Zero(n, n)};
    Value product;
    multiply(inverse, a, product);
    const Matrix R =
        sizes_of(product.mid - MatrixOf<Scalar>::Identity(n, n)) * (1 + 4 * unit) + product.rad;
    const double norm = n == 0 ? 0 : R.rowwise().sum().maxCoeff();
    out.rad = Matrix::Constant(n, n, no_bound());
    if (norm < 1) out.rad = R.rowwise().sum() * sizes_of(X).colwise().maxCoeff() / (1 - norm);
    out.mid = X;
  }
  void operator()(Is<Op::matrix_exponential>, const At& at, Value& out) const {
    const Value& a = at[0];
    const Index n = a.mid.rows();
    if (a.mid.isZero(0) && a.rad.isZero(0)) {
      out = {MatrixOf<Scalar>::Identity(n, n), Matrix::Zero(n, n)};
      return;
    }
    exponential_of_middle(at.instruction, a, out);
    const double rad = n == 0 ? 0 : a.rad.colwise().sum().maxCoeff();
    if (rad == 0) return;
    double mu = -no_bound();
    for (Index j = 0; j < n; ++j)
      mu = std::max(mu, static_cast<double>(a.mid(j, j)) + sizes_of(a.mid.col(j)).sum() -
                            size_of(a.mid(j, j)));
    out.rad.array() += rad * std::exp(mu + rad);
  }
  void operator()(Is<Op::diagonal_matrix>, const At& at, Value& out) const {
    const Index n = at.shape().rows;
    out = {MatrixOf<Scalar>::Constant(n, n, Scalar(0)), Matrix::Zero(n, n)};
    for (Index i = 0; i < n; ++i) {
      out.mid(i, i) = at[0].mid(i);
      out.rad(i, i) = at[0].rad(i);
    }
  }
  void operator()(Is<Op::diagonal_of>, const At& at, Value& out) const {
    move(at, out, [](const auto& m) { return m.diagonal(); });
  }
  /// Perfectly conditioned in the 2-norm (Weyl).
  void operator()(Is<Op::singular_values>, const At& at, Value& out) const {
    if constexpr (std::is_same_v<Scalar, double>) {
      const Matrix* operands[] = {&at[0].mid};
      numbers::Real<double>{}.apply(at.instruction, operands, out.mid);
      const double rounding = kFactorOfSvd * (static_cast<double>(at[0].mid.size()) + 4);
      const double largest = out.mid.size() == 0 ? 0 : out.mid.maxCoeff();
      out.rad = Matrix::Constant(out.mid.rows(), out.mid.cols(), rounding * unit * largest);
    } else {
      in_wide_digits(at.instruction, at[0], out);
    }
    out.rad.array() += at[0].rad.norm();
  }
  template <Op op>
  requires expr::OneOf<op, Op::pseudo_inverse, Op::range_basis, Op::kernel_basis, Op::determinant>
  void operator()(Is<op>, const At& at, Value& out) const {
    const MatrixOf<Scalar>* operands[] = {&at[0].mid};
    numbers::Real<Scalar>{}.apply(at.instruction, operands, out.mid);
    out.rad = Matrix::Constant(out.mid.rows(), out.mid.cols(), out.mid.isZero(0) ? 0 : no_bound());
  }
  template <Op op>
  requires expr::OneOf<op, Op::project_polytope, Op::project_ellipsoid, Op::project_affine,
                       Op::project_convex, Op::flow_map, Op::extremum, Op::eigenvalues,
                       Op::continuous_riccati, Op::discrete_riccati>
  void operator()(Is<op>, const At&, Value&) const { expr::fault::no_error_bound(op); }
};

}  // namespace gainsmith::bounded::rules
