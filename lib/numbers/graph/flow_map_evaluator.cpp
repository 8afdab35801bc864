#include "numbers/graph/flow_map_evaluator.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "numbers/graph/moving_function.h"
#include "numbers/types/flow_map_rules.h"

namespace gainsmith::numbers {

using Eigen::Index;
using Extrapolation = numerics::Extrapolation<double>;

namespace {

/// The programs whose signs decide on branches.
std::vector<const expr::Program*> differences_of(const std::vector<expr::Branch>& branches) {
  std::vector<const expr::Program*> programs;
  for (const expr::Branch& branch : branches) programs.push_back(&branch.difference);
  return programs;
}

}  // namespace

/// An integration, whose state is the value with its slopes beside it.
struct FlowMapEvaluator::Kept {
  Kept(const expr::Instruction& one, std::vector<bool> which)
      : instruction(one),
        moves(std::move(which)),
        branches(branches_along(one)),
        size(place_inputs()),
        at_x(place("the variable")),
        at_t(place("the time")),
        rate(moving(*one.body)),
        differences(differences_of(branches), place_of(), none, size),
        point(Eigen::VectorXd::Zero(size)),
        integration([this](double q, const Matrix& y, Matrix& out) { rate_at(q, y, out); },
                    watch()) {
    for (std::size_t k = 0; k < instruction.operands.size(); ++k)
      places_of_operands.push_back(place("operand " + std::to_string(k)));
  }

  /// The integration of [z, z'], r c x (1 + directions): the first column is the value.
  Matrix run(expr::Operands<Matrix> operands) {
    const Index directions = take_slopes(operands);
    length = (*operands[1])(0);
    if (timed()) start_time = (*operands[2])(0);
    for (std::size_t k = timed() ? 3 : 2; k < places_of_operands.size(); ++k)
      if (const auto at = places_of_operands[k])
        point.segment(*at, operands[k]->size()) = operands[k]->reshaped();
    if (directions == 0) {
      Matrix end = *operands[0];
      if (length != 0) end.reshaped() = moved<double>(integration, Matrix(end.reshaped()), length);
      return end;
    }
    Matrix start(operands[0]->size(), 1 + directions);
    start.col(0) = operands[0]->reshaped();
    start.rightCols(directions).setZero();
    if (moves[0]) start.rightCols(directions) = *operands[moves.size()];
    return moved<double>(integration, start, length);
  }

 private:
  bool timed() const { return instruction.attributes[0] == 1; }

  /// Gives each input of the rate and of what it branches on a place in the point.
  Index place_inputs() {
    Index used = 0;
    const auto add = [&](const expr::Program& program) {
      for (const expr::Input& input : program.inputs)
        if (places.emplace(input.name, used).second) used += input.shape.size();
    };
    add(*instruction.body);
    for (const expr::Branch& branch : branches) {
      add(branch.difference);
      elements += branch.difference.shape().size();
    }
    return used;
  }

  /// Where an input begins in the point; none where no program reads it.
  std::optional<Index> place(const std::string& name) const {
    const auto found = places.find(name);
    return found == places.end() ? std::nullopt : std::optional(found->second);
  }
  PlaceOfInput place_of() const {
    return [this](const std::string& name) { return place(name); };
  }

  /// A program with its slope: by the state always, by the time where it or the length moves, by
  /// other operands where they move. Without `moves` by nothing.
  MovingFunction moving(const expr::Program& program) const {
    const auto is_input_moving = [this](const std::string& name) {
      if (moves.empty()) return false;
      if (name == "the variable") return true;
      if (name == "the time") return moves[1] || moves[2];
      return bool{moves[std::stoul(name.substr(name.find_last_of(' ')))]};
    };
    return {program, place_of(), is_input_moving, size};
  }

  /// The slopes of the point, as far as they stay; how many directions there are.
  Index take_slopes(expr::Operands<Matrix> operands) {
    Index directions = 0;
    for (std::size_t k = 0; k < moves.size(); ++k)
      if (moves[k]) directions = operands[moves.size() + k]->cols();
    if (directions == 0) return 0;
    slopes.setZero(size, directions);
    for (std::size_t k = timed() ? 3 : 2; k < moves.size(); ++k)
      if (const auto at = places_of_operands[k]; at && moves[k])
        slopes.middleRows(*at, operands[k]->size()) = *operands[moves.size() + k];
    const auto slope_of = [&](std::size_t k) {
      return moves[k] ? *operands[moves.size() + k] : Matrix(Matrix::Zero(1, directions));
    };
    length_slope = slope_of(1);
    if (timed()) time_slope = slope_of(2);
    return directions;
  }

