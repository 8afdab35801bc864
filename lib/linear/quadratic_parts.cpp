#include "linear/quadratic_parts.h"

#include <map>
#include <stdexcept>

#include "linear/polynomial.h"
#include "numbers/types/degree.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;
using hybrid::Slot;
using Wide = numbers::MatrixOf<Decimal100>;

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
Wide sampled_form(const expr::Program& program, const Coordinates& coordinates) {
  const Index n = coordinates.layout.size;
  std::vector<Index> used;
  for (const Slot& slot : coordinates.layout.slots)
    if (program.uses(slot.name))
      for (Index e = 0; e < slot.shape.size(); ++e) used.push_back(slot.offset + e);
  WideFunction value(program, coordinates.layout, coordinates.constants);
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
  remove_noise(Q, largest_of(Q));
  return Q;
}

/// Words with the same factors of clocks are one part. The rest of each word has degree 2 at most.
/// False where the function is not of the form.
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
    for (const Chain& chain : rest.inner)
      for (const Factor& factor : chain) atoms.push_back(factor.atom);
    for (const int atom : atoms) {
      const expr::Program& part = polynomials.atom(atom);
      if (dependence_of(part, coordinates).clocks) return false;
      const auto degrees = numbers::degrees(part, moves);
      const int own = degrees[static_cast<std::size_t>(part.result)];
      // An atom that is not affine in what moves cannot be a factor of a quadratic form.
      if (own == numbers::kNotAffine) return false;
      degree += own;
    }
    if (degree > 2) return false;
    groups.try_emplace(factors, Polynomial{{1, 1}, {}}).first->second.terms[rest] += coefficient;
  }
  for (const auto& [factors, polynomial] : groups) {
    QuadraticPart part{std::nullopt, sampled_form(polynomials.program(polynomial), coordinates)};
    if (!factors.empty()) part.factor = polynomials.program({{1, 1}, {{Word{factors, {}, {}}, 1}}});
    parts.push_back(std::move(part));
  }
  return true;
}

}  // namespace

std::optional<std::vector<QuadraticPart>> quadratic_parts(const expr::Program& program,
                                                          const Coordinates& coordinates) {
  std::vector<QuadraticPart> parts;
  try {
    if (program.shape().is_scalar() && split(program, coordinates, parts)) return parts;
  } catch (const std::length_error&) {
  } catch (const expr::EvaluationError&) {
  }
  return std::nullopt;
}

}  // namespace gainsmith::linear
