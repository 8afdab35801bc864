#include "design/optimize.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "base/number.h"
#include "base/progress.h"
#include "base/stop.h"
#include "bind/instance.h"
#include "design/elastic.h"
#include "design/excluded_inequalities.h"
#include "design/hautus.h"
#include "design/joint_refinement.h"
#include "design/results.h"
#include "design/sos_statements.h"
#include "design/synthesize.h"
#include "search/ipopt.h"
#include "search/minimize.h"
#include "search/nlopt.h"

namespace gainsmith::design {

namespace {

/// The smallest margin of the strict inequalities; 0 where none is strict.
double smallest_margin(const model::Gains& gains) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const model::Margin& margin : gains.margins)
    if (margin.strict) smallest = std::min(smallest, margin.reached);
  return std::isfinite(smallest) ? smallest : 0;
}

/// The outer problem: minimise over the scalars s the figure f(s), such as the optimum of the
/// semidefinite program at s. f has no value where that is infeasible, is not convex and has kinks.
/// So it is searched without derivatives (search/minimize.h), on a grid first.
class OuterSearch {
 public:
  OuterSearch(const model::Instance& own, const SearchRequest& request, unsigned threads,
              const sdp::Options& solver, search::KnownValues& known)
      : own_(own), request_(request), threads_(threads), solver_(solver), known_(known) {}

  model::Gains run() {
    if (auto none = excluded_everywhere()) return *std::move(none);
    std::vector<search::Axis> axes;
    for (const SearchedScalar& scalar : request_.over) axes.push_back(scalar.axis);
    search::MinimizeOptions options;
    options.evaluations = request_.evaluations;
    options.threads = threads_;
    options.starts = {own_values()};
    // `cold` has no guess of the extreme; options.warm begins at the best one so far.
    const auto cold = [&](const search::Point& point) {
      doing_->step();
      return known_.value("figure", point, [&] { return figure(point, std::nullopt); });
    };
    if (request_.extreme)
      options.warm = [&](const search::Point& point, double best) {
        search::Point at = point;
        at.push_back(best);
        doing_->step();
        return known_.value("figure near", at,
                            [&] { return figure(point, request_.largest ? -best : best); });
      };
    // A design by formula has nothing to violate.
    const bool has_slacks = !own_.design->inequalities.empty();
    if (const auto scales = has_slacks ? scales_at(options.starts.front()) : std::nullopt)
      options.violation = [&, scales = *scales](const search::Point& point) {
        return *known_.value("violation", point, [&] { return violation(scales, point); });
      };
    const auto search = [&](const search::MinimizeOptions& asked) {
      const Doing doing("evaluations", static_cast<std::uint64_t>(asked.evaluations));
      doing_ = &doing;
      return search::minimize(cold, axes, local_, asked);
    };
    // With a mode that no gain moves a few points are enough to say that nothing was found.
    if (keeps_a_hidden_mode()) {
      search::MinimizeOptions few;
      few.starts = corners();
      few.evaluations = static_cast<int>(few.starts.size());
      if (const search::Minimum none = search(few); !none.point) return result(none);
    }
    return result(search(options));
  }

 private:
  /// Gains that the search met, with their figure.
  struct Found {
    model::Gains gains;
    double figure;
  };

  /// Keeps the best for a search that is stopped; `figure`.
  double keep(model::Gains gains, double figure) const {
    const std::lock_guard lock(mutex_);
    if (!best_ || figure < best_->figure) best_ = {std::move(gains), figure};
    return figure;
  }

  /// The values that the problem or the method gives, or the nearest in the ranges.
  search::Point own_values() const {
    search::Point point;
    for (const SearchedScalar& scalar : request_.over)
      point.push_back(std::clamp(model::scalar_named(own_, scalar.name).value_or(scalar.axis.high),
                                 scalar.axis.low, scalar.axis.high));
    return point;
  }

  /// These, and the two ends of all ranges.
  std::vector<search::Point> corners() const {
    std::vector<search::Point> points = {own_values(), {}, {}};
    for (const SearchedScalar& scalar : request_.over) {
      points[1].push_back(scalar.axis.low);
      points[2].push_back(scalar.axis.high);
    }
    return points;
  }

  /// Whether the output hides a mode, or the input does not reach it, and no value moves it.
  bool keeps_a_hidden_mode() const {
    const auto hides = [&](const search::Point& point) {
      try {
        return !hidden_mode_text(bind::evaluate(own_.design, at_easy_end(point))).empty();
      } catch (const InputError&) {
        return false;
      }
    };
    const std::vector<search::Point> points = corners();
    return std::all_of(points.begin(), points.end(), hides);
  }

