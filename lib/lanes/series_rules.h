// The operations of series_steps.h. Included by steps_rules.h, within its namespace: nothing here may
// be shared with other sources.

constexpr std::size_t kParts = kGroup / kWidth;  ///< vectors of one order

/// Memory of any alignment.
inline V loaded(const double* x) {
  V out;
  __builtin_memcpy(&out, x, sizeof out);
  return out;
}
inline void store(V value, double* x) { __builtin_memcpy(x, &value, sizeof value); }

/// One order of one value.
struct Order {
  V part[kParts];
};

template <class Operation>
inline Order each_part(const Operation& operation) {
  Order out;
#pragma GCC unroll 4
  for (std::size_t v = 0; v < kParts; ++v) out.part[v] = operation(v);
  return out;
}

inline V* order_of(double* slots, std::uint32_t slot, std::size_t k) {
  return reinterpret_cast<V*>(slots + slot * kSlot + k * kGroup);
}
inline const V* order_of(const double* slots, std::uint32_t slot, std::size_t k) {
  return reinterpret_cast<const V*>(slots + slot * kSlot + k * kGroup);
}

/// The sum of a_j b_(k-j), j from `first` to `last`, times j where `weighted`. Four sums in every
/// variant, so that all round alike.
template <bool weighted = false>
inline Order convolution(const V* a, const V* b, std::size_t k, std::size_t first,
                         std::size_t last) {
  V sums[4][kParts];
  for (auto& sum : sums)
    for (V& part : sum) part = all(0.0);
  const auto add = [&](std::size_t sum, std::size_t j) {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < kParts; ++v) {
      V factor = a[j * kParts + v];
      if (weighted) factor *= all(static_cast<double>(j));
      sums[sum][v] = multiply_add(factor, b[(k - j) * kParts + v], sums[sum][v]);
    }
  };
  std::size_t j = first;
  for (; j + 3 <= last; j += 4) {
    add(0, j);
    add(1, j + 1);
    add(2, j + 2);
    add(3, j + 3);
  }
  for (; j <= last; ++j) add(0, j);
  return each_part(
      [&](std::size_t v) { return (sums[0][v] + sums[1][v]) + (sums[2][v] + sums[3][v]); });
}

/// Order k of a^2, by the symmetry of its sum.
inline Order square_of(const V* a, std::size_t k) {
  Order half = convolution(a, a, k, 0, k == 0 ? 0 : (k - 1) / 2);
  if (k == 0) return half;
  return each_part([&](std::size_t v) {
    const V twice = half.part[v] + half.part[v];
    const V middle = a[k / 2 * kParts + v];
    return k % 2 == 0 ? multiply_add(middle, middle, twice) : twice;
  });
}

/// A function of the numbers of a vector, one by one; l is the place of each.
template <class Function>
inline V one_by_one(V x, const Function& function) {
  for (std::size_t l = 0; l < kWidth; ++l) x[l] = function(x[l], l);
  return x;
}

/// The value `length` after the start, by Horner's rule.
inline V value_at(const V* a, V length, std::size_t v, std::size_t order = kOrder) {
  V sum = a[order * kParts + v];
  for (std::size_t k = order; k-- > 0;) sum = multiply_add(sum, length, a[k * kParts + v]);
  return sum;
}

/// One order of an operation with branches. `at`, `other`: what decides; ak, bk, ck: of the operands.
inline void branch(SeriesOp op, std::size_t k, const V* at, const V* other, const V* ak,
                   const V* bk, const V* ck, V* out) {
  for (std::size_t v = 0; v < kParts; ++v) switch (op) {
      case SeriesOp::minimum:
        out[v] = other[v] < at[v] ? bk[v] : ak[v];
        break;
      case SeriesOp::maximum:
        out[v] = at[v] < other[v] ? bk[v] : ak[v];
        break;
      case SeriesOp::where_positive:
        out[v] = at[v] > all(0.0) ? bk[v] : ck[v];
        break;
      case SeriesOp::where_nonnegative:
        out[v] = at[v] >= all(0.0) ? bk[v] : ck[v];
        break;
      case SeriesOp::sign: {
        const V side = at[v] > all(0.0) ? all(1.0) : all(0.0);
        out[v] = k > 0 ? all(0.0) : at[v] < all(0.0) ? all(-1.0) : side;
        break;
      }
      default:  // abs
        out[v] = at[v] < all(0.0) ? -ak[v] : ak[v];
    }
}

/// Where the operands and the result of order k of a step are.
struct Operands {
  const V *a, *b;         ///< all orders, of what has a slot; otherwise order 0
  const V *ak, *bk, *ck;  ///< order k
  V *r, *beside;          ///< all orders of the result, and of what is computed with it
  V* out;                 ///< order k of the result
};

