// Gains by the rooms below: text to problem (io), bound to numbers (bind), solved and judged
// (design).
#include <string>
#include <utility>

#include "api/call.h"
#include "base/version.h"
#include "bind/bind.h"
#include "design/optimize.h"
#include "io/json/gains_json.h"
#include "methods/methods.h"

namespace gainsmith::api {

namespace {

Matrix matrix_of(const numbers::Matrix& matrix) {
  Matrix result{static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), {}};
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      result.elements.push_back(matrix(row, column));
  return result;
}

std::map<std::string, Matrix> matrices_of(const model::NamedMatrices& matrices) {
  std::map<std::string, Matrix> result;
  for (const auto& [name, matrix] : matrices) result.emplace(name, matrix_of(matrix));
  return result;
}

Verdict verdict_of(model::Verdict verdict) {
  return verdict == model::Verdict::yes  ? Verdict::yes
         : verdict == model::Verdict::no ? Verdict::no
                                         : Verdict::undecided;
}

Gains gains_of(const model::Gains& found, std::string text) {
  Gains result;
  result.problem = found.problem_name;
  result.verdict = verdict_of(found.verdict);
  result.message = found.solver.message;
  result.objective = found.objective;
  result.gains = matrices_of(found.gains);
  result.unknowns = matrices_of(found.unknowns);
  result.report = matrices_of(found.report);
  result.searched = {found.searched.begin(), found.searched.end()};
  for (const model::Margin& margin : found.margins)
    result.margins.push_back({margin.name, margin.strict, margin.holds, margin.reached,
                              margin.required, margin.worst_point});
  result.text = std::move(text);
  return result;
}

model::Gains synthesized(const std::string& text, const std::string& name,
                         const std::map<std::string, double>& values) {
  const io::MethodLibrary library{[](const std::string& method) { return methods::find(method); },
                                  methods::names()};
  const model::Instance instance =
      bind::bind(io::parse_problem(text, name, library), {values.begin(), values.end()});
  bind::refuse_free_unknowns(*instance.design);
  const auto& search = instance.design->search;
  if (search && search->run_figure)
    throw InputError({name}, "it searches for a figure of runs: 'gainsmith synth' does that");
  return design::synthesize_searched(instance, design::request_of(instance), 0, {});
}

}  // namespace

std::string version() { return kVersion; }

Gains synthesize(const std::string& problem, const std::string& name,
                 const std::map<std::string, double>& values) {
  return call([&] {
    const model::Gains gains = synthesized(problem, name, values);
    return gains_of(gains, io::gains_text(gains));
  });
}

Gains read_gains(const std::string& text, const std::string& name) {
  return call([&] { return gains_of(io::parse_gains(text, name), text); });
}

}  // namespace gainsmith::api
