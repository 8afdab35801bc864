#include "support/text_problem.h"

#include <memory>

#include "expr/text/parser.h"

namespace gainsmith::tests {

namespace {

constexpr const char* kFile = "test.yaml";

expr::Expression parse(const std::string& text) { return expr::parse(expr::Text(text, kFile)); }

std::vector<model::Named> named(const Pairs& entries) {
  std::vector<model::Named> result;
  for (const auto& [name, text] : entries) result.push_back({name, parse(text), {kFile, 1, 1}});
  return result;
}

model::Declaration declare(const std::string& name, const std::string& shape) {
  model::Declaration declaration;
  declaration.name = name;
  declaration.shape = model::parse_shape(expr::Text(shape, kFile));
  return declaration;
}

}  // namespace

TextProblem& TextProblem::data(const std::string& name, const std::string& shape,
                               const std::string& value) {
  method_.data.push_back(declare(name, shape));
  problem_.data.push_back({name, parse(value), false, {kFile, 1, 1}});
  return *this;
}

TextProblem& TextProblem::gain(const std::string& name, const numbers::Matrix& value) {
  // Only the shape of the formula matters here: the value comes from the gain file.
  method_.gains.push_back(
      {name,
       parse("zeros(" + std::to_string(value.rows()) + ", " + std::to_string(value.cols()) + ")"),
       {},
       ""});
  gains.gains.emplace_back(name, value);
  return *this;
}

TextProblem& TextProblem::gain_function(const std::string& name,
                                        const std::vector<double>& coefficients) {
  method_.gains.push_back({name, parse("zeros(1, 1)"), {}, "s"});
  model::GainFunction function{name, "s", model::GainFunction::Kind::polynomial, "", {}};
  for (const double coefficient : coefficients)
    function.coefficients.push_back(scalar(coefficient));
  gains.gain_functions.push_back(std::move(function));
  return *this;
}

TextProblem& TextProblem::unknown(const std::string& name, const std::string& shape) {
  method_.unknowns.push_back({declare(name, shape), "", std::nullopt});
  return *this;
}

TextProblem& TextProblem::unknown_function(const std::string& name,
                                           const std::vector<double>& coefficients) {
  const std::string degree = std::to_string(coefficients.size() - 1);
  method_.unknowns.push_back({declare(name, "scalar"), "s", parse(degree)});
  for (const double coefficient : coefficients)
    gains.unknowns.emplace_back(name + "_" + std::to_string(gains.unknowns.size()),
                                scalar(coefficient));
  return *this;
}

TextProblem& TextProblem::state(const std::string& name, const std::string& shape) {
  method_.plant.states.push_back(declare(name, shape));
  method_.plant.name = "plant";
  method_.has_dynamics = true;
  return *this;
}

TextProblem& TextProblem::flow(const Pairs& entries) {
  method_.plant.flow = named(entries);
  return *this;
}

TextProblem& TextProblem::jump(const Pairs& entries) {
  model::PassText pass;
  pass.map = named(entries);
  method_.plant.at = {{model::kTimerEvent, {pass}, {kFile, 1, 1}}};
  return *this;
}

TextProblem& TextProblem::signals(const Pairs& entries) {
  method_.signals = named(entries);
  return *this;
}

TextProblem& TextProblem::timer(const std::string& low, const std::string& high,
                                const std::string& first_low, const std::string& first_high) {
  model::EventText event;
  event.name = model::kTimerEvent;
  event.kind = model::Dynamics::EventKind::every;
  event.left = "tau";
  event.numbers = {parse(low), parse(high)};
  event.first = {parse(first_low), parse(first_high)};
  event.place = {kFile, 7, 3};
  method_.events = {event};
  return *this;
}

TextProblem& TextProblem::nonincreasing(const std::string& name, const std::string& value) {
  method_.claims.push_back({name, model::ClaimKind::nonincreasing, parse(value), {}, {}, {}, {}});
  return *this;
}

TextProblem& TextProblem::cost(const std::string& name, const std::string& bound,
                               const std::string& flow_cost, const std::string& jump_cost) {
  method_.claims.push_back(
      {name, model::ClaimKind::cost, parse(bound), parse(flow_cost), parse(jump_cost), {}, {}});
  return *this;
}

TextProblem& TextProblem::shrinks(const std::string& name, const std::string& value,
                                  const std::string& factor) {
  method_.claims.push_back(
      {name, model::ClaimKind::shrinks, parse(value), {}, {}, parse(factor), {}});
  return *this;
}

TextProblem& TextProblem::law(model::LawKind kind, const std::vector<std::string>& values) {
  model::SamplingLaw law{kind, {}, {kFile, 9, 5}};
  for (const std::string& value : values) law.values.push_back(parse(value));
  problem_.campaign.sampling.push_back(law);
  return *this;
}

TextProblem& TextProblem::first(const std::string& value) {
  problem_.campaign.first = parse(value);
  return *this;
}

TextProblem& TextProblem::horizon(const std::string& value) {
  problem_.campaign.horizon = parse(value);
  return *this;
}

TextProblem& TextProblem::start(const std::string& state, model::StartKind kind,
                                const std::vector<std::string>& values) {
  model::InitialValue initial{state, kind, {}, {kFile, 11, 5}};
  for (const std::string& value : values) {
    const bool flat = value.starts_with('[') && value.find(';') == std::string::npos;
    initial.values.push_back({state, parse(value), flat, {kFile, 11, 9}});
  }
  problem_.campaign.initial.push_back(initial);
  return *this;
}

TextProblem& TextProblem::runs(std::uint64_t count) {
  problem_.campaign.runs = count;
  return *this;
}

model::Instance TextProblem::instance() const {
  model::Problem problem = problem_;
  problem.method = std::make_shared<const model::Method>(method_);
  return bind::bind(problem);
}

expr::Program TextProblem::program(const std::string& text) const {
  TextProblem problem = *this;
  problem.signals({{"value of " + text, text}});
  return problem.instance().design->dynamics->signals.front().value.program;
}

TextProblem sampled_data(const std::string& T2, const numbers::Matrix& L, const numbers::Matrix& F,
                         const numbers::Matrix& H) {
  TextProblem problem;
  problem.data("A", "n x n", "[0.2, -1.01; 1, 0]").data("C", "p x n", "[0.5, -1]");
  problem.data("T1", "scalar", "0.5").data("T2", "scalar", T2);
  problem.gain("L", L).gain("F", F).gain("H", H);
  problem.state("z", "n").state("zh", "n").state("th", "p");
  problem.flow({{"z", "A*z"}, {"zh", "A*zh + L*th"}, {"th", "H*th"}});
  problem.jump({{"zh", "zh + F*(C*z - C*zh)"}, {"th", "(I - C*F)*(C*z - C*zh)"}});
  problem.signals({{"e", "z - zh"}, {"q", "C*e - th"}});
  problem.timer("T1", "T2", "0", "T2");
  return problem;
}

numbers::Matrix column(std::initializer_list<double> elements) {
  numbers::Matrix result(static_cast<Eigen::Index>(elements.size()), 1);
  Eigen::Index i = 0;
  for (const double element : elements) result(i++) = element;
  return result;
}

numbers::Matrix scalar(double value) { return numbers::Matrix::Constant(1, 1, value); }

}  // namespace gainsmith::tests
