// Internal to forall: the matrix of an inequality at points and over pieces, for proof_rules.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "expr/program/evaluate.h"
#include "forall/domain.h"
#include "numbers/dense/definite.h"
#include "numbers/types/enclosure.h"
#include "numbers/types/jet.h"

namespace gainsmith::forall::proof {

using numbers::Enclosed;
using numbers::Matrix;
using numbers::Sign;

/// A box low_i <= t_i <= high_i of the interval variables; without variables the one point.
struct Piece {
  static constexpr int kWhole = 1000;

  std::vector<double> low;
  std::vector<double> high;
  /// What a cut left of a piece: the part that was cut off is 2^-cut of that piece.
  int cut = kWhole;

  /// Bit i of `which`: at high_i.
  std::vector<double> corner(std::size_t which) const {
    std::vector<double> at = low;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (((which >> i) & 1U) != 0) at[i] = high[i];
    return at;
  }
  std::size_t corners() const { return std::size_t{1} << low.size(); }
};

/// The rows that are not exactly 0, with `more`.
template <class S>
void drop_zero_rows(Enclosed<S>& B, Matrix& more) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    const bool is_zero = (B.mid.row(i).array() == S(0)).all() &&
                         (B.mid.col(i).array() == S(0)).all() &&
                         (B.rad.row(i).array() == 0).all() && (B.rad.col(i).array() == 0).all() &&
                         (more.size() == 0 ||
                          ((more.row(i).array() == 0).all() && (more.col(i).array() == 0).all()));
    if (!is_zero) kept.push_back(i);
  }
  if (static_cast<Eigen::Index>(kept.size()) == B.rows()) return;
  B = {numbers::MatrixOf<S>(B.mid(kept, kept)), Matrix(B.rad(kept, kept))};
  if (more.size() != 0) more = Matrix(more(kept, kept));
}

/// B at points and over pieces, with the elements of sets and polytopes chosen.
template <class S>
class Function {
 public:
  /// At a point: (B + B')/2 with bounds of errors, its sign, and a direction that shows where it is
  /// not positive.
  struct Corner {
    Enclosed<S> value;
    Sign sign = Sign::open;
    numbers::Vector direction;
    std::string fault;  ///< why there is no value
  };
  /// Over a piece.
  struct Spread {
    Enclosed<double> value;
    std::vector<Matrix> errors;  ///< of the interpolation, along each variable
    /// The same with its sign, where all second derivatives are known: w_i^2/8 B''_i.
    std::vector<Enclosed<double>> sags;
    std::string fault;
  };

