#include "numbers/graph/stacked_functions.h"

#include <set>
#include <stdexcept>
#include <utility>

#include "expr/program/evaluate.h"
#include "numbers/graph/scalar_trace.h"

namespace gainsmith::numbers {

using Eigen::Index;

/// One program over Real, with the vector written to its inputs at each call.
struct StackedFunctions::Careful {
  Careful(const expr::Program& program, const std::vector<Index>& where, const Values& constants)
      : evaluator(program), inputs(program.inputs.size()), places(where) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      const expr::Input& input = program.inputs[k];
      if (places[k] < 0) {
        evaluator.fix(input.name, constants.find(input.name)->second);
      } else {
        inputs[k] = Matrix::Zero(input.shape.rows, input.shape.cols);
        evaluator.set(k, inputs[k]);
      }
    }
  }

  /// A place equal to `size` is that of the number beside the vector.
  const Matrix& operator()(const Eigen::VectorXd& x, Index size, double beside) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      if (places[k] == size) inputs[k].setConstant(beside);
      if (places[k] >= 0 && places[k] < size)
        inputs[k].reshaped() = x.segment(places[k], inputs[k].size());
    }
    return evaluator.run();
  }

  expr::Evaluator<RealAlgebra> evaluator;
  /// The evaluator reads those that move where they are.
  std::vector<Matrix> inputs;
  const std::vector<Index>& places;
};

StackedFunctions::StackedFunctions(std::vector<const expr::Program*> programs,
                                   const PlaceOfInput& place, const Values& constants, Index size)
    : programs_(std::move(programs)), constants_(&constants), size_(size) {
  for (const expr::Program* program : programs_) {
    std::vector<Index>& places = places_.emplace_back();
    for (const expr::Input& input : program->inputs) {
      places.push_back(place(input.name).value_or(-1));
      if (places.back() < 0 && !constants.contains(input.name))
        throw std::logic_error("no value for the input " + input.name);
    }
    values_.push_back(Matrix::Zero(program->shape().rows, program->shape().cols));
  }
  careful_.resize(programs_.size());
}

StackedFunctions::StackedFunctions(StackedFunctions&&) noexcept = default;
StackedFunctions& StackedFunctions::operator=(StackedFunctions&&) noexcept = default;
StackedFunctions::~StackedFunctions() = default;

/// One graph for all programs, so that what they share is computed once. The number beside the
/// vector is its last input.
void StackedFunctions::make() {
  ScalarGraph graph;
  std::vector<std::vector<int>> results;
  for (std::size_t k = 0; k < programs_.size(); ++k) {
    const expr::Program& program = *programs_[k];
    const auto input = [&](const expr::Input& one) {
      const Index place = places_[k][static_cast<std::size_t>(program.input(one.name))];
      if (place < 0) return traced(constants_->find(one.name)->second, graph);
      TracedMatrix made{one.shape, {}};
      for (int e = 0; e < one.shape.size(); ++e)
        made.value.push_back(graph.input(static_cast<int>(place) + e));
      return made;
    };
    results.push_back(trace(program, input, graph).value);
  }
  tape_.emplace(graph, results, static_cast<int>(size_) + 1);
}

bool StackedFunctions::run(const Eigen::VectorXd& x, double beside) {
  if (!tape_) make();
  double* const inputs = tape_->inputs();
  for (const std::uint32_t k : tape_->reads()) inputs[k] = k < size_ ? x.data()[k] : beside;
  return tape_->run();
}

bool StackedFunctions::enclose(const Box& x, double part) {
  if (!tape_) make();
  return tape_->enclose(x, part);
}

const Matrix& StackedFunctions::value(std::size_t k) {
  tape_->copy(k, values_[k].data());
  return values_[k];
}

/// The evaluator of a program is made at the first call for it.
const Matrix& StackedFunctions::at(std::size_t k, const Eigen::VectorXd& x, double beside) {
  if (careful_[k] == nullptr)
    careful_[k] = std::make_unique<Careful>(*programs_[k], places_[k], *constants_);
  return (*careful_[k])(x, size_, beside);
}

std::vector<Index> StackedFunctions::elements() const {
  std::set<Index> all;
  for (std::size_t k = 0; k < programs_.size(); ++k)
    for (std::size_t i = 0; i < places_[k].size(); ++i)
      for (Index e = 0; e < programs_[k]->inputs[i].shape.size(); ++e)
        if (const Index place = places_[k][i]; place >= 0 && place < size_) all.insert(place + e);
  return {all.begin(), all.end()};
}

}  // namespace gainsmith::numbers
