#include "simulate/exact_flow.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/number.h"
#include "base/unit_roundoff.h"
#include "numbers/dense/dense.h"
#include "numerics/balance.h"
#include "ode/chebyshev.h"
#include "ode/integrator.h"

namespace gainsmith::simulate {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using numbers::Matrix;

using WideMatrix = ode::ExponentialTable::WideMatrix;
using Level = ode::ExponentialTable::Level;

/// Of the series.
constexpr int exact_degree = 12;
/// Of s_0: more leave nothing of a step.
constexpr int most_doublings = 60;
/// Of the imaginary part of an eigenvalue.
constexpr double kDamped = 0.01;
/// The terms of expm(G length), |G length| <= 1/2 in balanced units: 24 leave less than 1e-31.
std::vector<WideMatrix> terms_of(const Matrix& G, double length) {
  constexpr int most = 24;
  const WideMatrix X = G.cast<DoubleDouble>() * DoubleDouble(length);
  std::vector<WideMatrix> terms = {WideMatrix::Identity(G.rows(), G.cols())};
  for (int k = 1; k <= most; ++k)
    terms.push_back(numbers::times<DoubleDouble>(terms.back(), X) / DoubleDouble(k));
  return terms;
}

/// Their sum at a share of the length, at most 1.
WideMatrix short_step(const std::vector<WideMatrix>& terms, const DoubleDouble& share) {
  WideMatrix sum = terms.back();
  for (std::size_t k = terms.size() - 1; k-- > 0;) sum = sum * share + terms[k];
  return sum;
}

/// Steps of the lengths 2^k s_0; level k holds the maps of that length.
class ExactFlow : public Flow {
 public:
  ExactFlow(VectorField& field, double longest, const LastPlaces* moved)
      : field_(&field), longest_(longest), moved_(moved) {}

  void start(double t, const VectorXd& values, double last) override {
    t_ = t;
    late_ = 0;
    last_ = last;
    level_ = 0;
    peaks_ = VectorXd::Zero(field_->size());
    read_generator(values);
    z_ = VectorXd::Ones(size_);
    z_.head(field_->size()) = field_->gathered(values);
    const auto& inputs = field_->linear_inputs();
    Index at = field_->size();
    for (const VectorField::LinearInput& input : inputs) z_(at++) = values(input.element);
    for (const VectorField::LinearInput& input : inputs)
      if (has_rate(input)) z_(at++) = field_->rate_of(input);
  }

  hybrid::DenseStep next() override {
    while (true) {
      const Level& level = level_at(std::min(level_, level_of(last_ - t_)));
      bool agrees = false;
      Matrix series = series_over(level, agrees);
      if (!agrees && level_ > 0) {
        --level_;
        grows_ = false;
        continue;
      }
      const double end = t_ + (level.length + late_);
      if (!series.allFinite()) throw ode::IntegrationError("the flow is not finite", t_, true);
      if (end <= t_)
        throw ode::IntegrationError("the flow is too fast to be followed at this time", t_, false);
      if (moved_ != nullptr) move(series);
      return end < last_ ? whole_step(level, series, end) : last_step(level, series, end);
    }
  }

 private:
  /// Whether its rate is one of the values that differ from flow to flow.
  static bool has_rate(const VectorField::LinearInput& input) {
    return !input.clock_rate && !input.rests;
  }

  /// z = (y, the linear inputs of y', their rates, 1),  z' = G z.
  void read_generator(const VectorXd& values) {
    const auto& inputs = field_->linear_inputs();
    size_ = field_->size() + static_cast<Index>(inputs.size()) +
            std::count_if(inputs.begin(), inputs.end(), has_rate) + 1;
    const VectorXd parameters = field_->parameters(values);
    std::vector<double> key(parameters.begin(), parameters.end());
    key.push_back(longest_);
    std::shared_ptr<ode::ExponentialTable>& known = field_->tables().at(key);
    if (known == nullptr) known = make_table();
    table_ = known;
  }

