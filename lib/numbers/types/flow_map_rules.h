// Internal to numbers: Op::flow_map, instantiated by one source a scalar.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/number.h"
#include "expr/program/branches.h"
#include "expr/program/evaluate.h"
#include "numbers/types/flow_map.h"
#include "numbers/types/real.h"
#include "numerics/extrapolation.h"

namespace gainsmith::numbers {

/// What the rate of a flow_map branches on.
inline std::vector<expr::Branch> branches_along(const expr::Instruction& instruction) {
  return expr::branches_of(*instruction.body, [](const std::string& name) {
    return name == "the variable" || name == "the time";
  });
}

/// The rate of an instruction and what it branches on at points of a number type: what does not
/// move is fixed. The branches must outlive it.
template <class Type>
class BodyPoint {
 public:
  using Value = typename Type::Value;

  BodyPoint(const expr::Instruction& instruction, expr::Operands<Value> operands,
            const std::vector<expr::Branch>& branches)
      : x(*operands[0]), rate_(*instruction.body) {
    differences_.reserve(branches.size());
    for (const expr::Branch& one : branches) differences_.emplace_back(one.difference);
    const bool timed = instruction.attributes[0] == 1;
    if (timed) t = *operands[2];
    link(rate_, operands, timed);
    for (auto& one : differences_) link(one, operands, timed);
  }
  BodyPoint(const BodyPoint&) = delete;
  BodyPoint& operator=(const BodyPoint&) = delete;

  const Value& rate() { return rate_.run(); }
  const Value& difference(std::size_t k) { return differences_[k].run(); }

  Value x, t{};  ///< where it is evaluated

 private:
  void link(expr::Evaluator<Type>& evaluator, expr::Operands<Value> operands, bool timed) {
    for (std::size_t k = timed ? 3 : 2; k < operands.size(); ++k)
      evaluator.fix("operand " + std::to_string(k), *operands[k]);
    evaluator.set("the variable", x);
    evaluator.set("the time", t);
  }

  expr::Evaluator<Type> rate_;
  std::vector<expr::Evaluator<Type>> differences_;
};

/// Of what a rate branches on, one an element: whether it jumps there.
inline std::vector<bool> jumps_of(const std::vector<expr::Branch>& branches) {
  std::vector<bool> jumps;
  for (const expr::Branch& branch : branches)
    jumps.insert(jumps.end(), static_cast<std::size_t>(branch.difference.shape().size()),
                 branch.jumps);
  return jumps;
}

/// integration(start), with its failure as the EvaluationError of a flow map that moves for the
/// time `length`. The place stays that of the call.
template <class Scalar>
MatrixOf<Scalar> moved(numerics::Extrapolation<Scalar>& integration, const MatrixOf<Scalar>& start,
                       double length) {
  try {
    return integration(start);
  } catch (const numerics::Unreached& end) {
    expr::fault::without_result(expr::Op::flow_map, "moved for the time " + brief(length) +
                                                        " it comes to " + brief(end.at * length) +
                                                        ": " + end.why);
  }
}

/// What the extrapolation watches: the differences of a body, one number an element. `go_to` sets
/// where the body is.
template <class Scalar, class GoTo>
typename numerics::Extrapolation<Scalar>::Watch watch_of(const std::vector<expr::Branch>& branches,
                                                         BodyPoint<Real<Scalar>>& body,
                                                         GoTo go_to) {
  typename numerics::Extrapolation<Scalar>::Watch watch;
  watch.jumps = jumps_of(branches);
  if (branches.empty()) return watch;
  const auto size = static_cast<Eigen::Index>(watch.jumps.size());
  watch.at = [&branches, &body, go_to, size](const Scalar& q, const MatrixOf<Scalar>& y,
                                             MatrixOf<Scalar>& out) {
    go_to(q, y);
    out.resize(size, 1);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < branches.size(); ++k) {
      const MatrixOf<Scalar>& values = body.difference(k);
      out.middleRows(row, values.size()) = values.reshaped();
      row += values.size();
    }
  };
  return watch;
}

