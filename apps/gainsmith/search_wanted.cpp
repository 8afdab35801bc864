#include "gainsmith/search_wanted.h"

#include <fmt/format.h>

#include "gainsmith/terminal.h"
#include "verify/run_measure.h"

namespace gainsmith::app {

design::SearchRequest wanted_search(const model::Instance& instance) {
  design::SearchRequest request = design::request_of(instance);
  const auto& search = instance.design->search;
  if (!search || !search->run_figure) return request;
  const model::Figure& figure = *search->run_figure;
  const std::uint64_t runs = search->runs;
  request.measure_name =
      figure.observer.empty() ? figure.title : figure.observer + ": " + figure.title;
  if (runs > 1) request.measure_name += fmt::format(", mean of {} runs", runs);
  // A text is bound again when values change a shape: the figure is that of the instance's design.
  request.measure = [runs](const model::Instance& at, const model::Gains& gains) {
    return verify::mean_figure(at, gains, *at.design->search->run_figure, runs, interrupted);
  };
  return request;
}

}  // namespace gainsmith::app