  /// G by values: its last column is y'(0, 0), the others y'(unit vector) - y'(0, 0).
  std::shared_ptr<ode::ExponentialTable> make_table() {
    const auto& inputs = field_->linear_inputs();
    const Index n = field_->size();
    const auto m = static_cast<Index>(inputs.size());
    auto made = std::make_shared<ode::ExponentialTable>();
    Matrix& generator = made->generator = Matrix::Zero(size_, size_);
    VectorXd constant(n), rate(n);
    field_->rate_at(VectorXd::Zero(n), VectorXd::Zero(m), constant);
    for (Index k = 0; k < n + m; ++k) {
      const VectorXd unit = VectorXd::Unit(n + m, k);
      field_->rate_at(unit.head(n), unit.tail(m), rate);
      generator.col(k).head(n) = rate - constant;
    }
    generator.col(size_ - 1).head(n) = constant;
    Index rates = n + m;
    for (Index k = 0; k < m; ++k) {
      const VectorField::LinearInput& input = inputs[static_cast<std::size_t>(k)];
      if (input.clock_rate) generator(n + k, size_ - 1) = *input.clock_rate;
      if (has_rate(input)) generator(n + k, rates++) = 1;
    }
    set_lengths(*made);
    return made;
  }

  /// s_0 = min(top, 1/(2 |G|)), |G| the 1-norm of the balanced matrix; top = 1/w or the longest
  /// step.
  void set_lengths(ode::ExponentialTable& table) const {
    const Index n = size_ - 1;
    const Matrix M = table.generator.topLeftCorner(n, n);
    if (!table.generator.allFinite())
      throw ode::IntegrationError("the flow is not finite", t_, false);
    double norm = 0;
    double rate = 0;
    if (n > 0) {
      const auto scale = [](double x, int exponent) { return std::ldexp(x, exponent); };
      const Matrix balanced = numerics::in_units(M, numerics::balance(M.cwiseAbs()), scale);
      norm = balanced.cwiseAbs().colwise().sum().maxCoeff();
      // What oscillates and dies down ends by itself: until then no series of a long step agrees.
      for (const auto& lambda : numbers::eigenvalues(M)) {
        const bool dies = -lambda.real() > kDamped * std::abs(lambda.imag());
        rate = std::max({rate, dies ? 0 : std::abs(lambda.imag()), lambda.real()});
      }
    }
    const double top = rate > 0 ? std::min(longest_, 1 / rate) : longest_;
    table.shortest = norm > 0 ? std::min(top, 0.5 / norm) : top;
    while (table.top < most_doublings && std::ldexp(table.shortest, table.top + 1) <= top)
      ++table.top;
  }

  /// The shortest level that covers a length, below 0 where s_0 is longer than it has to be: the
  /// rounding of a series is that of the interval that it is made for.
  int level_of(double length) const {
    int exponent = 0;
    std::frexp(length / table_->shortest, &exponent);
    return std::max(exponent, -most_doublings);
  }

  /// The maps at the Chebyshev points; those of level k > 0 are squares of those of level k - 1.
  const Level& level_at(int number) {
    const auto known = table_->levels.find(number);
    if (known != table_->levels.end()) return known->second;
    const Level* half = number > 0 ? &level_at(number - 1) : nullptr;
    const VectorXd& points = ode::chebyshev::points(exact_degree);
    Level level;
    level.length = std::ldexp(table_->shortest, number);
    if (table_->terms.empty()) table_->terms = terms_of(table_->generator, table_->shortest);
    for (Index k = 0; k < points.size(); ++k) {
      if (half != nullptr) {
        const WideMatrix& map = half->wide[static_cast<std::size_t>(k)];
        level.wide.push_back(numbers::times<DoubleDouble>(map, map));
      } else {
        const DoubleDouble share = (DoubleDouble(1) + DoubleDouble(points(k))) / DoubleDouble(2);
        level.wide.push_back(
            short_step(table_->terms, share * DoubleDouble(std::ldexp(1.0, number))));
      }
      level.maps.push_back(
          level.wide.back().unaryExpr([](const DoubleDouble& x) { return as<double>(x); }));
    }
    return table_->levels.emplace(number, std::move(level)).first->second;
  }

