#include "verdict/faces.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "base/stop.h"
#include "numbers/dense/rational_algebra.h"

namespace gainsmith::verdict {

namespace {

using numbers::RationalMatrix;

const RationalMatrix* term_of(const RationalBlock& block, int i) {
  for (const auto& [index, matrix] : block.terms)
    if (index == i) return &matrix;
  return nullptr;
}

std::string place_of(int row) {
  const std::string number = std::to_string(row + 1);
  return "(" + number + ", " + number + ")";
}

void add_multiple(RationalMatrix& sum, const Rational& factor, const RationalMatrix& matrix) {
  for (Eigen::Index e = 0; e < sum.size(); ++e)
    if (matrix(e) != 0) sum(e) += factor * matrix(e);
}

/// c > 0 with a = -c b for all coefficients but, with `constants`, those of x_0; none otherwise.
std::optional<Rational> opposite(const RationalBlock& a, const RationalBlock& b, bool constants) {
  std::optional<Rational> factor;
  const auto first = [&](const RationalBlock& block) {
    return block.terms.begin() +
           (!block.terms.empty() && block.terms.front().first == 0 && !constants ? 1 : 0);
  };
  auto p = first(a);
  auto q = first(b);
  if (a.terms.end() - p != b.terms.end() - q) return std::nullopt;
  for (; p != a.terms.end(); ++p, ++q) {
    if (p->first != q->first) return std::nullopt;
    for (Eigen::Index e = 0; e < p->second.size(); ++e) {
      const Rational& x = p->second(e);
      const Rational& y = q->second(e);
      if (x == 0 && y == 0) continue;
      if (y == 0 || x == 0) return std::nullopt;
      const Rational found = -x / y;
      if (factor && *factor != found) return std::nullopt;
      factor = found;
    }
  }
  return factor && *factor > 0 ? factor : std::nullopt;
}

}  // namespace

Faces::Faces(std::vector<RationalBlock> blocks, std::vector<std::string> names, int unknowns)
    : blocks_(std::move(blocks)),
      names_(std::move(names)),
      free_(static_cast<std::size_t>(unknowns)),
      origin_(static_cast<std::size_t>(unknowns), Rational(0)),
      directions_(RationalMatrix::Identity(unknowns, unknowns)) {
  std::iota(free_.begin(), free_.end(), 1);
  for (const RationalBlock& block : blocks_) {
    kept_.emplace_back(static_cast<std::size_t>(block.size));
    std::iota(kept_.back().begin(), kept_.back().end(), 0);
    sizes_.push_back(block.size);
  }
}

std::string Faces::why() const {
  std::string text;
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step)
    text += (text.empty() ? "" : "; because ") + *step;
  return text;
}

void Faces::exclude(const std::string& why, const FaceMultipliers& by) {
  record(by);
  excluded_ = true;
  steps_.push_back(why);
}

void Faces::exclude_numbers() {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const RationalBlock& block = blocks_[k];
    if (!block.exact) continue;
    if (const auto v = numbers::rational_witness(block.value({}), block.strict))
      return exclude("what is left has no unknowns and does not hold",
                     {{{k, {}, *v}}, {RationalMatrix::Identity(1, 1)}});
  }
}

void Faces::record(FaceMultipliers by) {
  for (FaceOfBlock& face : by.faces) {
    RationalMatrix whole = RationalMatrix::Constant(sizes_[face.block], face.V.cols(), Rational(0));
    whole(kept_[face.block], Eigen::all) = face.V;
    face.V = std::move(whole);
  }
  chain_.push_back(std::move(by));
}

void Faces::find_plain() {
  while (!excluded_ && (find_zero() || find_pair())) {
  }
}

