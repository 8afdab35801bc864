#include "forall/faults.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "expr/binding/derivative.h"
#include "expr/program/evaluate.h"
#include "expr/program/rewrite.h"
#include "numbers/types/real.h"

namespace gainsmith::forall {

namespace {

using expr::Op;
using expr::Program;
using At = std::vector<double>;

/// The part of a program that one of its instructions needs.
Program part_of(Program program, int instruction) {
  program.result = instruction;
  expr::Composer composer({});
  return composer.take(composer.program(program));
}

/// A program at points of the box, the rest fixed; it must outlive the function.
class Part {
 public:
  Part(const Program& program, const numbers::Values& values,
       const std::vector<const Variable*>& axes)
      : evaluator_(program), moving_(axes.size(), numbers::Matrix::Zero(1, 1)) {
    for (const expr::Input& input : program.inputs)
      if (const auto value = values.find(input.name); value != values.end())
        evaluator_.fix(input.name, value->second);
    for (std::size_t i = 0; i < axes.size(); ++i) evaluator_.set(axes[i]->name, moving_[i]);
  }

  const numbers::Matrix& operator()(const At& at) {
    check_stop();
    for (std::size_t i = 0; i < at.size(); ++i) moving_[i](0, 0) = at[i];
    return evaluator_.run();
  }

 private:
  expr::Evaluator<numbers::RealAlgebra> evaluator_;
  std::vector<numbers::Matrix> moving_;
};

/// A regular grid with the middles and ends of all axes: some 1200 points at most, or three values
/// an axis where these are more. Of more than nine axes only the first 20000 points are kept.
std::vector<At> grid(const std::vector<const Variable*>& axes) {
  constexpr double kPoints = 1200;
  const double root = std::pow(kPoints, 1 / static_cast<double>(axes.size()));
  const std::size_t half = std::max<std::size_t>(1, static_cast<std::size_t>((root - 1) / 2));
  const std::size_t side = 2 * half + 1;
  constexpr std::size_t kMost = 20000;  // boxes of many variables
  std::vector<At> points = {{}};
  for (const Variable* axis : axes) {
    std::vector<At> next;
    for (const At& point : points)
      for (std::size_t k = 0; k < side && next.size() < kMost; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(side - 1);
        next.push_back(point);
        next.back().push_back(axis->low + (axis->high - axis->low) * part);
      }
    points = std::move(next);
  }
  return points;
}

/// What must not be 0: the elements of a divisor, the determinant of what is inverted. Empty where
/// it has no value.
std::vector<double> divisors(Part& part, bool inverted, const At& at) {
  try {
    const numbers::Matrix& value = part(at);
    if (inverted) return {value.determinant()};
    return {value.reshaped().begin(), value.reshaped().end()};
  } catch (const expr::EvaluationError&) {
    return {};
  }
}

/// A zero of f between two points at which it has opposite signs; none for a jump or a pole of f.
template <class Function>
std::optional<At> zero_between(const Function& f, At above, At below) {
  const auto is_negative = [&](const At& at) {
    const auto value = f(at);
    return value && *value < 0;
  };
  // As few elements as possible move.
  for (std::size_t i = 0; i < above.size(); ++i) {
    At nearer = below;
    nearer[i] = above[i];
    if (is_negative(nearer)) below = std::move(nearer);
  }
  const double size = std::max(std::abs(*f(above)), std::abs(*f(below)));
  constexpr int kHalvings = 100;
  At middle = above;
  for (int k = 0; k < kHalvings; ++k) {
    for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = above[i] / 2 + below[i] / 2;
    const auto value = f(middle);
    if (!value) return std::nullopt;
    if (*value == 0) return middle;
    (*value < 0 ? below : above) = middle;
  }
  // Of the values at the two ends: a pole grows instead.
  constexpr double kZero = 1e-9;
  const auto value = f(middle);
  return value && std::abs(*value) <= kZero * size ? std::optional(middle) : std::nullopt;
}

/// A zero of a divisor: at a point of the grid, or between two points of it at which an element, or
/// the determinant, has opposite signs.
std::optional<At> zero_of(const Program& divisor, bool inverted, const numbers::Values& values,
                          const std::vector<const Variable*>& axes, const std::vector<At>& points) {
  Part part(divisor, values, axes);
  std::vector<const At*> above;
  std::vector<const At*> below;
  for (const At& at : points) {
    const auto found = divisors(part, inverted, at);
    above.resize(std::max(above.size(), found.size()));
    below.resize(above.size());
    for (std::size_t e = 0; e < found.size(); ++e) {
      if (found[e] == 0) return at;
      (found[e] > 0 ? above : below)[e] = &at;
    }
  }
  for (std::size_t e = 0; e < above.size(); ++e) {
    if (above[e] == nullptr || below[e] == nullptr) continue;
    const auto f = [&](const At& at) -> std::optional<double> {
      const auto found = divisors(part, inverted, at);
      return e < found.size() ? std::optional(found[e]) : std::nullopt;
    };
    if (auto zero = zero_between(f, *above[e], *below[e])) return zero;
  }
  return std::nullopt;
}

/// The first point of the grid at which the program has no value, with the reason.
std::optional<std::pair<At, std::string>> without_value(const Program& program,
                                                        const numbers::Values& values,
                                                        const std::vector<const Variable*>& axes,
                                                        const std::vector<At>& points) {
  Part part(program, values, axes);
  for (const At& at : points) {
    try {
      part(at);
    } catch (const expr::EvaluationError& error) {
      return std::pair(at, error.message());
    }
  }
  return std::nullopt;
}

Point labelled(Point point, const std::vector<const Variable*>& axes, const At& at) {
  constexpr double kNothing = 1e-12;  // beside the width: what halving leaves of 0
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double width = axes[i]->high - axes[i]->low;
    point = extended(point, axes[i]->name, std::abs(at[i]) <= kNothing * width ? 0 : at[i]);
  }
  return point;
}

/// What is said of an operation whose divisor is 0.
std::string said_of_zero(const expr::Instruction& instruction) {
  try {
    if (instruction.op == Op::inverse) expr::fault::singular(instruction);
    expr::fault::division_by_zero();
  } catch (const expr::EvaluationError& error) {
    return expr::fault::said_of(instruction, error.message());
  }
}

/// Operations that have no result for some operands.
bool is_partial(Op op) {
  return op == Op::divide || op == Op::elementwise_quotient || op == Op::inverse || op == Op::log ||
         op == Op::sqrt || op == Op::real_power;
}

}  // namespace