  /// The Chebyshev coefficients of y, n x at most 13. `agrees`: the last two are rounding of the
  /// terms.
  Matrix series_over(const Level& level, bool& agrees) {
    const Index n = field_->size();
    Matrix values(n, exact_degree + 1);
    VectorXd sizes = VectorXd::Zero(n);
    for (std::size_t k = 0; k < level.maps.size(); ++k) {
      const auto map = level.maps[k].topRows(n);
      values.col(static_cast<Index>(k)) = map.lazyProduct(z_);
      sizes = sizes.cwiseMax(map.cwiseAbs().lazyProduct(z_.cwiseAbs()));
    }
    Matrix series = ode::chebyshev::coefficients(values);
    const VectorXd tail = series.rightCols(2).cwiseAbs().rowwise().sum();
    peaks_ = peaks_.cwiseMax(sizes);
    sizes_ = level.maps.back().topRows(n).cwiseAbs().lazyProduct(z_.cwiseAbs());
    // What has died down so far is followed no more: its squares are nothing.
    constexpr double kDead = 1e-150;
    const auto size = sizes.array() + kDead * peaks_.array();
    agrees = (tail.array() <= hybrid::kSeriesRounding * size).all();
    // Of flows that are polynomials of a low degree the other coefficients are rounding.
    Index last = exact_degree;
    while (last > 1 && (series.col(last).cwiseAbs().array() <= kUnitRoundoff * sizes.array()).all())
      --last;
    return series.leftCols(last + 1);
  }

  /// What rests is not moved.
  /// Adds a line from 0 at the start of the step to the move at its end.
  void move(Matrix& series) {
    moves_ = VectorXd::Zero(series.rows());
    for (Index k = 0; k < series.rows(); ++k) {
      const auto row = series.row(k);
      if ((row.tail(series.cols() - 1).array() == 0).all()) continue;
      moves_(k) = moved_->of(row.sum(), sizes_(k));
      series(k, 0) += moves_(k) / 2;
      series(k, 1) += moves_(k) / 2;
    }
  }

  hybrid::DenseStep whole_step(const Level& level, const Matrix& series, double end) {
    hybrid::DenseStep step = field_->step(t_, end, series);
    z_ = (level.maps.back() * z_).eval();
    if (moved_ != nullptr) z_.head(moves_.size()) += moves_;
    // The steps are alike, and so is what t_ would lose in each.
    late_ += level.length - (end - t_);
    t_ = end;
    if (grows_ && level_ < table_->top) ++level_;
    grows_ = true;
    return step;
  }

  /// The part of a step up to `last`, from the polynomial of the whole.
  hybrid::DenseStep last_step(const Level& level, const Matrix& series, double end) {
    const double inside = 2 * ((last_ - t_ - late_) / level.length) - 1;
    const Matrix part = end == last_ ? series : ode::chebyshev::part(series, -1, inside);
    hybrid::DenseStep step = field_->step(t_, last_, part);
    z_.head(field_->size()) = ode::chebyshev::at(part, 1);
    t_ = last_;
    return step;
  }

  VectorField* field_;
  double longest_;
  double t_ = 0, last_ = 0;
  double late_ = 0;  ///< z_ is that of t_ + late_, half of a last place at most
  Index size_ = 1;
  std::shared_ptr<ode::ExponentialTable> table_;
  int level_ = 0;
  bool grows_ = true;  ///< false: the last try of a longer step failed
  VectorXd z_;
  VectorXd peaks_;  ///< the largest sizes of this flow
  VectorXd sizes_;  ///< of the terms at the end of the step
  const LastPlaces* moved_;
  VectorXd moves_;  ///< at the end of the step
};

}  // namespace

std::unique_ptr<Flow> exact_flow(VectorField& field, double longest, const LastPlaces* moved) {
  return std::make_unique<ExactFlow>(field, longest, moved);
}

}  // namespace gainsmith::simulate
