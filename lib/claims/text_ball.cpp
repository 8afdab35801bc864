#include "claims/text_ball.h"

#include <cmath>
#include <limits>

#include "base/unit_roundoff.h"
#include "claims/tolerances.h"

namespace gainsmith::claims {

using Eigen::VectorXd;

using Enclosed = numbers::Enclosed<double>;

numbers::EnclosedValues<double> rounded_once(const numbers::Values& constants) {
  const auto error = [](double x) { return std::rint(x) == x ? 0 : kUnitRoundoff * std::abs(x); };
  numbers::EnclosedValues<double> enclosed;
  for (const auto& [name, value] : constants)
    enclosed.emplace(name, Enclosed{value, value.unaryExpr(error)});
  return enclosed;
}

TextBall::Function::Function(const expr::Program& program, const hybrid::StateLayout& layout,
                             const numbers::EnclosedValues<double>& constants)
    : evaluator_(program) {
  for (const hybrid::Slot& slot : layout.slots)
    if (program.uses(slot.name)) slots_.push_back(slot);
  for (const hybrid::Slot& slot : slots_)
    moving_.push_back(
        numbers::exactly<double>(numbers::Matrix::Zero(slot.shape.rows, slot.shape.cols)));
  for (const expr::Input& input : program.inputs)
    if (const auto known = constants.find(input.name);
        known != constants.end() && !layout.moves(input.name))
      evaluator_.fix(input.name, known->second);
  for (std::size_t i = 0; i < slots_.size(); ++i) evaluator_.set(slots_[i].name, moving_[i]);
  try {
    evaluator_.prepare();
  } catch (const InputError& error) {
    fault_ = error;
  }
}

const Enclosed& TextBall::Function::operator()(const VectorXd& x, const VectorXd& r) {
  if (fault_) throw *fault_;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const hybrid::Slot& slot = slots_[i];
    moving_[i].mid.reshaped() = x.segment(slot.offset, slot.shape.size());
    moving_[i].rad.reshaped() = r.segment(slot.offset, slot.shape.size());
  }
  return evaluator_.run();
}

TextBall::TextBall(const expr::Program& program, RunValue& value, const hybrid::StateLayout& layout,
                   const numbers::EnclosedValues<double>& constants)
    : value_(&value), function_(program, layout, constants), exact_(VectorXd::Zero(layout.size)) {
  for (const expr::Program* difference : value.differences())
    differences_.emplace_back(*difference, layout, constants);
}

double TextBall::rounding(const VectorXd& x) {
  if (const auto known = value_->rounding(x)) return std::isfinite(*known) ? *known : 0;
  try {
    const double radius = function_(x, exact_).rad(0);
    return std::isfinite(radius) ? radius : 0;
  } catch (const InputError&) {
    return 0;
  }
}

bool TextBall::is_open(const VectorXd& x, const VectorXd& r) {
  for (std::size_t k = 0; k < differences_.size(); ++k)
    if (is_open(k, x, r)) return true;
  return false;
}

bool TextBall::is_open(std::size_t k, const VectorXd& x, const VectorXd& r) {
  if (value_->is_far(k, x, r.head(exact_.size()), kFarBranch)) return false;
  try {
    const Enclosed& d = differences_[k](x, r);
    if (!d.is_known()) return true;
    return (d.mid.array().abs() <= d.rad.array() && d.rad.array() > 0).any();
  } catch (const InputError&) {
    return true;
  }
}

Bounded TextBall::hull(const VectorXd& x, const VectorXd& r) {
  try {
    const Enclosed& value = function_(x, r);
    return {value.mid(0), value.rad(0)};
  } catch (const InputError&) {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  }
}

}  // namespace gainsmith::claims
