#include "linear/length_table.h"

#include <algorithm>
#include <cmath>

#include "linear/tolerances.h"

namespace gainsmith::linear {

namespace {

using Series = std::vector<Decimal100>;

double size_of(const Decimal100& x) { return std::abs(static_cast<double>(x)); }

/// cos(pi k/degree), k = 0, ..., 2 degree - 1.
Series cosines(int degree) {
  Series values;
  for (int k = 0; k < 2 * degree; ++k)
    values.emplace_back(cos(pi<Decimal100>() * Decimal100(k) / Decimal100(degree)));
  return values;
}

/// The functions at the points cos(pi k/degree); those of half the degree are among them.
class Points {
 public:
  Points(double middle, double scale, const WideFunctions& functions)
      : middle_(middle), scale_(scale), functions_(functions) {}

  const std::vector<Series>& of(int degree) {
    const Series cosine = cosines(degree);
    std::vector<Series> values;
    for (int k = 0; k <= degree; ++k) {
      const auto at = static_cast<std::size_t>(k);
      values.push_back(k % 2 == 0 && !values_.empty()
                           ? std::move(values_[at / 2])
                           : functions_(Decimal100(middle_) + cosine[at] / Decimal100(scale_)));
    }
    values_ = std::move(values);
    return values_;
  }

 private:
  double middle_, scale_;
  const WideFunctions& functions_;
  std::vector<Series> values_;
};

/// The coefficients of Chebyshev polynomials, by function: of the polynomial of this degree through
/// the points.
/// c_i = 2/(N p_i) sum_k f_k cos(pi i k/N)/p_k, p_0 = p_N = 2 and p_k = 1 elsewhere: a discrete
/// cosine transform, N the degree.
std::vector<Series> interpolated(const std::vector<Series>& values, int degree) {
  const Series cosine = cosines(degree);
  std::vector<Series> series(values.front().size(), Series(values.size()));
  for (std::size_t f = 0; f < series.size(); ++f)
    for (int i = 0; i <= degree; ++i) {
      Decimal100 sum(0);
      for (int k = 0; k <= degree; ++k) {
        const Decimal100 term = values[static_cast<std::size_t>(k)][f] *
                                cosine[static_cast<std::size_t>(i * k % (2 * degree))];
        sum += k == 0 || k == degree ? Decimal100(term / 2) : term;
      }
      const int parts = i == 0 || i == degree ? degree * 2 : degree;
      series[f][static_cast<std::size_t>(i)] = sum * Decimal100(2) / Decimal100(parts);
    }
  return series;
}

double sum_of_sizes(const Series& series) {
  double sum = 0;
  for (const Decimal100& decimal100 : series) sum += size_of(decimal100);
  return sum;
}

/// Whether what is left out is negligible: the last quarter of the coefficients is.
bool follows(const Series& series) {
  double most = 0, tail = 0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    most = std::max(most, size_of(series[i]));
    if (4 * i >= 3 * series.size()) tail = std::max(tail, size_of(series[i]));
  }
  return tail <= kLengthTail * most;
}

/// In powers of sigma, of T_0 = 1, T_1 = sigma, T_(i+1) = 2 sigma T_i - T_(i-1).
Series in_powers(const Series& series, std::size_t degree) {
  Series powers(degree + 1, Decimal100(0));
  Series before(degree + 1, Decimal100(0)), now(degree + 1, Decimal100(0));
  before[0] = Decimal100(1);
  if (degree > 0) now[1] = Decimal100(1);
  powers[0] = series[0];
  for (std::size_t i = 1; i <= degree; ++i) {
    for (std::size_t k = 0; k <= i; ++k) powers[k] += series[i] * now[k];
    Series next(degree + 1, Decimal100(0));
    for (std::size_t k = 0; k < degree; ++k) next[k + 1] = now[k] * Decimal100(2);
    for (std::size_t k = 0; k <= degree; ++k) next[k] -= before[k];
    before = std::move(now);
    now = std::move(next);
  }
  return powers;
}

/// The series to where the rest is negligible, and that rest.
std::size_t cut_degree(const Series& series, double& rest) {
  double most = 0;
  for (const Decimal100& decimal100 : series) most = std::max(most, size_of(decimal100));
  std::size_t degree = series.size() - 1;
  rest = 0;
  while (degree > 0 && rest + size_of(series[degree]) <= kLengthRest * most)
    rest += size_of(series[degree--]);
  return degree;
}

}  // namespace

