#include "bind/bind.h"

#include <filesystem>
#include <utility>

#include "bind/binding.h"
#include "expr/work.h"
#include "model/gains.h"

namespace gainsmith::bind {

double Recorder::number(const expr::Program& program) const {
  return numbers::evaluate(program, values)(0, 0);
}

int Recorder::rank(const expr::Program& matrix, const expr::Program* tolerance) const {
  for (const model::Design::Rank& known : ranks)
    if (is_same(known.matrix, matrix) && known.tolerance.has_value() == (tolerance != nullptr) &&
        (tolerance == nullptr || is_same(*known.tolerance, *tolerance)))
      return known.rank;
  const int found = numbers::KnownDoubles(values).rank(matrix, tolerance);
  ranks.push_back({matrix, tolerance ? std::optional(*tolerance) : std::nullopt, found});
  return found;
}

bool is_proper_column(expr::Shape shape) { return shape.cols == 1 && shape.rows > 1; }

expr::Expression oriented(const model::Value& value, bool column) {
  if (!value.flat || !column) return value.value;
  auto turned = std::make_shared<expr::Node>();
  turned->kind = expr::NodeKind::transpose;
  turned->begin = value.value.root->begin;
  turned->end = value.value.root->end;
  turned->children = {value.value.root};
  return {value.value.text, turned};
}

Binding::Binding(std::shared_ptr<const model::Problem> problem, const model::Overrides& overrides,
                 Checks checks)
    : source_(std::move(problem)),
      overrides_(overrides),
      checks_(checks),
      design_(std::make_shared<model::Design>()),
      names_(std::make_shared<Names>()),
      recorder_(std::make_shared<Recorder>()) {
  design_->name = source_->name;
  design_->file = source_->file;
  design_->method = method().name;
  design_->method_file = method().file;
  design_->method_place = source_->method_place;
  design_->synthesis = source_->synthesis;
  design_->source = source_;
  design_->statement = {method().name, method().text,
                        std::filesystem::path(source_->file).filename().string(), source_->text,
                        ""};
  design_->statement.hash = statement_hash(design_->statement);
  names_->known.known = recorder_;
}

model::Instance Binding::run() {
  expr::count_design();
  bind_data();
  bind_inequalities();
  bind_gains();
  bind_components();
  bind_search();
  bind_claims();
  bind_campaign();
  bind_expectation();
  bind_comparison();
  finish_dynamics();
  design_->ranks = recorder_->ranks;
  design_->names = names_;
  return {design_, overrides_, recorder_->values};
}

model::Formula Binding::scalar(const expr::Expression& expression, const expr::Scope& scope) const {
  return formula(expression, scope, expr::Shape{});
}

model::Formula Binding::formula(const expr::Expression& expression, const expr::Scope& scope,
                                std::optional<expr::Shape> expected) const {
  return {expr::compile(expression, scope, expected), expression.place(*expression.root),
          expression.text->str()};
}

model::Formula Binding::value(const model::Value& value, const expr::Scope& scope,
                              std::optional<expr::Shape> expected) const {
  model::Formula result =
      formula(oriented(value, expected && is_proper_column(*expected)), scope, expected);
  result.place = value.place;
  return result;
}

model::Instance bind(std::shared_ptr<const model::Problem> problem,
                     const model::Overrides& overrides) {
  return Binding(std::move(problem), overrides, Checks::all).run();
}

model::Instance bind(const model::Problem& problem, const model::Overrides& overrides) {
  return bind(std::make_shared<const model::Problem>(problem), overrides);
}

model::Instance bind_again(const model::Design& design, const model::Overrides& overrides) {
  return Binding(design.source, overrides, Checks::none).run();
}

}  // namespace gainsmith::bind
