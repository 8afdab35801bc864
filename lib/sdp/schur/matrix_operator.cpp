#include "sdp/schur/matrix_operator.h"

#include <algorithm>
#include <map>

#include "base/stop.h"
#include "sdp/core/work.h"

namespace gainsmith::sdp {
namespace {

using Dense = Matrix<double>;

double size_of(const Dense& M) { return static_cast<double>(M.size()); }

/// One dense block a block, one linear entry a row.
Layout layout_of(const MatrixProgram& program) {
  std::vector<int> sizes;
  for (const MatrixProgram::Block& block : program.blocks) sizes.push_back(block.size);
  return {std::move(sizes), static_cast<int>(program.rows.size())};
}

Dense stored(const DenseMatrix& M) {
  return ConstMatrixMap<double>(M.values.data(), M.rows, M.columns);
}

/// sum += factor G.
void add_elements(const std::vector<MatrixProgram::Element>& elements, double factor,
                  MatrixMap<double> sum) {
  for (const MatrixProgram::Element& e : elements) {
    sum(e.row, e.column) += factor * e.value;
    if (e.row != e.column) sum(e.column, e.row) += factor * e.value;
  }
}

/// <G, Q>.
double inner_with(const std::vector<MatrixProgram::Element>& elements, const Dense& Q) {
  double sum = 0;
  for (const MatrixProgram::Element& e : elements)
    sum += (e.row == e.column ? 1 : 2) * e.value * Q(e.row, e.column);
  return sum;
}

/// sum += E V F', E n x r, V r x c, F n x c: of sides that may be scaled, in the cheaper order.
void add_between(const Dense& E, const Dense& V, const Dense& F, Dense& sum) {
  const auto inner = static_cast<double>(std::min(V.rows(), V.cols()));
  spend(kBlockWork * (size_of(V) + inner * static_cast<double>(E.rows())) *
        static_cast<double>(E.rows()));
  if (V.cols() <= V.rows())
    sum.noalias() += (E * V) * F.transpose();
  else
    sum.noalias() += E * (V * F.transpose());
}

/// At most one element a column.
bool is_sparse(const Dense& M) {
  for (Eigen::Index j = 0; j < M.cols(); ++j)
    if ((M.col(j).array() != 0).count() > 1) return false;
  return true;
}

}  // namespace

Side::Side(Dense values)
    : rows_(values.rows()), columns_(values.cols()), dense_(std::move(values)) {
  row_.assign(static_cast<std::size_t>(columns_), 0);
  value_.assign(row_.size(), 0);
  for (Eigen::Index j = 0; j < columns_ && sparse_; ++j) {
    int found = 0;
    for (Eigen::Index i = 0; i < rows_ && found < 2; ++i) {
      if (dense_(i, j) == 0) continue;
      ++found;
      row_[static_cast<std::size_t>(j)] = i;
      value_[static_cast<std::size_t>(j)] = dense_(i, j);
    }
    sparse_ = found < 2;
  }
  if (sparse_) dense_.resize(0, 0);
}

Dense Side::from_left(const Dense& M) const {
  if (!sparse_) {
    spend_on<double>(static_cast<double>(M.rows()) * size_of(dense_));
    return M * dense_;
  }
  Dense result(M.rows(), columns_);
  for (Eigen::Index j = 0; j < columns_; ++j)
    result.col(j) = value_[static_cast<std::size_t>(j)] * M.col(row_[static_cast<std::size_t>(j)]);
  return result;
}

Dense Side::transposed_times(const Dense& M) const {
  if (!sparse_) {
    spend_on<double>(static_cast<double>(M.cols()) * size_of(dense_));
    return dense_.transpose() * M;
  }
  Dense result(columns_, M.cols());
  for (Eigen::Index k = 0; k < M.cols(); ++k)
    for (Eigen::Index j = 0; j < columns_; ++j)
      result(j, k) = value_[static_cast<std::size_t>(j)] * M(row_[static_cast<std::size_t>(j)], k);
  return result;
}

void Side::add_product(const Dense& M, Dense& sum) const {
  if (!sparse_) {
    spend_on<double>(static_cast<double>(M.cols()) * size_of(dense_));
    sum.noalias() += dense_ * M;
    return;
  }
  for (Eigen::Index k = 0; k < M.cols(); ++k)
    for (Eigen::Index j = 0; j < columns_; ++j)
      sum(row_[static_cast<std::size_t>(j)], k) += value_[static_cast<std::size_t>(j)] * M(j, k);
}

Dense Side::times(const Dense& M) const {
  Dense result = Dense::Zero(rows_, M.cols());
  add_product(M, result);
  return result;
}

MatrixOperator::MatrixOperator(const MatrixProgram& program)
    : program_(program), layout_(layout_of(program)), constant_(layout_) {
  std::vector<bool> in_matrix(program.c.size(), false);
  for (const MatrixProgram::Unknown& V : program.unknowns) {
    const int count = V.symmetric ? V.rows * (V.rows + 1) / 2 : V.rows * V.columns;
    std::fill_n(in_matrix.begin() + V.first, count, true);
  }
  for (std::size_t i = 0; i < in_matrix.size(); ++i)
    if (!in_matrix[i]) scalars_.push_back(static_cast<int>(i));
  for (std::size_t k = 0; k < program.blocks.size(); ++k) {
    Block& block = blocks_.emplace_back();
    add_terms(program.blocks[k], block);
    std::map<int, std::vector<MatrixProgram::Element>> by_variable;
    for (const MatrixProgram::Element& e : program.blocks[k].elements)
      by_variable[e.variable].push_back(e);
    for (auto& [variable, elements] : by_variable)
      if (variable < 0)
        add_elements(elements, 1, constant_.dense(static_cast<int>(k)));
      else
        block.scalars.push_back({variable, std::move(elements)});
  }
  for (std::size_t r = 0; r < program.rows.size(); ++r) {
    Row& row = rows_.emplace_back();
    row.coefficients.setZero(variables());
    for (const auto& [variable, value] : program.rows[r].coefficients)
      row.coefficients[variable] += value;
    constant_.linear()[static_cast<Eigen::Index>(r)] = program.rows[r].constant;
  }
}

void MatrixOperator::add_terms(const MatrixProgram::Block& from, Block& to) const {
  struct Pair {
    std::size_t unknown;
    Dense E, F;
  };
  std::vector<Pair> pairs;
  for (const MatrixProgram::Product& product : from.products) {
    Pair pair{static_cast<std::size_t>(product.unknown), stored(product.E),
              stored(product.F).transpose()};
    // He(E V F) = He(F' V E') of a symmetric V.
    if (program_.unknowns[pair.unknown].symmetric && is_sparse(pair.F) && !is_sparse(pair.E))
      pair.E.swap(pair.F);
    const bool sparse_F = is_sparse(pair.F) && !is_sparse(pair.E);
    Dense &unit = sparse_F ? pair.F : pair.E, &other = sparse_F ? pair.E : pair.F;
    // One side gets the largest element 1, the other one the factor.
    const double size = unit.cwiseAbs().maxCoeff();
    if (!(size > 0)) continue;
    unit /= size;
    other *= size;
    const auto same = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& known) {
      return known.unknown == pair.unknown && known.E == pair.E;
    });
    if (same == pairs.end())
      pairs.push_back(std::move(pair));
    else
      same->F += pair.F;
  }
  for (Pair& pair : pairs)
    to.terms.push_back({pair.unknown, Side(std::move(pair.E)), Side(std::move(pair.F))});
}