/// dy/dq = d e(y, t + q d), y(0) = x, over q in [0, 1], with y = z column by column; x for d = 0.
template <class Scalar>
MatrixOf<Scalar> flow_map(const expr::Instruction& instruction,
                          expr::Operands<MatrixOf<Scalar>> operands) {
  using M = MatrixOf<Scalar>;
  for (const M* operand : operands)
    if (!operand->allFinite()) expr::fault::not_finite(expr::Op::flow_map);
  const Scalar d = (*operands[1])(0);
  if (d == Scalar(0)) return *operands[0];
  const std::vector<expr::Branch> branches = branches_along(instruction);
  BodyPoint<Real<Scalar>> body(instruction, operands, branches);
  const M start_time = body.t;
  const auto go_to = [&](const Scalar& q, const M& y) {
    body.x.reshaped() = y;
    if (start_time.size() > 0) body.t = start_time + M::Constant(1, 1, q * d);
  };
  const auto rate = [&](const Scalar& q, const M& y, M& out) {
    go_to(q, y);
    out = d * body.rate().reshaped();
  };
  numerics::Extrapolation<Scalar> integration(rate, watch_of<Scalar>(branches, body, go_to));
  M end = *operands[0];
  end.reshaped() = moved<Scalar>(integration, M(end.reshaped()), static_cast<double>(d));
  return end;
}

/// The state is y = [z, z'], elements x (1 + directions), with the rate [d e, d e' + e d'] and e'
/// from dual numbers. Where a step crosses a jump of e at a place that moves, or e has no
/// derivative, the slope is not a number and out.without the operation.
template <class Scalar>
void flow_map_slope(const expr::Instruction& instruction, expr::Operands<Dual<Scalar>> operands,
                    Dual<Scalar>& out) {
  using M = MatrixOf<Scalar>;
  // Thrown out of the integration, and caught below.
  struct NoSlope {};
  const Eigen::Index directions = out.slope.cols();
  const auto slope_of = [&](const Dual<Scalar>& dual) {
    return dual.moves() ? dual.slope : M(M::Zero(dual.value.size(), directions));
  };
  const Scalar d = operands[1]->value(0);
  const M d_slope = slope_of(*operands[1]);
  const std::vector<expr::Branch> branches = branches_along(instruction);
  BodyPoint<DualNumbers<Scalar>> body(instruction, operands, branches);
  const M x_slope = slope_of(body.x);
  const M time = body.t.value;
  const M t_slope = time.size() > 0 ? slope_of(body.t) : M();
  const auto go_to = [&](const Scalar& q, const M& y) {
    body.x.value.reshaped() = y.col(0);
    body.x.slope = y.rightCols(directions);
    if (time.size() > 0) {
      body.t.value = time + M::Constant(1, 1, q * d);
      body.t.slope = t_slope + q * d_slope;
    }
  };
  const auto rate = [&](const Scalar& q, const M& y, M& result) {
    go_to(q, y);
    const Dual<Scalar>& e = body.rate();
    if (e.without) {
      out.without = e.without;
      throw NoSlope{};
    }
    result.resize(y.rows(), y.cols());
    result.col(0) = d * e.value.reshaped();
    result.rightCols(directions) = M(e.value.reshaped()).lazyProduct(d_slope);
    if (e.moves()) result.rightCols(directions) += d * e.slope;
  };
  std::vector<const M*> values;
  for (const Dual<Scalar>* operand : operands) values.push_back(&operand->value);
  BodyPoint<Real<Scalar>> level(instruction, values, branches);
  auto watch = watch_of<Scalar>(branches, level, [&](const Scalar& q, const M& y) {
    level.x.reshaped() = y;
    if (time.size() > 0) level.t = time + M::Constant(1, 1, q * d);
  });
  watch.crossed = [&](const Scalar& q, const M& y, Eigen::Index element) {
    if (!watch.jumps[static_cast<std::size_t>(element)]) return;
    go_to(q, y);
    std::size_t k = 0;
    for (; element >= branches[k].difference.shape().size(); ++k)
      element -= branches[k].difference.shape().size();
    const Dual<Scalar>& difference = body.difference(k);
    if (!difference.moves() || difference.slope.row(element).isZero(0)) return;
    out.without = expr::Op::flow_map;
    throw NoSlope{};
  };
  M start(x_slope.rows(), 1 + directions);
  start.col(0) = body.x.value.reshaped();
  start.rightCols(directions) = x_slope;
  numerics::Extrapolation<Scalar> integration(rate, watch);
  try {
    out.slope = moved<Scalar>(integration, start, static_cast<double>(d)).rightCols(directions);
  } catch (const NoSlope&) {
    out.slope.setConstant(std::numeric_limits<Scalar>::quiet_NaN());
  }
}

}  // namespace gainsmith::numbers
