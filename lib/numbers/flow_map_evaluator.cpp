#include "numbers/flow_map_evaluator.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "numbers/flow_map_rules.h"
#include "numbers/stacked_functions.h"

namespace gainsmith::numbers {

using Eigen::Index;
using Extrapolation = numerics::Extrapolation<double>;

namespace {

std::vector<const expr::Program*> differences_of(const std::vector<expr::Branch>& branches) {
  std::vector<const expr::Program*> programs;
  for (const expr::Branch& one : branches) programs.push_back(&one.difference);
  return programs;
}

}  // namespace

struct FlowMapEvaluator::Kept {
  explicit Kept(const expr::Instruction& one)
      : instruction(one),
        branches(branches_along(one)),
        size(place_inputs()),
        rate(stacked({one.body.get()})),
        differences(stacked(differences_of(branches))),
        point(Eigen::VectorXd::Zero(size)) {
    for (const expr::Branch& branch : branches)
      jumps.insert(jumps.end(), static_cast<std::size_t>(branch.difference.shape().size()),
                   branch.jumps);
  }

  bool timed() const { return instruction.attributes[0] == 1; }

  Matrix run(expr::Operands<Matrix> operands) {
    const double d = (*operands[1])(0);
    if (d == 0) return *operands[0];
    for (std::size_t k = timed() ? 3 : 2; k < operands.size(); ++k)
      set("operand " + std::to_string(k), *operands[k]);
    const std::optional<Index> x = place("the variable");
    const std::optional<Index> t = timed() ? place("the time") : std::nullopt;
    const double start_time = timed() ? (*operands[2])(0) : 0;
    const auto go_to = [&](double q, const Matrix& y) {
      if (x) point.segment(*x, y.size()) = y.reshaped();
      if (t) point(*t) = start_time + q * d;
    };
    const auto rate_at = [&](double q, const Matrix& y, Matrix& out) {
      go_to(q, y);
      if (!rate.run(point)) {
        out = d * rate.at(0, point).reshaped();
        return;
      }
      out.resize(y.rows(), 1);
      for (Index k = 0; k < y.rows(); ++k)
        out(k) = d * rate.element(0, static_cast<std::size_t>(k));
    };
    Extrapolation::Watch watch;
    watch.jumps = jumps;
    if (!jumps.empty())
      watch.at = [&](double q, const Matrix& y, Matrix& out) {
        go_to(q, y);
        differences_at_point(out);
      };
    Matrix end = *operands[0];
    end.reshaped() = moved<double>(Extrapolation(rate_at, watch), Matrix(end.reshaped()), d);
    return end;
  }

 private:
  /// Gives each input of the rate and of what it branches on a place in the point.
  Index place_inputs() {
    Index used = 0;
    const auto add = [&](const expr::Program& program) {
      for (const expr::Input& input : program.inputs)
        if (places.emplace(input.name, used).second) used += input.shape.size();
    };
    add(*instruction.body);
    for (const expr::Branch& one : branches) add(one.difference);
    return used;
  }

  StackedFunctions stacked(std::vector<const expr::Program*> programs) const {
    return {std::move(programs), [this](const std::string& name) { return place(name); }, none,
            size};
  }

  std::optional<Index> place(const std::string& name) const {
    const auto found = places.find(name);
    return found == places.end() ? std::nullopt : std::optional(found->second);
  }

  void set(const std::string& name, const Matrix& value) {
    if (const auto at = place(name)) point.segment(*at, value.size()) = value.reshaped();
  }

  void differences_at_point(Matrix& out) {
    out.resize(static_cast<Index>(jumps.size()), 1);
    const bool known = differences.run(point);
    Index row = 0;
    for (std::size_t k = 0; k < branches.size(); ++k) {
      const Matrix& values = known ? differences.value(k) : differences.at(k, point);
      out.middleRows(row, values.size()) = values.reshaped();
      row += values.size();
    }
  }

  const expr::Instruction& instruction;
  std::vector<expr::Branch> branches;
  std::vector<bool> jumps;  ///< by number of what the rate branches on
  std::map<std::string, Index> places;
  Index size;
  Values none;
  StackedFunctions rate, differences;
  Eigen::VectorXd point;  ///< all inputs
};

FlowMapEvaluator::FlowMapEvaluator(const expr::Instruction& instruction)
    : kept_(std::make_unique<Kept>(instruction)) {}
FlowMapEvaluator::FlowMapEvaluator(FlowMapEvaluator&&) noexcept = default;
FlowMapEvaluator& FlowMapEvaluator::operator=(FlowMapEvaluator&&) noexcept = default;
FlowMapEvaluator::~FlowMapEvaluator() = default;

Matrix FlowMapEvaluator::operator()(expr::Operands<Matrix> operands) {
  for (const Matrix* operand : operands)
    if (!operand->allFinite()) expr::fault::not_finite(expr::Op::flow_map);
  return kept_->run(operands);
}

}  // namespace gainsmith::numbers
