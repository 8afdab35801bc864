#include "design/certificates.h"

#include <functional>
#include <initializer_list>
#include <utility>

#include "base/stop.h"
#include "verdict/boundary_refutation.h"
#include "verdict/solved_multipliers.h"

namespace gainsmith::design {

namespace {

bool excludes(const verdict::Refutation& found) {
  return found.exact || found.backward_error <= verdict::kNothing;
}

/// The certificates of certificates.h, each with its own work, for one interior solution.
class Certificates {
 public:
  Certificates(const Posed& posed, const Effort& effort, const lmi::Formulation& formulation)
      : posed_(posed), effort_(effort), formulation_(formulation) {}

  bool in_double() const { return effort_.precision == "auto"; }

  /// Steps 1 and 6: the solver's multipliers as they are.
  verdict::Refutation exact(const sdp::Solution& solution, verdict::Exactness exactness) const {
    const auto Y = multipliers(solution);
    auto found =
        verdict::refute<DoubleDouble>(posed_.inequalities, posed_.lmi, formulation_, Y, exactness);
    // 31 digits have the range of double: what underflows there is in the file all the same.
    if (found.exact && posed_.wide)
      found =
          verdict::refute<Decimal100>(posed_.inequalities, posed_.lmi, formulation_, Y, exactness);
    return found;
  }

  /// It takes the time of several others, which decide as well; it alone is exact. So it is for
  /// those who are told more than a verdict.
  verdict::Refutation by_eigenvalue() const {
    if (!posed_.check.describe) return {};
    constexpr double kWorth = 0.5;  // what is spent here the other certificates lack
    const Allowance allowance(kWorth);
    std::optional<verdict::AlgebraicCertificate> found;
    try {
      found = verdict::algebraic_certificate(posed_.inequalities, posed_.lmi);
    } catch (const OutOfAllowance&) {
    }
    if (!found) return {};
    return {true, 0, kWideDigits,
            std::make_shared<const verdict::AlgebraicCertificate>(*std::move(found))};
  }

  /// Step 3: with the solution beside them.
  verdict::Refutation on_boundary(const sdp::Solution& solution) const {
    return verdict::refute_on_boundary(posed_.inequalities, posed_.lmi, formulation_, solution);
  }

  /// One program in double, of the unchanged inequalities.
  verdict::Refutation by_violation(const Solve& solve) const {
    if (!in_double() || !formulation_.homogenised) return {};
    const lmi::Formulation violation = lmi::formulate_violation(posed_.lmi);
    const sdp::Solution solution = solve(violation.problem, {"double", 1e-10});
    if (solution.x.empty() || !(lmi::interior_margin(solution) < 0)) return {};
    return verdict::refute_by_violation(posed_.inequalities, posed_.lmi, violation, solution);
  }

  /// The same of homogeneous inequalities, one unknown of which is a scale.
  verdict::Refutation by_violation_in_scale(const Solve& solve) const {
    if (!in_double() || formulation_.homogenised) return {};
    const auto scale = lmi::find_scale(posed_.lmi, posed_.inequalities.unknowns);
    if (!scale) return {};
    const lmi::Formulation violation = lmi::formulate_violation(lmi::scaled(posed_.lmi, *scale));
    const sdp::Solution solution = solve(violation.problem, {"double", 1e-10});
    if (solution.x.empty() || !(lmi::interior_margin(solution) < 0)) return {};
    return verdict::refute_by_violation(posed_.inequalities, posed_.lmi, *scale, violation,
                                        solution);
  }

 private:
  verdict::Multipliers multipliers(const sdp::Solution& solution) const {
    return verdict::multipliers_of(formulation_, posed_.lmi.blocks.size(), solution);
  }

  const Posed& posed_;
  const Effort& effort_;
  const lmi::Formulation& formulation_;
};

}  // namespace

verdict::Refutation find_certificate(const Posed& posed, const Effort& effort,
                                     const lmi::Formulation& formulation,
                                     const sdp::Solution& solution, const Solve& solve) {
  if (!posed.lmi.represents_points()) return {};
  // With more of a margin than this no certificate is near.
  constexpr double kNear = 1e-6;
  const Certificates certificates(posed, effort, formulation);
  verdict::Refutation first;  // that excludes but is not exact
  const auto decides = [&](const verdict::Refutation& found) {
    if (excludes(found) && !excludes(first)) first = found;
    return found.exact;
  };
  verdict::Refutation found = certificates.exact(solution, verdict::Exactness::in_double);
  if (found.exact) return found;
  const bool near = lmi::interior_margin(solution) <= kNear;
  if (posed.wide && near)
    for (const auto& make : std::initializer_list<std::function<verdict::Refutation()>>{
             [&] { return certificates.by_eigenvalue(); },
             [&] { return certificates.on_boundary(solution); },
             [&] { return certificates.by_violation(solve); },
             [&] { return certificates.by_violation_in_scale(solve); }})
      if (const auto made = make(); decides(made)) return made;
  found = certificates.exact(solution, verdict::Exactness::in_wide);
  if (found.exact) return found;
  return excludes(first) ? first : found;
}

}  // namespace gainsmith::design