  /// `y` may be without its slopes.
  void go_to(double q, const Matrix& y) {
    if (at_x) point.segment(*at_x, y.rows()) = y.col(0);
    if (at_t) point(*at_t) = start_time + q * length;
    if (y.cols() == 1) return;
    if (at_x) slopes.middleRows(*at_x, y.rows()) = y.rightCols(y.cols() - 1);
    if (at_t) slopes.row(*at_t) = time_slope + q * length_slope;
  }

  /// d e, and d (de/dp p') + d' e beside it (flow_map.h).
  void rate_at(double q, const Matrix& y, Matrix& out) {
    go_to(q, y);
    rate.go_to(point);
    const Matrix& e = rate.value();
    out.resize(y.rows(), y.cols());
    out.col(0) = length * e.reshaped();
    if (y.cols() == 1) return;
    auto slope = out.rightCols(y.cols() - 1);
    slope = e.reshaped().lazyProduct(length_slope);
    rate.add_slope(length, slopes, slope);
  }

  /// As watch_of (flow_map_rules.h), over tapes.
  Extrapolation::Watch watch() {
    Extrapolation::Watch result;
    result.jumps = jumps_of(branches);
    if (branches.empty()) return result;
    result.at = [this](double q, const Matrix& y, Matrix& out) { differences_at(q, y, out); };
    if (!moves.empty())
      result.crossed = [this](double q, const Matrix& y, Index element) { cross(q, y, element); };
    return result;
  }

  /// All differences, stacked, elements x 1; one by one over Real where the tape has no value.
  void differences_at(double q, const Matrix& y, Matrix& out) {
    go_to(q, y);
    const bool known = differences.run(point);
    out.resize(elements, 1);
    Index row = 0;
    for (std::size_t k = 0; k < branches.size(); ++k) {
      const Matrix& values = known ? differences.value(k) : differences.at(k, point);
      out.middleRows(row, values.size()) = values.reshaped();
      row += values.size();
    }
  }

  /// There is no slope across a boundary where the rate jumps, unless it is reached at a time that
  /// does not change.
  void cross(double q, const Matrix& y, Index element) {
    std::size_t k = 0;
    for (; element >= branches[k].difference.shape().size(); ++k)
      element -= branches[k].difference.shape().size();
    if (!branches[k].jumps) return;
    go_to(q, y);
    auto difference = moving(branches[k].difference);
    difference.go_to(point);
    Matrix slope = Matrix::Zero(branches[k].difference.shape().size(), slopes.cols());
    difference.add_slope(1, slopes, slope);
    if (!slope.row(element).isZero(0))
      expr::fault::without_result(expr::Op::flow_map, "there is no slope across a jump");
  }

  const expr::Instruction& instruction;
  /// By operand; empty where no slope is asked for.
  std::vector<bool> moves;
  std::vector<expr::Branch> branches;
  /// By the name of an input: where it begins in the point.
  std::map<std::string, Index> places;
  Index elements = 0;  ///< of what the rate branches on
  Index size;          ///< of the point
  std::optional<Index> at_x, at_t;
  Values none;
  /// e, and what it branches on.
  MovingFunction rate;
  StackedFunctions differences;
  std::vector<std::optional<Index>> places_of_operands;
  double length = 0, start_time = 0;
  Matrix length_slope, time_slope;  ///< rows
  Eigen::VectorXd point;            ///< all inputs
  Matrix slopes;                    ///< of the point
  Extrapolation integration;
};

FlowMapEvaluator::FlowMapEvaluator(const expr::Instruction& instruction, std::vector<bool> moves)
    : kept_(std::make_unique<Kept>(instruction, std::move(moves))) {}
FlowMapEvaluator::FlowMapEvaluator(FlowMapEvaluator&&) noexcept = default;
FlowMapEvaluator& FlowMapEvaluator::operator=(FlowMapEvaluator&&) noexcept = default;
FlowMapEvaluator::~FlowMapEvaluator() = default;

Matrix FlowMapEvaluator::operator()(expr::Operands<Matrix> operands) {
  for (const Matrix* operand : operands)
    if (!operand->allFinite()) expr::fault::not_finite(expr::Op::flow_map);
  return kept_->run(operands);
}

}  // namespace gainsmith::numbers
