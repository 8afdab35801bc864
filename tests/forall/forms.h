// Matrices that combine functions of the variables of `forall`, put together by hand.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "forall/hull.h"
#include "forall/residues.h"

namespace gainsmith::forall::testing {

/// sum_a phi_a M_a over the monomials of a table.
struct Form {
  MonomialTable monomials;
  std::map<int, numbers::Matrix> terms;

  explicit Form(Domain variables) : monomials(std::move(variables)) {}

  /// Adds the product of the monomials `factors` times M.
  void add(const std::vector<int>& factors, const numbers::Matrix& M) {
    std::map<int, double> product = {{0, 1.0}};
    for (const int factor : factors) {
      std::map<int, double> next;
      for (const auto& [index, coefficient] : product)
        for (const auto& [scale, found] : monomials.product(index, factor))
          next[found] += coefficient * scale;
      product = std::move(next);
    }
    for (const auto& [index, coefficient] : product) {
      const auto [found, fresh] = terms.try_emplace(index, coefficient * M);
      if (!fresh) found->second += coefficient * M;
    }
  }

  /// The monomials of the variable's expm(F t), and their coefficients.
  std::vector<std::pair<int, numbers::Matrix>> exponential(const numbers::Matrix& F, int variable) {
    const Variable& axis = monomials.variables()[static_cast<std::size_t>(variable)];
    std::vector<std::pair<int, numbers::Matrix>> parts;
    for (const auto& [atom, R] : residue_expansion(F, axis.low, axis.high))
      parts.emplace_back(monomials.index(variable, atom), R);
    return parts;
  }

  /// What is not rounding noise.
  std::set<int> standing() const {
    Sizes sizes;
    for (const auto& [index, M] : terms) sizes[index] = M.cwiseAbs().maxCoeff();
    const std::set<int> removed = noise(sizes, monomials);
    std::set<int> left;
    for (const auto& [index, M] : terms)
      if (index != 0 && !M.isZero(0) && !removed.contains(index)) left.insert(index);
    return left;
  }

  Hull hull(int slices = 1, const Place& place = {"test"}) const {
    return hull_of(standing(), monomials, slices, place);
  }

  /// The matrix at each vertex of the hull.
  std::vector<numbers::Matrix> vertices(int slices = 1) const {
    const std::set<int> left = standing();
    std::vector<numbers::Matrix> result;
    for (const Vertex& vertex : hull(slices).vertices) {
      const numbers::Matrix& any = terms.begin()->second;
      numbers::Matrix sum = numbers::Matrix::Zero(any.rows(), any.cols());
      for (const auto& [index, M] : terms)
        if (index == 0 || left.contains(index))
          sum += vertex.values[static_cast<std::size_t>(index)] * M;
      result.push_back(std::move(sum));
    }
    return result;
  }
};

}  // namespace gainsmith::forall::testing
