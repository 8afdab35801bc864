#include "verify/worst.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/stop.h"
#include "search/nlopt.h"
#include "verify/draw_cube.h"
#include "verify/pack_judge.h"

namespace gainsmith::verify {

namespace {

using Point = std::vector<double>;

constexpr double kLargestMargin = 1e6;

/// The worst run so far of one claim.
struct Worst {
  double margin = -std::numeric_limits<double>::infinity();
  bool violated = false;
  claims::Finding finding;
  std::size_t cube = 0;
  Point u;
};

bool is_worse(const Worst& a, const Worst& b) {
  return std::pair(a.violated, a.margin) > std::pair(b.violated, b.margin);
}

/// Runs of one thread, in a place of the given runs that is its own.
class Runs {
 public:
  /// `linear`: nullptr, or what makes the runs.
  Runs(const Setup& setup, const linear::LinearSystem* linear, const Doing& doing,
       hybrid::GivenRun& run, std::size_t number, std::uint64_t seed)
      : setup_(&setup),
        doing_(&doing),
        run_(&run),
        number_(number),
        seed_(seed),
        judge_(setup),
        worst_(setup.events->judged.size()) {
    if (linear != nullptr) linear_.emplace(*linear);
  }

  /// The margin of a claim at a point of a cube.
  double operator()(const DrawCube& cube, std::size_t cube_number, const Point& u,
                    std::size_t claim) {
    check_stop();
    *run_ = cube.at(u);
    const auto [findings, lost] = make();
    ++made_;
    doing_->step();
    double margin = 0;
    for (std::size_t c = 0; c < worst_.size(); ++c) {
      const claims::Finding& finding = findings[c];
      Worst worst{margin_of(finding, setup_->events->judged[c].kind), finding.violated(), finding,
                  cube_number, u};
      if (lost) worst.margin = kLargestMargin;
      if (c == claim) margin = worst.margin;
      if (is_worse(worst, worst_[c])) worst_[c] = std::move(worst);
    }
    return margin;
  }

  const std::vector<Worst>& worst() const { return worst_; }
  std::uint64_t made() const { return made_; }

 private:
  /// One computation of a run.
  struct Made {
    std::vector<claims::Finding> findings;
    bool lost = false;  ///< the run ends early for certain
  };

  /// By a linear pack where that decides, else by one run of the campaign and its track.
  Made make() {
    if (linear_) {
      const packs::PackVerdict verdict = linear_->run(seed_, number_, number_ + 1).front();
      if (!verdict.open) return {verdict.findings, false};
    }
    const claims::Track& track = judge_.track(seed_, number_);
    check_stop();  // perhaps amid the run
    Made made{{}, track.termination == claims::Termination::broken_off};
    for (const claims::ClaimCheck& check : judge_.checks()) made.findings.push_back(check(track));
    return made;
  }

  const Setup* setup_;
  const Doing* doing_;
  hybrid::GivenRun* run_;
  std::size_t number_;
  std::uint64_t seed_;
  Judge judge_;
  std::optional<packs::LinearRunner> linear_;
  std::vector<Worst> worst_;
  std::uint64_t made_ = 0;
};

/// The search over all claims: cubes with periods first, then draw by draw.
class Search {
 public:
  Search(const model::Instance& instance, const model::Gains& gains, const WorstOptions& options)
      : options_(options), setup_(make_setup(instance, gains, &given_)) {
    constexpr std::uint64_t kExact = 3000, kIntegrated = 600;
    linear_ = make_linear_packs(*setup_);
    runs_ = options.runs.value_or(linear_ ? kExact : kIntegrated);
    if (setup_->events->judged.empty())
      throw InputError(instance.design->campaign.place,
                       "there is no claim to search the worst run of");
    make_cubes();
    if (cubes_.front().size() == 0)
      throw InputError(instance.design->campaign.place,
                       "nothing is drawn in this campaign: there is no worst run to search");
  }

  WorstReport report() {
    WorstReport report;
    report.seed = options_.seed;
    report.horizon = setup_->horizon();
    for (const claims::Claim& claim : setup_->claims())
      if (!claim.stated()) report.missing.emplace_back(claim.name, claim.missing);
    const Doing doing("runs of the search", runs_);
    doing_ = &doing;
    try {
      report.lengths = fastest_lengths(*setup_);
      if (report.lengths && report.lengths->lengths.size() > kPeriods)
        cubes_.insert(cubes_.end() - 1, cube(report.lengths->lengths.size()));
      lengths_ = report.lengths ? report.lengths->lengths : Point();
      search_periods();
      if (cubes_.back().size() > cubes_.front().size()) search_each_draw();
      judge(report);
      report.runs = made_;
    } catch (const Stopped&) {
      leave(report);
    }
    return report;
  }

