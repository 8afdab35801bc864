#include "design/facial_reduction.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/rational.h"
#include "design/face_program.h"
#include "design/gain_values.h"
#include "design/minimum.h"
#include "numbers/dense/dense.h"
#include "numbers/dense/rational_algebra.h"
#include "verdict/algebraic_multipliers.h"
#include "verdict/face_multipliers.h"
#include "verdict/faces.h"
#include "verdict/printable.h"
#include "verdict/solved_multipliers.h"
#include "verdict/weak_duality.h"

namespace gainsmith::design {

namespace {

using verdict::Faces;
using verdict::RationalBlock;

/// Beyond these sizes of what equations leave fractions take too long.
constexpr int kMostUnknowns = 100;
constexpr int kMostRows = 120;

std::vector<std::string> names_of(const lmi::Lmi& lmi, const lmi::GainBounds& bounds) {
  std::vector<std::string> names;
  for (const auto* list : {&lmi.blocks, &bounds.blocks})
    for (const lmi::Block& block : *list)
      names.push_back(block.name + (block.point.empty() ? "" : " at " + block.point));
  return names;
}

/// The bounds last, as their doubles are.
/// The inequalities as fractions of the file's decimals.
std::vector<RationalBlock> blocks_of(const Posed& posed, const lmi::GainBounds& bounds) {
  auto blocks = verdict::rational_blocks(posed.inequalities, posed.lmi.blocks);
  for (const lmi::Block& of : bounds.blocks) {
    RationalBlock& block = blocks.emplace_back();
    block.size = of.size;
    block.strict = of.strict;
    for (const auto& [i, matrix] : of.terms)
      block.terms.emplace_back(
          i, numbers::Matrix(matrix).unaryExpr([](double x) { return Rational(x); }));
  }
  return blocks;
}

/// The loop of facial_reduction.h over `faces_`, the face so far x = x_0 + N y. Each step ends with
/// a point, with an exclusion, with a smaller face or with nothing; then the loop is done.
class FacialReduction {
 public:
  FacialReduction(const Posed& posed, const lmi::GainBounds& bounds, const Solve& solve)
      : posed_(posed),
        solve_(solve),
        stated_(blocks_of(posed, bounds)),
        faces_(stated_, names_of(posed.lmi, bounds), posed.lmi.unknowns + bounds.scalars) {
    result_.question = {lmi::Goal::interior, bounds, {"quad", 1e-22}, 0};
    result_.formulation = lmi::pose_interior(posed.lmi, {});
  }

  std::optional<Attempt> run() {
    const bool any = std::ranges::any_of(stated_, &RationalBlock::exact);
    if (!any) return std::nullopt;
    faces_.find_plain();
    // A quick answer checks only what needs no multipliers.
    if (!posed_.wide && faces_.steps() == 0) return std::nullopt;
    while (!done_) step();
    if (!result_.point && !excludes()) {
      if (faces_.steps() == 0) return std::nullopt;
      result_.left_open = "every solution has only equality somewhere (" + faces_.why() +
                          "); no numbers of 16 digits were found that keep it";
    }
    return finished();
  }

 private:
  /// What a solution is asked for.
  enum class Want { point, point_or_multipliers };

  /// On a face that was only guessed nothing is excluded.
  bool excludes() const { return faces_.excluded() && !guessed_; }

  Attempt finished() {
    if (excludes()) {
      result_.point = false;
      result_.refutation = verdict::Refutation{true, 0, kWideDigits, multipliers_of_blocks()};
      result_.chain = faces_.why();
    }
    result_.on_face = true;
    result_.solution = as_solution_of(result_.formulation);
    return std::move(result_);
  }

  /// What the solver said of what was left, in the shape of the program of all blocks; the
  /// multipliers are 0, as they are those of a face.
  sdp::Solution as_solution_of(const lmi::Formulation& formulation) const {
    sdp::Solution solution = solved_.solution;
    solution.rest = {};
    solution.x.assign(static_cast<std::size_t>(formulation.variables), 0);
    solution.Y.values.clear();
    for (const auto& rows : formulation.free_variables.kept)
      solution.Y.values.emplace_back(rows.size() * rows.size(), 0);
    if (result_.holds()) {
      solution.status = sdp::Status::optimal;
      solution.cause = sdp::Cause::converged;
    }
    return solution;
  }

