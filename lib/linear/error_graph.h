// Operations over lanes on numbers whose errors are bounded: linear maps and quadratic forms with
// polynomials of a length as coefficients (length_table.h).
//
// A number is known as value and radius, |true - value| <= radius. The graph computes both in
// double. Rules of one operation, with u the unit roundoff:
//
//   M v      radius+ = |M| radius + (error of M + (n + 4) u |M|) size + kTiny
//   v'F v    |error| <= A (part A + 2 R),   A = sum w_i size_i,   R = sum w_i radius_i,
//            |F_ij| <= w_i w_j
//
// These are forward error bounds of inner products (Higham, Accuracy and Stability of Numerical
// Algorithms, 2002, chapter 3). The bounds are rounded to nearest and widened by kBoundSlack.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "lanes/machine.h"
#include "linear/flow.h"
#include "linear/length_table.h"
#include "linear/tolerances.h"

namespace gainsmith::linear {

using Nodes = std::vector<int>;

/// More than all that underflows in one result; added to each bound.
inline constexpr double kTiny = 1e-290;
/// Numbers with bounds of their errors: |true - value| <= radius, size >= |value| + radius.
struct Numbers {
  Nodes value, size, radius;
  std::size_t count() const { return value.size(); }
};
/// Nodes of a number and of a bound of its error.
struct Known {
  int value = 0;
  int error = 0;
};

/// Of a symmetric F: |F_ij| over all lengths, and how far what is computed may be from it. Elements
/// beside the diagonal are those of both triangles together.
class Sizes {
 public:
  explicit Sizes(std::size_t count) : size_(count, std::vector<double>(count)), error_(size_) {}

  void set(std::size_t i, std::size_t j, double size, double error) {
    const double share = i == j ? 1 : 0.5;
    size_[i][j] = size_[j][i] = share * size;
    error_[i][j] = error_[j][i] = share * error;
  }
  /// w with |F_ij| <= w_i w_j: near the roots of the diagonal, which are enough where F >= 0.
  std::vector<double> weights() const {
    const std::size_t n = size_.size();
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, size_[i][j]);
    std::vector<double> w(n);
    for (std::size_t i = 0; i < n; ++i) {
      const bool zero =
          std::all_of(size_[i].begin(), size_[i].end(), [](double x) { return x == 0; });
      // An element off the diagonal may exceed the roots where F is indefinite. So w is widened
      // below.
      w[i] = zero ? 0 : std::max(std::sqrt(size_[i][i]), 1e-8 * std::sqrt(largest));
    }
    double excess = 1;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (size_[i][j] > 0) excess = std::max(excess, size_[i][j] / (w[i] * w[j]));
    for (double& one : w) one *= std::sqrt(excess) * kBoundSlack;
    return w;
  }
  /// The errors, as a part of w_i w_j.
  double part(const std::vector<double>& w) const {
    double most = 0;
    for (std::size_t i = 0; i < size_.size(); ++i)
      for (std::size_t j = 0; j < size_.size(); ++j)
        if (error_[i][j] > 0) most = std::max(most, error_[i][j] / (w[i] * w[j]));
    return most;
  }

 private:
  std::vector<std::vector<double>> size_, error_;
};

/// Of M v with M computed, as a part of |M| |v|.
inline double rounding_of_product(std::size_t columns) {
  return (static_cast<double>(columns) + 4) * kUnitRoundoff;
}

/// Nodes of numbers and of bounds of their errors.
class ErrorGraph {
 public:
  /// `constant`: vectors have a last element 1.
  explicit ErrorGraph(bool constant) : constant_(constant) {}

  int input() { return graph_.input(inputs_++); }
  Nodes inputs(std::size_t count) {
    Nodes nodes;
    for (std::size_t k = 0; k < count; ++k) nodes.push_back(input());
    return nodes;
  }
  int constant(double value) { return graph_.constant(value); }
  int add(int a, int b) { return graph_.add(a, b); }
  int subtract(int a, int b) { return graph_.subtract(a, b); }
  int multiply(int a, int b) { return graph_.multiply(a, b); }
  int scaled(double factor, int a) { return multiply(constant(factor), a); }
  int maximum(int a, int b) { return graph_.apply(numbers::ScalarOp::maximum, a, b); }
  int minimum(int a, int b) { return graph_.apply(numbers::ScalarOp::minimum, a, b); }
  int abs(int a) { return graph_.apply(numbers::ScalarOp::abs, a); }
  int root(int a) { return graph_.apply(numbers::ScalarOp::sqrt, a); }
  /// a where it is > 0, otherwise 1.
  int positive(int a) { return graph_.where(true, a, a, constant(1)); }
  int over(int a, int b) { return graph_.divide(a, b); }

  /// Where a polynomial is taken.
  int sigma(const LengthTable& table, int length) {
    return scaled(table.scale, add(length, constant(-table.middle)));
  }
  /// A table in pieces is computed elsewhere: its functions are the next inputs.
  void give(const LengthTable& table) {
    if (table.functions.empty() || !table.functions.front().powers.empty()) return;
    given_ = inputs(table.functions.size());
  }
  /// Horner's scheme in sigma of function k; of a table in pieces the input that holds it.
  int polynomial(const LengthTable& table, std::size_t k, int sigma) {
    const std::vector<double>& powers = table.functions[k].powers;
    if (powers.empty()) return given_[k];
    int sum = constant(powers.back());
    for (std::size_t i = powers.size() - 1; i-- > 0;)
      sum = add(multiply(sum, sigma), constant(powers[i]));
    return sum;
  }