std::optional<WideTable> make_wide_table(double from, double to, const WideFunctions& functions) {
  WideTable table;
  table.middle = from + (to - from) / 2;
  // A little smaller, so that no length lies outside.
  if (to > from) table.scale = (1 - 0x1p-40) * 2 / (to - from);
  if (table.scale == 0 || !std::isfinite(table.scale)) {
    table.scale = 0;
    table.middle = to;
    for (const Decimal100& value : functions(Decimal100(to))) {
      table.powers.push_back({value});
      table.errors.push_back(0);
    }
    return table;
  }
  Points points(table.middle, table.scale, functions);
  for (int degree = kMostLengthDegree / 4; degree <= kMostLengthDegree; degree *= 2) {
    std::vector<Series> all = interpolated(points.of(degree), degree);
    // What is nothing but rounding of 100 digits is 0.
    double most = 0;
    for (const Series& series : all)
      for (const Decimal100& value : series) most = std::max(most, size_of(value));
    for (Series& series : all)
      if (std::all_of(series.begin(), series.end(), [&](const Decimal100& value) {
            return size_of(value) <= kLengthNoise * most;
          }))
        std::fill(series.begin(), series.end(), Decimal100(0));
    const auto has_faded = [&](const Series& series) {
      return sum_of_sizes(series) <= kLengthFaded * most;
    };
    if (!std::all_of(all.begin(), all.end(),
                     [&](const Series& series) { return has_faded(series) || follows(series); }))
      continue;
    for (const Series& series : all) {
      // Below kLengthFaded of the largest: 0, with the sum of its coefficients as its error.
      if (has_faded(series)) {
        table.powers.push_back({Decimal100(0)});
        table.errors.push_back(2 * sum_of_sizes(series));
        continue;
      }
      double rest = 0;
      const std::size_t cut = cut_degree(series, rest);
      table.powers.push_back(in_powers(series, cut));
      table.errors.push_back(2 * rest);
    }
    return table;
  }
  return std::nullopt;
}

/// Powers in double. The error grows by (4 k + 3) u |c_k| a coefficient, u the unit roundoff.
LengthTable rounded(const WideTable& wide) {
  LengthTable table{wide.middle, wide.scale, {}};
  for (std::size_t f = 0; f < wide.powers.size(); ++f) {
    LengthTable::Polynomial& made = table.functions.emplace_back();
    made.error = wide.errors[f];
    for (std::size_t k = 0; k < wide.powers[f].size(); ++k) {
      made.powers.push_back(static_cast<double>(wide.powers[f][k]));
      const double size = std::abs(made.powers.back());
      made.size += size;
      // The coefficient, at most 2 k + 2 products and sums, and sigma^k, each factor of which is
      // rounded twice.
      made.error += (4 * static_cast<double>(k) + 3) * kUnitRoundoff * size;
    }
    made.size += made.error;
  }
  return table;
}

void PieceTable::values(double length, double* out, std::size_t stride) const {
  const auto end = std::lower_bound(ends.begin(), ends.end() - 1, length);
  const LengthTable& piece = pieces[static_cast<std::size_t>(end - ends.begin())];
  const double sigma = piece.scale * (length - piece.middle);
  for (const LengthTable::Polynomial& function : piece.functions) {
    double sum = function.powers.back();
    for (std::size_t k = function.powers.size() - 1; k-- > 0;)
      sum = sum * sigma + function.powers[k];
    *out = sum;
    out += stride;
  }
}

std::optional<PieceTable> make_piece_table(double from, double to, double shortest,
                                           const WideFunctions& functions) {
  PieceTable table;
  for (double start = from, end = shortest; table.pieces.empty() || start < to; end *= 2) {
    if (start < to && end <= start) continue;
    const double last = start < to ? std::min(end, to) : to;
    const auto wide = make_wide_table(start, last, functions);
    if (!wide) return std::nullopt;
    table.ends.push_back(last);
    table.pieces.push_back(rounded(*wide));
    start = last;
  }
  // Of several pieces the whole keeps the largest sizes and errors, which bound all of them.
  table.whole = table.pieces.front();
  for (std::size_t k = 1; k < table.pieces.size(); ++k)
    for (std::size_t f = 0; f < table.whole.functions.size(); ++f) {
      LengthTable::Polynomial& function = table.whole.functions[f];
      function.powers.clear();
      function.size = std::max(function.size, table.pieces[k].functions[f].size);
      function.error = std::max(function.error, table.pieces[k].functions[f].error);
    }
  return table;
}

}  // namespace gainsmith::linear
