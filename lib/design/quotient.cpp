#include "design/quotient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/number.h"
#include "design/elastic.h"
#include "expr/program/rewrite.h"
#include "model/function.h"
#include "numbers/dense/dense.h"

namespace gainsmith::design {

namespace {

using model::Design;
using numbers::Matrix;

/// No name that a text may use.
constexpr const char* kStep = "the step";

/// Dinkelbach's iteration for min over x of lambda_max(M(x), N(x)) (quotient.h).
class Quotient {
 public:
  Quotient(const model::Instance& instance, const sdp::Options& options, Depth depth)
      : stated_(*instance.design->quotient), options_(options), depth_(depth) {
    const model::Bodies bodies(model::polynomials(*instance.design));
    numerator_ = bodies.link(stated_.numerator);
    denominator_ = bodies.link(stated_.denominator);
    base_ = with_design(instance, [&](Design& design) {
      design.quotient.reset();
      design.objective.reset();
      design.inequalities.push_back(
          inequality(stated_.denominator_text + " > 0", denominator_, true));
    });
  }

  /// From a point with N > 0, or one where N is more even, by steps to the least l; then settled by
  /// verdicts.
  model::Gains run() {
    model::Gains best = solve(base_);
    if (best.verdict != model::Verdict::yes) return best;
    double least = value_at(best);
    if (auto even = evenly(); even && value_at(*even) < least) {
      best = std::move(*even);
      least = value_at(best);
    }
    double before = least;
    for (int k = 0; k < kMostSteps; ++k) {
      auto better = step(best, least);
      if (!better) break;
      best = std::move(*better);
      before = std::exchange(least, value_at(best));
      if (before - least <= kSmallStep * std::abs(before)) break;
    }
    return settled(least, std::max(std::abs(least), std::abs(before)));
  }

 private:
  /// Steps end when one lowers l by less than kSmallStep of itself.
  static constexpr int kMostSteps = 60;
  static constexpr double kSmallStep = 1e-10;
  static constexpr double kRoom = 100;  ///< of N in a step

  model::Gains solve(const model::Instance& instance) const {
    return synthesize(instance, options_, depth_);
  }

  Design::Inequality inequality(const std::string& name, expr::Program difference,
                                bool strict) const {
    return {name, {}, {{name, std::move(difference), strict}}, stated_.place, stated_.place};
  }

  Matrix evaluated(const expr::Program& program, const model::Gains& gains) const {
    numbers::Values values = base_.values;
    for (const auto& [name, matrix] : gains.unknowns) values[name] = matrix;
    return numbers::evaluate(program, values);
  }

  /// The largest eigenvalue of the pair (M, N) at the unknowns: that of L^-1 M L^-T with N = L L'.
  /// N is positive definite there, as every point satisfies N > 0.
  double value_at(const model::Gains& gains) const {
    const Matrix L = numbers::Cholesky(evaluated(denominator_, gains)).lower();
    const Matrix M = evaluated(numerator_, gains);
    const auto lower = L.triangularView<Eigen::Lower>();
    const Matrix half = lower.solve(M);
    const Matrix whole = lower.solve(half.transpose());
    return numbers::SymmetricEigen(0.5 * (whole + whole.transpose())).values().maxCoeff();
  }

  /// l N - M + t N_k; without N_k the first two terms.
  expr::Program difference(double value, const Matrix* of_step = nullptr) const {
    expr::Composer compose(stated_.place);
    const expr::Shape shape = numerator_.shape();
    const int scaled = compose.apply(
        expr::Op::scale, {compose.number(decimal17(value)), compose.program(denominator_)}, shape);
    int result = compose.apply(expr::Op::subtract, {scaled, compose.program(numerator_)}, shape);
    if (of_step != nullptr) {
      const int t = compose.apply(expr::Op::scale,
                                  {compose.input(kStep), constant(compose, *of_step)}, shape);
      result = compose.apply(expr::Op::add, {result, t}, shape);
    }
    return compose.take(result);
  }

  /// (M + M')/2 in 17 digits.
  static int constant(expr::Composer& compose, const Matrix& matrix) {
    std::vector<int> elements;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        elements.push_back(compose.number(decimal17(0.5 * (matrix(i, j) + matrix(j, i)))));
    return compose.apply(expr::Op::blocks, std::move(elements), numbers::shape_of(matrix),
                         {static_cast<int>(matrix.cols())});
  }

  /// What N may grow to in a step.
  expr::Program room(const Matrix& denominator) const {
    expr::Composer compose(stated_.place);
    const int most = constant(compose, kRoom * denominator);
    return compose.take(compose.apply(expr::Op::subtract, {most, compose.program(denominator_)},
                                      numbers::shape_of(denominator)));
  }

