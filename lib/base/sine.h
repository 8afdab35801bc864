// The sine with the same bits on every machine, for draws: that of the C library depends on the
// instructions that it finds.
#pragma once

namespace gainsmith {

/// sin(x) to some units in the last place of 1, for |x| <= 1e6. Without branches: T is a double, or
/// a vector of them. With k the whole number nearest to x / (pi/2), r = x - k pi/2 has |r| <= pi/4
/// (reduction of Cody and Waite); sin(r) and cos(r) are the polynomials of fdlibm.
template <class T>
[[gnu::always_inline]] inline T sine(T x) {
  // To add and subtract 1.5 2^52 rounds to a whole number.
  constexpr double round = 0x1.8p52;
  const T k = (x * 6.36619772367581382433e-01 + round) - round;
  // pi/2 in parts of 33 bits (fdlibm): the products are exact.
  const T r = ((x - k * 1.57079632673412561417e+00) - k * 6.07710050630396597660e-11) -
              k * 2.02226624879595063154e-21;
  const T z = r * r;
  const T odd =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 +
                                                                z * 1.58969099521155010221e-10)))));
  const T even =
      1 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  // k modulo 4, from -2 to 2: half turns change the sign, quarter turns take the cosine.
  const T half = (k * 0.5 + round) - round;
  const T quarter = k - 2 * half;
  const T turns = half - 2 * ((half * 0.5 + round) - round);
  const T size = quarter == 0 ? odd : quarter * even;
  return turns == 0 ? size : -size;
}

}  // namespace gainsmith
