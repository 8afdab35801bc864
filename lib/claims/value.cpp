#include "claims/value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "bounded/polynomial.h"
#include "numbers/degree.h"

namespace gainsmith::claims {

namespace {

using bounded::Bounded;
using bounded::Coordinates;
using bounded::Polynomial;
using bounded::Polynomials;
using bounded::Word;
using Eigen::Index;
using hybrid::Slot;
using Wide = numbers::MatrixOf<Decimal100>;

/// Below this, squares and products may underflow; then the bound grows by kUnderflow.
constexpr double kUnderflow = bounded::full_precision_from();
const double kTiny = std::pow(kUnderflow, 0.25);

/// What a program depends on.
struct Dependence {
  bool clocks = false;  ///< the timer or a clock
  bool others = false;  ///< any other coordinate
};

Dependence dependence_of(const expr::Program& program, const Coordinates& coordinates) {
  Dependence result;
  result.clocks = program.uses(coordinates.layout.timer);
  for (std::size_t i = 0; i < coordinates.list.size(); ++i)
    if (program.uses(coordinates.layout.slots[i].name))
      (coordinates.list[i].clock ? result.clocks : result.others) = true;
  return result;
}

/// The matrix of a program that is a polynomial of degree 2 in the coordinates, by its values:
/// q(x) = c + b'x + x'Q x has b_i = (q(e_i) - q(-e_i))/2, and so on.
Wide sampled(const expr::Program& program, const Coordinates& coordinates) {
  const Index n = coordinates.layout.size;
  std::vector<Index> used;
  for (const Slot& slot : coordinates.layout.slots)
    if (program.uses(slot.name))
      for (Index e = 0; e < slot.shape.size(); ++e) used.push_back(slot.offset + e);
  bounded::WideFunction value(program, coordinates.layout, coordinates.constants);
  Wide x = Wide::Zero(n, 1);
  const Decimal100 half = Decimal100(1) / Decimal100(2);
  Wide Q = Wide::Zero(n + 1, n + 1);
  const Decimal100 c = value(x)(0);
  Q(n, n) = c;
  std::map<Index, Decimal100> plus;
  for (const Index i : used) {
    x(i) = Decimal100(1);
    plus[i] = value(x)(0);
    x(i) = Decimal100(-1);
    const Decimal100 minus = value(x)(0);
    x(i) = Decimal100(0);
    Q(i, i) = (plus[i] + minus) * half - c;
    Q(i, n) = Q(n, i) = (plus[i] - minus) * half * half;
  }
  for (const Index i : used)
    for (const Index j : used) {
      if (j >= i) continue;
      x(i) = x(j) = Decimal100(1);
      Q(i, j) = Q(j, i) = (value(x)(0) - plus[i] - plus[j] + c) * half;
      x(i) = x(j) = Decimal100(0);
    }
  bounded::remove_noise(Q, bounded::largest_of(Q));
  return Q;
}

/// Splits the function; empty and false when it is not of the form.
bool split(const expr::Program& program, const Coordinates& coordinates,
           std::vector<QuadraticPart>& parts) {
  Polynomials polynomials;
  const Polynomial whole = polynomials.of(program);
  const auto moves = [&](const std::string& name) {
    return name != coordinates.layout.timer && coordinates.layout.moves(name);
  };
  std::map<std::vector<int>, Polynomial> groups;
  for (const auto& [word, coefficient] : whole.terms) {
    Word rest = word;
    rest.scalars.clear();
    std::vector<int> factors;
    for (const int scalar : word.scalars) {
      const Dependence on = dependence_of(polynomials.atom(scalar), coordinates);
      (on.clocks && !on.others ? factors : rest.scalars).push_back(scalar);
    }
    int degree = 0;
    std::vector<int> atoms = rest.scalars;
    for (const bounded::Chain& chain : rest.inner)
      for (const bounded::Factor& factor : chain) atoms.push_back(factor.atom);
    for (const int atom : atoms) {
      const expr::Program& part = polynomials.atom(atom);
      if (dependence_of(part, coordinates).clocks) return false;
      const auto degrees = numbers::degrees(part, moves);
      const int own = degrees[static_cast<std::size_t>(part.result)];
      if (own == numbers::kNotAffine) return false;
      degree += own;
    }
    if (degree > 2) return false;
    groups.try_emplace(factors, Polynomial{{1, 1}, {}}).first->second.terms[rest] += coefficient;
  }
  for (const auto& [factors, polynomial] : groups) {
    QuadraticPart part{std::nullopt, sampled(polynomials.program(polynomial), coordinates)};
    if (!factors.empty()) part.factor = polynomials.program({{1, 1}, {{Word{factors, {}, {}}, 1}}});
    parts.push_back(std::move(part));
  }
  return true;
}

}  // namespace

JudgedFunction make_function(const expr::Program& program, const Coordinates& coordinates) {
  JudgedFunction function;
  function.program = program;
  try {
    function.quadratic = program.shape().is_scalar() && split(program, coordinates, function.parts);
  } catch (const std::length_error&) {
    function.quadratic = false;
  } catch (const expr::EvaluationError&) {
    function.quadratic = false;
  }
  if (!function.quadratic) function.parts.clear();
  function.varies_in_flow = program.uses(coordinates.layout.timer);
  function.varies_in_jump = function.varies_in_flow;
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    if (!program.uses(coordinates.layout.slots[i].name)) continue;
    if (!coordinates.is_still(i)) function.varies_in_flow = true;
    if (coordinates.list[i].jump) function.varies_in_jump = true;
  }
  return function;
}

