// What is searched, what is expected and what the command line asks for.
#include <algorithm>
#include <set>

#include "model/binding.h"

namespace gainsmith::model {

namespace {

/// Each scalar is searched in one way.
void refuse_repetition(const Search& search) {
  std::set<std::string> names;
  if (search.extreme) names.insert(search.extreme->name);
  for (const ScalarRange& range : search.over)
    if (!names.insert(range.name).second)
      throw InputError(range.place, "'" + range.name + "' is searched already");
}

}  // namespace

Range Binding::range(const ScalarRange& range) const {
  return {range.name, scalar(range.low, names_->known), scalar(range.high, names_->known),
          range.place};
}

Formula Binding::figure(const expr::Expression& text) const {
  Formula bound = formula(text, names_->results);
  if (!bound.program.shape().is_scalar())
    throw InputError(bound.place, "expected a number, found a matrix: " + bound.text);
  return bound;
}

void Binding::bind_search() {
  const auto checked = [&](const ScalarRange& text) {
    check_scalar_name(*design_, text.name, text.place);
    Range bound = range(text);
    if (checks_ == Checks::all) ends_of(bound, recorder_->values);
    return bound;
  };
  for (const ScalarRange& text : problem().negotiable) design_->negotiable.push_back(checked(text));
  const auto is_given = [&](const std::string& name) {
    return std::any_of(problem().parameters.begin(), problem().parameters.end(),
                       [&](const Value& value) { return value.name == name; });
  };
  for (const Parameter& parameter : method().parameters)
    if (parameter.search && !is_given(parameter.name))
      design_->open.push_back(checked(*parameter.search));
  for (const ScalarRange& text : problem().questions.ranges)
    design_->asked.push_back(checked(text));
  for (const expr::Expression& figure : problem().questions.figures)
    design_->figures.push_back({figure.text->str(), this->figure(figure), {}});
  if (!problem().search) return;
  const Search& search = *problem().search;
  refuse_repetition(search);
  Design::Search bound;
  if (search.extreme) bound.extreme = checked(*search.extreme);
  bound.largest = search.largest;
  bound.tolerance = search.tolerance;
  for (const ScalarRange& text : search.over) bound.over.push_back(checked(text));
  if (search.minimize) bound.minimize = scalar(*search.minimize, names_->results);
  bound.evaluations = search.evaluations;
  design_->search = std::move(bound);
}

void Binding::bind_expectation() {
  if (!problem().expect) return;
  const Expectation& expect = *problem().expect;
  Design::Expectation bound;
  bound.verdict = expect.verdict;
  bound.status = expect.status;
  bound.campaign = expect.campaign;
  bound.active_bounds = expect.active_bounds;
  bound.place = expect.place;
  for (const ExpectedValue& each : expect.values) {
    Formula what = formula(each.what, names_->results);
    Formula wanted = value(each.value, names_->known, what.program.shape());
    bound.values.push_back(
        {each.name, std::move(what), std::move(wanted), each.relative, each.absolute, each.place});
  }
  design_->expect = std::move(bound);
}

}  // namespace gainsmith::model
