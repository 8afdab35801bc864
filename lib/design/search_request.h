// What is searched besides the unknowns, with its ranges as numbers: scalars in which the
// inequalities are not affine together with the unknowns. At most one of them is bisected
// (`extreme`); the others are searched without derivatives (`over`).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"
#include "search/axis.h"
#include "search/bisect.h"

namespace gainsmith::design {

struct SearchedScalar {
  std::string name;
  search::Axis axis;
};

/// A figure of runs with gains: none where a run has no such number.
using Measure =
    std::function<std::optional<double>(const model::Instance&, const model::Gains& gains)>;

/// The figure is `extreme` when it is there, then `measure` and `minimize`, then the method's
/// objective, and without an objective the margin: the smallest one of the strict inequalities, as
/// large as it can be.
struct SearchRequest {
  std::optional<SearchedScalar> extreme;
  bool largest = true;          ///< of `extreme`; otherwise the smallest
  search::Tolerance tolerance;  ///< of the bracket of `extreme`
  std::vector<SearchedScalar> over;
  std::optional<model::Formula> minimize;
  Measure measure;           ///< called from several threads at once; the caller knows how to run
  std::string measure_name;  ///< in messages and in the record
  int evaluations = 200;     ///< of the figure, at most
  bool refine = false;       ///< move scalars and unknowns together at the end (joint_refinement.h)

  bool empty() const { return !extreme && over.empty(); }
};

/// What the problem's `search:` asks for, and the parameters that it leaves open as far as
/// `search:` does not name them. The ends of ranges have the instance's values.
SearchRequest request_of(const model::Instance& instance);

/// A scalar that stays at a value of the problem.
struct HeldScalar {
  std::string name;
  double value = 0;
};

/// The scalars that synth would search, at the instance's values, without those in `varied`.
std::vector<HeldScalar> held_scalars(const model::Instance& instance,
                                     const std::vector<std::string>& varied = {});

/// "b = 0.001, eta = 0.1"; empty without one.
std::string held_text(const std::vector<HeldScalar>& held);

/// What counts as one value unless the problem gives a tolerance: 1e-4 of the range, or of the
/// value on a logarithmic scale.
search::Tolerance default_tolerance(const search::Axis& axis);

/// A width that a person gives, or else the default.
search::Tolerance tolerance_of(const std::optional<double>& width, const search::Axis& axis);

/// The scalar with the range's ends as numbers, at the instance's values.
/// Logarithmic where search::axis() makes it so.
SearchedScalar searched_scalar(const model::Instance& instance, const model::Range& range);

/// The name of the figure: "largest T2", "trace(P1)", "objective", "margin".
std::string figure_name(const SearchRequest& request, const model::Design& design);

}  // namespace gainsmith::design
