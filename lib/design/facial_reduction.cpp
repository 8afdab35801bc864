#include "design/facial_reduction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rational.h"
#include "design/gain_values.h"
#include "verdict/face_multipliers.h"
#include "verdict/faces.h"
#include "verdict/printable.h"
#include "verdict/solved_multipliers.h"

namespace gainsmith::design {

namespace {

using verdict::Faces;
using verdict::RationalBlock;

/// Beyond these sizes fractions take too long.
constexpr int kMostUnknowns = 60;
constexpr int kMostRows = 120;

std::vector<std::string> names_of(const lmi::Lmi& lmi) {
  std::vector<std::string> names;
  for (const lmi::Block& block : lmi.blocks)
    names.push_back(block.name + (block.point.empty() ? "" : " at " + block.point));
  return names;
}

/// What is left, as blocks that a solver can be asked about.
struct Left {
  lmi::Lmi lmi;
  std::vector<std::size_t> blocks;  ///< which of the faces' they are: those with rows
};

/// c'x in the coordinates of the face, x = x_0 + N y.
void pose_objective(const Faces& faces, const lmi::Lmi& stated, lmi::Lmi& left) {
  left.has_objective = stated.has_objective;
  if (!stated.has_objective) return;
  const std::vector<Rational> c(stated.objective.begin(), stated.objective.end());
  const numbers::RationalMatrix& N = faces.directions();
  Rational constant = 0;
  for (std::size_t i = 0; i < c.size(); ++i) constant += c[i] * faces.origin()[i];
  left.objective_constant = stated.objective_constant + nearest_double(constant);
  for (Eigen::Index j = 0; j < N.cols(); ++j) {
    Rational sum = 0;
    for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * N(static_cast<Eigen::Index>(i), j);
    left.objective.push_back(nearest_double(sum));
  }
}

Left left_of(const Faces& faces, const lmi::Lmi& stated) {
  Left left;
  left.lmi.unknowns = faces.unknowns();
  pose_objective(faces, stated, left.lmi);
  for (std::size_t k = 0; k < faces.blocks().size(); ++k) {
    const RationalBlock& of = faces.blocks()[k];
    if (of.size == 0) continue;
    lmi::Block block;
    block.name = faces.names()[k];
    block.strict = of.strict;
    block.size = of.size;
    for (const auto& [i, matrix] : of.terms) {
      const numbers::Matrix rounded =
          matrix.unaryExpr([](const Rational& x) { return nearest_double(x); });
      double& size = i == 0 ? block.constant_size : block.coefficient_size;
      size = std::max(size, rounded.cwiseAbs().maxCoeff());
      block.terms.emplace_back(i, lmi::sparse(rounded));
    }
    left.lmi.blocks.push_back(std::move(block));
    left.blocks.push_back(k);
  }
  return left;
}

class FacialReduction {
 public:
  FacialReduction(const Posed& posed, const Solve& solve)
      : posed_(posed),
        solve_(solve),
        stated_(verdict::rational_blocks(posed.inequalities, posed.lmi.blocks)),
        faces_(stated_, names_of(posed.lmi), posed.lmi.unknowns) {
    result_.question = {lmi::Goal::interior, {}, {"quad", 1e-22}, 0};
    result_.formulation = lmi::pose_interior(posed.lmi, {});
  }

  /// The plain steps, and a point in double.
  std::optional<Attempt> run_plain() {
    faces_.find_plain();
    if (faces_.steps() == 0) return std::nullopt;
    if (!faces_.excluded()) faces_.drop_dependent();
    if (!faces_.excluded() && faces_.unknowns() > 0)
      solve_left(left_of(faces_, posed_.lmi), {}, Want::point);
    if (!faces_.excluded() && !result_.holds()) return std::nullopt;
    return finished();
  }

  std::optional<Attempt> run() {
    const bool any = std::any_of(stated_.begin(), stated_.end(),
                                 [](const RationalBlock& block) { return block.exact; });
    if (!any) return std::nullopt;
    if (!posed_.wide) {
      // A quick answer checks only what needs no multipliers.
      faces_.find_plain();
      if (faces_.steps() == 0) return std::nullopt;
    }
    while (!done_) step();
    if (!result_.point && !faces_.excluded()) {
      if (faces_.steps() == 0) return std::nullopt;
      result_.left_open = "every solution has only equality somewhere (" + faces_.why() +
                          "); no numbers of 16 digits were found that keep it";
    }
    return finished();
  }

 private:
  enum class Want { point, point_or_multipliers };