 private:
  static constexpr std::size_t kPeriods = 3;

  /// Period 0: all draws up to the horizon.
  DrawCube cube(std::size_t period) const {
    return {setup_->events->system, setup_->events->scenario, period};
  }

  /// Those with a period, and last the one without.
  void make_cubes() {
    cubes_.push_back(cube(1));
    for (std::size_t period = 2; period <= kPeriods; ++period)
      if (cube(period).size() > cubes_.front().size()) cubes_.push_back(cube(period));
    cubes_.push_back(cube(0));
  }

  std::size_t claims() const { return setup_->events->judged.size(); }

  /// Does the tasks, each with runs of its own, and keeps what is worse in their order.
  template <class Task>
  void share(std::size_t count, const Task& task) {
    given_.assign(count, {});
    std::vector<std::optional<Runs>> runs(count);
    try {
      parallel_for(count, options_.threads, [&](std::size_t i) {
        runs[i].emplace(*setup_, linear_.get(), *doing_, given_[i], i, options_.seed);
        task(i, *runs[i]);
      });
    } catch (const Stopped&) {
      add(runs);
      throw;
    }
    add(runs);
  }

  /// In the order of the tasks, so that the number of threads does not matter.
  void add(const std::vector<std::optional<Runs>>& runs) {
    for (const auto& run : runs) {
      if (!run) continue;
      made_ += run->made();
      for (std::size_t c = 0; c < claims(); ++c)
        if (is_worse(run->worst()[c], worst_[c])) worst_[c] = run->worst()[c];
    }
  }

  /// Two thirds of the runs, evenly to claims and periods.
  void search_periods() {
    constexpr std::uint64_t kFewest = 16;
    const std::size_t periods = cubes_.size() - 1;
    const std::size_t tasks = claims() * periods;
    const auto runs =
        static_cast<int>(std::max(kFewest, 2 * runs_ / 3 / static_cast<std::uint64_t>(tasks)));
    worst_.assign(claims(), {});
    share(tasks, [&](std::size_t task, Runs& own) {
      search_cube(task % periods, task / periods, runs, options_.seed + task, own);
    });
  }

  /// Half of the runs all over the cube (CRS2), half near the best point (simplex, BOBYQA).
  void search_cube(std::size_t number, std::size_t claim, int runs, std::uint64_t seed, Runs& own) {
    const DrawCube& cube = cubes_[number];
    const auto function = [&](const Point& u) { return -own(cube, number, u, claim); };
    Point start = cube.start();
    if (!lengths_.empty()) start = cube.with_lengths(std::move(start), 0, lengths_);
    search::LocalSearchOptions options;
    options.step = 0.2;
    options.evaluations = (runs + 1) / 2;
    const auto go_on = [] { return true; };
    search::nlopt_global_search(seed)(function, start, options, go_on);
    options.step = 0.1;
    options.evaluations = runs / 2;
    search::nlopt_search()(function, own.worst()[claim].u, options, go_on);
  }

  /// Each draw of the worst run at both its ends, until nothing gets worse; of claims that no run
  /// violates so far.
  void search_each_draw() {
    const std::size_t number = cubes_.size() - 1;
    const DrawCube& cube = cubes_[number];
    const std::uint64_t most = runs_ / 3 / static_cast<std::uint64_t>(claims());
    const std::vector<Worst> from = worst_;
    share(claims(), [&](std::size_t claim, Runs& own) {
      if (from[claim].violated) return;
      Point u = cube.unrolled(cubes_[from[claim].cube], from[claim].u);
      double margin = own(cube, number, u, claim);
      for (bool worse = true; worse && own.made() < most;) {
        worse = false;
        for (std::size_t i = 0; i < u.size() && own.made() + 1 < most; ++i)
          for (const double end : {0.0, 1.0}) {
            if (u[i] == end) continue;
            const double before = std::exchange(u[i], end);
            const double next = own(cube, number, u, claim);
            if (next > margin)
              worse = true, margin = next;
            else
              u[i] = before;
          }
      }
    });
  }

