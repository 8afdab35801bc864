#include "linear/model.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "expr/program/square_of_norm.h"
#include "linear/proof.h"
#include "linear/quadratic_parts.h"
#include "linear/tolerances.h"
#include "linear/wide_function.h"
#include "numbers/types/degree.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;
using expr::Program;
using hybrid::StateLayout;
using model::ClaimKind;

/// Whether a program is affine in what `varies` and does not ask for the timer.
bool is_affine(const expr::Program& program, const StateLayout& layout,
               const std::set<std::string>& varies) {
  const auto degrees =
      numbers::degrees(program, [&](const std::string& name) { return varies.contains(name); });
  return degrees[static_cast<std::size_t>(program.result)] != numbers::kNotAffine &&
         !program.uses(layout.timer);
}

/// Writes rows of `out` for an affine program of x = X [xi; 1].
void set_rows(const hybrid::Slot& slot, WideFunction& function, const Wide& X, Wide& out) {
  const Index last = X.cols() - 1;
  const Index rows = slot.shape.size();
  const Wide still = X.col(last);
  const Wide constant = function(still).reshaped();
  for (Index j = 0; j < last; ++j)
    out.block(slot.offset, j, rows, 1) = function(still + X.col(j)).reshaped() - constant;
  out.block(slot.offset, last, rows, 1) = constant;
}

/// The start as a map of what is drawn and 1; false when it is none.
bool find_start(LinearModel& linear) {
  const SampledSystem& sampled = *linear.sampled;
  const Coordinates& coordinates = *linear.coordinates;
  for (std::size_t k = 0; k < sampled.variable.size(); ++k) {
    const auto& rule = linear.scenario->starts[sampled.variable[k]];
    if (!rule) return false;
    if (rule->kind == model::StartKind::expression) continue;
    for (int e = 0; e < sampled.layout.slots[k].shape.size(); ++e)
      linear.drawn.push_back({sampled.variable[k], e});
  }
  const auto m = static_cast<Index>(linear.drawn.size());
  Wide X = Wide::Zero(sampled.layout.size, m + 1);
  Index next = 0;
  std::set<std::string> varies;  // from run to run
  for (std::size_t k = 0; k < sampled.variable.size(); ++k) {
    const hybrid::StartRule& rule = *linear.scenario->starts[sampled.variable[k]];
    const hybrid::Slot& slot = sampled.layout.slots[k];
    if (rule.kind == model::StartKind::expression) {
      if (!is_affine(rule.program, sampled.layout, varies)) return false;
      WideFunction value(rule.program, sampled.layout, coordinates.constants);
      set_rows(slot, value, X, X);
    } else {
      for (int e = 0; e < slot.shape.size(); ++e) X(slot.offset + e, next++) = Decimal100(1);
    }
    if (!X.block(slot.offset, 0, slot.shape.size(), m).isZero(0)) varies.insert(slot.name);
  }
  Wide S = Wide::Zero(coordinates.layout.size, m + 1);
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const expr::Program& start = coordinates.list[i].start;
    if (!is_affine(start, sampled.layout, varies)) return false;
    WideFunction value(start, sampled.layout, coordinates.constants);
    set_rows(coordinates.layout.slots[i], value, X, S);
  }
  remove_noise(S, largest_of(S));
  // Without what no coordinate depends on.
  std::vector<Index> kept;
  std::vector<DrawnElement> drawn;
  for (Index j = 0; j < m; ++j)
    if (!S.col(j).isZero(0)) {
      kept.push_back(j);
      drawn.push_back(linear.drawn[static_cast<std::size_t>(j)]);
    }
  kept.push_back(m);
  linear.drawn = std::move(drawn);
  linear.S = S(Eigen::all, kept);
  return true;
}

/// [M c; 0 last] of a map, or M alone without a constant.
Wide homogeneous(const Wide& M, const Wide& c, bool constant, int last) {
  if (!constant) return M;
  const Index n = M.rows();
  Wide whole = Wide::Zero(n + 1, M.cols() + 1);
  whole.topLeftCorner(n, M.cols()) = M;
  whole.block(0, M.cols(), n, 1) = c;
  whole(n, M.cols()) = Decimal100(last);
  return whole;
}

/// Lengths at which the range of a jump that depends on them is found.
constexpr int kRangeLengths = 5;