  /// One pass of facial_reduction.h: plain steps, then solutions in double, in 31 and in 100 digits
  /// until the face shrinks or the loop is done.
  void step() {
    faces_.find_plain();
    if (faces_.excluded()) return finish();
    faces_.drop_dependent();
    if (faces_.unknowns() == 0) {
      try_only_point();
      return finish();
    }
    const FaceProgram left = program_on(faces_, posed_.lmi);
    const std::size_t steps = faces_.steps();
    // Of the whole space double was asked before.
    if (steps > 0) solve_left(left, {}, Want::point);
    // Of bounds nothing but a point is asked.
    if (!posed_.wide || !result_.question.bounds.blocks.empty() ||
        left.lmi.unknowns > kMostUnknowns || left.lmi.rows() > kMostRows)
      return finish();
    for (const Effort& effort : {Effort{"quad", 1e-22}, Effort{"100", 1e-40}}) {
      if (done_ || faces_.steps() > steps) return;
      solve_left(left, effort, Want::point_or_multipliers);
      if (!done_ && faces_.steps() == steps) guess(left);
    }
    if (faces_.steps() == steps) finish();
  }

  /// Nothing is left to choose: the blocks are numbers, and the point x_0 is checked.
  void try_only_point() {
    faces_.exclude_numbers();
    if (faces_.excluded()) return;
    try_point({});
    settle_constant();
  }

  void finish() { done_ = true; }

  /// Solves for the largest margin on the face with these digits, tries its point, from there the
  /// objective, and with `want` the multipliers. A round whose margin rises by half leads to
  /// another.
  void solve_left(const FaceProgram& left, const Effort& effort, Want want) {
    constexpr int kMostRounds = 4;
    constexpr double kRises = 1.5;
    constexpr double kRoots = 3, kRounding = 1e-10;
    lmi::Round round;
    std::optional<std::vector<double>> inside;
    solved_ = {};
    for (int k = 0; k < kMostRounds; ++k) {
      lmi::Formulation formulation = formulate(faces_, left, round);
      sdp::Solution solution = solve_(formulation.problem, effort);
      if (solution.x.empty()) break;
      const auto next = lmi::next_round(left.lmi, {}, formulation, solution.x);
      if (next && next->margin > round.margin)
        inside = lmi::read_back(left.lmi, formulation, solution);
      if (k == 0) solved_ = {std::move(solution), std::move(formulation)};
      // Points of the whole space are those of the other attempts.
      if (faces_.steps() == 0 || !next || next->margin <= round.margin * kRises) break;
      round = *next;
    }
    // What the tolerance leaves of no interior is as large as its root.
    const bool interior = round.margin > std::max(kRoots * std::sqrt(effort.tolerance), kRounding);
    if (faces_.steps() > 0 && inside && is_finite(*inside)) {
      try_point(*inside);
      // A point that shows a violation ends the reduction without a minimum.
      const bool fails = done_ && !result_.holds();
      if (posed_.lmi.has_objective && interior && !fails) minimise(left, *inside);
      // An optimum wants the face that has an interior; more digits show no more of one that is
      // there.
      if (!fails && (interior || posed_.lmi.has_objective)) done_ = interior;
    }
    if (want == Want::point_or_multipliers && !done_ && !solved_.solution.x.empty())
      take_multipliers(left);
  }

  /// Decimals near a point of the face that the exact blocks take, or nearest to one where there
  /// are none, and their margins.
  struct Decimals {
    std::vector<double> x;
    verdict::Margins margins;
  };

  /// None where no decimals with so many digits are on the face and satisfy the exact blocks. With
  /// 16 digits the fractions of the point itself take their place.
  std::optional<Decimals> decimals(const std::vector<double>& y, int digits) const {
    constexpr int kMostDigits = 16;  // of a decimal that is a double
    std::vector<double> units;
    for (int i = 1; i <= posed_.lmi.unknowns; ++i)
      units.push_back(result_.formulation.balance.unit(i));
    const std::size_t unknowns = units.size();
    units.resize(unknowns + static_cast<std::size_t>(result_.question.bounds.scalars), 1);
    const std::vector<Rational> exact(y.begin(), y.end());
    auto x = verdict::printable_point(faces_, exact, units, digits);
    std::vector<Rational> solution;
    verdict::CheckOptions check;
    if (x) {
      for (const double value : *x) solution.push_back(verdict::printed_fraction(value));
    } else if (digits == kMostDigits) {  // none in 16 digits: the solution that they are near to
      solution = faces_.point(exact);
      x.emplace();
      for (const Rational& value : solution) x->push_back(nearest_double(value));
      check.solution = &solution;
    }
    if (!x || !verdict::satisfies(stated_, solution)) return std::nullopt;
    x->resize(unknowns);
    return Decimals{
        *x, verdict::compute_margins(posed_.inequalities, posed_.lmi, result_.formulation.balance,
                                     posed_.choices().margin, *x, check)};
  }