  /// The worst runs again, as they are given in the report.
  void judge(WorstReport& report) {
    given_.assign(claims(), {});
    Judge judge(*setup_);
    report.verdict = model::CampaignVerdict::held;
    for (std::size_t c = 0; c < claims(); ++c) {
      const claims::JudgedClaim& claim = setup_->events->judged[c];
      claims::Finding finding = simplest(c, judge);
      if (finding.violated() && !judge.confirm(options_.seed, c).findings[c].violated()) {
        finding.judgement = claims::Judgement::undecided;
        finding.disputed = true;
      }
      check_stop();
      if (finding.violated()) report.verdict = model::CampaignVerdict::violated;
      if (finding.undecided() && report.verdict == model::CampaignVerdict::held)
        report.verdict = model::CampaignVerdict::undecided;
      report.claims.push_back({claim.name, claim.kind, finding});
    }
    report.given = given_;
  }

  /// The worst runs by careful runs, as far as half a second goes: packs know their values at the end.
  void make_worst_carefully() {
    const Concluding concluding(0.5);
    given_.assign(claims(), {});
    Judge judge(*setup_);
    try {
      for (std::size_t c = 0; c < worst_.size(); ++c) {
        given_[c] = cubes_[worst_[c].cube].at(worst_[c].u);
        const claims::Finding finding = finding_of(c, judge);
        check_stop();  // perhaps amid the run
        worst_[c].finding = finding;
      }
    } catch (const Stopped&) {
      // Then what packs say is told.
    }
  }

  /// What was found so far.
  void leave(WorstReport& report) {
    if (linear_ && made_ > 0) make_worst_carefully();
    report.runs = made_;
    report.interrupted = true;
    report.verdict = model::CampaignVerdict::undecided;
    report.claims.clear();
    report.given.clear();
    for (std::size_t c = 0; c < worst_.size() && made_ > 0; ++c) {
      const claims::JudgedClaim& claim = setup_->events->judged[c];
      report.claims.push_back({claim.name, claim.kind, worst_[c].finding});
      report.given.push_back(cubes_[worst_[c].cube].at(worst_[c].u));
    }
  }

  /// The worst run of a claim with numbers of as few digits as leave it nearly as bad.
  claims::Finding simplest(std::size_t claim, Judge& judge) {
    constexpr double kAsBad = 0.1;  // of the margin
    const Worst& worst = worst_[claim];
    const DrawCube& cube = cubes_[worst.cube];
    for (const int digits : {2, 3, 4, 6}) {
      given_[claim] = cube.rounded(worst.u, digits);
      claims::Finding finding = finding_of(claim, judge);
      check_stop();
      const double margin = margin_of(finding, setup_->events->judged[claim].kind);
      if (finding.violated() == worst.violated &&
          margin >= worst.margin - kAsBad * std::abs(worst.margin))
        return finding;
    }
    given_[claim] = cube.at(worst.u);
    return finding_of(claim, judge);
  }

  /// By the careful run, with what linear packs prove.
  claims::Finding finding_of(std::size_t claim, Judge& judge) const {
    return verdict_on_run(judge, linear_.get(), options_.seed, claim).findings[claim];
  }

  WorstOptions options_;
  const Doing* doing_ = nullptr;  ///< the search
  std::uint64_t runs_ = 0;
  std::vector<hybrid::GivenRun> given_;  ///< of the setup: those that are being made
  std::unique_ptr<const Setup> setup_;
  std::unique_ptr<const linear::LinearSystem> linear_;  ///< none: runs are careful
  std::vector<DrawCube> cubes_;
  Point lengths_;
  std::vector<Worst> worst_;  ///< by claim
  std::uint64_t made_ = 0;
};

}  // namespace

double margin_of(const claims::Finding& finding, model::ClaimKind kind) {
  if (!finding.sampled) return -kLargestMargin;
  if (finding.ended) return finding.violated() ? kLargestMargin : 0;
  const bool above = kind == model::ClaimKind::above;
  const double value = above ? finding.bound : finding.value;
  const double bound = above ? finding.value : finding.bound;
  double margin = finding.score;
  // log(value/bound) without an overflow of the quotient.
  if (bound > 0 && value > 0) margin = std::log(value) - std::log(bound);
  if (std::isnan(margin)) return kLargestMargin;
  return std::clamp(margin, -kLargestMargin, kLargestMargin);
}

WorstReport search_worst(const model::Instance& instance, const model::Gains& gains,
                         const WorstOptions& options) {
  return Search(instance, gains, options).report();
}

}  // namespace gainsmith::verify