/// x, and the maps of x; false: the jump is of another kind.
bool set_maps(LinearModel& linear) {
  const Coordinates& coordinates = *linear.coordinates;
  const Index m = linear.S.cols() - 1;
  std::vector<bool> same;
  for (Index e = 0; e < linear.S.rows(); ++e) same.push_back(linear.S.row(e).head(m).isZero(0));
  auto made = LinearJump::make(coordinates, linear.S.rightCols(1), same);
  if (!made) return false;
  linear.jump = std::make_shared<const LinearJump>(std::move(*made));
  const LinearJump& jump = *linear.jump;
  const std::vector<Index>& x = jump.elements();
  const auto n = static_cast<Index>(x.size());
  // All lengths together, since x behind a jump is in one range.
  Wide maps(n, 0);
  Wide constant = Wide::Zero(n, 1);
  for (const bool first : {true, false})
    for (int k = 0; k < (jump.varies() ? kRangeLengths : 1); ++k) {
      const double low = first ? linear.first_low : linear.low;
      const double high = first ? linear.first_high : linear.high;
      const Wide map = jump(Decimal100(low + k * (high - low) / (kRangeLengths - 1)), first);
      constant = map.rightCols(1);
      if (jump.varies() && !constant.isZero(0)) return false;
      Wide more(n, maps.cols() + n);
      more << maps, map.leftCols(n);
      maps = std::move(more);
    }
  const Wide S = linear.S(x, Eigen::all);
  const Wide inputs = coordinates.constant(x, Eigen::all);
  linear.constant = !inputs.isZero(0) || !constant.isZero(0) || !S.rightCols(1).isZero(0);
  linear.A = homogeneous(coordinates.linear(x, x), inputs, linear.constant, 0);
  // [J(s_1), J(s_2), ...] = B [D(s_1), D(s_2), ...]: the columns of B span the range of these
  // jumps.
  const RankFactors factors = rank_factors(maps);
  linear.jump_rows = factors.rows;
  linear.B = homogeneous(factors.B, constant, linear.constant, 1);
  linear.S =
      linear.constant ? homogeneous(S.leftCols(m), S.rightCols(1), true, 1) : Wide(S.leftCols(m));
  return true;
}

/// The form over x alone; none: it needs clocks.
std::optional<Wide> over_elements(const Wide& Q, const std::vector<Index>& x) {
  std::vector<Index> kept = x;
  kept.push_back(Q.rows() - 1);
  for (Index e = 0; e < Q.rows(); ++e)
    if (!Q.row(e).isZero(0) && std::find(kept.begin(), kept.end(), e) == kept.end())
      return std::nullopt;
  return Wide(Q(kept, kept));
}

/// The form over x with or without a last coordinate 1. None: it has terms that need more.
std::optional<Wide> form_over(const Wide& whole, const LinearModel& linear) {
  auto Q = over_elements(whole, linear.jump->elements());
  if (!Q || linear.constant) return Q;
  const Index n = Q->rows() - 1;
  if (!Q->row(n).isZero(0)) return std::nullopt;
  return Wide(Q->topLeftCorner(n, n));
}

/// The parts of a quadratic function whose factors depend on the timer alone.
bool add_parts(const Program& function, const LinearModel& linear, std::vector<LinearForm>& forms) {
  const auto parts = quadratic_parts(function, *linear.coordinates);
  if (!parts) return false;
  const StateLayout& layout = linear.coordinates->layout;
  for (const QuadraticPart& part : *parts) {
    if (part.factor && std::any_of(layout.slots.begin(), layout.slots.end(),
                                   [&](const auto& slot) { return part.factor->uses(slot.name); }))
      return false;
    const auto Q = form_over(part.matrix, linear);
    if (!Q) return false;
    forms.push_back({part.factor, *Q});
  }
  return true;
}

/// The form of a cost, nowhere negative, with constant coefficients; none: it is no such form.
std::optional<Wide> cost_form(const Program& cost, const LinearModel& linear) {
  const auto parts = quadratic_parts(cost, *linear.coordinates);
  if (!parts || parts->size() > 1) return std::nullopt;
  const Index n = linear.A.rows();
  if (parts->empty()) return Wide(Wide::Zero(n, n));
  if (parts->front().factor) return std::nullopt;
  auto Q = form_over(parts->front().matrix, linear);
  if (!Q || !is_semidefinite(*Q)) return std::nullopt;
  return Q;
}

/// The factor of `shrinks` and the bound of `below`; none where it moves.
std::optional<double> constant(const Program& program, const LinearModel& linear) {
  const StateLayout& layout = linear.coordinates->layout;
  for (const expr::Input& input : program.inputs)
    if (layout.moves(input.name)) return std::nullopt;
  WideFunction value(program, layout, linear.coordinates->constants);
  return static_cast<double>(value(Wide::Zero(layout.size, 1))(0));
}

