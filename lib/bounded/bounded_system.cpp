#include "bounded/bounded_system.h"

#include <algorithm>
#include <set>

#include "numbers/degree.h"

namespace gainsmith::bounded {

namespace {

using Eigen::Index;
using numbers::Matrix;
using Wide = numbers::MatrixOf<Decimal100>;

bool uses_any(const expr::Program& program, const std::set<std::string>& names) {
  return std::any_of(program.inputs.begin(), program.inputs.end(),
                     [&](const expr::Input& input) { return names.contains(input.name); });
}

}  // namespace

std::optional<WideMap> affine_jump(const Coordinates& coordinates) {
  const Index n = coordinates.layout.size;
  WideMap map{Wide::Identity(n, n), Wide::Zero(n, 1)};
  const auto moves = [&](const std::string& name) { return coordinates.layout.moves(name); };
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const auto& jump = coordinates.list[i].jump;
    if (!jump) continue;
    const auto degrees = numbers::degrees(*jump, moves);
    if (degrees[static_cast<std::size_t>(jump->result)] == numbers::kNotAffine ||
        jump->uses(coordinates.layout.timer))
      return std::nullopt;
    WideFunction entry(*jump, coordinates.layout, coordinates.constants);
    map.set_rows(coordinates.layout.slots[i], entry);
  }
  map.remove_noise();
  return map;
}

template <class Scalar>
BallFunction<Scalar>::BallFunction(const expr::Program& program, const hybrid::StateLayout& layout,
                                   const BallsOf<Scalar>& constants)
    : evaluator_(program) {
  for (const hybrid::Slot& slot : layout.slots)
    if (program.uses(slot.name)) slots_.push_back(slot);
  for (const hybrid::Slot& slot : slots_)
    moving_.push_back(exact_ball<Scalar>(Matrix::Zero(slot.shape.rows, slot.shape.cols)));
  moving_.push_back(exact_ball<Scalar>(Matrix::Zero(1, 1)));
  for (const expr::Input& input : program.inputs)
    if (const auto known = constants.find(input.name);
        known != constants.end() && !layout.moves(input.name))
      evaluator_.fix(input.name, known->second);
  for (std::size_t i = 0; i < slots_.size(); ++i) evaluator_.set(slots_[i].name, moving_[i]);
  evaluator_.set(layout.timer, moving_.back());
}

template <class Scalar>
const Ball<Scalar>& BallFunction<Scalar>::operator()(const Eigen::Ref<const ColumnOf<Scalar>>& x,
                                                     const Eigen::Ref<const Eigen::VectorXd>& r,
                                                     const Scalar& tau, double tau_bound) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const hybrid::Slot& slot = slots_[i];
    for (Index e = 0; e < slot.shape.size(); ++e) {
      moving_[i].mid(e) = x(slot.offset + e);
      moving_[i].rad(e) = r(slot.offset + e);
    }
  }
  moving_.back().mid(0) = tau;
  moving_.back().rad(0) = tau_bound;
  return evaluator_.run();
}

template <class Scalar>
BoundedSystem<Scalar>::BoundedSystem(const Coordinates& all, const std::optional<ExactSteps>& exact)
    : coordinates(&all), steps(exact ? StepMaps<Scalar>(*exact) : StepMaps<Scalar>()) {
  for (const auto& [name, value] : all.constants) constants.emplace(name, ball_of<Scalar>(value));
  const Eigen::Index n = all.layout.size;
  if (const auto map = affine_jump(all))
    jump = bounded_map<Scalar>(map->linear, map->constant, numbers::Matrix::Zero(n, n + 1));
  std::set<std::string> turning;
  for (std::size_t i = 0; i < all.list.size(); ++i)
    if (!all.list[i].clock) turning.insert(all.layout.slots[i].name);
  const auto moves = [&](const std::string& name) { return turning.contains(name); };
  for (const Coordinate& coordinate : all.list) {
    bool linear = true;
    if (coordinate.jump && uses_any(*coordinate.jump, turning)) {
      const auto degrees = numbers::degrees(*coordinate.jump, moves);
      linear = degrees[static_cast<std::size_t>(coordinate.jump->result)] != numbers::kNotAffine;
    }
    linear_jump.push_back(linear);
  }
}

template class BallFunction<double>;
template class BallFunction<DoubleDouble>;
template struct BoundedSystem<double>;
template struct BoundedSystem<DoubleDouble>;

}  // namespace gainsmith::bounded