/// `at`, `other_at`: what decides a branch. of_k: 1/k.
inline __attribute__((always_inline)) void run_order(SeriesOp op, std::size_t k, V of_k,
                                                     const Operands& of, const V* at,
                                                     const V* other_at) {
  const V *const a = of.a, *const b = of.b, *const ak = of.ak, *const bk = of.bk;
  V *const r = of.r, *const out = of.out;
  const auto over = [&](const auto& operation) {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < kParts; ++v) out[v] = operation(v);
  };
  switch (op) {
    case SeriesOp::integral:
      if (k > 0) over([&](std::size_t v) { return ak[v] * of_k; });
      break;
    case SeriesOp::add:
      over([&](std::size_t v) { return ak[v] + bk[v]; });
      break;
    case SeriesOp::subtract:
      over([&](std::size_t v) { return ak[v] - bk[v]; });
      break;
    case SeriesOp::negate:
      over([&](std::size_t v) { return -ak[v]; });
      break;
    case SeriesOp::multiply: {
      const Order sum = convolution(a, b, k, 0, k);
      over([&](std::size_t v) { return sum.part[v]; });
      break;
    }
    case SeriesOp::multiply_still:
      over([&](std::size_t v) { return ak[v] * b[v]; });
      break;
    case SeriesOp::square: {
      const Order sum = square_of(a, k);
      over([&](std::size_t v) { return sum.part[v]; });
      break;
    }
    case SeriesOp::divide: {
      const Order sum = convolution(b, r, k, 1, k);
      over([&](std::size_t v) { return (ak[v] - sum.part[v]) / b[v]; });
      break;
    }
    case SeriesOp::divide_still:
      over([&](std::size_t v) { return ak[v] / b[v]; });
      break;
    case SeriesOp::sqrt:
      if (k == 0) {
        over([&](std::size_t v) { return sqrt_of(a[v]); });
      } else {
        const Order sum = convolution(r, r, k, 1, k - 1);
        over([&](std::size_t v) { return (ak[v] - sum.part[v]) / (r[v] + r[v]); });
      }
      break;
    case SeriesOp::exp:
      if (k == 0) {
        over([&](std::size_t v) { return exp_of(a[v]); });
      } else {
        const Order sum = convolution<true>(a, r, k, 1, k);
        over([&](std::size_t v) { return sum.part[v] * of_k; });
      }
      break;
    case SeriesOp::log:
      if (k == 0) {
        over([&](std::size_t v) {
          return one_by_one(a[v], [](double x, std::size_t) { return __builtin_log(x); });
        });
      } else {
        const Order sum = convolution<true>(r, a, k, 1, k - 1);
        over([&](std::size_t v) { return (ak[v] - sum.part[v] * of_k) / a[v]; });
      }
      break;
    case SeriesOp::power:
      if (k == 0) {
        over([&](std::size_t v) {
          return one_by_one(a[v],
                            [&](double x, std::size_t l) { return __builtin_pow(x, b[v][l]); });
        });
      } else {
        // k a_0 r_k = sum (p j - (k - j)) a_j r_(k-j), p = b.
        const Order weighted = convolution<true>(a, r, k, 1, k);
        const Order plain = convolution(a, r, k, 1, k);
        over([&](std::size_t v) {
          return ((b[v] + all(1.0)) * weighted.part[v] * of_k - plain.part[v]) / a[v];
        });
      }
      break;
    case SeriesOp::sine_cosine: {
      V* const cosine_of = of.beside;
      V* const other = cosine_of + k * kParts;
      if (k == 0) {
        over([&](std::size_t v) { return sine<false>(a[v]); });
        for (std::size_t v = 0; v < kParts; ++v) other[v] = sine<true>(a[v]);
      } else {
        const Order up = convolution<true>(a, cosine_of, k, 1, k);
        const Order down = convolution<true>(a, r, k, 1, k);
        over([&](std::size_t v) { return up.part[v] * of_k; });
        for (std::size_t v = 0; v < kParts; ++v) other[v] = -(down.part[v] * of_k);
      }
      break;
    }
    case SeriesOp::tanh: {
      V* const slope = of.beside;
      if (k == 0) {
        over([&](std::size_t v) { return tanh_of(a[v]); });
      } else {
        const Order sum = convolution<true>(a, slope, k, 1, k);
        over([&](std::size_t v) { return sum.part[v] * of_k; });
      }
      const Order squared = square_of(r, k);
      for (std::size_t v = 0; v < kParts; ++v)
        slope[k * kParts + v] = (k == 0 ? all(1.0) : all(0.0)) - squared.part[v];
      break;
    }
    case SeriesOp::angle: {
      V* const length_squared = of.beside;
      const Order aa = square_of(a, k), bb = square_of(b, k);
      for (std::size_t v = 0; v < kParts; ++v)
        length_squared[k * kParts + v] = aa.part[v] + bb.part[v];
      if (k == 0) {
        over([&](std::size_t v) {
          return one_by_one(a[v],
                            [&](double x, std::size_t l) { return __builtin_atan2(x, b[v][l]); });
        });
      } else {
        // (a^2 + b^2) r' = b a' - a b'.
        const Order up = convolution<true>(a, b, k, 1, k);
        const Order down = convolution<true>(b, a, k, 1, k);
        const Order rest = convolution<true>(r, length_squared, k, 1, k - 1);
        over([&](std::size_t v) {
          return (up.part[v] - down.part[v] - rest.part[v]) * of_k / length_squared[v];
        });
      }
      break;
    }
    case SeriesOp::abs:
    case SeriesOp::sign:
    case SeriesOp::minimum:
    case SeriesOp::maximum:
    case SeriesOp::where_positive:
    case SeriesOp::where_nonnegative:
      branch(op, k, at, other_at, ak, bk, of.ck, out);
      break;
  }
}