  /// With the constant 1 behind, where there is one.
  Numbers exact(const Nodes& values) {
    Numbers numbers;
    for (const int one : values) push(one, constant(0), numbers);
    append_one(numbers);
    return numbers;
  }
  void push(int value, int radius, Numbers& numbers) {
    numbers.value.push_back(value);
    numbers.radius.push_back(radius);
    numbers.size.push_back(add(abs(value), radius));
  }
  void append_one(Numbers& numbers) {
    if (constant_) push(constant(1), constant(0), numbers);
  }

  /// M v of the functions from `next` on, `rows` times as many as v; what their errors and rounding
  /// add to that of v; and M, |M|.
  struct Product {
    Nodes value, added;
    std::vector<Nodes> M;
    std::vector<std::vector<double>> sizes;
  };
  Product product(const LengthTable& table, std::size_t& next, int sigma, std::size_t rows,
                  const Numbers& v) {
    Product made;
    const double rounding = rounding_of_product(v.count());
    for (std::size_t i = 0; i < rows; ++i) {
      int value = constant(0), added = constant(kTiny);
      made.M.emplace_back();
      made.sizes.emplace_back();
      for (std::size_t j = 0; j < v.count(); ++j, ++next) {
        const LengthTable::Polynomial& function = table.functions[next];
        made.M.back().push_back(polynomial(table, next, sigma));
        made.sizes.back().push_back(function.size * kBoundSlack);
        value = add(multiply(made.M.back().back(), v.value[j]), value);
        added = add(scaled(kBoundSlack * (function.error + rounding * function.size), v.size[j]),
                    added);
      }
      made.value.push_back(value);
      made.added.push_back(added);
    }
    return made;
  }

  /// v'F v with F the functions from `next` on.
  Known form(const LengthTable& table, std::size_t& next, int sigma, const Numbers& v) {
    std::size_t same = next;
    const int error = form_error(table, same, v);
    return {form_value(table, next, sigma, v.value), error};
  }
  /// sum_j v_j sum_(i <= j) f_ij v_i, f_ij with i < j doubled in the table. It takes n (n + 1)/2
  /// functions from `next` on.
  int form_value(const LengthTable& table, std::size_t& next, int sigma, const Nodes& v) {
    int value = constant(0);
    for (std::size_t j = 0; j < v.size(); ++j) {
      int sum = constant(0);
      for (std::size_t i = 0; i <= j; ++i, ++next)
        sum = add(multiply(polynomial(table, next, sigma), v[i]), sum);
      value = add(multiply(sum, v[j]), value);
    }
    return value;
  }
  /// The bound of the error of that value; takes the same functions.
  int form_error(const LengthTable& table, std::size_t& next, const Numbers& v) {
    Sizes sizes(v.count());
    for (std::size_t j = 0; j < v.count(); ++j)
      for (std::size_t i = 0; i <= j; ++i, ++next)
        sizes.set(i, j, table.functions[next].size, table.functions[next].error);
    return error(sizes, v);
  }
  /// v'Q v with a constant Q.
  Known form(const Wide& Q, const Numbers& v) {
    Known made{constant(0), 0};
    Sizes sizes(v.count());
    for (std::size_t j = 0; j < v.count(); ++j) {
      int sum = constant(0);
      for (std::size_t i = 0; i <= j; ++i) {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        const double q = static_cast<double>(Q(row, column)) * (i == j ? 1 : 2);
        sum = add(scaled(q, v.value[i]), sum);
        sizes.set(i, j, std::abs(q), 2 * kUnitRoundoff * std::abs(q));
      }
      made.value = add(multiply(sum, v.value[j]), made.value);
    }
    made.error = error(sizes, v);
    return made;
  }

  lanes::LaneCode code(const std::vector<Nodes>& results,
                       std::optional<std::uint32_t> feed_back = {}) {
    return {graph_, results, static_cast<std::size_t>(inputs_), feed_back};
  }

 private:
  /// |v'F v - computed| <= A (part A + 2 R), A = sum w_i a_i, R = sum w_i r_i, where |F_ij| <= w_i w_j
  /// and the errors of F are at most `part` of that.
  int error(const Sizes& sizes, const Numbers& v) {
    const std::vector<double> w = sizes.weights();
    const double rounding = (2 * static_cast<double>(v.count()) + 8) * kUnitRoundoff;
    int A = constant(0), R = constant(0);
    for (std::size_t i = 0; i < v.count(); ++i) {
      A = add(scaled(w[i], v.size[i]), A);
      R = add(scaled(2 * w[i], v.radius[i]), R);
    }
    return add(multiply(add(scaled(sizes.part(w) + rounding, A), R), A), constant(kTiny));
  }

  bool constant_;
  numbers::ScalarGraph graph_;
  int inputs_ = 0;
  Nodes given_;  ///< functions of a table in pieces
};

}  // namespace gainsmith::linear
