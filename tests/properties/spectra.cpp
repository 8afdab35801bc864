#include "properties/spectra.h"

#include <array>

namespace gainsmith::tests::properties {

namespace {

/// The blocks along the diagonal, the worst at a place of its own.
template <class Block>
ExactMatrix triangular(Draw& draw, int n, const Block& block) {
  ExactMatrix A(n, n);
  std::vector<int> ends(static_cast<std::size_t>(n));
  const int worst = draw.below(n);
  bool placed = false;
  for (int i = 0; i < n;) {
    const int size = i + 1 < n && draw.chance(0.4) ? 2 : 1;
    const bool here = !placed && (i + size > worst);
    placed |= here;
    block(A, i, size, here);
    for (int k = 0; k < size; ++k) ends[static_cast<std::size_t>(i + k)] = i + size;
    i += size;
  }
  for (int i = 0; i < n; ++i)
    for (int j = ends[static_cast<std::size_t>(i)]; j < n; ++j) A(i, j) = draw.between(-2, 2);
  return A;
}

}  // namespace

ExactMatrix continuous_spectrum(Draw& draw, int n, const Exact& worst, const Exact& slack) {
  return triangular(draw, n, [&](ExactMatrix& A, int i, int size, bool here) {
    const Exact part = here ? worst : -draw.hundredths(20, 300) - slack;
    const Exact turn = draw.between(1, 3);
    for (int k = 0; k < size; ++k) A(i + k, i + k) = part;
    if (size == 2) A(i, i + 1) = turn, A(i + 1, i) = -turn;
  });
}

ExactMatrix discrete_spectrum(Draw& draw, int n, const Exact& worst) {
  constexpr std::array<std::array<int, 2>, 3> kTenths = {{{6, 8}, {8, 6}, {-6, 8}}};
  return triangular(draw, n, [&](ExactMatrix& A, int i, int size, bool here) {
    const Exact modulus = here ? worst : draw.hundredths(0, 90);
    const auto& [c, s] = kTenths[static_cast<std::size_t>(draw.below(3))];
    if (size == 1) {
      A(i, i) = draw.chance(0.5) ? modulus : Exact(-modulus);
      return;
    }
    A(i, i) = A(i + 1, i + 1) = modulus * c / 10;
    A(i, i + 1) = modulus * s / 10;
    A(i + 1, i) = -A(i, i + 1);
  });
}

}  // namespace gainsmith::tests::properties
