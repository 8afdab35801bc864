#include "bind/search.h"

#include <set>

#include "base/named.h"
#include "base/nearest.h"
#include "bind/estimates.h"
#include "bind/formulas.h"

namespace gainsmith::bind {

namespace {

/// Each scalar is searched once only.
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

/// A number over the results of a design, the objective among them.
model::Formula scalar_figure(const Binding& binding, const expr::Expression& text) {
  model::Formula bound = formula(text, binding.names->results);
  if (!bound.program.shape().is_scalar())
    throw InputError(bound.place, "expected a number, found a matrix: " + bound.text);
  return bound;
}

/// InputError where there is no such event.
std::size_t event_of(const Binding& binding, const model::FigureText& text,
                     const std::string& observer) {
  if (const auto found = find_event(binding, text.event, observer)) return *found;
  const model::Component* component = nullptr;
  for (const model::Component& one : binding.method().observers)
    if (one.name == observer) component = &one;
  throw InputError(text.place,
                   "there is no event '" + text.event + "'" +
                       suggestion(text.event, binding.dynamics_names->event_names(component)));
}

/// Of each observer that has the names in it, or the only one.
std::vector<model::Figure> figures(const Binding& binding, const model::FigureText& text) {
  if (!binding.design->dynamics)
    throw InputError(text.place, "figures are of runs, and the method has no dynamics");
  std::vector<expr::Expression> texts;
  if (text.value) texts.push_back(*text.value);
  if (text.error) texts.push_back(*text.error);
  std::vector<Reading> readings = {{text.observer, {}}};
  if (text.value && !text.observer.empty())
    readings = {binding.dynamics_names->of_observer(text.observer, texts, text.place)};
  else if (text.value)
    readings = binding.dynamics_names->outside(texts);
  std::vector<model::Figure> result;
  for (const Reading& reading : readings) {
    model::Figure bound;
    bound.kind = text.kind;
    bound.title = text.title;
    bound.observer = reading.observer;
    bound.count = text.count;
    bound.after = text.after;
    bound.place = text.place;
    // Of the error first: its messages are about what was written.
    if (text.error)
      bound.elements = formula(reading.texts.back(), binding.names->running).program.shape().size();
    if (text.value) bound.value = scalar(reading.texts.front(), binding.names->running);
    if (bound.value && estimate(*binding.design, bound.value->program) != expr::Estimate::none)
      bound.title += " (from estimates)";
    if (!text.event.empty()) bound.event = event_of(binding, text, reading.observer);
    const bool at_event =
        text.kind == model::FigureKind::at_event || text.kind == model::FigureKind::nis;
    for (const expr::Expression& part : reading.texts)
      check_measured(binding, part, at_event ? std::optional(bound.event) : std::nullopt,
                     text.place, "; `at: {event: ...}` and `nis` have its values");
    for (const expr::Expression& number : text.numbers)
      bound.numbers.push_back(scalar(number, binding.names->known));
    result.push_back(std::move(bound));
  }
  return result;
}

}  // namespace

/// The index in Dynamics::events; none where there is none.
std::optional<std::size_t> find_event(const Binding& binding, const std::string& name,
                                      const std::string& observer) {
  const model::Component* component = nullptr;
  for (const model::Component& one : binding.method().observers)
    if (one.name == observer) component = &one;
  const auto found = binding.dynamics_names->event(component, name);
  const auto& events = binding.design->dynamics->events;
  for (std::size_t k = 0; found && k < events.size(); ++k)
    if (events[k].name == *found) return k;
  return std::nullopt;
}

/// Parameters of the method with a range and without a value stay open: they are searched by
/// default.
void bind_search(Binding& binding) {
  const auto named = [&](const model::ScalarRange& text) {
    check_scalar_name(*binding.design, text.name, text.place);
    return range(text, binding.names->known);
  };
  const auto checked = [&](const model::ScalarRange& text) {
    model::Range bound = named(text);
    if (binding.checks == Checks::all) ends_of(bound, binding.recorder->values);
    return bound;
  };
  for (const model::ScalarRange& text : binding.problem().negotiable)
    binding.design->negotiable.push_back(checked(text));
  const auto is_given = [&](const std::string& name) {
    return has_named(binding.problem().parameters, name);
  };
  for (const model::Parameter& parameter : binding.method().parameters)
    if (parameter.search && !is_given(parameter.name))
      binding.design->open.push_back(checked(*parameter.search));
  for (const model::ScalarRange& text : binding.problem().questions.ranges)
    binding.design->asked.push_back(named(text));  // of a grid, which may have one point
  for (const expr::Expression& figure : binding.problem().questions.figures)
    binding.design->figures.push_back({figure.text->str(), scalar_figure(binding, figure), {}});
  if (!binding.problem().search) return;
  const model::Search& search = *binding.problem().search;
  refuse_repetition(search);
  model::Design::Search bound;
  if (search.extreme) bound.extreme = checked(*search.extreme);
  bound.largest = search.largest;
  bound.tolerance = search.tolerance;
  for (const model::ScalarRange& text : search.over) bound.over.push_back(checked(text));
  if (search.minimize) bound.minimize = scalar(*search.minimize, binding.names->results);
  if (search.run_figure) bound.run_figure = only(figures(binding, *search.run_figure));
  bound.runs = search.runs;
  bound.evaluations = search.evaluations;
  binding.design->search = std::move(bound);
}

void bind_expectation(Binding& binding) {
  if (!binding.problem().expect) return;
  const model::Expectation& expect = *binding.problem().expect;
  model::Design::Expectation bound;
  bound.verdict = expect.verdict;
  bound.status = expect.status;
  bound.campaign = expect.campaign;
  bound.active_bounds = expect.active_bounds;
  bound.place = expect.place;
  for (const model::ExpectedValue& each : expect.values) {
    model::Formula what = formula(each.what, binding.names->results);
    const auto of =
        [&](const std::optional<model::Value>& wanted) -> std::optional<model::Formula> {
      if (!wanted) return std::nullopt;
      return value(*wanted, binding.names->known, what.program.shape());
    };
    auto wanted = of(each.value), below = of(each.below), above = of(each.above);
    bound.values.push_back({each.name, std::move(what), std::move(wanted), std::move(below),
                            std::move(above), each.relative, each.absolute, each.place});
  }
  for (const model::ExpectedFigureText& text : expect.run) {
    const auto known = [&](const std::optional<expr::Expression>& wanted) {
      return wanted ? std::optional(scalar(*wanted, binding.names->known)) : std::nullopt;
    };
    model::ExpectedFigure figure{only(figures(binding, text.figure)),
                                 known(text.is),
                                 known(text.below),
                                 known(text.above),
                                 text.ending,
                                 text.relative,
                                 text.absolute};
    bound.run.push_back(std::move(figure));
  }
  binding.design->expect = std::move(bound);
}

void bind_comparison(Binding& binding) {
  for (const model::FigureText& text : binding.problem().compare)
    for (model::Figure& figure : figures(binding, text))
      binding.design->compare.push_back(std::move(figure));
}

}  // namespace gainsmith::bind