Dense MatrixOperator::unpack(std::size_t unknown, const Vector<double>& x) const {
  const MatrixProgram::Unknown& of = program_.unknowns[unknown];
  if (!of.symmetric) return ConstMatrixMap<double>(x.data() + of.first, of.rows, of.columns);
  Dense V(of.rows, of.rows);
  Eigen::Index at = of.first;
  for (Eigen::Index j = 0; j < of.rows; ++j)
    for (Eigen::Index i = j; i < of.rows; ++i) V(i, j) = V(j, i) = x[at++];
  return V;
}

void MatrixOperator::pack(std::size_t unknown, const Dense& V, Vector<double>& x) const {
  const MatrixProgram::Unknown& of = program_.unknowns[unknown];
  if (!of.symmetric) {
    MatrixMap<double>(x.data() + of.first, of.rows, of.columns) = V;
    return;
  }
  Eigen::Index at = of.first;
  for (Eigen::Index j = 0; j < of.rows; ++j)
    // The mean of both triangles, as rounding may tell them apart.
    for (Eigen::Index i = j; i < of.rows; ++i) x[at++] = 0.5 * (V(i, j) + V(j, i));
}

// The scalar V_ij = V_ji, i > j, is at two places: its part of <R, dV> is R_ij + R_ji.
void MatrixOperator::add_gradient(std::size_t unknown, const Dense& R, Vector<double>& g) const {
  const MatrixProgram::Unknown& of = program_.unknowns[unknown];
  if (!of.symmetric) {
    MatrixMap<double>(g.data() + of.first, of.rows, of.columns) += R;
    return;
  }
  Eigen::Index at = of.first;
  for (Eigen::Index j = 0; j < of.rows; ++j) {
    g[at++] += R(j, j);
    for (Eigen::Index i = j + 1; i < of.rows; ++i) g[at++] += R(i, j) + R(j, i);
  }
}