  /// A no of all values.
  std::optional<model::Gains> excluded_everywhere() const {
    std::optional<model::Instance> at;
    try {
      at = bind::evaluate(own_.design, overrides(own_values()));
    } catch (const InputError&) {
      return std::nullopt;
    }
    auto excluded = excluded_inequalities(*at, request_, solver_);
    if (!excluded) return std::nullopt;
    std::string names;
    for (const SearchedScalar& scalar : request_.over) {
      const std::string& name = scalar.name;
      names += (names.empty() ? "" : ", ") + name;
      // It was solved at a value that says nothing.
      excluded->gains.searched.erase(name);
      std::erase_if(excluded->gains.parameters, [&](const auto& one) { return one.first == name; });
    }
    excluded->gains.solver.add_message(
        "the certificate is about inequalities that no searched value changes: no " + names +
        " has gains");
    return std::move(excluded->gains);
  }

  /// The problem's own overrides with the searched scalars at a point.
  model::Overrides overrides(const search::Point& point) const {
    model::Overrides values = own_.overrides;
    for (std::size_t i = 0; i < point.size(); ++i) values[request_.over[i].name] = point[i];
    return values;
  }

  /// What is minimised: none where there are no gains, or where the values are refused.
  std::optional<double> figure(const search::Point& point, std::optional<double> guess) const {
    const model::Overrides values = overrides(point);
    try {
      if (request_.extreme) {
        BisectResult result = bracket(values, kSharper, guess, Depth::quick);
        check_stop();
        if (!result.found.yes) return std::nullopt;
        const double found = request_.largest ? -*result.found.yes : *result.found.yes;
        return keep(std::move(result.gains), found);
      }
      const model::Instance instance = bind::evaluate(own_.design, values);
      model::Gains gains = synthesize(instance, solver_, Depth::quick);
      if (gains.verdict == model::Verdict::undecided) check_stop();
      if (gains.verdict != model::Verdict::yes) return std::nullopt;
      const auto found = value(instance, gains);
      return found ? keep(std::move(gains), *found) : found;
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  /// The overrides of a point, the scalar that is bisected at the end where it is easy.
  model::Overrides at_easy_end(const search::Point& point) const {
    model::Overrides values = overrides(point);
    if (const auto& extreme = request_.extreme)
      values[extreme->name] = request_.largest ? extreme->axis.low : extreme->axis.high;
    return values;
  }

  /// What the slacks of all points are measured in; none where the values of the point are refused.
  std::optional<Diagonals> scales_at(const search::Point& point) const {
    try {
      return row_scales_of(without_gains(bind::evaluate(own_.design, at_easy_end(point))));
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  /// How far a point is from feasible: the smallest sum of slacks. Infinite where the values are
  /// refused or the slacks are not decided.
  double violation(const Diagonals& scales, const search::Point& point) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    try {
      const auto plain = without_gains(bind::evaluate(own_.design, at_easy_end(point)));
      return estimated_violation(plain, scales, solver_).value_or(none);
    } catch (const InputError&) {
      return none;
    }
  }

  /// The figure of gains, without the sign that makes it a minimum.
  std::optional<double> value(const model::Instance& instance, const model::Gains& gains) const {
    if (request_.measure) return request_.measure(instance, gains);
    if (request_.minimize) {
      const auto found = Results(instance, gains).value(*request_.minimize);
      return found ? std::optional((*found)(0, 0)) : std::nullopt;
    }
    return gains.objective ? *gains.objective : -smallest_margin(gains);
  }

  /// The extreme of the scalar that is bisected, the outer scalars held.
  BisectResult bracket(const model::Overrides& values, double sharper, std::optional<double> guess,
                       Depth depth = Depth::thorough) const {
    return bisect(own_, values,
                  {*request_.extreme, request_.largest, request_.tolerance * sharper, guess, depth},
                  solver_);
  }

  /// The gains at values of the outer scalars, with the figure's value; for an extreme its bracket
  /// is in their record.
  std::pair<model::Gains, std::optional<double>> design_at(
      const model::Overrides& values, std::optional<double> guess = std::nullopt) const {
    if (request_.extreme) {
      BisectResult result = bracket(values, 1, guess);
      check_stop();
      return {std::move(result.gains), result.found.yes};
    }
    const model::Instance instance = bind::evaluate(own_.design, values);
    model::Gains gains = synthesize(instance, solver_);
    check_stop();
    // A measure was taken in the search.
    if (gains.verdict != model::Verdict::yes || request_.measure)
      return {std::move(gains), std::nullopt};
    const auto found = value(instance, gains);
    return {std::move(gains), found};
  }

  /// Whether figure a is better than b.
  bool is_better(double a, double b) const {
    return request_.extreme && request_.largest ? a > b : a < b;
  }

  /// Replaces a design by what joint refinement proposes, if that is better.
  model::RefinementRecord refine_design(model::Gains& gains, std::optional<double>& figure) const {
    const Proposal proposal = refine_jointly(own_, request_, gains, smooth_);
    model::RefinementRecord record{*figure, std::nullopt, false, proposal.cause};
    if (!proposal.scalars) return record;
    model::Overrides values = *proposal.scalars;
    if (request_.extreme) values.erase(request_.extreme->name);
    auto [refined, after] = design_at(values);
    record.after = after;
    record.kept = after && is_better(*after, *figure);
    if (record.kept) {
      gains = std::move(refined);
      figure = after;
    }
    return record;
  }

  /// Whether a value is an end of its axis, as far as the search tells values apart.
  static bool is_at_end(const search::Axis& axis, double value) {
    constexpr double kNear = 1e-4;
    const double fraction = axis.fraction(value);
    return std::min(fraction, 1 - fraction) < kNear;
  }

  /// The extreme that the search saw at its best point: there is something feasible there, which a
  /// bisection that begins anew may miss.
  std::optional<double> extreme_of(const search::Minimum& minimum) const {
    if (!request_.extreme) return std::nullopt;
    return request_.largest ? -minimum.value : minimum.value;
  }

  /// The gains at the best point, with the record of the search.
  /// The design at the best point is made anew, thoroughly, and perhaps refined.
  model::Gains result(const search::Minimum& minimum) const {
    model::Gains gains;
    std::optional<double> best;
    std::optional<model::RefinementRecord> refined;
    bool finished = minimum.finished;
    if (minimum.point) {
      // Unless the search comes to its end, those that it met.
      if (best_) {
        gains = best_->gains;
        best = request_.extreme && request_.largest ? -best_->figure : best_->figure;
      }
      try {
        std::tie(gains, best) = design_at(overrides(*minimum.point), extreme_of(minimum));
        if (request_.measure && gains.verdict == model::Verdict::yes) best = minimum.value;
        if (request_.refine && best && finished && !has_sums_of_squares(*own_.design))
          refined = refine_design(gains, best);
      } catch (const Stopped&) {
        if (!best_) throw;  // all figures were known
        finished = false;
      }
    } else {
      gains = nothing_found();
    }
    const Concluding concluding;
    model::SearchRecord record = gains.search.value_or(model::SearchRecord{});
    record.figure = figure_name(request_, *own_.design);
    // An objective without a minimum is no figure: the margin is.
    const bool stated = request_.extreme || request_.minimize || request_.measure;
    if (best && !stated && !gains.objective) record.figure = "margin";
    record.value = record.figure == "margin" && best ? std::optional(-*best) : best;
    record.joint_refinement = std::move(refined);
    for (const SearchedScalar& scalar : request_.over) {
      record.over.push_back(scalar.name);
      if (best && is_at_end(scalar.axis, gains.searched.at(scalar.name)))
        record.at_end.push_back(scalar.name);
    }
    record.evaluations = minimum.evaluations;
    record.feasible = minimum.feasible;
    record.finished = finished;
    gains.search = std::move(record);
    return gains;
  }

  /// At the problem's own values, or at an end of the ranges where these are refused.
  model::Gains gains_somewhere() const {
    const std::vector<search::Point> points = corners();
    for (const search::Point& point : points) {
      try {
        return synthesize_at(own_.design, overrides(point), solver_);
      } catch (const InputError&) {
        if (&point == &points.back()) throw;
      }
    }
    return {};
  }

  /// The result at the problem's own values, where there are no gains; it decides nothing of the
  /// ranges.
  model::Gains nothing_found() const {
    model::Gains gains = gains_somewhere();
    gains.verdict = model::Verdict::undecided;
    gains.solver.status = "undecided";
    gains.certificate.reset();
    std::string ranges;
    for (const SearchedScalar& scalar : request_.over)
      ranges += (ranges.empty() ? "" : ", ") + scalar.name + " in [" + brief(scalar.axis.low) +
                ", " + brief(scalar.axis.high) + "]";
    const std::string what =
        request_.measure ? "point at which the runs have a finite '" + request_.measure_name + "'"
                         : "feasible point";
    gains.solver.message = "no " + what + " was found for " + ranges;
    if (const std::string hidden = hidden_mode_text(own_); !hidden.empty())
      gains.solver.message += "; " + hidden;
    return gains;
  }

  /// Brackets inside the search are closer than the final one, so that their width is not
  /// mistaken for a slope.
  static constexpr double kSharper = 0.1;

  const model::Instance& own_;
  const SearchRequest& request_;
  const search::LocalSearch local_ = search::nlopt_search();
  const search::SmoothSolver smooth_ = search::ipopt_solver();
  unsigned threads_;
  const sdp::Options& solver_;
  search::KnownValues& known_;
  const Doing* doing_ = nullptr;  ///< the search
  mutable std::mutex mutex_;
  mutable std::optional<Found> best_;  ///< of the search so far
};

}  // namespace

model::Gains optimize(const model::Instance& own, const SearchRequest& request, unsigned threads,
                      const sdp::Options& solver, search::KnownValues& known) {
  return OuterSearch(own, request, threads, solver, known).run();
}

model::Gains synthesize_searched(const model::Instance& own, const SearchRequest& request,
                                 unsigned threads, const sdp::Options& solver) {
  if (request.empty()) return synthesize(own, solver);
  if (request.over.empty())
    return bisect(own, {}, {*request.extreme, request.largest, request.tolerance, std::nullopt},
                  solver)
        .gains;
  search::KnownValues none;
  return optimize(own, request, threads, solver, none);
}

}  // namespace gainsmith::design