  Attempt finished() {
    if (faces_.excluded()) {
      result_.point = false;
      result_.refutation = verdict::Refutation{true, 0, kWideDigits};
      result_.chain = faces_.why();
    }
    result_.on_face = true;
    result_.solution = as_solution_of(result_.formulation);
    return std::move(result_);
  }

  /// What the solver said of what was left, in the shape of the program of all blocks; the
  /// multipliers are 0, as they are those of a face.
  sdp::Solution as_solution_of(const lmi::Formulation& formulation) const {
    sdp::Solution solution = solved_;
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

  void step() {
    faces_.find_plain();
    if (faces_.excluded()) return finish();
    faces_.drop_dependent();
    if (faces_.unknowns() == 0) {
      if (!verdict::satisfies(faces_.blocks(), {}))
        faces_.exclude("what is left has no unknowns and does not hold");
      else
        try_point({});
      if (result_.holds()) settle(posed_.lmi.objective_at(result_.x));
      return finish();
    }
    const Left left = left_of(faces_, posed_.lmi);
    const std::size_t steps = faces_.steps();
    for (const Effort& effort : {Effort{"quad", 1e-22}, Effort{"100", 1e-40}}) {
      solve_left(left, effort, Want::point_or_multipliers);
      if (done_ || faces_.steps() > steps || !posed_.wide) break;
    }
    if (done_ || faces_.steps() > steps) return;
    finish();
  }

  void finish() { done_ = true; }

  lmi::Formulation formulate(const Left& left, const lmi::Round& round) const {
    return lmi::formulate_interior(
        left.lmi, {}, round,
        [&](std::size_t k, const lmi::Balance& balance, const std::vector<int>& kept) {
          lmi::BalancedBlock block{static_cast<int>(kept.size()), {}, {}};
          for (const auto& [i, matrix] : faces_.blocks()[left.blocks[k]].terms)
            for (int c = 0; c < block.size; ++c)
              for (int r = 0; r <= c; ++r) {
                const int row = kept[static_cast<std::size_t>(r)];
                const int column = kept[static_cast<std::size_t>(c)];
                if (matrix(row, column) == 0) continue;
                const auto value = nearest_double_double(matrix(row, column));
                const double unit = balance.factor(k, row, column, i);
                block.elements.push_back({i, r, c, value.hi() * unit, value.lo() * unit});
              }
          return block;
        });
  }

  void solve_left(const Left& left, const Effort& effort, Want want) {
    constexpr int kMostRounds = 4;
    constexpr double kRises = 1.5;
    lmi::Round round;
    std::optional<lmi::Formulation> first;
    std::optional<std::vector<double>> inside;
    for (int k = 0; k < kMostRounds; ++k) {
      lmi::Formulation formulation = formulate(left, round);
      sdp::Solution solution = solve_(formulation.problem, effort);
      if (solution.x.empty()) break;
      const auto next = lmi::next_round(left.lmi, {}, formulation, solution.x);
      if (next && next->margin > round.margin)
        inside = lmi::read_back(left.lmi, formulation, solution);
      if (k == 0) {
        solved_ = std::move(solution);
        first = std::move(formulation);
      }
      // Points of the whole space are those of the other attempts.
      if (faces_.steps() == 0 || !next || next->margin <= round.margin * kRises) break;
      round = *next;
    }
    if (faces_.steps() > 0 && inside &&
        std::all_of(inside->begin(), inside->end(),
                    [](double value) { return std::isfinite(value); }))
      try_point(*inside);
    if (result_.holds() && posed_.lmi.has_objective) minimise(left, *inside);
    if (want == Want::point_or_multipliers && !done_ && first) take_multipliers(left, *first);
  }

  /// Decimals near a point of the face that the exact blocks take, or nearest to one where there
  /// are none, and their margins.
  struct Decimals {
    std::vector<double> x;
    verdict::Margins margins;
  };

  std::optional<Decimals> decimals(const std::vector<double>& y, int digits) const {
    constexpr int kMostDigits = 16;  // of a decimal that is a double
    std::vector<double> units;
    for (int i = 1; i <= posed_.lmi.unknowns; ++i)
      units.push_back(result_.formulation.balance.unit(i));
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

  /// The point is a minimum: no solution has an objective below `least`.
  void settle(double least) {
    if (!posed_.lmi.has_objective) return;
    result_.question.goal = lmi::Goal::objective;
    result_.least = least;
  }

  /// Whether the gains are within the bound, or within ten times those of the point inside.
  bool has_small_gains(const std::vector<double>& x) const {
    constexpr double kMore = 10;
    const auto& bound = posed_.choices().gain_bound;
    if (!bound) return true;
    return gain_at(x) <= std::max(*bound, kMore * gain_at(result_.x));
  }

  double gain_at(const std::vector<double>& x) const {
    const lmi::Inequalities& of = posed_.inequalities;
    numbers::Values values = of.instance.values;
    for (auto& [name, matrix] : of.unknowns.values(x)) values[name] = matrix;
    return largest_gain(of, values);
  }

  /// From a point inside to the least objective on the face: as near as decimals hold.
  void minimise(const Left& left, const std::vector<double>& inside) {
    const std::vector<double>& c = left.lmi.objective;
    if (std::all_of(c.begin(), c.end(), [](double value) { return value == 0; }))
      return settle(left.lmi.objective_constant);
    if (!lmi::has_minimum(left.lmi, {})) return;
    const auto formulation = lmi::formulate_objective(left.lmi, {}, posed_.choices().margin);
    Attempt minimum;
    minimum.solution = solve_(formulation.problem, {"auto", 1e-10});
    if (!minimum.is_near_optimal()) return;
    const auto least = lmi::read_back(left.lmi, formulation, minimum.solution);
    for (const double e :
         {0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
      std::vector<double> y = least;
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += e * (inside[i] - least[i]);
      if (!std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); }))
        return;
      auto found = decimals(y, 16);
      if (!found || !verdict::all_hold(found->margins) || !has_small_gains(found->x)) continue;
      result_.x = std::move(found->x);
      result_.margins = std::move(found->margins);
      solved_ = std::move(minimum.solution);
      return settle(lmi::objective_lower_bound(left.lmi, {}, formulation, solved_));
    }
  }

