#include "lmi/block.h"

#include <algorithm>
#include <cmath>

namespace gainsmith::lmi {

namespace {

/// Whether scalar i is one of the matrices in products.
class InProducts {
 public:
  explicit InProducts(const Block& block) {
    if (!block.products) return;
    for (const HermitianProduct& product : *block.products)
      ranges_.emplace_back(product.unknown.first, product.unknown.first + product.unknown.count());
  }
  bool operator()(int i) const {
    return std::any_of(ranges_.begin(), ranges_.end(),
                       [&](const auto& range) { return range.first <= i && i < range.second; });
  }

 private:
  std::vector<std::pair<int, int>> ranges_;
};

}  // namespace

numbers::Matrix Block::value(const std::vector<double>& x, double one) const {
  numbers::Matrix result = numbers::Matrix::Zero(size, size);
  const InProducts in_products(*this);
  for (const auto& [i, matrix] : terms)
    if (!in_products(i))
      add_multiple(result, i == 0 ? one : x[static_cast<std::size_t>(i) - 1], matrix);
  if (!products) return result;
  for (const HermitianProduct& product : *products) {
    // He(E V F)
    const numbers::Matrix inner = product.left * matrix_at(product.unknown, x);
    const numbers::Matrix half = inner * product.right;
    result += half + half.transpose();
  }
  return result;
}

bool is_homogeneous(const std::vector<Block>& blocks) {
  return std::all_of(blocks.begin(), blocks.end(),
                     [](const Block& block) { return block.constant_size == 0; });
}

namespace {

/// InputError when a product or sum of the data left the range of double.
void check_finite(const Sparse& matrix, const Place& place, const std::string& name) {
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      if (!std::isfinite(it.value()))
        throw InputError(place, "the inequality '" + name +
                                    "' has a coefficient that is not "
                                    "finite: its data are too large for double");
}

/// Elements (r, c) and (c, r) that differ by less, beside the largest one, differ by rounding.
constexpr double kSymmetric = 1e-12;

/// Makes a coefficient exactly symmetric; InputError when it is not so up to rounding.
Sparse symmetric_part(const Sparse& matrix, double scale, const Place& place,
                      const std::string& name) {
  if (is_symmetric(matrix)) return matrix;
  const Sparse mirrored = matrix.transpose();
  const Sparse difference = matrix - mirrored;
  for (int k = 0; k < difference.outerSize(); ++k)
    for (Sparse::InnerIterator it(difference, k); it; ++it)
      if (std::abs(it.value()) > kSymmetric * scale)
        throw InputError(place,
                         "the inequality '" + name + "' is not symmetric: elements (" +
                             std::to_string(it.row() + 1) + ", " + std::to_string(it.col() + 1) +
                             ") and (" + std::to_string(it.col() + 1) + ", " +
                             std::to_string(it.row() + 1) + ") differ; M + M' is written He(M)");
  return 0.5 * (matrix + mirrored);
}

/// The terms of two lists in the order of their scalars; those of one scalar become one. The lists
/// are used up, for sparse matrices are not moved but copied.
std::vector<std::pair<int, Sparse>> merged(std::vector<std::pair<int, Sparse>>& a,
                                           std::vector<std::pair<int, Sparse>>& b) {
  if (a.empty() || b.empty()) return std::move(a.empty() ? b : a);
  std::vector<std::pair<int, Sparse>> result;
  result.reserve(a.size() + b.size());
  auto p = a.begin();
  auto q = b.begin();
  while (p != a.end() || q != b.end()) {
    const bool takes_p = p != a.end() && (q == b.end() || p->first <= q->first);
    const bool takes_q = q != b.end() && (p == a.end() || q->first <= p->first);
    auto& [i, matrix] = result.emplace_back((takes_p ? p : q)->first, Sparse());
    if (takes_p && takes_q)
      matrix = sum_of(p->second, q->second, 1);
    else
      matrix.swap((takes_p ? p : q)->second);
    if (takes_p) ++p;
    if (takes_q) ++q;
  }
  return result;
}

/// Whether a scalar of the matrices in products also occurs in a term.
bool is_elsewhere(const AffineForm& form) {
  return std::any_of(form.products.begin(), form.products.end(), [&](const Product& product) {
    const int first = product.unknown.first;
    const auto found = form.terms.lower_bound({0, first});
    return found != form.terms.end() && found->first.second < first + product.unknown.count();
  });
}

}  // namespace

Block block_of(const AffineForm& form, std::string name, std::string point, bool strict,
               const Place& place) {
  // A matrix that is in products and in terms is written out by its scalars.
  if (is_elsewhere(form)) {
    Block block = block_of(expanded(form), std::move(name), std::move(point), strict, place);
    block.products.reset();
    return block;
  }
  Block block;
  block.name = std::move(name);
  block.point = std::move(point);
  block.strict = strict;
  block.size = form.shape.rows;
  if (block.size == 0) throw InputError(place, "the inequality '" + block.name + "' has no rows");
  const auto measure = [&](int i, const Sparse& matrix) {
    check_finite(matrix, place, block.name);
    double& size = i == 0 ? block.constant_size : block.coefficient_size;
    size = std::max(size, largest_element(matrix));
  };
  block.products = symmetric_part(form.products);
  std::vector<std::pair<int, Sparse>> of_matrices = coefficients(*block.products, block.size);
  for (const auto& [i, matrix] : of_matrices) measure(i, matrix);
  for (const auto& [key, matrix] : form.terms) measure(key.second, matrix);
  const double scale = std::max(block.constant_size, block.coefficient_size);
  if (!form.products.empty() && !(asymmetry(form.products) <= kSymmetric * scale)) {
    AffineForm products{form.shape, {}, form.products};
    for (const auto& [key, matrix] : expanded(products).terms)
      symmetric_part(matrix, scale, place, block.name);
  }
  std::vector<std::pair<int, Sparse>> others;
  for (const auto& [key, matrix] : form.terms)
    others.emplace_back(key.second, symmetric_part(matrix, scale, place, block.name));
  block.terms = merged(others, of_matrices);
  return block;
}

}  // namespace gainsmith::lmi