/// The parts of a value, or of the square of a norm: norm(e) is the root of e'e, which is a form.
bool add_squares(const Program& value, const LinearModel& linear, LinearClaim& made) {
  if (add_parts(value, linear, made.value)) return true;
  made.value.clear();
  const auto square = expr::square_of_norm(value);
  made.squared = square.has_value();
  return square && add_parts(*square, linear, made.value);
}

/// What the value grows by at most along a flow; false where no bound is found.
bool set_growth(const LinearModel& linear, LinearClaim& made) {
  Wide Q = Wide::Zero(linear.A.rows(), linear.A.rows());
  for (const LinearForm& form : made.value) {
    if (form.factor) return false;
    Q += form.Q;
  }
  const auto rate = growth_along_flows(Q, linear.A, linear.longest());
  if (rate) made.growth = std::exp(*rate * linear.longest()) * kBoundSlack;
  return rate.has_value();
}

/// `functions`: the first of those of the claim.
bool add_claim(const claims::Claim& claim, const Program* functions, LinearModel& linear) {
  if (claim.after > 0 || claim.over) return false;
  if (claim.tolerance > 0 && claim.kind != ClaimKind::nonincreasing) return false;
  LinearClaim& made = linear.claims.emplace_back();
  made.kind = claim.kind;
  made.tolerance = claim.tolerance;
  const Program& value = *functions++;
  switch (claim.kind) {
    case ClaimKind::nonincreasing:
      return add_parts(value, linear, made.value);
    case ClaimKind::cost:
      if (claim.flow_cost && !(made.flow_cost = cost_form(*functions++, linear))) return false;
      if (claim.jump_cost && !(made.jump_cost = cost_form(*functions++, linear))) return false;
      return add_parts(value, linear, made.value);
    case ClaimKind::shrinks:
      made.factor = constant(*functions, linear).value_or(0);
      return made.factor > 0 && add_squares(value, linear, made);
    case ClaimKind::below: {
      const auto bound = constant(*functions, linear);
      made.bound = bound.value_or(0);
      return bound && !claim.always && linear.jump_rows.size() <= kMostPeakRank &&
             add_squares(value, linear, made) && set_growth(linear, made);
    }
    default:
      return false;
  }
}

/// Ranges of lengths. A first length that the campaign gives leaves no range.
void set_lengths(LinearModel& linear) {
  const hybrid::System& system = *linear.sampled->dynamics;
  const hybrid::System::Clock& clock = *system.clocks.front();
  linear.low = clock.low;
  linear.high = clock.high;
  linear.first_low = clock.first ? clock.first->first : clock.low;
  linear.first_high = clock.first ? clock.first->second : clock.high;
  const auto& given = linear.scenario->first;
  if (!given.empty() && given.front()) linear.first_low = linear.first_high = *given.front();
}

}  // namespace

std::optional<Wide> LinearModel::D(const Decimal100& length, bool first) const {
  const auto r = static_cast<Index>(jump_rows.size());
  const Wide map = (*jump)(length, first);
  const Index n = map.rows();
  const Wide J = map.leftCols(n);
  const Wide rows = J(jump_rows, Eigen::all);
  // J - B D, which is to be 0 but for rounding.
  Wide rest = J - numbers::times<Decimal100>(Wide(B.topLeftCorner(n, r)), rows);
  remove_noise(rest, largest_of(J));
  if (!rest.isZero(0)) return std::nullopt;
  return homogeneous(rows, Wide::Zero(r, 1), constant, 1);
}

std::optional<LinearModel> make_linear_model(const SampledSystem& sampled,
                                             const hybrid::Scenario& scenario,
                                             const Coordinates& coordinates,
                                             const std::vector<claims::Claim>& claims) {
  LinearModel linear;
  linear.sampled = &sampled;
  linear.scenario = &scenario;
  linear.coordinates = &coordinates;
  set_lengths(linear);
  if (!find_start(linear) || !set_maps(linear)) return std::nullopt;
  if (flow_norm(linear.A, linear.longest()) > kLongestFlow) return std::nullopt;
  const Program* functions = coordinates.functions.data();
  for (const claims::Claim& claim : claims) {
    if (!claim.stated()) continue;
    if (!add_claim(claim, functions, linear)) return std::nullopt;
    functions += claims::programs_of(claim).size();
  }
  return linear;
}

}  // namespace gainsmith::linear
