#include "gainsmith/search_wanted.h"

#include <fmt/format.h>

#include "base/stop.h"
#include "bind/instance.h"
#include "model/names.h"
#include "verify/run_measure.h"

namespace gainsmith::app {

namespace {

/// InputError when nothing says which values are best: without inequalities there is no margin.
void check_figure(const design::SearchRequest& request, const model::Design& design) {
  const bool has_figure = request.extreme || request.minimize || design.objective ||
                          design.quotient || !design.inequalities.empty();
  if (request.over.empty() || has_figure) return;
  const model::Range& range =
      design.open.empty() ? design.search->over.front() : design.open.front();
  throw InputError(range.place, "nothing says which " + range.name +
                                    " is best, as the method has no inequalities: give 'search: "
                                    "{minimize: ...}', or " +
                                    range.name + " a value");
}

}  // namespace

design::SearchRequest wanted_search(const model::Instance& instance) {
  design::SearchRequest request = design::request_of(instance);
  const auto& search = instance.design->search;
  if (!search || !search->run_figure) {
    check_figure(request, *instance.design);
    return request;
  }
  const model::Figure& figure = *search->run_figure;
  const std::uint64_t runs = search->runs;
  request.measure_name =
      figure.observer.empty() ? figure.title : figure.observer + ": " + figure.title;
  if (runs > 1) request.measure_name += fmt::format(", mean of {} runs", runs);
  // A text is bound again when values change a shape: the figure is that of the instance's design.
  request.measure = [runs](const model::Instance& at, const model::Gains& gains) {
    return verify::mean_figure(at, gains, *at.design->search->run_figure, runs);
  };
  return request;
}

void state_search(const model::Search& search, model::Problem& problem) {
  const auto end = [](const expr::Expression& expression) {
    const std::string& text = expression.text->str();
    const bool is_plain = text.find_first_of(",[]{}#:'") == std::string::npos;
    return is_plain ? text : '"' + text + '"';
  };
  const auto range = [&](const model::ScalarRange& interval) {
    return fmt::format("{}: [{}, {}]", interval.name, end(interval.low), end(interval.high));
  };
  std::string parts;
  if (search.extreme)
    parts =
        fmt::format("{}: {{{}}}", search.largest ? "largest" : "smallest", range(*search.extreme));
  std::string over;
  for (const model::ScalarRange& interval : search.over)
    over += (over.empty() ? "" : ", ") + range(interval);
  if (!over.empty()) parts += (parts.empty() ? "over: {" : ", over: {") + over + "}";
  std::erase_if(problem.settings, [](const auto& one) { return one.name == model::kSearch; });
  problem.settings.push_back({model::kSearch, "{" + parts + "}"});
}

void find_error(const model::Instance& instance, model::Gains& gains) {
  const auto& search = instance.design->search;
  if (!search || !search->run_figure || !gains.search || !gains.search->value) return;
  const Concluding concluding;
  const model::Instance at = bind::evaluate(instance.design, gains.searched);
  gains.search->error = verify::mean_error(at, gains, *at.design->search->run_figure, search->runs);
}

}  // namespace gainsmith::app
