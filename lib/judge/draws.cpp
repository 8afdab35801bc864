#include "judge/draws.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "judge/tolerances.h"
#include "ode/tolerances.h"

namespace gainsmith::judge {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Design;
using model::Dynamics;
using model::LawKind;
using V = Dynamics::VariableKind;

/// Of the streams.
enum : std::uint32_t { of_start = 1, of_first, of_length, of_losses, of_noise };
/// What the run may round twice: of the time, and of the horizon.
constexpr double one_instant = 2 * hybrid::kOneInstant;
constexpr double near_horizon = 2 * hybrid::kAddedUp;

class Draws {
 public:
  Draws(Texts& texts, const hybrid::Trajectory& run, const DrawnFrom& from, Faults& faults)
      : texts_(texts), run_(run), from_(from), faults_(faults) {}

  void check() {
    for (std::size_t v = 0; v < texts_.dynamics.variables.size(); ++v)
      if (texts_.is(v, V::state) || texts_.is(v, V::mode)) check_start(v);
    for (std::size_t e = 0; e < texts_.events.size(); ++e) {
      if (texts_.dynamics.events[e].low) check_clock(e);
      if (texts_.dynamics.events[e].lost > 0) check_losses(e);
    }
    for (std::size_t v = 0; v < texts_.dynamics.variables.size(); ++v)
      if (texts_.is(v, V::noise)) check_noise(v);
  }

 private:
  /// u(p, i, k) is draw k of it.
  RandomStream stream(std::uint32_t purpose, std::size_t index) const {
    const auto word = [](std::uint64_t x, int k) {
      return static_cast<std::uint32_t>(x >> (32 * k));
    };
    const auto key =
        philox4x32({purpose, word(index, 0), 0, 0}, {word(from_.seed, 0), word(from_.seed, 1)});
    return {std::uint64_t{key[0]} << 32U | key[1], from_.run};
  }

  // --- Starts. ---

  void check_start(std::size_t v) {
    const auto& starts = from_.campaign->starts;
    const auto start = std::ranges::find(starts, v, &Design::Start::state);
    if (start == starts.end() || texts_.layout.slots[v].shape.size() == 0) return;
    const VectorXd wanted = start_value(v, *start);
    const VectorXd here = texts_.part(run_.start, v);
    faults_.check(0, 0, "starts where it is not drawn: " + texts_.layout.slots[v].name,
                  (here - wanted).cwiseAbs().maxCoeff(), kRounding * wanted.cwiseAbs().maxCoeff());
  }

  /// Where the state starts, a column; the draws are those of p = 1 and the variable.
  VectorXd start_value(std::size_t v, const Design::Start& start) const {
    const expr::Shape shape = texts_.layout.slots[v].shape;
    if (start.kind == model::StartKind::list)
      return texts_.constant(start.values[from_.run % start.values.size()]).reshaped();
    if (start.kind == model::StartKind::expression) {
      const model::Formula& formula = start.values.front();
      Text text(texts_.stated.bodies.link(formula.program), formula.place, texts_.layout,
                texts_.stated);
      return text(run_.start).reshaped();
    }
    if (start.kind == model::StartKind::ellipsoid) return in_ellipsoid(v, start);
    const bool logarithmic = start.kind == model::StartKind::lognormal;
    if (logarithmic || start.kind == model::StartKind::normal)
      return around(start.values, start.covariance, logarithmic, shape, stream(of_start, v), 0);
    const numbers::Matrix low = texts_.constant(start.values[0]);
    const numbers::Matrix high = texts_.constant(start.values[1]);
    const auto at = [](const numbers::Matrix& end, Index i, Index j) {
      return end.size() == 1 ? end(0, 0) : end(i, j);
    };
    const bool symmetric = texts_.dynamics.variables[v].structure == model::Structure::symmetric;
    const RandomStream random = stream(of_start, v);
    numbers::Matrix value(shape.rows, shape.cols);
    std::uint64_t draw = 0;
    for (Index j = 0; j < shape.cols; ++j)
      for (Index i = symmetric ? j : 0; i < shape.rows; ++i) {
        value(i, j) = at(low, i, j) + (at(high, i, j) - at(low, i, j)) * random.uniform_at(draw++);
        if (symmetric) value(j, i) = value(i, j);
      }
    return value.reshaped();
  }

