// Many runs at once beside single runs, run by run: run_agreement RUNS FILE...
//
// Of each problem, or gain file, runs 0, ..., RUNS - 1 of its seed are made by every kernel for many runs
// at once that takes them, and singly. What a kernel decides must be what the single run says: the
// verdict on each claim, which events happen, how near each claim comes to its bound. The judge of
// runs must find nothing, and each figure under `compare` that is known must be what the run that is
// shown has; where a run is undecided figures are not compared. Exit code 1 when something differs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "claims/twin_runs.h"
#include "gainsmith/load.h"
#include "statistics/bound_figure.h"
#include "verify/pack_judge.h"
#include "verify/replay.h"

namespace gainsmith {
namespace {

constexpr double kNear = 1e-5;       ///< relative, and absolute: figures
constexpr double kNearValue = 1e-4;  ///< the same: values at events, of many runs at once
constexpr double kNearPeak = 0.02;   ///< the same: what is said of peaks of many runs at once

/// A way to make many runs at once.
struct Kernel {
  std::string name;
  std::vector<packs::PackVerdict> verdicts;
};

struct Counts {
  std::uint64_t runs = 0, undecided = 0, early = 0, figures = 0, unknown = 0;
  std::array<std::uint64_t, 3> decided{}, asked{};  ///< linear, flights, packs
  std::vector<std::string> differences;

  void add(const Counts& more) {
    runs += more.runs;
    undecided += more.undecided;
    early += more.early;
    figures += more.figures;
    unknown += more.unknown;
    for (std::size_t k = 0; k < decided.size(); ++k) {
      decided[k] += more.decided[k];
      asked[k] += more.asked[k];
    }
    differences.insert(differences.end(), more.differences.begin(), more.differences.end());
  }
};

bool is_near(double one, double other, double near) {
  return one == other || (std::isnan(one) && std::isnan(other)) ||
         std::abs(one - other) <= near * (1 + std::min(std::abs(one), std::abs(other)));
}

class Comparison {
 public:
  Comparison(std::string file, std::uint64_t runs)
      : file_(std::move(file)),
        runs_(runs),
        loaded_(app::load_run(file_)),
        setup_(verify::make_setup(loaded_.stated, loaded_.gains)),
        seed_(loaded_.stated.design->campaign.seed),
        twins_(*setup_->events) {}

  Counts compare() {
    make_kernels();
    for (std::uint64_t run = 0; run < runs_; ++run) one_run(run);
    return std::move(counts_);
  }

 private:
  void make_kernels() {
    kernels_ = {{"linear", {}}, {"flights", {}}, {"packs", {}}};
    if (const auto linear = verify::make_linear_packs(*setup_))
      kernels_[0].verdicts = packs::LinearRunner(*linear).run(seed_, 0, runs_);
    const claims::RunSetup& events = setup_->judged();
    const simulate::Accuracy accuracy = events.accuracy(claims::kAccuracyOfMany);
    const Eigen::VectorXd absolute =
        accuracy.absolute_of.size() > 0
            ? accuracy.absolute_of
            : Eigen::VectorXd(Eigen::VectorXd::Constant(events.system.size, accuracy.absolute));
    const auto pack = packs::make_pack_system(events.system, events.scenario, events.claims,
                                              accuracy.relative, absolute);
    if (!pack) return;
    kernels_[2].verdicts = packs::PackRunner(*pack).run(seed_, 0, runs_);
    if (const auto flights = flights::make_flights(*pack, events.claims))
      kernels_[1].verdicts = flights::FlightRunner(*pack, *flights).run(seed_, 0, runs_);
  }

  void one_run(std::uint64_t run) {
    const verify::Replay single = verify::replay_run(*setup_, seed_, run, 0, true);
    ++counts_.runs;
    if (!single.faults.empty()) {
      const judge::Fault& fault = single.faults.front();
      differs(run, fmt::format("the judge at t = {}: {} ({} of {}), the first of {}", fault.t,
                               fault.what, fault.size, fault.allowed, single.faults.size()));
    }
    std::vector<char> happened(setup_->events->system.dynamics.events.size(), 0);
    for (const auto& part : single.run.parts)
      if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) happened[jump->event] = 1;
    const bool open = std::any_of(single.claims.begin(), single.claims.end(),
                                  [](const auto& one) { return one.finding.undecided(); });
    const bool early = !is_complete(single.run.ending);
    counts_.undecided += open ? 1 : 0;
    counts_.early += early ? 1 : 0;
    for (std::size_t k = 0; k < kernels_.size(); ++k) {
      if (kernels_[k].verdicts.empty()) continue;
      ++counts_.asked[k];
      const packs::PackVerdict& pack = kernels_[k].verdicts[static_cast<std::size_t>(run)];
      if (pack.open) continue;
      ++counts_.decided[k];
      one_verdict(run, kernels_[k].name, pack, single, happened, open);
    }
    if (!open && !early) figures(run, single.run);
  }