  /// A point where N is as near to a multiple of I as it may be, if one has N >= I.
  std::optional<model::Gains> evenly() const {
    const Matrix I = Matrix::Identity(denominator_.shape().rows, denominator_.shape().cols);
    expr::Composer above(stated_.place);
    const expr::Program least = above.take(
        above.apply(expr::Op::subtract, {above.program(denominator_), constant(above, I)},
                    denominator_.shape()));
    expr::Composer below(stated_.place);
    const int most = below.apply(expr::Op::identity, {below.input(kStep)}, denominator_.shape());
    const expr::Program room = below.take(
        below.apply(expr::Op::subtract, {most, below.program(denominator_)}, denominator_.shape()));
    model::Gains gains = solve(with_step({{"least", least}, {"room", room}}));
    return gains.verdict == model::Verdict::yes ? std::optional(std::move(gains)) : std::nullopt;
  }

  /// The smallest step under the inequalities and these, each >= 0.
  model::Instance with_step(const std::vector<std::pair<std::string, expr::Program>>& more) const {
    return with_design(base_, [&](Design& design) {
      Design::Unknown t;
      t.name = kStep;
      t.structure = model::Structure::scalar;
      t.place = stated_.place;
      design.unknowns.push_back(std::move(t));
      for (const auto& [name, program] : more)
        design.inequalities.push_back(inequality(name, program, false));
      expr::Composer compose(stated_.place);
      design.objective = {compose.take(compose.input(kStep)), stated_.place, kStep};
      design.gains.clear();
      design.report.clear();
    });
  }

  /// A point with a smaller value.
  /// minimise t subject to M - l N <= t N_k and N <= 100 N_k; none where the value does not fall.
  std::optional<model::Gains> step(const model::Gains& from, double value) const {
    const Matrix denominator = evaluated(denominator_, from);
    model::Gains gains = solve(
        with_step({{stated_.text, difference(value, &denominator)}, {"room", room(denominator)}}));
    if (gains.verdict != model::Verdict::yes || !(value_at(gains) < value)) return std::nullopt;
    return gains;
  }

  /// The verdict for "M <= value N" beside the inequalities.
  model::Gains at(double value) const {
    return solve(with_design(base_, [&](Design& design) {
      design.inequalities.push_back(
          inequality(stated_.text + " <= " + brief(value, 10), difference(value), false));
    }));
  }

  /// The gains at the least value that the check of decimals accepts, with one that a certificate
  /// excludes: from the value found outwards, then between the two.
  model::Gains settled(double value, double size) {
    // Of the size of l: distances of values that are asked, first above and then below.
    constexpr std::array kAway = {2e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
    constexpr double kNear = 1e-8;
    std::optional<model::Gains> best;
    double high = value;
    for (const double away : kAway) {
      high = value + away * size;
      best = at(high);
      if (best->verdict == model::Verdict::yes) break;
    }
    if (best->verdict == model::Verdict::no) {
      best->verdict = model::Verdict::undecided;
      best->solver.add_message(
          "a value that the steps reached was found infeasible: too near to double");
    }
    if (best->verdict != model::Verdict::yes) return *best;
    std::optional<double> low;
    for (const double away : kAway) {
      const double below = value - away * size;
      model::Gains found = at(below);
      if (found.verdict == model::Verdict::yes) std::tie(high, best) = std::pair(below, found);
      if (found.verdict != model::Verdict::no) continue;
      low = below;
      break;
    }
    while (low && high - *low > kNear * size) {
      const double middle = *low + 0.5 * (high - *low);
      model::Gains found = at(middle);
      if (found.verdict == model::Verdict::undecided) break;
      if (found.verdict == model::Verdict::no) low = middle;
      if (found.verdict == model::Verdict::yes) std::tie(high, best) = std::pair(middle, found);
    }
    best->objective = high;
    best->objective_lower_bound = low;
    if (!low) best->solver.status = "feasible";
    if (!low)
      best->solver.add_message("no value below " + brief(high, 10) +
                               " is infeasible by a certificate: a smaller one may be possible");
    return *best;
  }

  const Design::Quotient stated_;
  const sdp::Options& options_;
  Depth depth_;
  model::Instance base_;
  expr::Program numerator_;
  expr::Program denominator_;
};

}  // namespace

model::Gains smallest_quotient(const model::Instance& instance, const sdp::Options& options,
                               Depth depth) {
  return Quotient(instance, options, depth).run();
}

}  // namespace gainsmith::design
