#include "design/search_request.h"

#include <algorithm>

namespace gainsmith::design {

namespace {

SearchedScalar with_numbers(const model::Instance& instance, const model::ScalarRange& range) {
  const auto [low, high] = ends_of(range, instance.scope, instance.known_values());
  return {range.name, search::axis(low, high)};
}

bool names(const SearchRequest& request, const std::string& name) {
  return (request.extreme && request.extreme->name == name) ||
         std::any_of(request.over.begin(), request.over.end(),
                     [&](const SearchedScalar& scalar) { return scalar.name == name; });
}

}  // namespace

SearchRequest request_of(const model::Problem& problem) {
  const model::Instance instance = model::make_instance(problem);
  SearchRequest request;
  if (const auto& search = problem.search) {
    if (search->extreme) {
      request.extreme = with_numbers(instance, *search->extreme);
      request.tolerance = tolerance_of(search->tolerance, request.extreme->axis);
    }
    request.largest = search->largest;
    for (const model::ScalarRange& range : search->over)
      request.over.push_back(with_numbers(instance, range));
    request.minimize = search->minimize;
    request.evaluations = search->evaluations;
  }
  for (const model::ScalarRange& range : open_parameters(problem))
    if (!names(request, range.name)) request.over.push_back(with_numbers(instance, range));
  return request;
}

search::Tolerance default_tolerance(const search::Axis& axis) {
  constexpr double kPart = 1e-4;
  if (axis.logarithmic) return {kPart, true};
  return {kPart * (axis.high - axis.low), false};
}

search::Tolerance tolerance_of(const std::optional<double>& width, const search::Axis& axis) {
  return width ? search::Tolerance{*width, false} : default_tolerance(axis);
}

SearchedScalar searched_scalar(const model::Problem& problem, const model::ScalarRange& range) {
  return with_numbers(model::make_instance(problem), range);
}

std::string figure_name(const SearchRequest& request, const model::Method& method) {
  if (request.extreme) return (request.largest ? "largest " : "smallest ") + request.extreme->name;
  if (request.minimize) return request.minimize->text->str();
  return method.minimize ? "objective" : "margin";
}

}  // namespace gainsmith::design
