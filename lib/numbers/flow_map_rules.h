// Internal to numbers: Op::flow_map, instantiated by one source a scalar.
#pragma once

#include <limits>
#include <string>

#include "base/number.h"
#include "expr/evaluate.h"
#include "numbers/extrapolation.h"
#include "numbers/flow_map.h"
#include "numbers/real.h"

namespace gainsmith::numbers {

/// The rate of an instruction at points of a number type: what stands still is fixed.
template <class Type>
class BodyRate {
 public:
  using Value = typename Type::Value;

  BodyRate(const expr::Instruction& instruction, expr::Operands<Value> operands)
      : x(*operands[0]), evaluator_(*instruction.body) {
    const bool timed = instruction.attributes[0] == 1;
    if (timed) t = *operands[2];
    for (std::size_t k = timed ? 3 : 2; k < operands.size(); ++k)
      evaluator_.fix("operand " + std::to_string(k), *operands[k]);
    evaluator_.set("the variable", x);
    evaluator_.set("the time", t);
  }
  BodyRate(const BodyRate&) = delete;
  BodyRate& operator=(const BodyRate&) = delete;

  const Value& operator()() { return evaluator_.run(); }

  Value x, t{};  ///< where it is evaluated

 private:
  expr::Evaluator<Type> evaluator_;
};

/// The place stays that of the call.
template <class Scalar>
MatrixOf<Scalar> moved(const typename Extrapolation<Scalar>::Rate& rate,
                       const MatrixOf<Scalar>& start, double length) {
  try {
    return Extrapolation<Scalar>(rate)(start);
  } catch (const Unreached& end) {
    expr::fault::without_result(expr::Op::flow_map, "moved for the time " + brief(length) +
                                                        " it comes to " + brief(end.at * length) +
                                                        ": " + end.why);
  }
}

template <class Scalar>
MatrixOf<Scalar> flow_map(const expr::Instruction& instruction,
                          expr::Operands<MatrixOf<Scalar>> operands) {
  using M = MatrixOf<Scalar>;
  for (const M* operand : operands)
    if (!operand->allFinite()) expr::fault::not_finite(expr::Op::flow_map);
  const Scalar d = (*operands[1])(0);
  if (d == Scalar(0)) return *operands[0];
  BodyRate<Real<Scalar>> body(instruction, operands);
  const M start_time = body.t;
  const auto rate = [&](const Scalar& q, const M& y, M& out) {
    body.x.reshaped() = y;
    if (start_time.size() > 0) body.t = start_time + M::Constant(1, 1, q * d);
    out = d * body().reshaped();
  };
  M end = *operands[0];
  end.reshaped() = moved<Scalar>(rate, M(end.reshaped()), static_cast<double>(d));
  return end;
}

template <class Scalar>
void flow_map_slope(const expr::Instruction& instruction, expr::Operands<Dual<Scalar>> operands,
                    Dual<Scalar>& out) {
  using M = MatrixOf<Scalar>;
  struct NoSlope {};
  const Eigen::Index directions = out.slope.cols();
  const auto slope_of = [&](const Dual<Scalar>& dual) {
    return dual.moves() ? dual.slope : M(M::Zero(dual.value.size(), directions));
  };
  const Scalar d = operands[1]->value(0);
  const M d_slope = slope_of(*operands[1]);
  BodyRate<DualNumbers<Scalar>> body(instruction, operands);
  const M x_slope = slope_of(body.x);
  const M time = body.t.value;
  const M t_slope = time.size() > 0 ? slope_of(body.t) : M();
  const auto rate = [&](const Scalar& q, const M& y, M& result) {
    body.x.value.reshaped() = y.col(0);
    body.x.slope = y.rightCols(directions);
    if (time.size() > 0) {
      body.t.value = time + M::Constant(1, 1, q * d);
      body.t.slope = t_slope + q * d_slope;
    }
    const Dual<Scalar>& e = body();
    if (e.without) {
      out.without = e.without;
      throw NoSlope{};
    }
    result.resize(y.rows(), y.cols());
    result.col(0) = d * e.value.reshaped();
    result.rightCols(directions) = M(e.value.reshaped()).lazyProduct(d_slope);
    if (e.moves()) result.rightCols(directions) += d * e.slope;
  };
  M start(x_slope.rows(), 1 + directions);
  start.col(0) = body.x.value.reshaped();
  start.rightCols(directions) = x_slope;
  try {
    out.slope = moved<Scalar>(rate, start, static_cast<double>(d)).rightCols(directions);
  } catch (const NoSlope&) {
    out.slope.setConstant(std::numeric_limits<Scalar>::quiet_NaN());
  }
}

}  // namespace gainsmith::numbers
