#include "lmi/matrix_program.h"

#include <algorithm>
#include <map>

namespace gainsmith::lmi {

namespace {

using Program = sdp::MatrixProgram;

/// Rows or columns times units.
sdp::DenseMatrix scaled(const Sparse& matrix, const std::vector<double>& units, bool rows) {
  sdp::DenseMatrix result;
  result.rows = static_cast<int>(matrix.rows());
  result.columns = static_cast<int>(matrix.cols());
  result.values.assign(static_cast<std::size_t>(matrix.size()), 0.0);
  for (int c = 0; c < matrix.outerSize(); ++c)
    for (Sparse::InnerIterator it(matrix, c); it; ++it) {
      const auto row = static_cast<std::size_t>(it.row());
      const auto column = static_cast<std::size_t>(c);
      result.values[column * static_cast<std::size_t>(result.rows) + row] =
          it.value() * units[rows ? row : column];
    }
  return result;
}

/// Makes one program. Its variables are those of the formulation, from 0. Matrices stay in data
/// units: E and F get the units of a block's rows alone, and costs of their scalars no d_i.
class Maker {
 public:
  Maker(const Lmi& lmi, const GainBounds& bounds, const Formulation& formulation,
        const Round& round)
      : lmi_(lmi),
        bounds_(bounds),
        formulation_(formulation),
        round_(round),
        own_(lmi.unknowns + bounds.scalars) {
    for (const auto* list : {&lmi.blocks, &bounds.blocks})
      for (const Block& block : *list) blocks_.push_back(&block);
  }

  std::optional<Program> make() {
    if (!has_structure()) return std::nullopt;
    const bool interior = formulation_.goal == Goal::interior;
    const bool homogenised = formulation_.homogenised;
    // After the scalars of the Lmi and the bounds: x_0, then s.
    constant_ = homogenised ? own_ : -1;
    margin_ = interior ? own_ + (homogenised ? 1 : 0) : -1;
    program_.c.assign(static_cast<std::size_t>(interior ? margin_ + 1 : own_), 0.0);
    trace_.assign(program_.c.size(), 0.0);
    find_unknowns();
    if (is_in_scalars()) return std::nullopt;
    for (std::size_t k = 0; k < blocks_.size(); ++k) add_block(k);
    if (interior) {
      if (homogenised) program_.rows.push_back({0, {{constant_, 1}, {margin_, -round_.constant}}});
      add_trace_limit();
      program_.c.back() = -1;
    } else if (lmi_.has_objective) {
      set_costs();
    }
    return std::move(program_);
  }

 private:
  /// Whether t = 0, no scalar is free, no row is left out and every block has its products, some of
  /// them not empty.
  bool has_structure() const {
    if (round_.margin != 0 || !formulation_.free_variables.list.empty()) return false;
    const auto& kept = formulation_.free_variables.kept;
    bool some = false;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      if (!blocks_[k]->products) return false;
      if (k < kept.size() && std::ssize(kept[k]) != blocks_[k]->size) return false;
      some |= !blocks_[k]->products->empty();
    }
    return some;
  }

  /// The matrices of all blocks, in the order of their scalars.
  void find_unknowns() {
    std::map<int, MatrixUnknown> found;
    for (const Block* block : blocks_)
      for (const HermitianProduct& product : *block->products)
        found.emplace(product.unknown.first, product.unknown);
    of_matrix_.assign(program_.c.size(), false);
    for (const auto& [first, unknown] : found) {
      place_[first] = static_cast<int>(program_.unknowns.size());
      program_.unknowns.push_back({first - 1, unknown.rows, unknown.columns, unknown.symmetric});
      std::fill_n(of_matrix_.begin() + (first - 1), unknown.count(), true);
    }
  }

  /// Whether a matrix occurs in a block by its scalars, as in trace(P) < 1.
  bool is_in_scalars() const {
    return std::any_of(blocks_.begin(), blocks_.end(), [&](const Block* block) {
      std::vector<bool> in_products(of_matrix_.size(), false);
      for (const HermitianProduct& product : *block->products)
        std::fill_n(in_products.begin() + (product.unknown.first - 1), product.unknown.count(),
                    true);
      return std::any_of(block->terms.begin(), block->terms.end(), [&](const auto& term) {
        const auto at = static_cast<std::size_t>(term.first) - 1;
        return term.first > 0 && of_matrix_[at] && !in_products[at];
      });
    });
  }

  /// D_k: what a row keeps for the margin, and by what its diagonal counts in the limit.
  double diagonal(std::size_t k, int row) const {
    return round_.diagonals.empty() ? 1 : round_.diagonals[k][row];
  }