// Half of g at each of two mirror places.
Dense MatrixOperator::gradient(std::size_t unknown, const Vector<double>& g) const {
  Dense R = unpack(unknown, g);
  if (!program_.unknowns[unknown].symmetric) return R;
  R *= 0.5;
  R.diagonal() *= 2;
  return R;
}

void MatrixOperator::apply(const Vector<double>& x, Blocks<double>& S) const {
  std::vector<Dense> V;
  for (std::size_t u = 0; u < program_.unknowns.size(); ++u) V.push_back(unpack(u, x));
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    auto target = S.dense(static_cast<int>(k));
    Dense sum = Dense::Zero(target.rows(), target.cols());
    for (const Term& term : blocks_[k].terms) {
      // V F, as (F' V')'.
      const Dense right = term.F.times(V[term.unknown].transpose()).transpose();
      term.E.add_product(right, sum);
    }
    target = sum + sum.transpose();
    for (const Scalar& scalar : blocks_[k].scalars)
      add_elements(scalar.elements, x[scalar.variable], target);
  }
  for (std::size_t r = 0; r < rows_.size(); ++r)
    S.linear()[static_cast<Eigen::Index>(r)] = rows_[r].coefficients.dot(x);
}

void MatrixOperator::adjoint(const Blocks<double>& Q, Vector<double>& g) const {
  g.setZero(variables());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    // <He(E V F), Q> = 2 <V, E'Q F'> for symmetric Q.
    const Dense block = Q.dense(static_cast<int>(k));
    for (const Term& term : blocks_[k].terms)
      add_gradient(term.unknown, 2 * term.E.transposed_times(term.F.from_left(block)), g);
    for (const Scalar& scalar : blocks_[k].scalars)
      g[scalar.variable] += inner_with(scalar.elements, block);
  }
  for (std::size_t r = 0; r < rows_.size(); ++r)
    g += Q.linear()[static_cast<Eigen::Index>(r)] * rows_[r].coefficients;
}

SchurOperator::SchurOperator(const MatrixOperator& of) : of_(of), scaled_(of.blocks().size()) {}