  /// c + sqrt(r) inv(L)' b with Q = L L', b uniform in the unit ball; of two levels [r0, r] in the
  /// part of the ball beyond the radius sqrt(r0/r).
  VectorXd in_ellipsoid(std::size_t v, const Design::Start& start) const {
    const numbers::Matrix Q = texts_.constant(start.values[1]);
    const numbers::Matrix levels = texts_.constant(start.values[2]);
    const double level = levels.reshaped().tail(1)(0);
    const RandomStream random = stream(of_start, v);
    const Index n = Q.rows();
    VectorXd b = normals(n, random, 0);
    double u = random.uniform_at(static_cast<std::uint64_t>(2 * n));
    if (levels.size() > 1) {  // the share of the volume up to the radius
      const double inside = std::pow(levels(0) / level, static_cast<double>(n) / 2);
      u = inside + (1 - inside) * u;
    }
    if (b.norm() > 0) b *= std::pow(u, 1.0 / static_cast<double>(n)) / b.norm();
    const numbers::Matrix L = numbers::Matrix((Q + Q.transpose()) / 2).llt().matrixL();
    return texts_.constant(start.values[0]).reshaped() +
           std::sqrt(level) * L.transpose().triangularView<Eigen::Upper>().solve(b);
  }

  /// From draw `at` on.
  static VectorXd normals(Index n, const RandomStream& random, std::uint64_t at) {
    VectorXd z(n);
    for (Index k = 0; k < n; ++k, at += 2)
      z(k) = std::sqrt(-2 * std::log(1 - random.uniform_at(at))) *
             std::cos(2 * std::numbers::pi * random.uniform_at(at + 1));
    return z;
  }

  /// M z, row by row of M.
  VectorXd spread(const model::Formula& text, bool covariance, expr::Shape shape,
                  const VectorXd& z) const {
    if (!covariance) return filled(text, shape).reshaped().cwiseProduct(z);
    const numbers::Matrix given = texts_.constant(text);
    numbers::Matrix M = numbers::Matrix::Zero(given.rows(), given.cols());
    for (Index i = 0; i < given.rows(); ++i)
      for (Index j = 0; j <= i; ++j) {
        double sum = given(i, j);
        for (Index k = 0; k < j; ++k) sum -= M(i, k) * M(j, k);
        if (i == j) M(i, i) = sum > hybrid::kTermRounding * given(i, i) ? std::sqrt(sum) : 0;
        if (i != j && M(j, j) > 0) M(i, j) = sum / M(j, j);
      }
    return M * z;
  }

  /// c + M z, or c .* exp(M z), z from draw `at` on.
  VectorXd around(const std::vector<model::Formula>& values, bool covariance, bool logarithmic,
                  expr::Shape shape, const RandomStream& random, std::uint64_t at) const {
    const VectorXd center = filled(values[0], shape).reshaped();
    const VectorXd away = spread(values[1], covariance, shape, normals(shape.size(), random, at));
    return logarithmic ? VectorXd(center.array() * away.array().exp()) : VectorXd(center + away);
  }

  // --- Clocks. ---

  /// Those of the event, or else those of all events.
  std::vector<const Design::Law*> laws_of(std::size_t event) const {
    std::vector<const Design::Law*> own, all;
    for (const Design::Law& law : from_.campaign->laws) {
      if (law.event == event) own.push_back(&law);
      if (!law.event) all.push_back(&law);
    }
    return own.empty() ? all : own;
  }

  /// The kind of the law of this run, and the law where the campaign has one.
  std::pair<LawKind, const Design::Law*> law_of(std::size_t event) const {
    const auto laws = laws_of(event);
    if (!laws.empty()) {
      const Design::Law* law = laws[from_.run % laws.size()];
      return {law->kind, law};
    }
    // Uniform, extremes, where the shortest is > 0 sinusoid and always the shortest, always the longest.
    const bool has_shortest = texts_.events[event].low > 0;
    const std::uint64_t number = from_.run % (has_shortest ? 5 : 3);
    if (number == 0) return {LawKind::uniform, nullptr};
    if (number == 1) return {LawKind::extremes, nullptr};
    if (number == 2 && has_shortest) return {LawKind::sinusoid, nullptr};
    return {LawKind::constant, nullptr};
  }

  /// Length k of the event by the law of this run, in [low, high]; t: where it begins.
  double length(std::size_t event, std::uint64_t k, double t) const {
    const double low = texts_.events[event].low;
    const double high = texts_.events[event].high;
    const auto [kind, law] = law_of(event);
    const auto given = [&](std::uint64_t at) {
      return texts_.constant(law->values[at % law->values.size()])(0, 0);
    };
    const auto u = [&] { return stream(of_length, event).uniform_at(k); };
    switch (kind) {
      case LawKind::uniform:
        return low + (high - low) * u();
      case LawKind::extremes:
        return u() < 0.5 ? low : high;
      case LawKind::sinusoid:
        return (high + low) / 2 + (high - low) / 2 * std::sin(t / high);
      case LawKind::list:
        return given(k);
      case LawKind::constant:
        if (law != nullptr) return given(0);
        return low > 0 && from_.run % 5 == 3 ? low : high;
      case LawKind::golden: {
        const double turns = static_cast<double>(k + 1) * 0.6180339887498949;
        return low + (high - low) * (turns - std::floor(turns));
      }
    }
    return high;
  }

