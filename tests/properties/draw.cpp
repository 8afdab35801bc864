#include "properties/draw.h"

namespace gainsmith::tests::properties {

Draw::Draw(std::uint64_t seed, std::uint64_t index, std::optional<OtherUnits> others)
    : stream_(seed, index) {
  if (others) {
    others_.emplace(others->seed ^ seed, index);
    others_two_ = others->powers_of_two;
  }
  yes_ = chance(0.5);
  units_ = chance(0.5);
  const int shear = below(8);
  shear_ = shear < 4 ? 0 : shear < 7 ? 1 : 2;
  const int near = below(4);
  closeness_ = near < 2 ? 0 : near - 1;
}

Exact Draw::distance(bool boundary) {
  const Exact sign = yes_ ? 1 : -1;
  if (closeness_ == 0) return sign * hundredths(5, 100);
  if (boundary && !yes_ && chance(0.2)) return 0;
  if (closeness_ == 1) return sign * between(1, 10) * ten_to(-between(3, 6));
  return sign * ten_to(-6);
}

Exact Draw::small_distance(bool boundary) { return distance(boundary) / 2; }

Exact Draw::unit() {
  Exact result = 1;
  // Of twos and fives: the inverse is a decimal too.
  if (units_) result = ten_to(between(-6, 6)) * two_to(between(0, 3));
  if (!others_) return result;
  const auto drawn = [&](int count) { return static_cast<int>(others_->uniform() * count); };
  result *= two_to(drawn(21) - 10);
  if (!others_two_) result *= ten_to(drawn(7) - 3);
  return result;
}

Coordinates Draw::shears(int n) {
  Coordinates result{ExactMatrix::identity(n), ExactMatrix::identity(n)};
  if (n < 2 || shear_ == 0) return result;
  const int count = shear_ == 1 ? n : 1;
  for (int k = 0; k < count; ++k) {
    const int i = below(n);
    const int j = (i + 1 + below(n - 1)) % n;
    const int size = shear_ == 1 ? between(1, 3) : 10000;
    const Exact factor = chance(0.5) ? size : -size;
    ExactMatrix S = ExactMatrix::identity(n);
    S(i, j) = factor;
    result.T = result.T * S;
    S(i, j) = -factor;
    result.inverse = S * result.inverse;
  }
  return result;
}

Coordinates Draw::scales(int n) {
  std::vector<Exact> units;
  std::vector<Exact> inverses;
  for (int i = 0; i < n; ++i) {
    units.push_back(unit());
    inverses.push_back(1 / units.back());
  }
  return {ExactMatrix::diagonal(units), ExactMatrix::diagonal(inverses)};
}

Coordinates Draw::coordinates(int n) {
  const Coordinates sheared = shears(n);
  const Coordinates scaled = scales(n);
  return {sheared.T * scaled.T, scaled.inverse * sheared.inverse};
}

ExactMatrix symmetric(Draw& draw, int n) {
  ExactMatrix F(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j) F(i, j) = F(j, i) = draw.between(-5, 5);
  return F;
}

}  // namespace gainsmith::tests::properties
