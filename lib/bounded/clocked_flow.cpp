#include "bounded/clocked_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bounded/ball.h"
#include "numbers/degree.h"
#include "ode/integrator.h"

namespace gainsmith::bounded {

using Eigen::Index;
using Eigen::VectorXd;
using numbers::Matrix;

namespace {

/// The value of a program of constants; none when it depends on anything that moves.
std::optional<Matrix> fixed_value(const expr::Program& program, const hybrid::StateLayout& layout,
                                  const numbers::Values& constants) {
  for (const expr::Input& input : program.inputs)
    if (layout.moves(input.name)) return std::nullopt;
  return numbers::evaluate(program, constants);
}

/// The value of a clock, which is a state, when any flow begins.
std::optional<Matrix> clock_start(const Coordinate& clock, const std::string& name,
                                  const SampledSystem& system, const hybrid::Scenario& scenario,
                                  const Coordinates& coordinates,
                                  const numbers::Values& constants) {
  const auto state = system.layout.slot(name);
  if (!clock.jump || !state) return std::nullopt;
  const hybrid::StartRule& rule = *scenario.starts[system.variable[*state]];
  if (rule.kind != model::StartKind::expression) return std::nullopt;
  const auto first = fixed_value(rule.program, system.layout, constants);
  const auto next = fixed_value(*clock.jump, coordinates.layout, constants);
  const bool same = first && next && first->rows() == next->rows() &&
                    first->cols() == next->cols() && *first == *next;
  return same ? first : std::nullopt;
}

/// Elements of a symmetric matrix of n + 1 rows.
Index triangle(Index n) { return (n + 1) * (n + 2) / 2; }

}  // namespace

std::optional<VectorXd> ClockedFlow::start_of(const SampledSystem& system,
                                              const hybrid::Scenario& scenario,
                                              const Coordinates& coordinates,
                                              const numbers::Values& constants,
                                              const std::vector<Index>& integrals) {
  const hybrid::StateLayout& layout = coordinates.layout;
  VectorXd start = VectorXd::Zero(layout.size);
  std::vector<std::string> turning;
  std::vector<std::string> clocks;
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const Coordinate& one = coordinates.list[i];
    const hybrid::Slot& slot = layout.slots[i];
    const bool ticks = one.flow && one.rate_is_constant(layout);
    (ticks ? clocks : turning).push_back(slot.name);
    if (!ticks) continue;
    const auto value = clock_start(one, slot.name, system, scenario, coordinates, constants);
    if (!value) return std::nullopt;
    start.segment(slot.offset, slot.shape.size()) = value->reshaped();
  }
  const auto moves = [&](const std::string& name) {
    return std::find(turning.begin(), turning.end(), name) != turning.end();
  };
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const auto& flow = coordinates.list[i].flow;
    if (!flow) continue;
    if (flow->uses(layout.timer)) return std::nullopt;
    if (std::find(integrals.begin(), integrals.end(), layout.slots[i].offset) != integrals.end())
      continue;
    const auto degrees = numbers::degrees(*flow, moves);
    const int degree = degrees[static_cast<std::size_t>(flow->result)];
    if (degree == numbers::kNotAffine || degree > 1) return std::nullopt;
  }
  return start;
}

/// The derivative of Phi and W, stacked: Phi column by column, then the lower triangle of each W.
class ClockedFlow::Stack {
 public:
  Stack(const Coordinates& coordinates, const numbers::Values& constants, const VectorXd& start,
        const ClockedFlow& flow)
      : rate_(coordinates, constants),
        flow_(flow),
        full_(start),
        n_(static_cast<Index>(flow.linear_.size())),
        count_(static_cast<Index>(flow.quadratic_.size())),
        moving_(static_cast<Index>(rate_.elements().size())),
        slope_(moving_.size()) {}

  Index size() const { return n_ * (n_ + 1) + count_ * triangle(n_); }

  VectorXd begin() const {
    VectorXd stack = VectorXd::Zero(size());
    for (Index i = 0; i < n_; ++i) stack(i * n_ + i) = 1;
    return stack;
  }

