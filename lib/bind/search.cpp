// What is searched, what is expected and what the command line asks for.
#include <algorithm>
#include <set>

#include "base/nearest.h"
#include "bind/binding.h"

namespace gainsmith::bind {

namespace {

/// Each scalar is searched in one way.
void refuse_repetition(const model::Search& search) {
  std::set<std::string> names;
  if (search.extreme) names.insert(search.extreme->name);
  for (const model::ScalarRange& range : search.over)
    if (!names.insert(range.name).second)
      throw InputError(range.place, "'" + range.name + "' is searched already");
}

/// The figure of one observer, or of none.
model::Figure only(std::vector<model::Figure> readings) {
  if (readings.size() != 1)
    throw InputError(readings.front().place, "this is of one observer; say of which, 'observer: " +
                                                 readings.front().observer + "'");
  return std::move(readings.front());
}

}  // namespace

model::Range Binding::range(const model::ScalarRange& range) const {
  return {range.name, scalar(range.low, names_->known), scalar(range.high, names_->known),
          range.place};
}

model::Formula Binding::figure(const expr::Expression& text) const {
  model::Formula bound = formula(text, names_->results);
  if (!bound.program.shape().is_scalar())
    throw InputError(bound.place, "expected a number, found a matrix: " + bound.text);
  return bound;
}

void Binding::bind_search() {
  const auto checked = [&](const model::ScalarRange& text) {
    check_scalar_name(*design_, text.name, text.place);
    model::Range bound = range(text);
    if (checks_ == Checks::all) ends_of(bound, recorder_->values);
    return bound;
  };
  for (const model::ScalarRange& text : problem().negotiable)
    design_->negotiable.push_back(checked(text));
  const auto is_given = [&](const std::string& name) {
    return std::any_of(problem().parameters.begin(), problem().parameters.end(),
                       [&](const model::Value& value) { return value.name == name; });
  };
  for (const model::Parameter& parameter : method().parameters)
    if (parameter.search && !is_given(parameter.name))
      design_->open.push_back(checked(*parameter.search));
  for (const model::ScalarRange& text : problem().questions.ranges)
    design_->asked.push_back(checked(text));
  for (const expr::Expression& figure : problem().questions.figures)
    design_->figures.push_back({figure.text->str(), this->figure(figure), {}});
  if (!problem().search) return;
  const model::Search& search = *problem().search;
  refuse_repetition(search);
  model::Design::Search bound;
  if (search.extreme) bound.extreme = checked(*search.extreme);
  bound.largest = search.largest;
  bound.tolerance = search.tolerance;
  for (const model::ScalarRange& text : search.over) bound.over.push_back(checked(text));
  if (search.minimize) bound.minimize = scalar(*search.minimize, names_->results);
  if (search.run_figure) bound.run_figure = only(figures(*search.run_figure));
  bound.runs = search.runs;
  bound.evaluations = search.evaluations;
  design_->search = std::move(bound);
}

void Binding::bind_expectation() {
  if (!problem().expect) return;
  const model::Expectation& expect = *problem().expect;
  model::Design::Expectation bound;
  bound.verdict = expect.verdict;
  bound.status = expect.status;
  bound.campaign = expect.campaign;
  bound.active_bounds = expect.active_bounds;
  bound.place = expect.place;
  for (const model::ExpectedValue& each : expect.values) {
    model::Formula what = formula(each.what, names_->results);
    model::Formula wanted = value(each.value, names_->known, what.program.shape());
    bound.values.push_back(
        {each.name, std::move(what), std::move(wanted), each.relative, each.absolute, each.place});
  }
  for (const model::ExpectedFigureText& text : expect.run) {
    model::ExpectedFigure figure{only(figures(text.figure)), std::nullopt, text.ending,
                                 text.relative, text.absolute};
    if (text.is) figure.is = scalar(*text.is, names_->known);
    bound.run.push_back(std::move(figure));
  }
  design_->expect = std::move(bound);
}

/// Of each observer that has the names in it, or the only one.
std::vector<model::Figure> Binding::figures(const model::FigureText& text) const {
  if (!design_->dynamics)
    throw InputError(text.place, "figures are of runs, and the method has no dynamics");
  std::vector<Reading> readings = {{text.observer, {}}};
  if (text.value && !text.observer.empty())
    readings = {dynamics_names_->of_observer(text.observer, {*text.value}, text.place)};
  else if (text.value)
    readings = dynamics_names_->outside(std::vector{*text.value});
  std::vector<model::Figure> result;
  for (const Reading& reading : readings) {
    model::Figure bound;
    bound.kind = text.kind;
    bound.title = text.title;
    bound.observer = reading.observer;
    bound.count = text.count;
    bound.after = text.after;
    bound.place = text.place;
    if (text.value) bound.value = scalar(reading.texts.front(), names_->running);
    if (bound.value && estimate(bound.value->program) != expr::Estimate::none)
      bound.title += " (from estimates)";
    if (!text.event.empty()) bound.event = event_of(text, reading.observer);
    for (const expr::Expression& number : text.numbers)
      bound.numbers.push_back(scalar(number, names_->known));
    result.push_back(std::move(bound));
  }
  return result;
}

/// The event that a name means for an observer: its own, or one of all.
std::optional<std::size_t> Binding::find_event(const std::string& name,
                                               const std::string& observer) const {
  const model::Component* component = nullptr;
  for (const model::Component& one : method().observers)
    if (one.name == observer) component = &one;
  const auto found = dynamics_names_->event(component, name);
  const auto& events = design_->dynamics->events;
  for (std::size_t k = 0; found && k < events.size(); ++k)
    if (events[k].name == *found) return k;
  return std::nullopt;
}

std::size_t Binding::event_of(const model::FigureText& text, const std::string& observer) const {
  if (const auto found = find_event(text.event, observer)) return *found;
  const model::Component* component = nullptr;
  for (const model::Component& one : method().observers)
    if (one.name == observer) component = &one;
  throw InputError(text.place, "there is no event '" + text.event + "'" +
                                   suggestion(text.event, dynamics_names_->event_names(component)));
}

void Binding::bind_comparison() {
  for (const model::FigureText& text : problem().compare)
    for (model::Figure& figure : figures(text)) design_->compare.push_back(std::move(figure));
}

}  // namespace gainsmith::bind