  /// `open`: the single run is undecided somewhere, and may not have been followed to its end.
  void one_verdict(std::uint64_t run, const std::string& kernel, const packs::PackVerdict& pack,
                   const verify::Replay& single, const std::vector<char>& happened, bool open) {
    if (!is_complete(single.run.ending))
      differs(run, kernel + ": decided, but the single run ends: " + single.run.message);
    for (std::size_t e = 0; e < happened.size() && !open; ++e)
      if ((pack.happened[e] != 0) != (happened[e] != 0))
        differs(run,
                fmt::format("{}: {} {}", kernel, setup_->events->system.dynamics.events[e].name,
                            happened[e] != 0 ? "is missed" : "is made up"));
    for (std::size_t c = 0; c < single.claims.size(); ++c) {
      const claims::Finding& finding = single.claims[c].finding;
      const claims::Finding& claim = pack.findings[c];
      const std::string name = kernel + ": " + single.claims[c].name;
      if (finding.undecided()) continue;
      if (claim.violated() != finding.violated() || claim.sampled != finding.sampled)
        differs(run, fmt::format("{}: {} with the score {}, singly {} with {}", name,
                                 claim.violated() ? "violated" : "held", claim.score,
                                 claims::to_string(finding.judgement), finding.score));
      else if (finding.sampled && !open && !is_near(claim.score, finding.score, near(c, finding)))
        differs(run, fmt::format("{}: the score {}, singly {}", name, claim.score, finding.score));
    }
  }

  /// Values just after events are known better than peaks; of rises only some points are seen.
  double near(std::size_t claim, const claims::Finding& finding) const {
    const claims::JudgedClaim& one = setup_->judged().judged[claim];
    if (one.kind == model::ClaimKind::nonincreasing && finding.violated()) return HUGE_VAL;
    return one.over ? kNearValue : kNearPeak;
  }

  void figures(std::uint64_t run, const hybrid::Trajectory& shown) {
    if (loaded_.stated.design->compare.empty()) return;
    const claims::TwinRun twins = twins_(seed_, run, claims::kAccuracyOfOne);
    for (const model::Figure& figure : loaded_.stated.design->compare) {
      statistics::BoundFigure bound(figure, *setup_->events);
      const auto one = bound.of(shown);
      const statistics::Estimate other = bound.of(twins);
      ++counts_.figures;
      if (!other.known()) {
        ++counts_.unknown;
      } else if (one.has_value() != other.value.has_value() ||
                 (one && !is_near(*one, *other.value, kNear))) {
        differs(run, fmt::format("{}: {} in the table, {} among figures", figure.title,
                                 one.value_or(NAN), other.value.value_or(NAN)));
      }
    }
  }

  void differs(std::uint64_t run, const std::string& how) {
    counts_.differences.push_back(fmt::format("{}: run {}: {}", file_, run, how));
  }

  std::string file_;
  std::uint64_t runs_;
  app::LoadedGains loaded_;
  std::unique_ptr<const verify::Setup> setup_;
  std::uint64_t seed_;
  claims::TwinRuns twins_;
  std::vector<Kernel> kernels_;
  Counts counts_;
};

int compare(const std::vector<std::string>& files, std::uint64_t runs) {
  std::vector<Counts> counts(files.size());
  parallel_for(files.size(), 0, [&](std::size_t k) {
    try {
      counts[k] = Comparison(files[k], runs).compare();
    } catch (const InputError& error) {
      counts[k].differences.push_back(files[k] + ": " + error.what());
    }
  });
  Counts all;
  for (const Counts& one : counts) all.add(one);
  for (const std::string& one : all.differences) std::cout << one << "\n";
  fmt::print(
      "{} files, {} runs: {} undecided, {} early; many at once decided {} of linear ({} asked), {} "
      "of flights ({} asked), {} of packs ({} asked); {} figures, {} unknown; {} differences\n",
      files.size(), all.runs, all.undecided, all.early, all.decided[0], all.asked[0],
      all.decided[1], all.asked[1], all.decided[2], all.asked[2], all.figures, all.unknown,
      all.differences.size());
  return all.differences.empty() ? 0 : 1;
}

}  // namespace
}  // namespace gainsmith

int main(int count, char** arguments) {
  if (count < 3) {
    std::cerr << "run_agreement RUNS FILE...\n";
    return 2;
  }
  return gainsmith::compare({arguments + 2, arguments + count},
                            std::strtoull(arguments[1], nullptr, 10));
}