  void add_block(std::size_t k) {
    const Block& block = *blocks_[k];
    Program::Block& added = program_.blocks.emplace_back();
    added.size = block.size;
    std::vector<double> units;
    for (int r = 0; r < block.size; ++r) units.push_back(formulation_.balance.row(k, r));
    for (const HermitianProduct& product : *block.products) {
      added.products.push_back({place_.at(product.unknown.first), scaled(product.left, units, true),
                                scaled(product.right, units, false)});
      if (margin_ >= 0) add_trace(k, product, units);
    }
    for (const auto& [i, matrix] : block.terms)
      if (i == 0 || !of_matrix_[static_cast<std::size_t>(i) - 1]) add_elements(k, i, matrix, added);
    for (int r = 0; r < block.size; ++r) {
      if (margin_ >= 0)
        added.elements.push_back({margin_, r, r, -diagonal(k, r)});
      else if (k < lmi_.blocks.size() && formulation_.shift != 0)
        added.elements.push_back({-1, r, r, -formulation_.shift});
    }
  }

  void add_elements(std::size_t k, int i, const Sparse& matrix, Program::Block& added) {
    const int variable = i == 0 ? constant_ : i - 1;
    for (int c = 0; c < matrix.outerSize(); ++c)
      for (Sparse::InnerIterator it(matrix, c); it; ++it) {
        const int r = static_cast<int>(it.row());
        if (r > c || it.value() == 0) continue;
        const double value = it.value() * formulation_.balance.factor(k, r, c, i);
        added.elements.push_back({variable, r, c, value});
        if (r != c || margin_ < 0) continue;
        (variable < 0 ? constant_trace_ : trace_[static_cast<std::size_t>(variable)]) +=
            value / diagonal(k, r);
      }
  }

  /// tr(D_k^-1 S He(E V F) S) = 2 tr(W V) with W = F S D_k^-1 S E.
  void add_trace(std::size_t k, const HermitianProduct& product, const std::vector<double>& units) {
    Sparse left = product.left;
    for (int c = 0; c < left.outerSize(); ++c)
      for (Sparse::InnerIterator it(left, c); it; ++it) {
        const double unit = units[static_cast<std::size_t>(it.row())];
        it.valueRef() *= unit * unit / diagonal(k, static_cast<int>(it.row()));
      }
    const numbers::Matrix W(multiplied(product.right, left));
    const MatrixUnknown& unknown = product.unknown;
    std::size_t at = static_cast<std::size_t>(unknown.first) - 1;
    for (int j = 0; j < unknown.columns; ++j)
      for (int i = unknown.symmetric ? j : 0; i < unknown.rows; ++i)
        trace_[at++] += 2 * (unknown.symmetric && i != j ? W(i, j) + W(j, i) : W(j, i));
  }

  /// N - sum_k tr(D_k^-1 B_k(x)) - x_0 / D_0 >= 0.
  void add_trace_limit() {
    if (formulation_.homogenised)
      trace_[static_cast<std::size_t>(constant_)] += 1 / round_.constant;
    Program::Row limit{formulation_.rows - constant_trace_, {}};
    for (std::size_t i = 0; i < trace_.size(); ++i)
      if (trace_[i] != 0) limit.coefficients.emplace_back(static_cast<int>(i), -trace_[i]);
    program_.rows.push_back(std::move(limit));
  }

  /// c_i d_i of a scalar, c_i of a matrix's, in cost units.
  void set_costs() {
    for (int i = 1; i <= lmi_.unknowns; ++i) {
      const auto at = static_cast<std::size_t>(i) - 1;
      program_.c[at] = lmi_.objective[at] * formulation_.cost_unit *
                       (of_matrix_[at] ? 1.0 : formulation_.balance.unit(i));
    }
  }

  const Lmi& lmi_;
  const GainBounds& bounds_;
  const Formulation& formulation_;
  const Round& round_;
  const int own_;  ///< scalars of the Lmi and the bounds
  std::vector<const Block*> blocks_;
  Program program_;
  std::map<int, int> place_;     ///< of each matrix by its first scalar
  std::vector<bool> of_matrix_;  ///< for each variable
  int constant_ = -1;            ///< x_0
  int margin_ = -1;              ///< s
  std::vector<double> trace_;    ///< of each variable in the limit
  double constant_trace_ = 0;
};

}  // namespace

std::optional<sdp::MatrixProgram> matrix_program(const Lmi& lmi, const GainBounds& bounds,
                                                 const Formulation& formulation,
                                                 const Round& round) {
  return Maker(lmi, bounds, formulation, round).make();
}

std::vector<double> balanced_variables(const Formulation& formulation,
                                       const sdp::MatrixProgram& program,
                                       const std::vector<double>& x) {
  std::vector<double> y = x;
  for (const sdp::MatrixProgram::Unknown& unknown : program.unknowns) {
    const int count =
        unknown.symmetric ? unknown.rows * (unknown.rows + 1) / 2 : unknown.rows * unknown.columns;
    for (int i = unknown.first; i < unknown.first + count; ++i)
      y[static_cast<std::size_t>(i)] /= formulation.balance.unit(i + 1);
  }
  return y;
}

}  // namespace gainsmith::lmi