  /// A point is one where everything holds, or one that shows what does not.
  void try_point(const std::vector<double>& y) {
    for (const int digits : {3, 6, 9, 12, 15, 16}) {
      auto found = decimals(y, digits);
      if (!found) continue;
      const bool holds = verdict::all_hold(found->margins);
      if (!holds && result_.point) continue;
      result_.point = true;
      result_.x = std::move(found->x);
      result_.margins = std::move(found->margins);
      if (holds || !result_.margins.violations.empty()) return finish();
    }
  }

  /// c_0 + c'x in the coordinates of the face.
  verdict::Costs costs() const {
    return verdict::on_face(faces_, verdict::exact_objective(posed_.inequalities));
  }

  /// The objective is the same at all points of the face.
  void settle_constant() {
    if (!posed_.lmi.has_objective) return;
    const auto constant = costs().front();
    result_.question.goal = lmi::Goal::objective;
    result_.reached = static_cast<double>(constant.mid);
    if (!guessed_) result_.least = numbers::low_end(constant);
  }

  /// Whether the gains are within the bound, or within ten times those of the point inside.
  bool has_small_gains(const std::vector<double>& x) const {
    constexpr double kMore = 10;
    const auto& bound = posed_.choices().gain_bound;
    if (!bound || !result_.holds()) return true;
    return gain_at(x) <= std::max(*bound, kMore * gain_at(result_.x));
  }

  /// The largest gain at x (gain_values.h).
  double gain_at(const std::vector<double>& x) const {
    const lmi::Inequalities& of = posed_.inequalities;
    numbers::Values values = of.instance.values;
    for (auto& [name, matrix] : of.unknowns.values(x)) values[name] = matrix;
    return largest_gain(of, values);
  }

  struct Minimum {
    sdp::Solution solution;
    std::vector<double> y;
    double value = 0;
    std::optional<double> least;
    double cost_unit = 1;
  };

  /// The minimum of c'x on the face, by the solver with several gaps; the one with the greatest
  /// lower bound counts. None where there is none, or it was not found.
  std::optional<Minimum> minimum_of(const FaceProgram& left) {
    std::optional<Minimum> best;
    lmi::Formulation formulation = lmi::pose_objective(left.lmi, {}, posed_.choices().margin);
    formulation.only_strict = true;
    lmi::assemble(left.lmi, {}, {}, formulation);
    for (const Effort& effort :
         {Effort{"auto", 1e-10}, Effort{"auto", 1e-8}, Effort{"quad", 1e-14}}) {
      Minimum found{solve_(formulation.problem, effort), {}, 0, {}, formulation.cost_unit};
      if (found.solution.status == sdp::Status::dual_infeasible) result_.unbounded = true;
      if (!is_near_optimal(found.solution)) continue;
      found.y = lmi::read_back(left.lmi, formulation, found.solution);
      if (!is_finite(found.y)) continue;
      found.value = left.lmi.objective_at(found.y);
      found.least = bound_of(left, formulation, found.solution);
      const bool closed =
          found.least && lmi::is_narrow_bracket(*found.least, found.value, formulation);
      if (!best || (found.least && (!best->least || *found.least > *best->least)))
        best = std::move(found);
      if (closed || guessed_) break;
    }
    return best;
  }

  /// Shown by weak duality on the face.
  std::optional<double> bound_of(const FaceProgram& left, const lmi::Formulation& formulation,
                                 const sdp::Solution& solution) const {
    if (guessed_) return std::nullopt;
    std::vector<verdict::ExactBlock<DoubleDouble>> blocks;
    for (std::size_t k = 0; k < left.blocks.size(); ++k) {
      const RationalBlock& block = faces_.blocks()[left.blocks[k]];
      if (!block.exact) return std::nullopt;
      blocks.push_back(
          verdict::exact_block(block, formulation.balance, k, formulation.free_variables.kept[k]));
    }
    verdict::Costs of = costs();
    for (std::size_t i = 0; i < of.size(); ++i)
      of[i] =
          numbers::scaled(of[i], formulation.cost_unit *
                                     (i == 0 ? 1 : formulation.balance.unit(static_cast<int>(i))));
    const auto least = verdict::lower_bound(
        blocks, verdict::multipliers_of(formulation, blocks.size(), solution), std::move(of));
    if (!least) return std::nullopt;
    return least->value / formulation.cost_unit;
  }

