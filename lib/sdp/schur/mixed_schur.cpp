#include "sdp/schur/mixed_schur.h"

#include <algorithm>

#include "base/scalars.h"

namespace gainsmith::sdp {
namespace {

/// B in double is tried where B in T costs as much as so many steps of refinement.
constexpr double kWorthwhile = 10;

/// Multiplications for B and its factor in T, beside those of a step of refinement.
double steps_for(const Data& data) {
  const double m = data.m();
  double factor = m * m * m / 6, step = 0;
  for (std::size_t b = 0; b < data.dense.size(); ++b) {
    const BlockData& block = data.dense[b];
    const double n = data.layout.size[b], lists = block.lists(), cube = n * n * n;
    const auto entries = static_cast<double>(block.terms.size());
    factor += std::min(2 * lists * cube, m * entries * std::min(n, entries / lists));
    step += 3 * cube + 2 * entries;
  }
  return factor / std::max(step, 1.0);
}

}  // namespace

template <typename T>
MixedSchur<T>::MixedSchur(const Data& data, unsigned threads) : data_(data), threads_(threads) {
  if constexpr (std::is_same_v<T, double>)
    schur_ = std::make_unique<Schur<T>>(data, threads);
  else if (steps_for(data) >= kWorthwhile)
    narrow_ = std::make_unique<Narrow>(data, threads);
}

template <typename T>
void MixedSchur<T>::assemble(const Blocks<T>& inverse_X, const Blocks<T>& Y, bool must_be_exact) {
  inverse_X_ = &inverse_X;
  Y_ = &Y;
  rounded_ = narrow_ && !must_be_exact && !widened_;
  if (rounded_) {
    convert(inverse_X.flat(), narrow_->inverse_X.flat());
    convert(Y.flat(), narrow_->Y.flat());
    narrow_->schur.assemble(narrow_->inverse_X, narrow_->Y);
    return;
  }
  // Made when it is first needed, for its memory.
  if (!schur_) schur_ = std::make_unique<Schur<T>>(data_, threads_);
  schur_->assemble(inverse_X, Y);
}

template <typename T>
bool MixedSchur<T>::factorise() {
  if (!rounded_) return schur_->factorise();
  return narrow_->schur.factorise() || widen();
}

template <typename T>
bool MixedSchur<T>::widen() {
  if (!rounded_) return false;
  widened_ = true;
  assemble(*inverse_X_, *Y_, true);
  return factorise();
}

// The right-hand side is scaled: its numbers may be below what double has.
template <typename T>
void MixedSchur<T>::solve(const Vector<T>& r, Vector<T>& x) {
  if (!rounded_) return schur_->solve(r, x);
  const T size = r.template lpNorm<Eigen::Infinity>();
  x.setZero(r.size());
  if (!(size > T(0))) return;
  for (Eigen::Index i = 0; i < r.size(); ++i) narrow_->r[i] = static_cast<double>(T(r[i] / size));
  narrow_->schur.solve(narrow_->r, narrow_->x);
  for (Eigen::Index i = 0; i < r.size(); ++i) x[i] = T(narrow_->x[i]) * size;
}

#define GAINSMITH_INSTANTIATE(T) template class MixedSchur<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
