// Problems for the tests of hybrid and verify, written as text without a YAML file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bind/bind.h"
#include "model/gains.h"

namespace gainsmith::tests {

/// {"A", "[0, 1; 2, 3]"}.
using Pairs = std::vector<std::pair<std::string, std::string>>;

/// A method and a problem that uses it, put together from text.
class TextProblem {
 public:
  TextProblem& data(const std::string& name, const std::string& shape, const std::string& value);
  TextProblem& gain(const std::string& name, const numbers::Matrix& value);
  /// A gain that is the polynomial with these coefficients in s.
  TextProblem& gain_function(const std::string& name, const std::vector<double>& coefficients);
  TextProblem& unknown(const std::string& name, const std::string& shape);
  /// A scalar unknown that is the polynomial with these coefficients in s.
  TextProblem& unknown_function(const std::string& name, const std::vector<double>& coefficients);
  TextProblem& state(const std::string& name, const std::string& shape);
  TextProblem& flow(const Pairs& entries);
  TextProblem& jump(const Pairs& entries);
  TextProblem& signals(const Pairs& entries);
  TextProblem& timer(const std::string& low, const std::string& high, const std::string& first_low,
                     const std::string& first_high);
  TextProblem& nonincreasing(const std::string& name, const std::string& value);
  TextProblem& cost(const std::string& name, const std::string& bound, const std::string& flow_cost,
                    const std::string& jump_cost);
  TextProblem& shrinks(const std::string& name, const std::string& value,
                       const std::string& factor);
  TextProblem& law(model::LawKind kind, const std::vector<std::string>& values = {});
  TextProblem& first(const std::string& value);
  TextProblem& horizon(const std::string& value);
  TextProblem& start(const std::string& state, model::StartKind kind,
                     const std::vector<std::string>& values);
  TextProblem& runs(std::uint64_t count);

  model::Instance instance() const;
  /// An expression over data, gains, unknowns, states and the timer.
  expr::Program program(const std::string& text) const;

  model::Gains gains;

 private:
  model::Method method_;
  model::Problem problem_;
};

/// The plant (1), observer (4) and errors of Ferrante and Seuret 2021 with the published A, C, T1
/// and the given T2, the given gains, signals e and q, first timer value in [0, T2].
TextProblem sampled_data(const std::string& T2, const numbers::Matrix& L, const numbers::Matrix& F,
                         const numbers::Matrix& H);

numbers::Matrix column(std::initializer_list<double> elements);
numbers::Matrix scalar(double value);

}  // namespace gainsmith::tests