  /// From a point inside to the least objective on the face: as near as decimals hold.
  /// y(e) = y* + e (y_f - y*) for e = 0, 1e-12, ..., 0.1, y* the minimum and y_f the point inside:
  /// the first whose decimals hold.
  void minimise(const FaceProgram& left, const std::vector<double>& inside) {
    const verdict::Costs of = costs();
    if (std::all_of(of.begin() + 1, of.end(), [](const auto& cost) { return cost.is_zero(); }))
      return settle_constant();
    if (!lmi::has_minimum(left.lmi, {})) return;
    auto minimum = minimum_of(left);
    if (!minimum) return;
    result_.reached = minimum->value;
    result_.formulation.cost_unit = minimum->cost_unit;
    for (const double e :
         {0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
      std::vector<double> y = minimum->y;
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += e * (inside[i] - y[i]);
      auto found = decimals(y, 16);
      if (!found || !verdict::all_hold(found->margins) || !has_small_gains(found->x)) continue;
      result_.point = true;
      result_.x = std::move(found->x);
      result_.margins = std::move(found->margins);
      solved_.solution = std::move(minimum->solution);
      result_.question.goal = lmi::Goal::objective;
      result_.least = minimum->least;
      return finish();
    }
  }

  /// Where no multipliers are exact: the kernels, in fractions near them. What holds on the face
  /// holds; that the face is all is shown by multipliers on it, or not at all.
  void guess(const FaceProgram& left) {
    for (const double relative : {1e-10, 1e-7, 1e-4}) {
      const auto face =
          verdict::fractions_near(faces_, kernels_on(faces_, left, solved_), relative);
      if (!face) continue;
      const verdict::FaceMultipliers by =
          verdict::exact_on(faces_, *face, multipliers_on(faces_, left, solved_));
      const bool shown = !by.S.empty();
      Faces whole = faces_;
      faces_.note("kernels near the largest margin leave equality on their range");
      faces_.restrict_to(by);
      if (!faces_.excluded()) {
        guessed_ |= !shown;
        return;
      }
      faces_ = std::move(whole);
    }
  }

  /// Multipliers near those of the solver in fractions: they exclude every solution or lead to a
  /// smaller face.
  void take_multipliers(const FaceProgram& left) {
    const verdict::ExactMultipliers exact =
        verdict::exact_multipliers(faces_, multipliers_on(faces_, left, solved_));
    if (exact.say == verdict::ExactMultipliers::Say::nothing) return;
    std::string on;
    for (const verdict::FaceOfBlock& face : exact.faces)
      on += (on.empty() ? "" : ", ") + faces_.names()[face.block];
    if (exact.say == verdict::ExactMultipliers::Say::excludes) {
      faces_.exclude("exact multipliers of " + on + " exclude every solution", exact);
      return finish();
    }
    faces_.note("exact multipliers of " + on + " leave equality on their range");
    faces_.restrict_to(exact);
  }

  /// The multipliers V_k S_k V_k' of all steps as sums of weighted squares c z z', in the form of
  /// an algebraic certificate whose polynomial is l.
  std::shared_ptr<const verdict::AlgebraicCertificate> multipliers_of_blocks() const {
    auto found = std::make_shared<verdict::AlgebraicCertificate>();
    found->p = {0, 1};
    found->root = verdict::roots(found->p).front();
    int step = 0;
    for (const auto& [faces, S] : faces_.chain()) {
      ++step;
      for (std::size_t k = 0; k < faces.size(); ++k)
        for (auto& [weight, column] : numbers::rational_squares(S[k]))
          found->multipliers.push_back(
              {faces[k].block, faces[k].V.lazyProduct(column), verdict::weight(weight), step});
    }
    return found;
  }

  const Posed& posed_;
  const Solve& solve_;
  std::vector<RationalBlock> stated_;
  Faces faces_;
  Attempt result_;
  FaceSolution solved_;   ///< the first round of what was left last
  bool guessed_ = false;  ///< that the face holds all solutions is not shown
  bool done_ = false;
};

}  // namespace

bool states_equations(const lmi::Lmi& lmi) {
  return std::any_of(lmi.blocks.begin(), lmi.blocks.end(), [](const lmi::Block& block) {
    if (block.strict) return false;
    std::vector<bool> nonzero(static_cast<std::size_t>(block.size), false);
    for (const auto& [i, matrix] : block.terms)
      for (int row = 0; row < block.size; ++row)
        if (matrix.coeff(row, row) != 0) nonzero[static_cast<std::size_t>(row)] = true;
    return std::find(nonzero.begin(), nonzero.end(), false) != nonzero.end();
  });
}

std::optional<Attempt> attempt_facial_reduction(const Posed& posed, const lmi::GainBounds& bounds,
                                                const Solve& solve) {
  return FacialReduction(posed, bounds, solve).run();
}

}  // namespace gainsmith::design