  Function(const expr::Program& program, const numbers::EnclosedValues<S>& known, bool strict,
           const std::vector<const Variable*>& axes)
      : axes_(axes), strict_(strict), points_(program), at_(axes.size()) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      along_.emplace_back(program);
      variables_.emplace_back(axes.size());
    }
    for (const expr::Input& input : program.inputs) {
      const auto value = known.find(input.name);
      if (value == known.end()) continue;
      points_.fix(input.name, constants_.emplace_back(value->second));
      const auto& jet =
          jets_.emplace_back(numbers::constant_jet(numbers::converted<double>(value->second)));
      for (auto& evaluator : along_) evaluator.fix(input.name, jet);
    }
    for (std::size_t k = 0; k < axes.size(); ++k) {
      points_.set(axes[k]->name, at_[k]);
      for (std::size_t i = 0; i < axes.size(); ++i) along_[i].set(axes[k]->name, variables_[i][k]);
    }
  }

  /// B at a point in S, with its sign; each point once. `margin` becomes the smallest so far.
  const Corner& corner(const std::vector<double>& at, double& margin) {
    const auto [found, is_new] = corners_.try_emplace(at);
    Corner& corner = found->second;
    if (!is_new) return corner;
    for (std::size_t k = 0; k < at.size(); ++k) at_[k] = numbers::exact_number<S>(S(at[k]));
    try {
      corner.value = numbers::symmetric_part(points_.run());
    } catch (const expr::EvaluationError& error) {
      corner.fault = error.what();
      return corner;
    }
    Enclosed<S> rows = corner.value;
    Matrix none;
    if (!strict_) drop_zero_rows(rows, none);
    numbers::Definite definite = numbers::definite(rows);
    corner.sign = definite.sign;
    corner.direction = std::move(definite.direction);
    if (corner.sign == Sign::negative && rows.rows() != corner.value.rows())
      corner.direction = numbers::definite(corner.value).direction;
    margin = std::min(
        margin,
        numbers::margin(rows.mid.unaryExpr([](const S& x) { return static_cast<double>(x); })));
    return corner;
  }

  /// Whether B certainly violates the comparison there.
  bool fails_at(const Corner& corner) const {
    return corner.sign == Sign::negative || (strict_ && corner.sign == Sign::not_positive);
  }

  /// Enclosures over a piece in double, by one evaluation of second-order Taylor arithmetic a
  /// variable (numbers/types/jet.h).
  Spread over(const Piece& piece) {
    Spread spread;
    try {
      for (std::size_t i = 0; i < axes_.size(); ++i) {
        for (std::size_t k = 0; k < axes_.size(); ++k)
          variables_[i][k] = k == i ? numbers::variable_jet(piece.low[k], piece.high[k])
                                    : numbers::other_variable_jet(piece.low[k], piece.high[k]);
        const numbers::Jet& jet = along_[i].run();
        if (i == 0) spread.value = jet.value();
        spread.errors.push_back(chord_error(jet, piece.high[i] - piece.low[i]));
        if (jet.order == 2 && jet.derivatives[2].is_known())
          spread.sags.push_back(sag(jet.derivatives[2], piece.high[i] - piece.low[i]));
        else if (jet.order < 2)
          spread.sags.push_back(numbers::exactly<double>(spread.errors.back()));
      }
    } catch (const expr::EvaluationError& error) {
      spread.fault = error.what();
    }
    return spread;
  }

  /// Over a piece; unknown where it has no bound.
  Enclosed<double> value_over(const Piece& piece) {
    for (std::size_t k = 0; k < axes_.size(); ++k)
      variables_[0][k] = numbers::other_variable_jet(piece.low[k], piece.high[k]);
    try {
      return along_[0].run().value();
    } catch (const expr::EvaluationError&) {
      return {Matrix::Zero(1, 1), Matrix::Constant(1, 1, numbers::kNothingKnown)};
    }
  }

  bool strict() const { return strict_; }

 private:
  /// w^2/8 B'' with its rounding.
  static Enclosed<double> sag(const Enclosed<double>& bend, double width) {
    const double part = width * width / 8;
    Enclosed<double> result = bend;
    result.mid *= part;
    for (Eigen::Index k = 0; k < bend.mid.size(); ++k)
      if (bend.mid(k) != 0 || bend.rad(k) != 0)
        result.rad(k) = bend.rad(k) * part * (1 + 0x1p-45) + std::abs(result.mid(k)) * 0x1p-45 +
                        std::numeric_limits<double>::min();
    return result;
  }

  /// min(w/2 rad(B'), w^2/8 |B''|) element by element, rounded upward: a function with B' in a ball
  /// of radius r is within r w/2 of its chord, and one with |B''| <= b within b w^2/8.
  static Matrix chord_error(const numbers::Jet& jet, double width) {
    const Eigen::Index n = jet.value().rows();
    if (jet.order < 2) return Matrix::Zero(n, n);  // affine: it is its chord
    const double w = width * (1 + 0x1p-50);
    const auto& bend = jet.derivatives[2];
    const Matrix by_slope = jet.derivatives[1].rad * (w / 2);
    const Matrix by_bend = (bend.mid.cwiseAbs() + bend.rad) * (w * w / 8 * (1 + 0x1p-50));
    return by_slope.cwiseMin(by_bend) * (1 + 0x1p-50);
  }

  const std::vector<const Variable*>& axes_;
  bool strict_;
  expr::Evaluator<numbers::Enclosure<S>> points_;
  std::vector<Enclosed<S>> at_;
  std::deque<expr::Evaluator<numbers::JetAlgebra>> along_;
  std::deque<std::vector<numbers::Jet>> variables_;
  std::deque<Enclosed<S>> constants_;
  std::deque<numbers::Jet> jets_;
  std::map<std::vector<double>, Corner> corners_;
};

}  // namespace gainsmith::forall::proof