  /// When the event is due, up to the end of the run.
  std::vector<double> due_times(std::size_t event) const {
    const Dynamics::Event& clock = texts_.dynamics.events[event];
    const EventTexts& texts = texts_.events[event];
    const bool fixed = texts.low == texts.high;
    const double last = run_.end * (1 + near_horizon);
    std::uint64_t lengths = 0;
    double due = 0;
    if (clock.first_low || from_.campaign->first) {
      due = texts.first_low;
      if (texts.first_low != texts.first_high)
        due += (texts.first_high - texts.first_low) * stream(of_first, event).uniform_at(0);
    } else {
      due = fixed ? texts.low : length(event, lengths++, 0);
    }
    const double first = due;
    std::vector<double> times;
    while (due <= last) {
      times.push_back(due);
      due = fixed ? first + static_cast<double>(times.size()) * texts.low
                  : due + length(event, lengths++, due);
    }
    return times;
  }

  /// Of a sum of lengths.
  double slack(std::size_t lengths, double t) const {
    const double rounding = one_instant * t + static_cast<double>(lengths) * time_rounding(t, 0);
    return t >= run_.horizon ? std::max(rounding, near_horizon * t) : rounding;
  }

  /// Matches the jumps of the event to its due times, in order. With an `if` due times without a
  /// jump are passed over.
  void check_clock(std::size_t event) {
    const std::vector<double> due = due_times(event);
    const bool conditional = texts_.dynamics.events[event].only_if.has_value();
    const std::string what = "jumps when it is not drawn: " + texts_.dynamics.events[event].name;
    std::size_t next = 0;
    for (std::size_t k = 0; k < run_.parts.size(); ++k) {
      const auto* jump = std::get_if<hybrid::JumpPoint>(&run_.parts[k]);
      if (jump == nullptr || jump->event != event) continue;
      const double rounding = slack(next, jump->t);
      while (conditional && next < due.size() && due[next] < jump->t - rounding) ++next;
      if (next == due.size()) {
        faults_.add(k, jump->t, what);
        return;
      }
      faults_.check(k, jump->t, what, std::abs(jump->t - due[next]), rounding);
      ++next;
    }
    if (!conditional && next < due.size() && due[next] < run_.end - slack(next, run_.end))
      faults_.add(run_.parts.size(), due[next],
                  "does not jump when it is drawn: " + texts_.dynamics.events[event].name);
  }

  /// Jump k is lost where u(4, event, k) < probability, unless `in_a_row` losses come just before
  /// it.
  void check_losses(std::size_t event) {
    const Dynamics::Event& clock = texts_.dynamics.events[event];
    const RandomStream random = stream(of_losses, event);
    std::uint64_t number = 0;
    int row = 0;
    for (std::size_t k = 0; k < run_.parts.size(); ++k) {
      const auto* jump = std::get_if<hybrid::JumpPoint>(&run_.parts[k]);
      if (jump == nullptr || jump->event != event) continue;
      const bool lost = random.uniform_at(number++) < clock.lost &&
                        !(clock.lost_in_a_row && row >= *clock.lost_in_a_row);
      row = lost ? row + 1 : 0;
      if (lost != jump->lost)
        faults_.add(
            k, jump->t,
            (lost ? "is not lost as it is drawn: " : "is lost, but not drawn so: ") + clock.name);
    }
  }

  // --- Noise. ---

  /// Vertices and corners are numbered by the run; nothing is drawn.
  static bool is_taken(const Dynamics::Noise& noise) {
    return noise.kind == Dynamics::NoiseKind::vertices ||
           noise.kind == Dynamics::NoiseKind::corners;
  }

  /// The value of a text; a number fills the whole shape.
  numbers::Matrix filled(const model::Formula& text, expr::Shape shape) const {
    const numbers::Matrix value = texts_.constant(text);
    if (value.size() != 1) return value;
    return numbers::Matrix::Constant(shape.rows, shape.cols, value(0, 0));
  }

  /// How many vertices or corners it has.
  std::uint64_t count_of(const Dynamics::Noise& noise) const {
    if (noise.kind == Dynamics::NoiseKind::vertices) return noise.values.size();
    const numbers::Matrix low = filled(noise.values[0], noise.shape);
    const numbers::Matrix high = filled(noise.values[1], noise.shape);
    return std::uint64_t{1} << static_cast<unsigned>((low.array() != high.array()).count());
  }

