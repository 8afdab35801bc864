#include "linear/wide_function.h"

#include <algorithm>

#include "linear/tolerances.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;
using Wide = numbers::MatrixOf<Decimal100>;

}  // namespace

Decimal100 largest_of(const Wide& matrix) {
  Decimal100 largest(0);
  for (Index e = 0; e < matrix.size(); ++e) largest = std::max<Decimal100>(largest, abs(matrix(e)));
  return largest;
}

void remove_noise(Wide& matrix, const Decimal100& largest) {
  const Decimal100 least = largest * Decimal100(kCoefficientNoise);
  for (Index e = 0; e < matrix.size(); ++e)
    if (abs(matrix(e)) <= least) matrix(e) = Decimal100(0);
}

WideFunction::WideFunction(const expr::Program& program, const hybrid::StateLayout& layout,
                           const numbers::ValuesOf<Decimal100>& constants)
    : slots_(layout.slots), evaluator_(program) {
  for (const hybrid::Slot& slot : slots_)
    moving_.push_back(Wide::Zero(slot.shape.rows, slot.shape.cols));
  moving_.push_back(Wide::Zero(1, 1));
  for (const expr::Input& input : program.inputs)
    if (const auto known = constants.find(input.name); known != constants.end())
      evaluator_.fix(input.name, known->second);
  for (std::size_t i = 0; i < slots_.size(); ++i) evaluator_.set(slots_[i].name, moving_[i]);
  evaluator_.set(layout.timer, moving_.back());
}

const Wide& WideFunction::operator()(const Wide& x, const Decimal100& tau) {
  moving_.back()(0) = tau;
  for (std::size_t i = 0; i < slots_.size(); ++i)
    moving_[i].reshaped() = x.col(0).segment(slots_[i].offset, slots_[i].shape.size());
  return evaluator_.run();
}

void WideMap::set_rows(const hybrid::Slot& slot, WideFunction& entry) {
  const Index rows = slot.shape.size();
  Wide x = Wide::Zero(linear.cols(), 1);
  constant.middleRows(slot.offset, rows) = entry(x).reshaped();
  for (Index j = 0; j < linear.cols(); ++j) {
    x(j) = Decimal100(1);
    linear.block(slot.offset, j, rows, 1) =
        entry(x).reshaped() - constant.middleRows(slot.offset, rows);
    x(j) = Decimal100(0);
  }
}

void WideMap::remove_noise() {
  linear::remove_noise(linear, largest_of(linear));
  linear::remove_noise(constant, std::max<Decimal100>(largest_of(linear), largest_of(constant)));
}

}  // namespace gainsmith::linear