  void operator()(double t, const VectorXd& stack, VectorXd& rate) {
    const Eigen::Map<const Matrix> phi(stack.data(), n_, n_ + 1);
    const VectorXd last = phi.col(n_);
    const VectorXd none = values(t, last);
    Matrix plus(n_ + count_, n_), minus(n_ + count_, n_);
    for (Index i = 0; i < n_; ++i) plus.col(i) = values(t, last + phi.col(i));
    rate.head(n_ * n_) = (plus.topRows(n_).colwise() - none.head(n_)).reshaped();
    rate.segment(n_ * n_, n_) = none.head(n_);
    if (count_ == 0) return;
    for (Index i = 0; i < n_; ++i) minus.col(i) = values(t, last - phi.col(i));
    for (Index i = 0; i < n_; ++i)
      for (Index j = 0; j < i; ++j) {
        const VectorXd both = values(t, last + phi.col(i) + phi.col(j));
        for (Index k = 0; k < count_; ++k)
          entry(rate, k, i, j) =
              0.5 * (both(n_ + k) - plus(n_ + k, i) - plus(n_ + k, j) + none(n_ + k));
      }
    for (Index k = 0; k < count_; ++k) {
      for (Index i = 0; i < n_; ++i) {
        entry(rate, k, i, i) = 0.5 * (plus(n_ + k, i) + minus(n_ + k, i)) - none(n_ + k);
        entry(rate, k, n_, i) = 0.25 * (plus(n_ + k, i) - minus(n_ + k, i));
      }
      entry(rate, k, n_, n_) = none(n_ + k);
    }
  }

 private:
  double& entry(VectorXd& rate, Index k, Index i, Index j) const {
    return rate(n_ * (n_ + 1) + k * triangle(n_) + i * (i + 1) / 2 + j);
  }

  /// The derivatives of x and of the integrals at x.
  VectorXd values(double t, const VectorXd& x) {
    full_(flow_.linear_) = x;
    full_(flow_.quadratic_).setZero();
    moving_ = full_(rate_.elements());
    rate_(full_, 0, t, moving_, slope_);
    VectorXd all = VectorXd::Zero(full_.size());
    all(rate_.elements()) = slope_;
    VectorXd result(n_ + count_);
    result << all(flow_.linear_), all(flow_.quadratic_);
    return result;
  }

  FlowRate rate_;
  const ClockedFlow& flow_;
  VectorXd full_;
  Index n_, count_;
  VectorXd moving_, slope_;
};

/// The size to which the error of each entry is relative: of Phi that of its column, of W that of
/// W.
VectorXd ClockedFlow::sizes(const VectorXd& stack, const VectorXd& rate, double longest) const {
  const auto n = static_cast<Index>(linear_.size());
  VectorXd result = VectorXd::Ones(stack.size());
  for (Index j = 0; j <= n; ++j) {
    const double size = stack.segment(j * n, n).lpNorm<Eigen::Infinity>();
    result.segment(j * n, n).setConstant(j < n ? std::max(size, kLeastColumn) : size);
  }
  const double largest = n > 0 ? result.head(n * n).maxCoeff() : 1;
  if (n > 0) result.segment(n * n, n) = result.segment(n * n, n).cwiseMax(kLeastColumn * largest);
  for (std::size_t k = 0; k < quadratic_.size(); ++k) {
    const Index at = n * (n + 1) + static_cast<Index>(k) * triangle(n);
    const double size =
        std::max(stack.segment(at, triangle(n)).lpNorm<Eigen::Infinity>(),
                 kLeastColumn * longest * rate.segment(at, triangle(n)).lpNorm<Eigen::Infinity>());
    result.segment(at, triangle(n)).setConstant(std::max(size, std::sqrt(full_precision_from())));
  }
  return result;
}

/// The Chebyshev coefficients of what has these columns at the points cos(pi k/N).
Matrix ClockedFlow::series_of(const Matrix& at_points) {
  const int N = degree::shared_flow;
  Matrix transform(N + 1, N + 1);
  for (int k = 0; k <= N; ++k)
    for (int d = 0; d <= N; ++d) {
      const double ends = (k == 0 || k == N ? 0.5 : 1) * (d == 0 || d == N ? 0.5 : 1);
      transform(k, d) = 2.0 / N * ends * std::cos(std::numbers::pi * k * d / N);
    }
  return at_points * transform;
}