  /// The vertex or corner of this run.
  VectorXd taken(std::size_t noise) const {
    std::uint64_t before = 1;
    for (std::size_t k = 0; k < noise; ++k)
      if (is_taken(texts_.dynamics.noise[k])) before *= count_of(texts_.dynamics.noise[k]);
    const Dynamics::Noise& noise_law = texts_.dynamics.noise[noise];
    std::uint64_t number = from_.run / before % count_of(noise_law);
    if (noise_law.kind == Dynamics::NoiseKind::vertices)
      return filled(noise_law.values[number], noise_law.shape).reshaped();
    const VectorXd high = filled(noise_law.values[1], noise_law.shape).reshaped();
    VectorXd value = filled(noise_law.values[0], noise_law.shape).reshaped();
    for (Index k = 0; k < value.size(); ++k) {
      if (value(k) == high(k)) continue;
      if (number % 2 == 1) value(k) = high(k);
      number /= 2;
    }
    return value;
  }

  /// Drawing `drawing` = 0, 1, ... of the noise: one draw an element of uniform noise, two of the
  /// others.
  VectorXd noise_value(std::size_t noise, std::uint64_t drawing) const {
    const Dynamics::Noise& noise_law = texts_.dynamics.noise[noise];
    if (is_taken(noise_law)) return taken(noise);
    const RandomStream random = stream(of_noise, noise);
    const auto size = static_cast<std::uint64_t>(noise_law.shape.size());
    if (noise_law.has_center())
      return around(noise_law.values, noise_law.covariance,
                    noise_law.kind == Dynamics::NoiseKind::lognormal, noise_law.shape, random,
                    2 * drawing * size);
    const VectorXd low = filled(noise_law.values[0], noise_law.shape).reshaped();
    const VectorXd high = filled(noise_law.values[1], noise_law.shape).reshaped();
    VectorXd value = low;
    for (std::uint64_t k = 0; k < size; ++k) {
      const auto element = static_cast<Index>(k);
      value(element) += (high(element) - low(element)) * random.uniform_at(drawing * size + k);
    }
    return value;
  }

  /// Whether x holds this drawing, up to kRounding.
  bool is_drawing(std::size_t v, std::uint64_t drawing, const VectorXd& x) const {
    const VectorXd wanted = noise_value(texts_.dynamics.variables[v].of, drawing);
    const VectorXd here = texts_.part(x, v);
    return wanted.size() == 0 ||
           (here - wanted).cwiseAbs().maxCoeff() <= kRounding * wanted.cwiseAbs().maxCoeff();
  }

  /// The number of the drawing goes up at each jump of its event, or with the time. Where `if`
  /// spends occurrences some numbers may have left no trace.
  void check_noise(std::size_t v) {
    const std::size_t noise = texts_.dynamics.variables[v].of;
    const auto event = texts_.dynamics.noise[noise].event;
    const bool spent = event && texts_.dynamics.events[*event].only_if;
    const auto& every = texts_.noise[noise].every;
    std::uint64_t drawing = 0;
    bool wrong = false;
    const auto check_at = [&](std::size_t part, double t, const VectorXd& x, bool drawn) {
      if (wrong) return;
      if (every)
        drawing = static_cast<std::uint64_t>(std::floor(t / *every * (1 + hybrid::kAddedUp)));
      if (drawn) ++drawing;
      for (int more = 0; spent && more < ode::kPatience && !is_drawing(v, drawing, x); ++more)
        ++drawing;
      wrong = !is_drawing(v, drawing, x);
      if (wrong) faults_.add(part, t, "noise that is not drawn so: " + texts_.layout.slots[v].name);
    };
    check_at(0, 0, run_.start, false);
    for (std::size_t k = 0; k < run_.parts.size(); ++k) {
      if (const auto* jump = std::get_if<hybrid::JumpPoint>(&run_.parts[k])) {
        check_at(k, jump->t, jump->before, event && *event == jump->event);
        continue;
      }
      const auto& piece = std::get<hybrid::FlowPiece>(run_.parts[k]);
      check_at(k, piece.from(), piece.start, false);
      for (const hybrid::DenseStep& step : piece.steps)
        if (every || spent) check_at(k, step.from, step(step.from), false);
    }
  }

  Texts& texts_;
  const hybrid::Trajectory& run_;
  const DrawnFrom& from_;
  Faults& faults_;
};

}  // namespace

void check_draws(Texts& texts, const hybrid::Trajectory& trajectory, const DrawnFrom& from,
                 Faults& faults) {
  Draws(texts, trajectory, from, faults).check();
}

}  // namespace gainsmith::judge