std::optional<Fault> find_fault(const expr::Program& difference, const Domain& domain,
                                const numbers::Values& known) {
  const auto axes = intervals(domain);
  if (axes.empty()) return std::nullopt;
  const Program program = expr::with_derivatives(difference);
  const std::vector<At> points = grid(axes);
  for (const Point& fixed : finite_points(domain)) {
    numbers::Values values = known;
    for (const auto& [name, value] : fixed.values) values.insert_or_assign(name, value);
    const auto is_known = [&](const expr::Input& input) {
      return values.contains(input.name) ||
             std::any_of(axes.begin(), axes.end(),
                         [&](const Variable* axis) { return axis->name == input.name; });
    };
    for (std::size_t k = 0; k < program.code.size(); ++k) {
      const expr::Instruction& instruction = program.code[k];
      if (!is_partial(instruction.op)) continue;
      // Only what this operation needs, so that another fault does not hide it.
      const Program part = part_of(program, static_cast<int>(k));
      if (!std::all_of(part.inputs.begin(), part.inputs.end(), is_known)) continue;
      if (const auto found = without_value(part, values, axes, points))
        return Fault{instruction.place(), found->second, labelled(fixed, axes, found->first)};
      const bool inverted = instruction.op == Op::inverse;
      const bool divides =
          instruction.op == Op::divide || instruction.op == Op::elementwise_quotient;
      if (!inverted && !divides) continue;
      const Program divisor = part_of(program, instruction.operands[inverted ? 0 : 1]);
      if (const auto zero = zero_of(divisor, inverted, values, axes, points))
        return Fault{instruction.place(), said_of_zero(instruction), labelled(fixed, axes, *zero)};
    }
  }
  return std::nullopt;
}

}  // namespace gainsmith::forall
