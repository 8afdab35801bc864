#include "forall/monomials.h"

#include <algorithm>

#include "base/named.h"

namespace gainsmith::forall {

MonomialTable::MonomialTable(Domain variables)
    : variables_(std::move(variables)), monomials_{Monomial{}} {}

int MonomialTable::find_variable(const std::string& name) const {
  const Variable* found = find_named(variables_, name);
  return found == nullptr ? -1 : static_cast<int>(found - variables_.data());
}

int MonomialTable::index(const Monomial& monomial) {
  const auto found = std::find(monomials_.begin(), monomials_.end(), monomial);
  if (found != monomials_.end()) return static_cast<int>(found - monomials_.begin());
  monomials_.push_back(monomial);
  return static_cast<int>(monomials_.size()) - 1;
}

int MonomialTable::index(int variable, const Atom& atom) {
  if (atom.is_one()) return 0;
  return index(Monomial{{variable, atom, 0}});
}

int MonomialTable::index_of_weight(int variable, int weight) {
  return index(Monomial{{variable, {}, weight}});
}

namespace {

/// f g for factors of one variable.
std::vector<std::pair<double, Factor>> factor_product(const Factor& f, const Factor& g,
                                                      const Variable& variable) {
  if (f.weight > 0)
    throw expr::EvaluationError("not affine in " + variable.name +
                                ", which runs over a polytope: a product of two of its elements");
  std::vector<std::pair<double, Factor>> result;
  for (const auto& [coefficient, atom] : forall::product(f.atom, g.atom))
    result.push_back({coefficient, {f.variable, atom, 0}});
  return result;
}

}  // namespace

/// Factors of different variables are multiplied as they are; those of one variable are a sum of
/// atoms by the addition theorems of sine and cosine.
Combination MonomialTable::product(int a, int b) {
  if (a == 0) return {{1.0, b}};
  if (b == 0) return {{1.0, a}};
  const Monomial first = (*this)[a];
  const Monomial second = (*this)[b];
  std::vector<std::pair<double, Monomial>> terms = {{1.0, {}}};
  for (int v = 0; v < static_cast<int>(variables_.size()); ++v) {
    const auto is_of_v = [v](const Factor& factor) { return factor.variable == v; };
    const auto f = std::find_if(first.begin(), first.end(), is_of_v);
    const auto g = std::find_if(second.begin(), second.end(), is_of_v);
    if (f == first.end() && g == second.end()) continue;
    std::vector<std::pair<double, Factor>> factors;
    if (f == first.end()) {
      factors = {{1.0, *g}};
    } else if (g == second.end()) {
      factors = {{1.0, *f}};
    } else {
      factors = factor_product(*f, *g, variables_[static_cast<std::size_t>(v)]);
    }
    std::vector<std::pair<double, Monomial>> next;
    for (const auto& [coefficient, monomial] : terms) {
      for (const auto& [scale, factor] : factors) {
        Monomial longer = monomial;
        if (factor.weight > 0 || !factor.atom.is_one()) longer.push_back(factor);
        next.emplace_back(coefficient * scale, std::move(longer));
      }
    }
    terms = std::move(next);
  }
  Combination result;
  for (const auto& [coefficient, monomial] : terms)
    result.emplace_back(coefficient, index(monomial));
  return result;
}

}  // namespace gainsmith::forall