template <class Scalar>
Value<Scalar>::Value(const JudgedFunction& function, const bounded::BoundedSystem<Scalar>& system)
    : function_(&function) {
  const Coordinates& coordinates = *system.coordinates;
  if (!function.quadratic) {
    whole_.emplace(function.program, coordinates.layout, system.constants);
    for (const Slot& slot : coordinates.layout.slots)
      if (function.program.uses(slot.name))
        for (Index e = 0; e < slot.shape.size(); ++e) elements_.push_back(slot.offset + e);
    return;
  }
  const Index n = coordinates.layout.size;
  for (Index i = 0; i < n; ++i)
    if (std::any_of(function.parts.begin(), function.parts.end(),
                    [&](const QuadraticPart& part) { return !part.matrix.row(i).isZero(0); }))
      elements_.push_back(i);
  std::vector<Index> with_one = elements_;
  with_one.push_back(n);
  for (const QuadraticPart& part : function.parts) {
    Part made{bounded::form_of<Scalar>(part.matrix(with_one, with_one)), std::nullopt};
    if (part.factor) made.factor.emplace(*part.factor, coordinates.layout, system.constants);
    parts_.push_back(std::move(made));
  }
  x_.resize(static_cast<Index>(elements_.size()));
  r_.resize(static_cast<Index>(elements_.size()));
}

template <class Scalar>
Bounded<Scalar> Value<Scalar>::quadratic(const bounded::Track<Scalar>& track, std::size_t sample) {
  const auto x = track.state(sample);
  const auto r = track.bound(sample);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    x_(static_cast<Index>(i)) = x(elements_[i]);
    r_(static_cast<Index>(i)) = r(elements_[i]);
  }
  constexpr double kUnit = bounded::unit_roundoff<Scalar>();
  Bounded<Scalar> sum;
  double sizes = 0;
  for (Part& part : parts_) {
    Bounded<Scalar> term = bounded::value_of<Scalar>(part.form, x_, r_);
    if (part.factor) {
      const bounded::Ball<Scalar>& g =
          (*part.factor)(x, r, track.timer[sample], track.timer_bound[sample]);
      const double size = bounded::size_of(g.mid(0));
      term.bound = size * term.bound + g.rad(0) * (bounded::size_of(term.value) + term.bound);
      term.value = g.mid(0) * term.value;
      term.bound += kUnit * bounded::size_of(term.value);
    }
    sum.value += term.value;
    sum.bound += term.bound;
    sizes += bounded::size_of(term.value);
  }
  if (parts_.size() > 1) sum.bound += static_cast<double>(parts_.size()) * kUnit * sizes;
  return sum;
}

template <class Scalar>
Bounded<Scalar> Value<Scalar>::operator()(const bounded::Track<Scalar>& track, std::size_t sample) {
  Bounded<Scalar> result;
  try {
    if (whole_) {
      const bounded::Ball<Scalar>& value = (*whole_)(
          track.state(sample), track.bound(sample), track.timer[sample], track.timer_bound[sample]);
      result = {value.mid(0), value.rad(0)};
    } else {
      result = quadratic(track, sample);
    }
  } catch (const expr::EvaluationError&) {
    return {Scalar(std::numeric_limits<double>::quiet_NaN()), 0};
  }
  const auto x = track.state(sample);
  for (const Index i : elements_)
    if (const double size = bounded::size_of(x(i)); size > 0 && size < kTiny) {
      result.bound += kUnderflow;
      break;
    }
  result.bound *= bounded::kBoundSlack;
  return result;
}

template class Value<double>;
template class Value<DoubleDouble>;

}  // namespace gainsmith::claims