bool Faces::find_zero() {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const RationalBlock& block = blocks_[k];
    std::vector<int> rows;
    for (int row = 0; block.exact && row < block.size; ++row) {
      if (is_zero_diagonal(k, row)) rows.push_back(row);
      if (excluded_) return true;
    }
    if (rows.empty()) continue;
    RationalMatrix V = RationalMatrix::Constant(block.size, std::ssize(rows), Rational(0));
    std::string places;
    for (std::size_t c = 0; c < rows.size(); ++c) {
      V(rows[c], static_cast<Eigen::Index>(c)) = 1;
      const int stated = kept_[k][static_cast<std::size_t>(rows[c])];
      places += (c == 0 ? "" : c + 1 == rows.size() ? " and " : ", ") + place_of(stated);
    }
    steps_.push_back(
        names_[k] +
        (rows.size() == 1
             ? ": element " + places + " is 0 for all unknowns, so its row must be 0"
             : ": elements " + places + " are 0 for all unknowns, so their rows must be 0"));
    const RationalMatrix I = RationalMatrix::Identity(V.cols(), V.cols());
    restrict_to({{{k, rows, std::move(V)}}, {I}});
    return true;
  }
  return false;
}

bool Faces::is_zero_diagonal(std::size_t k, int row) {
  const RationalBlock& block = blocks_[k];
  Rational constant = 0;
  for (const auto& [i, matrix] : block.terms) {
    if (matrix(row, row) == 0) continue;
    if (i != 0) return false;
    constant = matrix(row, row);
  }
  if (constant > 0) return false;
  if (constant == 0 && !block.strict) return true;
  const int stated = kept_[k][static_cast<std::size_t>(row)];
  exclude(names_[k] + ": element " + place_of(stated) + " is " + (constant < 0 ? "below " : "") +
              "0 for all unknowns",
          {{{k, {row}, RationalMatrix::Identity(block.size, block.size).col(row)}},
           {RationalMatrix::Identity(1, 1)}});
  return false;
}

bool Faces::find_pair() {
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    for (std::size_t l = k + 1; l < blocks_.size(); ++l)
      if (pairs(k, l)) return true;
  return false;
}

/// For 1 x 1 blocks a(x) = a_0 + f(x) and b(x) = b_0 - f(x)/c the sum a + c b = a_0 + c b_0
/// decides: < 0 excludes, 0 leaves equality (or excludes beside a strict one), > 0 says nothing.
bool Faces::pairs(std::size_t k, std::size_t l) {
  const RationalBlock& a = blocks_[k];
  const RationalBlock& b = blocks_[l];
  if (!a.exact || !b.exact || a.size != b.size || a.size == 0) return false;
  const bool numbers = a.size == 1;
  const auto factor = opposite(a, b, !numbers);
  if (!factor) return false;
  const std::string both = names_[k] + " and " + names_[l];
  std::vector<int> rows(static_cast<std::size_t>(a.size));
  std::iota(rows.begin(), rows.end(), 0);
  const RationalMatrix I = RationalMatrix::Identity(a.size, a.size);
  const std::vector<FaceOfBlock> faces = {{k, rows, I}, {l, rows, I}};
  const FaceMultipliers sum{faces, {I, *factor * I}};
  if (numbers) {
    const auto constant = [](const RationalBlock& block) {
      const RationalMatrix* matrix = term_of(block, 0);
      return matrix == nullptr ? Rational(0) : (*matrix)(0, 0);
    };
    const Rational room = constant(a) + *factor * constant(b);
    if (room > 0) return false;
    if (room < 0) {
      exclude(both + " exclude each other", sum);
      return true;
    }
  }
  if (a.strict || b.strict) {
    exclude(both + " are opposite, one of them strict", sum);
    return true;
  }
  steps_.push_back(both + " are opposite and leave equality only");
  restrict_to(sum);
  return true;
}

