// Certificates on the boundary of the cone, from multipliers that are only nearly one.
#include <utility>

#include "lmi/polished_multipliers.h"
#include "lmi/refutation.h"

namespace gainsmith::lmi {

namespace {

using Wide = numbers::MatrixOf<Decimal100>;

double trace_of(const numbers::MatrixOf<DoubleDouble>& Y) {
  return as<double>(DoubleDouble(Y.trace()));
}

}  // namespace

Refutation refute_polished(const Inequalities& of, const Lmi& lmi, const Formulation& formulation,
                           const Multipliers& Y) {
  // A block that a certificate does not need may keep the others from being one.
  constexpr double kShares[] = {0, 1e-8, 1e-4};
  Refutation best;
  if (!lmi.stands_for_points()) return best;
  const auto blocks = exact_blocks<Decimal100>(of, lmi, formulation);
  double whole = 0;
  for (const auto& y : Y) whole += trace_of(y);
  std::size_t looked_at = 0;
  for (const double share : kShares) {
    std::vector<WideMultiplier> kept;
    std::vector<std::size_t> which;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      if (!(trace_of(Y[k]) > 0 && trace_of(Y[k]) >= share * whole)) continue;
      kept.push_back(
          {&blocks[k], Y[k].unaryExpr([](const DoubleDouble& y) { return as<Decimal100>(y); })});
      which.push_back(k);
    }
    if (which.size() == looked_at) continue;
    looked_at = which.size();
    if (!polish(kept, lmi.unknowns)) continue;
    std::vector<Wide> polished;
    for (const auto& y : Y) polished.push_back(Wide::Zero(y.rows(), y.cols()));
    for (std::size_t a = 0; a < which.size(); ++a) polished[which[a]] = std::move(kept[a].Y);
    const Refutation found = refute<Decimal100>(lmi, blocks, polished);
    if (found.exact || found.omega < best.omega) best = found;
    if (best.exact || best.omega <= kNothing) break;
  }
  return best;
}

}  // namespace gainsmith::lmi