void SchurOperator::set_scaling(const Blocks<double>& W) {
  W_ = &W;
  for (std::size_t k = 0; k < scaled_.size(); ++k) {
    check_stop();
    const Dense w = W.dense(static_cast<int>(k));
    Scaled& scaled = scaled_[k];
    scaled = {};
    for (const MatrixOperator::Term& term : of_.blocks()[k].terms) {
      scaled.E.push_back(term.E.from_left(w));
      scaled.F.push_back(term.F.from_left(w));
    }
    for (const MatrixOperator::Scalar& scalar : of_.blocks()[k].scalars) {
      Dense half = Dense::Zero(w.rows(), w.cols());
      for (const MatrixProgram::Element& e : scalar.elements) {
        half.row(e.row) += e.value * w.row(e.column);
        if (e.row != e.column) half.row(e.column) += e.value * w.row(e.row);
      }
      scaled.scalars.push_back(w * half);
    }
  }
}

void SchurOperator::apply(const Vector<double>& v, Vector<double>& Mv) const {
  Mv.setZero(of_.variables());
  unknowns_.clear();
  for (std::size_t u = 0; u < of_.program().unknowns.size(); ++u)
    unknowns_.push_back(of_.unpack(u, v));
  for (std::size_t k = 0; k < scaled_.size(); ++k) {
    const MatrixOperator::Block& block = of_.blocks()[k];
    const Scaled& scaled = scaled_[k];
    const Eigen::Index n = W_->dense(static_cast<int>(k)).rows();
    // Q = W L(v) W, then its share of L*(Q).
    Dense half = Dense::Zero(n, n);
    for (std::size_t t = 0; t < block.terms.size(); ++t)
      add_between(scaled.E[t], unknowns_[block.terms[t].unknown], scaled.F[t], half);
    Dense Q = half + half.transpose();
    for (std::size_t i = 0; i < block.scalars.size(); ++i)
      Q += v[block.scalars[i].variable] * scaled.scalars[i];
    for (const MatrixOperator::Term& term : block.terms)
      of_.add_gradient(term.unknown, 2 * term.E.transposed_times(term.F.from_left(Q)), Mv);
    for (const MatrixOperator::Scalar& scalar : block.scalars)
      Mv[scalar.variable] += inner_with(scalar.elements, Q);
  }
  const auto weights = W_->linear();
  for (std::size_t r = 0; r < of_.rows().size(); ++r) {
    const Vector<double>& a = of_.rows()[r].coefficients;
    Mv += weights[static_cast<Eigen::Index>(r)] * a.dot(v) * a;
  }
}

// A term E V F of a block of `size` rows takes E V and E'(Q F'), of size rows columns each, and E V
// F and Q F', of size^2 times min(rows, columns) and columns.
double SchurOperator::cost() const {
  double sum = 0;
  for (const MatrixOperator::Block& block : of_.blocks())
    for (const MatrixOperator::Term& term : block.terms) {
      const auto size = static_cast<double>(term.E.rows());
      const auto rows = static_cast<double>(term.E.columns());
      const auto columns = static_cast<double>(term.F.columns());
      sum += size * (2 * rows * columns + size * (columns + std::min(rows, columns)));
    }
  return sum;
}

double SchurOperator::diagonal(int scalar) const {
  double sum = 0;
  for (std::size_t k = 0; k < scaled_.size(); ++k)
    for (std::size_t i = 0; i < of_.blocks()[k].scalars.size(); ++i)
      if (of_.blocks()[k].scalars[i].variable == scalar)
        sum += inner_with(of_.blocks()[k].scalars[i].elements, scaled_[k].scalars[i]);
  const auto weights = W_->linear();
  for (std::size_t r = 0; r < of_.rows().size(); ++r) {
    const double a = of_.rows()[r].coefficients[scalar];
    sum += weights[static_cast<Eigen::Index>(r)] * a * a;
  }
  return sum;
}

}  // namespace gainsmith::sdp
