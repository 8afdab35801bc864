#include "hybrid/breaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "expr/program/branches.h"
#include "hybrid/rounding_terms.h"
#include "hybrid/tolerances.h"
#include "numerics/golden_section.h"
#include "ode/step_range.h"

namespace gainsmith::hybrid {

using Eigen::Index;
using Eigen::VectorXd;
using expr::Instruction;
using expr::Op;
using expr::Program;
using numbers::Matrix;

namespace {

/// An element of a function; not a number where it has no value.
double element(PointFunction& function, const VectorXd& x, Index e) {
  try {
    return function(x, 0)(e);
  } catch (const InputError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// Empty where it has no value.
Matrix value_at(PointFunction& function, const VectorXd& x) {
  try {
    return function(x, 0);
  } catch (const InputError&) {
    return {};
  }
}

/// x with the elements moved by r, up where the bit of their number is set.
VectorXd moved(const VectorXd& x, const VectorXd& r, int bit) {
  VectorXd result = x;
  for (Index e = 0; e < r.size(); ++e) result(e) += ((e >> bit) & 1) != 0 ? r(e) : -r(e);
  return result;
}

/// Adds the roots of g on the pieces between the breaks so far, and to these what it does there;
/// false where there are too many.
bool add_roots(const ode::RootFunction& g, bool jumps, double from, double to,
               std::vector<ode::Break>& breaks) {
  std::vector<ode::Break> fresh;
  const auto add = [&](double a, double b) {
    if (!(a < b)) return true;
    const ode::Found found = ode::find_roots(g, a, b);
    for (const ode::Root& root : found.roots) fresh.push_back({root, jumps});
    return found.whole;
  };
  double left = from;
  for (ode::Break& edge : breaks) {
    edge.jumps = edge.jumps || (jumps && g.value(edge.left) * g.value(edge.right) <= 0);
    if (!add(left, edge.left)) return false;
    left = edge.right;
  }
  if (!add(left, to)) return false;
  breaks.insert(breaks.end(), fresh.begin(), fresh.end());
  std::stable_sort(breaks.begin(), breaks.end(),
                   [](const ode::Break& a, const ode::Break& b) { return a.left < b.left; });
  return true;
}

/// Whether g is nothing but rounding all along, so that its sign says nothing.
bool is_noise(const std::function<double(double)>& g, double noise, double from, double to) {
  return std::ranges::all_of(ode::first_points(from, to),
                             [&](double t) { return std::abs(g(t)) <= noise; });
}

/// Adds the place where |g| is least on a step, if it is small there and not at an end.
void add_near(const std::function<double(double)>& g, double from, double to,
              std::vector<double>& near) {
  const std::vector<double> times = ode::first_points(from, to);
  std::vector<double> sizes;
  sizes.reserve(times.size());
  for (const double t : times) sizes.push_back(std::abs(g(t)));
  const auto least = std::min_element(sizes.begin(), sizes.end());
  if (!(*least <= kNearBreak * *std::max_element(sizes.begin(), sizes.end()))) return;
  const auto k = static_cast<std::size_t>(least - sizes.begin());
  const double low = times[k == 0 ? 0 : k - 1];
  const double high = times[std::min(k + 1, times.size() - 1)];
  near.push_back(numerics::peak_between([&](double t) { return -std::abs(g(t)); }, low, high));
}

/// Whether what lies in a range has no root; with `near`, nor a place for add_near.
bool is_apart(const numbers::Range& range, bool near) {
  return range.least() > (near ? kNearBreak * range.largest() : 0);
}

/// Makes one of breaks with next to nothing between them.
void merge(std::vector<ode::Break>& breaks, double from, double to) {
  const double nothing =
      kAddedUp * (to - from) + kOneInstant * std::max(std::abs(from), std::abs(to));
  std::size_t kept = 0;
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const ode::Break& edge = breaks[k];
    if (edge.left - breaks[kept].right > nothing) {
      breaks[++kept] = edge;
      continue;
    }
    breaks[kept].right = std::max(breaks[kept].right, edge.right);
    breaks[kept].jumps = breaks[kept].jumps || edge.jumps;
  }
  if (!breaks.empty()) breaks.resize(kept + 1);
}

}  // namespace

bool may_wave(const Program& program) {
  using enum Op;
  return std::ranges::any_of(program.code, [](const Instruction& instruction) {
    return expr::behaves(instruction.op, expr::NumberFunction::waves) ||
           is_one_of(instruction.op, {matrix_exponential, flow_map});
  });
}

Breaks::Breaks(const Program& program, const StateLayout& layout, const numbers::Values& constants,
               const std::function<bool(const std::string&)>& moves) {
  for (expr::Branch& text : expr::branches_of(program, moves)) {
    auto terms = std::make_unique<const Program>(terms_of_sign(text.difference));
    auto own = std::make_unique<const Program>(std::move(text.difference));
    PointFunction value(*own, layout, constants);
    PointFunction sizes(*terms, layout, constants);
    const bool waves = text.waves || may_wave(*own);
    texts_.push_back(
        {std::move(own), std::move(terms), std::move(value), std::move(sizes), text.jumps, waves});
  }
}

std::vector<const Program*> Breaks::differences() const {
  std::vector<const Program*> all;
  for (const Text& text : texts_) all.push_back(text.program.get());
  return all;
}

/// min_e |D_e(x)| / max(rounding_e, max_b |D_e(x + s_b r) - D_e(x)|), where the signs s_b of move b
/// are the bits b of the numbers of the elements: log2(n) + 1 moves of n variables.
double Breaks::distance(std::size_t k, const VectorXd& x, const VectorXd& r) {
  const double none = std::numeric_limits<double>::infinity();
  Text& text = texts_[k];
  const Matrix here = value_at(text.value, x);
  if (here.size() == 0) return none;
  Matrix change = Matrix::Zero(here.rows(), here.cols());
  const auto widen = [&](const Matrix& by) {
    for (Index e = 0; e < by.size(); ++e) change(e) = std::fmax(change(e), by(e));
  };
  widen(kTermRounding * value_at(text.terms, x));
  // Any two variables are once moved apart; in the last of all, together.
  for (int bit = 0; bit == 0 || (r.size() - 1) >> (bit - 1) > 0; ++bit)
    if (const Matrix there = value_at(text.value, moved(x, r, bit)); there.size() != 0)
      widen((there - here).cwiseAbs());
  double least = none;
  for (Index e = 0; e < here.size(); ++e)
    if (change(e) > 0) least = std::min(least, std::abs(here(e)) / change(e));
  return least;
}

bool Breaks::is_far(std::size_t k, const VectorXd& x, const VectorXd& r, double times) {
  Text& text = texts_[k];
  box_.resize(static_cast<std::size_t>(r.size()));
  for (Index e = 0; e < r.size(); ++e) {
    const double width = times * (r(e) + kTermRounding * std::abs(x(e)));
    box_[static_cast<std::size_t>(e)] = {x(e) - width, x(e) + width};
  }
  const auto size = static_cast<std::size_t>(text.program->shape().size());
  // Interval arithmetic over the box x +- times (r + rounding) first; it needs no moves.
  bool apart = text.value.enclose(box_);
  for (std::size_t e = 0; e < size && apart; ++e) apart = text.value.range(e).least() > 0;
  return apart || distance(k, x, r) > times;
}

/// For each element of each D, cheapest test first: an interval over the box excludes a root; three
/// points of the step exclude one of a slow D; else the roots are searched on the pieces between
/// the breaks so far. A D below kAddedUp of its terms all along is rounding and has none.
std::optional<std::vector<ode::Break>> Breaks::on(const std::function<const VectorXd&(double)>& x,
                                                  double from, double to, const numbers::Box& box,
                                                  std::vector<double>* near) {
  constexpr std::size_t kMostKnown = 1 << 14;  // a search near rounding asks for millions
  std::vector<ode::Break> breaks;
  if (none() || !(from < to)) return breaks;
  std::optional<std::array<VectorXd, 3>> points;
  for (Text& text : texts_) {
    const Index size = text.program->shape().size();
    const bool bounded = text.value.enclose(box);
    std::map<double, Matrix> known;  // of all elements
    for (Index e = 0; e < size; ++e) {
      if (bounded && is_apart(text.value.range(static_cast<std::size_t>(e)), near != nullptr))
        continue;
      if (!points) points = {x(from), x(from + (to - from) / 2), x(to)};
      const auto at = [&](const VectorXd& values) { return element(text.value, values, e); };
      const bool is_slow = breaks.empty() && !text.waves;
      if (is_slow && ode::StepRange(at, *points).is_far_from_zero()) continue;
      double terms = 0;
      for (const VectorXd& point : *points) terms = std::fmax(terms, element(text.terms, point, e));
      const auto difference = [&](double t) {
        if (size == 1) return at(x(t));
        if (known.size() >= kMostKnown) known.clear();
        const auto [value, fresh] = known.try_emplace(t);
        if (fresh) value->second = value_at(text.value, x(t));
        return value->second.size() > 0 ? value->second(e)
                                        : std::numeric_limits<double>::quiet_NaN();
      };
      if (is_noise(difference, kAddedUp * terms, from, to)) continue;
      if (!add_roots({difference, false, kAddedUp * terms}, text.jumps, from, to, breaks))
        return std::nullopt;
      if (near != nullptr) add_near(difference, from, to, *near);
    }
  }
  merge(breaks, from, to);
  return breaks;
}

}  // namespace gainsmith::hybrid