ClockedFlow::ClockedFlow(const Coordinates& coordinates, const numbers::Values& constants,
                         const VectorXd& start, const std::vector<Index>& integrals, double longest,
                         double relative, double step)
    : quadratic_(integrals) {
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const Coordinate& one = coordinates.list[i];
    const hybrid::Slot& slot = coordinates.layout.slots[i];
    const bool ticks = one.flow && one.rate_is_constant(coordinates.layout);
    if (ticks || std::find(integrals.begin(), integrals.end(), slot.offset) != integrals.end())
      continue;
    for (Index e = 0; e < slot.shape.size(); ++e) linear_.push_back(slot.offset + e);
  }
  Stack stack(coordinates, constants, start, *this);
  ode::Integrator integrator(
      stack.size(), [&](double t, const VectorXd& x, VectorXd& rate) { stack(t, x, rate); });
  VectorXd at = stack.begin();
  VectorXd rate(at.size());
  double begin = 0;
  double length = longest / kPartsOfFlow;
  for (std::size_t tried = 0; begin < longest; ++tried) {
    if (tried >= kMostPieces)
      throw ode::IntegrationError(
          "the flow needs more than " + std::to_string(kMostPieces) + " pieces", begin, false);
    const bool is_last = longest - begin <= 1.5 * length;
    const double end = is_last ? longest : begin + length;
    stack(begin, at, rate);
    const VectorXd scale = sizes(at, rate, longest);
    integrator.start(begin, at, end, relative, kSharper * relative * scale,
                     step * (end - begin) / 2);
    Matrix points(at.size(), degree::shared_flow + 1);
    points.col(degree::shared_flow) = at;
    VectorXd next(at.size());
    for (int k = degree::shared_flow - 1; k >= 0; --k) {
      const double t = k == 0
                           ? end
                           : begin + 0.5 * (end - begin) *
                                         (1 + std::cos(std::numbers::pi * k / degree::shared_flow));
      integrator.advance(t, next);
      points.col(k) = next;
    }
    Piece piece{begin, end, series_of(points)};
    const auto left = piece.series.rightCols(2).cwiseAbs().rowwise().maxCoeff();
    const VectorXd reached = points.cwiseAbs().rowwise().maxCoeff().cwiseMax(scale);
    if ((left.array() > relative * reached.array()).any()) {
      length = 0.5 * (end - begin);
      continue;
    }
    at = points.col(0);
    length = 2 * (end - begin);
    begin = end;
    pieces_.push_back(std::move(piece));
  }
}

void ClockedFlow::operator()(const VectorXd& from, double t, VectorXd& to) const {
  const auto found = std::lower_bound(pieces_.begin(), pieces_.end(), t,
                                      [](const Piece& piece, double at) { return piece.end < at; });
  const Piece& piece = found == pieces_.end() ? pieces_.back() : *found;
  const double s =
      std::clamp((2 * t - piece.begin - piece.end) / (piece.end - piece.begin), -1.0, 1.0);
  VectorXd cosines(degree::shared_flow + 1);
  cosines(0) = 1;
  cosines(1) = s;
  for (int d = 2; d <= degree::shared_flow; ++d)
    cosines(d) = 2 * s * cosines(d - 1) - cosines(d - 2);
  const VectorXd stack = piece.series * cosines;
  const auto n = static_cast<Index>(linear_.size());
  VectorXd x(n + 1);
  x << from(linear_), 1;
  to = from;
  to(linear_) = Eigen::Map<const Matrix>(stack.data(), n, n + 1) * x;
  for (std::size_t k = 0; k < quadratic_.size(); ++k) {
    Index at = n * (n + 1) + static_cast<Index>(k) * triangle(n);
    double sum = 0;
    for (Index i = 0; i <= n; ++i)
      for (Index j = 0; j <= i; ++j) sum += (i == j ? 1 : 2) * stack(at++) * x(i) * x(j);
    to(quadratic_[k]) += sum;
  }
}

}  // namespace gainsmith::bounded
