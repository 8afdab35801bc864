#include "sdp/schur/product.h"

#include <algorithm>
#include <cstring>

namespace gainsmith::sdp {
namespace {

using Index = Eigen::Index;

/// A tile of C is kRegisters x kColumns vector registers: with the column of A that it is
/// multiplied by, what the machine has.
#if defined(__AVX__)
constexpr Index kVector = 4, kRegisters = 3, kColumns = 4;
#else
constexpr Index kVector = 2, kRegisters = 2, kColumns = 4;
#endif
constexpr Index kTileRows = kVector * kRegisters;
/// Rows of A and inner length that are packed at a time: a packed A stays in the second-level
/// cache, the columns of B that a tile needs in the first.
constexpr Index kInner = 256, kRows = 10 * kTileRows;

using Lanes = double __attribute__((vector_size(kVector * sizeof(double))));

/// What becomes of C: A B, C + A B or C - A B.
enum class Write { assign, add, subtract };

/// Up to kVector numbers and zeros after them.
Lanes load(const double* from, Index count) {
  Lanes result;
  if (count >= kVector) {
    std::memcpy(&result, from, sizeof result);
  } else {
    for (Index i = 0; i < kVector; ++i) result[i] = i < count ? from[i] : 0.0;
  }
  return result;
}

/// A in panels of kTileRows rows, the last one filled with zeros to whole registers.
void pack_rows(const View<const double>& a, double* to) {
  for (Index i = 0; i < a.rows; i += kTileRows) {
    const Index rows = std::min(kTileRows, a.rows - i);
    for (Index k = 0; k < a.columns; ++k)
      for (Index r = 0; r < rows; r += kVector, to += kVector) {
        const Lanes part = load(&a(i + r, k), rows - r);
        std::memcpy(to, &part, sizeof part);
      }
  }
}

void put(const Lanes& value, Write how, double* to) {
  Lanes old = {};
  if (how != Write::assign) std::memcpy(&old, to, sizeof old);
  old = how == Write::subtract ? old - value : old + value;
  std::memcpy(to, &old, sizeof old);
}

/// The first `count` lanes of it.
void put(const Lanes& value, Write how, double* to, Index count) {
  Lanes part = how == Write::assign ? Lanes{} : load(to, count);
  part = how == Write::subtract ? part - value : part + value;
  for (Index i = 0; i < kVector; ++i)
    if (i < count) to[i] = part[i];
}

/// The second factor from some place on: entry (k, j) is at[k * down + j * across].
struct Right {
  const double* at;
  Index down, across;

  Right from(Index k, Index j) const { return {at + k * down + j * across, down, across}; }
};

/// A tile of C: one panel of A times some columns of B.
template <Index registers, Index columns>
void multiply_tile(const double* a, Right b, Index inner, const View<double>& c, Write how) {
  Lanes sum[columns][registers] = {};
  for (Index k = 0; k < inner; ++k, a += registers * kVector, b.at += b.down) {
    Lanes row[registers];
#pragma GCC unroll 8
    for (Index r = 0; r < registers; ++r) std::memcpy(&row[r], a + r * kVector, sizeof row[r]);
#pragma GCC unroll 8
    for (Index q = 0; q < columns; ++q)
#pragma GCC unroll 8
      for (Index r = 0; r < registers; ++r) sum[q][r] += row[r] * b.at[q * b.across];
  }
#pragma GCC unroll 8
  for (Index q = 0; q < columns; ++q)
#pragma GCC unroll 8
    for (Index r = 0; r < registers; ++r) {
      const Index left = c.rows - r * kVector;
      if (left >= kVector)
        put(sum[q][r], how, &c(r * kVector, q));
      else
        put(sum[q][r], how, &c(r * kVector, q), left);
    }
}

/// Columns j .. of C while `columns` of them are left, from the packed rows of A.
template <Index columns>
void multiply_columns(const double* a, const Right& b, Index inner, const View<double>& c, Index& j,
                      Write how) {
  for (; j + columns <= c.columns; j += columns) {
    const Right right = b.from(0, j);
    for (Index i = 0; i < c.rows; i += kTileRows) {
      const Index rows = std::min(kTileRows, c.rows - i);
      const View<double> tile = c.part(i, j, rows, columns);
      const double* const panel = a + i * inner;
      if (rows <= kVector)
        multiply_tile<1, columns>(panel, right, inner, tile, how);
      else if (rows <= 2 * kVector)
        multiply_tile<2, columns>(panel, right, inner, tile, how);
      else
        multiply_tile<kRegisters, columns>(panel, right, inner, tile, how);
    }
  }
}

/// C = A B, C += A B or C -= A B: parts of the inner length, in each of them groups of rows of A
/// that are packed once, then all columns of B against that group.
void multiply_blocks(const View<const double>& a, const Right& b, const View<double>& c,
                     Write how) {
  static thread_local Eigen::VectorXd packed(kRows * kInner);
  for (Index k = 0; k < a.columns || k == 0; k += kInner) {
    const Index inner = std::min(kInner, a.columns - k);
    for (Index i = 0; i < a.rows; i += kRows) {
      const View<double> part = c.part(i, 0, std::min(kRows, a.rows - i), c.columns);
      pack_rows(a.part(i, k, part.rows, inner), packed.data());
      const Right right = b.from(k, 0);
      Index j = 0;
      multiply_columns<kColumns>(packed.data(), right, inner, part, j, how);
      multiply_columns<4>(packed.data(), right, inner, part, j, how);
      multiply_columns<2>(packed.data(), right, inner, part, j, how);
      multiply_columns<1>(packed.data(), right, inner, part, j, how);
    }
    if (how == Write::assign) how = Write::add;
  }
}

}  // namespace

void multiply_doubles(const View<const double>& a, const View<const double>& b,
                      const View<double>& c, Update update) {
  multiply_blocks(a, {b.data, 1, b.stride}, c,
                  update == Update::assign ? Write::assign : Write::subtract);
}

void multiply_outer_doubles(const View<const double>& a, const View<const double>& b,
                            const View<double>& c, Update update) {
  multiply_blocks(a, {b.data, b.stride, 1}, c,
                  update == Update::assign ? Write::assign : Write::subtract);
}

}  // namespace gainsmith::sdp