  void take_multipliers(const Left& left, const lmi::Formulation& formulation) {
    verdict::FoundMultipliers found;
    for (const RationalBlock& block : faces_.blocks()) {
      found.Y.push_back(
          numbers::MatrixOf<DoubleDouble>::Constant(block.size, block.size, DoubleDouble(0)));
      found.rows.emplace_back(static_cast<std::size_t>(block.size), 0);
    }
    const verdict::Multipliers Y =
        verdict::multipliers_of(formulation, left.blocks.size(), solved_);
    for (std::size_t k = 0; k < Y.size(); ++k) {
      const std::size_t at = left.blocks[k];
      const auto& kept = formulation.free_variables.kept[k];
      found.rows[at] = formulation.balance.rows[k];
      for (std::size_t i = 0; i < kept.size(); ++i)
        for (std::size_t j = 0; j < kept.size(); ++j)
          found.Y[at](kept[i], kept[j]) =
              Y[k](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
    if (formulation.homogenised) found.v = solved_.Y.values[Y.size()][0];
    const verdict::ExactMultipliers exact = verdict::exact_multipliers(faces_, found);
    if (exact.say == verdict::ExactMultipliers::Say::nothing) return;
    std::string on;
    for (const verdict::FaceOfBlock& face : exact.faces)
      on += (on.empty() ? "" : ", ") + faces_.names()[face.block];
    if (exact.say == verdict::ExactMultipliers::Say::excludes) {
      if (faces_.steps() == 0) keep_multipliers(exact);
      faces_.exclude("exact multipliers of " + on + " exclude every solution");
      return finish();
    }
    faces_.note("exact multipliers of " + on + " leave equality on their range");
    faces_.restrict_to(exact.faces);
  }

  /// Those of the blocks themselves, in the units of the data.
  void keep_multipliers(const verdict::ExactMultipliers& exact) {
    for (const RationalBlock& block : stated_)
      result_.multipliers.push_back(numbers::Matrix::Zero(block.size, block.size));
    for (std::size_t k = 0; k < exact.faces.size(); ++k) {
      const verdict::FaceOfBlock& face = exact.faces[k];
      const numbers::RationalMatrix half = face.V.lazyProduct(exact.S[k]);
      const numbers::RationalMatrix Y = half.lazyProduct(face.V.transpose());
      result_.multipliers[face.block] =
          Y.unaryExpr([](const Rational& y) { return nearest_double(y); });
    }
  }

  const Posed& posed_;
  const Solve& solve_;
  std::vector<RationalBlock> stated_;
  Faces faces_;
  Attempt result_;
  sdp::Solution solved_;  ///< the first round of what was left last
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

std::optional<Attempt> attempt_on_equations(const Posed& posed, const Solve& solve) {
  return FacialReduction(posed, solve).run_plain();
}

std::optional<Attempt> attempt_facial_reduction(const Posed& posed, const Solve& solve) {
  if (posed.lmi.unknowns > kMostUnknowns || posed.lmi.rows() > kMostRows) return std::nullopt;
  return FacialReduction(posed, solve).run();
}

}  // namespace gainsmith::design