/// The equations B_k(x) V = 0, one for each element of n_k x rank, linear in (1, y).
void Faces::restrict_to(const FaceMultipliers& by) {
  const std::vector<FaceOfBlock>& faces = by.faces;
  record(by);
  std::vector<std::vector<Rational>> equations;
  const std::vector<Rational> none(static_cast<std::size_t>(unknowns()) + 1, Rational(0));
  for (const FaceOfBlock& face : faces) {
    const RationalBlock& block = blocks_[face.block];
    const Eigen::Index columns = face.V.cols();
    const std::size_t first = equations.size();
    equations.resize(first + static_cast<std::size_t>(block.size * columns), none);
    for (const auto& [i, matrix] : block.terms) {
      check_stop();
      const RationalMatrix product = numbers::rational_product(matrix, face.V);
      for (Eigen::Index e = 0; e < product.size(); ++e)
        equations[first + static_cast<std::size_t>(e)][static_cast<std::size_t>(i)] = product(e);
    }
  }
  for (const FaceOfBlock& face : faces) drop_rows(face.block, face.pivots);
  // Both triangles say the same, and so do the blocks of a pair.
  std::set<std::vector<Rational>> known = {none};
  std::erase_if(equations, [&](const auto& equation) { return !known.insert(equation).second; });
  RationalMatrix whole(static_cast<Eigen::Index>(equations.size()), std::ssize(none));
  for (Eigen::Index r = 0; r < whole.rows(); ++r)
    for (Eigen::Index c = 0; c < whole.cols(); ++c)
      whole(r, c) = equations[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  keep(whole);
  if (impose(whole)) return;
  excluded_ = true;
  steps_.emplace_back("the equations that this leaves have no solution");
}

void Faces::keep(const RationalMatrix& equations) {
  for (Eigen::Index r = 0; r < equations.rows(); ++r) {
    Equation equation{{}, -equations(r, 0)};
    for (Eigen::Index c = 1; c < equations.cols(); ++c)
      if (equations(r, c) != 0)
        equation.terms.emplace_back(free_[static_cast<std::size_t>(c) - 1], equations(r, c));
    equations_.push_back(std::move(equation));
  }
}

void Faces::drop_rows(std::size_t block, const std::vector<int>& rows) {
  std::vector<int> stay;
  for (int r = 0; r < blocks_[block].size; ++r)
    if (std::find(rows.begin(), rows.end(), r) == rows.end()) stay.push_back(r);
  std::vector<std::pair<int, RationalMatrix>> terms;
  for (const auto& [i, matrix] : blocks_[block].terms) {
    RationalMatrix part = matrix(stay, stay);
    if (!numbers::is_rational_zero(part)) terms.emplace_back(i, std::move(part));
  }
  blocks_[block].terms = std::move(terms);
  blocks_[block].size = static_cast<int>(stay.size());
  std::vector<int> kept;
  for (const int r : stay) kept.push_back(kept_[block][static_cast<std::size_t>(r)]);
  kept_[block] = std::move(kept);
}

bool Faces::impose(const RationalMatrix& equations) {
  const Eigen::Index d = unknowns();
  // The constants last; pivots from the right, so that the first unknowns stay free.
  // Gauss-Jordan elimination in fractions gives y_j = a_j + sum of the y that stay.
  RationalMatrix turned(equations.rows(), d + 1);
  for (Eigen::Index c = 0; c < d; ++c) turned.col(c) = equations.col(d - c);
  turned.col(d) = equations.col(0);
  const numbers::Echelon echelon = numbers::reduced_echelon(std::move(turned));
  if (echelon.pivots.empty()) return true;
  if (echelon.pivots.back() == d) return false;
  std::vector<Eigen::Index> row_of(static_cast<std::size_t>(d), -1);  // the equation that gives y
  for (std::size_t r = 0; r < echelon.pivots.size(); ++r)
    row_of[static_cast<std::size_t>(d - 1 - echelon.pivots[r])] = static_cast<Eigen::Index>(r);
  std::vector<Eigen::Index> stay;
  for (Eigen::Index j = 0; j < d; ++j)
    if (row_of[static_cast<std::size_t>(j)] < 0) stay.push_back(j);
  // (1, y) = M (1, z).
  const auto kept = static_cast<Eigen::Index>(stay.size());
  RationalMatrix M = RationalMatrix::Constant(d + 1, kept + 1, Rational(0));
  M(0, 0) = 1;
  for (Eigen::Index z = 0; z < kept; ++z) M(stay[static_cast<std::size_t>(z)] + 1, z + 1) = 1;
  for (Eigen::Index j = 0; j < d; ++j) {
    const Eigen::Index r = row_of[static_cast<std::size_t>(j)];
    if (r < 0) continue;
    M(j + 1, 0) = -echelon.rows(r, d);
    for (Eigen::Index z = 0; z < kept; ++z)
      M(j + 1, z + 1) = -echelon.rows(r, d - 1 - stay[static_cast<std::size_t>(z)]);
  }
  for (RationalBlock& block : blocks_) {
    std::vector<std::pair<int, RationalMatrix>> terms;
    for (Eigen::Index z = 0; z <= kept; ++z) {
      check_stop();
      RationalMatrix sum = RationalMatrix::Constant(block.size, block.size, Rational(0));
      for (const auto& [i, matrix] : block.terms)
        if (M(i, z) != 0) add_multiple(sum, M(i, z), matrix);
      if (!numbers::is_rational_zero(sum)) terms.emplace_back(static_cast<int>(z), std::move(sum));
    }
    block.terms = std::move(terms);
  }
  RationalMatrix whole(directions_.rows(), d + 1);
  for (Eigen::Index i = 0; i < whole.rows(); ++i)
    whole(i, 0) = origin_[static_cast<std::size_t>(i)];
  whole.rightCols(d) = directions_;
  const RationalMatrix moved = numbers::rational_product(whole, M);
  for (Eigen::Index i = 0; i < moved.rows(); ++i)
    origin_[static_cast<std::size_t>(i)] = moved(i, 0);
  directions_ = moved.rightCols(kept);
  std::vector<int> left;
  for (const Eigen::Index j : stay) left.push_back(free_[static_cast<std::size_t>(j)]);
  free_ = std::move(left);
  return true;
}

/// Unknowns whose columns, the upper triangles of all B_i, depend on those before: their y are 0.
void Faces::drop_dependent() {
  const Eigen::Index d = unknowns();
  Eigen::Index elements = 0;
  for (const RationalBlock& block : blocks_) elements += block.size * (block.size + 1) / 2;
  RationalMatrix columns = RationalMatrix::Constant(elements, d, Rational(0));
  Eigen::Index first = 0;
  for (const RationalBlock& block : blocks_) {
    for (const auto& [i, matrix] : block.terms) {
      if (i == 0) continue;
      Eigen::Index at = first;
      for (Eigen::Index c = 0; c < matrix.cols(); ++c)
        for (Eigen::Index r = 0; r <= c; ++r) columns(at++, i - 1) = matrix(r, c);
    }
    first += block.size * (block.size + 1) / 2;
  }
  if (numbers::are_surely_independent(columns)) return;
  const auto pivots = numbers::reduced_echelon(std::move(columns)).pivots;
  if (static_cast<Eigen::Index>(pivots.size()) == d) return;
  RationalMatrix equations = RationalMatrix::Constant(d - std::ssize(pivots), d + 1, Rational(0));
  Eigen::Index row = 0;
  for (Eigen::Index j = 0; j < d; ++j)
    if (std::find(pivots.begin(), pivots.end(), j) == pivots.end()) equations(row++, j + 1) = 1;
  impose(equations);
}

std::vector<Rational> Faces::point(const std::vector<Rational>& y) const {
  std::vector<Rational> x = origin_;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j)
      x[i] += directions_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * y[j];
  return x;
}

bool satisfies(const std::vector<RationalBlock>& blocks, const std::vector<Rational>& x) {
  return std::all_of(blocks.begin(), blocks.end(), [&](const RationalBlock& block) {
    if (!block.exact) return true;
    const RationalMatrix value = block.value(x);
    return block.strict ? numbers::is_rational_definite(value)
                        : numbers::is_rational_semidefinite(value);
  });
}

}  // namespace gainsmith::verdict
