#include "design/search_request.h"

#include <algorithm>

#include "base/named.h"
#include "base/number.h"

namespace gainsmith::design {

namespace {

bool names(const SearchRequest& request, const std::string& name) {
  return (request.extreme && request.extreme->name == name) || has_named(request.over, name);
}

}  // namespace

SearchedScalar searched_scalar(const model::Instance& instance, const model::Range& range) {
  const auto [low, high] = model::ends_of(range, instance.values);
  return {range.name, search::axis(low, high)};
}

SearchRequest request_of(const model::Instance& instance) {
  SearchRequest request;
  if (const auto& search = instance.design->search) {
    if (search->extreme) {
      request.extreme = searched_scalar(instance, *search->extreme);
      request.tolerance = tolerance_of(search->tolerance, request.extreme->axis);
    }
    request.largest = search->largest;
    for (const model::Range& range : search->over)
      request.over.push_back(searched_scalar(instance, range));
    request.minimize = search->minimize;
    request.evaluations = search->evaluations;
  }
  for (const model::Range& range : instance.design->open)
    if (!names(request, range.name)) request.over.push_back(searched_scalar(instance, range));
  return request;
}

std::vector<HeldScalar> held_scalars(const model::Instance& instance,
                                     const std::vector<std::string>& varied) {
  const SearchRequest request = request_of(instance);
  std::vector<SearchedScalar> searched = request.over;
  if (request.extreme) searched.push_back(*request.extreme);
  std::vector<HeldScalar> held;
  for (const SearchedScalar& scalar : searched) {
    const auto value = model::scalar_named(instance, scalar.name);
    if (value && std::find(varied.begin(), varied.end(), scalar.name) == varied.end())
      held.push_back({scalar.name, *value});
  }
  return held;
}

std::string held_text(const std::vector<HeldScalar>& held) {
  std::string text;
  for (const HeldScalar& scalar : held)
    text += (text.empty() ? "" : ", ") + scalar.name + " = " + brief(scalar.value);
  return text;
}

search::Tolerance default_tolerance(const search::Axis& axis) {
  constexpr double kPart = 1e-4;
  if (axis.logarithmic) return {kPart, true};
  return {kPart * (axis.high - axis.low), false};
}

search::Tolerance tolerance_of(const std::optional<double>& width, const search::Axis& axis) {
  return width ? search::Tolerance{*width, false} : default_tolerance(axis);
}

std::string figure_name(const SearchRequest& request, const model::Design& design) {
  if (request.extreme) return (request.largest ? "largest " : "smallest ") + request.extreme->name;
  if (request.measure) return request.measure_name;
  if (request.minimize) return request.minimize->text;
  return design.objective || design.quotient ? "objective" : "margin";
}

}  // namespace gainsmith::design
