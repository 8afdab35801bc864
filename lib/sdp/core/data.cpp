#include "sdp/core/data.h"

#include "base/scalars.h"
#include "sdp/schur/pairs.h"

namespace gainsmith::sdp {
namespace {

/// The factor of F_i in sum_i x_i F_i - tau F_0: x_i, or -tau of F_0.
template <typename T>
T multiplier(int constraint, const Vector<T>& x, const T& tau) {
  return constraint == 0 ? T(-tau) : T(x[constraint - 1]);
}

/// The sum over the terms first .. last - 1 of one F_i and their mirror images: F_i . S in one
/// block.
template <typename T>
T inner_with(const BlockData& block, std::size_t first, std::size_t last,
             const ConstMatrixMap<T>& S) {
  T off(0), on(0);
  for (std::size_t t = first; t < last; ++t) {
    const Term& term = block.terms[t];
    (term.row == term.column ? on : off) += S(term.row, term.column) * coefficient<T>(block, t);
  }
  return on + off + off;
}

/// The same without waiting for the carries of every sum.
template <>
DoubleDouble inner_with(const BlockData& block, std::size_t first, std::size_t last,
                        const ConstMatrixMap<DoubleDouble>& S) {
  PairSum off, on;
  for (std::size_t t = first; t < last; ++t) {
    const Term& term = block.terms[t];
    (term.row == term.column ? on : off).add(S(term.row, term.column), {term.value, term.rest});
  }
  return on.value() + 2 * off.value();
}

}  // namespace

template <typename T>
void adjoint(const Data& data, const Vector<T>& x, const T& tau, Blocks<T>& s) {
  s.flat().setZero();
  for (int b = 0; b < data.layout.blocks(); ++b) {
    const BlockData& block = data.dense[static_cast<std::size_t>(b)];
    auto target = s.dense(b);
    for (int k = 0; k < block.lists(); ++k) {
      const auto list = static_cast<std::size_t>(k);
      const T factor = multiplier(block.constraint[list], x, tau);
      for (std::size_t t = block.start[list]; t < block.start[list + 1]; ++t) {
        const Term& term = block.terms[t];
        target(term.row, term.column) += factor * coefficient<T>(block, t);
      }
    }
    // Terms are those of the upper triangle.
    target.template triangularView<Eigen::StrictlyLower>() = target.transpose();
  }
  auto target = s.linear();
  for (int k = 0; k < data.linear.lists(); ++k) {
    const auto list = static_cast<std::size_t>(k);
    const T factor = multiplier(data.linear.constraint[list], x, tau);
    for (std::size_t t = data.linear.start[list]; t < data.linear.start[list + 1]; ++t)
      target[data.linear.terms[t].row] += factor * coefficient<T>(data.linear, t);
  }
}

template <typename T>
T apply(const Data& data, const Blocks<T>& s, Vector<T>& r) {
  r.setZero();
  T with_f0(0);
  // F_0 is constraint 0; its product is the result, those of the others are r.
  const auto add = [&](int constraint, const T& value) {
    (constraint == 0 ? with_f0 : r[constraint - 1]) += value;
  };
  for (int b = 0; b < data.layout.blocks(); ++b) {
    const BlockData& block = data.dense[static_cast<std::size_t>(b)];
    const auto source = s.dense(b);
    for (int k = 0; k < block.lists(); ++k) {
      const auto list = static_cast<std::size_t>(k);
      add(block.constraint[list],
          inner_with(block, block.start[list], block.start[list + 1], source));
    }
  }
  const auto source = s.linear();
  for (int k = 0; k < data.linear.lists(); ++k) {
    const auto list = static_cast<std::size_t>(k);
    T sum(0);
    for (std::size_t t = data.linear.start[list]; t < data.linear.start[list + 1]; ++t)
      sum += source[data.linear.terms[t].row] * coefficient<T>(data.linear, t);
    add(data.linear.constraint[list], sum);
  }
  return with_f0;
}

#define GAINSMITH_INSTANTIATE(T)                                                 \
  template void adjoint<T>(const Data&, const Vector<T>&, const T&, Blocks<T>&); \
  template T apply<T>(const Data&, const Blocks<T>&, Vector<T>&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