inline V* slot_of(double* slots, std::uint32_t slot) {
  return reinterpret_cast<V*>(slots + slot * kSlot);
}

inline void copy_order(const V* from, V* to) {
  for (std::size_t v = 0; v < kParts; ++v) to[v] = from[v];
}

void run_flow(const FlowStep* first, const FlowStep* others, std::size_t count, std::size_t last) {
  const auto whole = [](const double* x) { return reinterpret_cast<const V*>(x); };
  const auto result = [](double* x) { return reinterpret_cast<V*>(x); };
  for (std::size_t k = 0; k <= last; ++k) {
    const V of_k = all(1.0 / static_cast<double>(k == 0 ? 1 : k));
    const FlowStep* const steps = k == 0 ? first : others;
    for (const FlowStep* one = steps; one != steps + count; ++one) {
      V* const out = result(one->out);
      const Operands of{whole(one->a),  whole(one->b),  whole(one->ak),      whole(one->bk),
                        whole(one->ck), result(one->r), result(one->beside), out};
      run_order(one->op, k, of_k, of, of.a, of.b);
      if (one->r != nullptr) copy_order(out, of.r + k * kParts);
      if (one->beside_out != nullptr) copy_order(of.beside + k * kParts, result(one->beside_out));
    }
  }
}

void run_step(const SeriesStep& step, const double* length, double* slots) {
  const auto slot = [&](const SeriesPlace& place) {
    return slot_of(slots, place.slot == kNoSlot ? 0 : place.slot);
  };
  V *const a = slot(step.a), *const b = slot(step.b), *const c = slot(step.c);
  V *const r = slot(step.out), *const beside = slot(step.beside);
  V at[kParts], other[kParts];
  for (std::size_t v = 0; v < kParts; ++v) {
    const V middle = loaded(length + v * kWidth) * all(0.5);
    at[v] = value_at(a, middle, v);
    other[v] = value_at(b, middle, v);
  }
  for (std::size_t k = 0; k <= kOrder; ++k)
    run_order(step.op, k, all(1.0 / static_cast<double>(k == 0 ? 1 : k)),
              {a, b, a + k * kParts, b + k * kParts, c + k * kParts, r, beside, r + k * kParts}, at,
              other);
}

void series_values(const std::uint32_t* slot, std::size_t count, std::size_t order,
                   const double* length, const double* slots, double* out, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i) {
    const V* const a = order_of(slots, slot[i], 0);
    for (std::size_t v = 0; v < kParts; ++v)
      store(value_at(a, loaded(length + v * kWidth), v, order), out + i * stride + v * kWidth);
  }
}

void series_growth(const std::uint32_t* slot, std::size_t count, const double* floor,
                   const double* length, const double* slots, double* last, double* before) {
  for (std::size_t v = 0; v < kParts; ++v) {
    V of_last = all(0.0), of_before = all(0.0);
    const V h = loaded(length + v * kWidth);
    for (std::size_t i = 0; i < count; ++i) {
      const V* const a = order_of(slots, slot[i], 0) + v;
      const V scale =
          all(floor[i]) + abs_of(a[0]) + h * (abs_of(a[kParts]) + h * abs_of(a[2 * kParts]));
      const V x = abs_of(a[kOrder * kParts]) / scale;
      const V y = abs_of(a[(kOrder - 1) * kParts]) / scale;
      // What is not a number stays one.
      of_last = of_last > x ? of_last : x;
      of_before = of_before > y ? of_before : y;
    }
    store(of_last, last + v * kWidth);
    store(of_before, before + v * kWidth);
  }
}
