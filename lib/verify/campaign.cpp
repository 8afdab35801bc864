#include "verify/campaign.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/save_pace.h"
#include "base/stop.h"
#include "hybrid/doubts.h"
#include "hybrid/idle.h"
#include "verify/growing.h"

namespace gainsmith::verify {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::uint64_t kFirstRuns = 64;  ///< by which it is decided whether packs go on

}  // namespace

/// What threads have done, added as it comes, and saved now and then. Of a campaign until its first
/// violated run it is added in the order of the runs, and nothing behind that run.
class Collector {
 public:
  Collector(CampaignPart& part, const Save& save, const Doing& doing)
      : part_(part), save_(save), doing_(doing), next_(part.runs.count()) {}

  void add(statistics::RunRange range, const Tally& tally) {
    if (range.count() == 0) return;
    const std::scoped_lock lock(mutex_);
    if (!part_.facts.until_violated) return take(range, tally);
    waiting_.emplace(range.first, Waiting{range, tally});
    for (auto at = waiting_.begin(); at != waiting_.end() && at->first == next_ && !part_.ended();
         at = waiting_.erase(at)) {
      next_ = at->second.range.last;
      take(at->second.range, at->second.tally);
    }
  }

  /// This run is made.
  void note(std::uint64_t run, const Tally& tally) {
    doing_.step();
    if (!part_.facts.until_violated || tally.violations == 0) return;
    std::uint64_t known = last_;
    while (run < known && !last_.compare_exchange_weak(known, run)) {
    }
  }
  /// Whether the campaign ends before this run.
  bool is_behind_the_end(std::uint64_t run) const { return run > last_; }

  void finish() {
    const std::scoped_lock lock(mutex_);
    if (unsaved_) save();
  }

 private:
  struct Waiting {
    statistics::RunRange range;
    Tally tally;
  };

  /// Adds to the part; saves it when that is due.
  void take(statistics::RunRange range, const Tally& tally) {
    part_.runs.add(range);
    verify::add(tally, part_.tally);
    unsaved_ = true;
    if (pace_.is_due()) save();
  }

  /// Writes what has been added since the last time.
  void save() {
    if (!save_) return;
    pace_.save(save_);
    unsaved_ = false;
  }

  std::mutex mutex_;
  CampaignPart& part_;
  const Save& save_;
  const Doing& doing_;
  bool unsaved_ = false;
  SavePace pace_;
  std::atomic<std::uint64_t> last_ = std::numeric_limits<std::uint64_t>::max();
  std::map<std::uint64_t, Waiting> waiting_;  ///< for runs before them
  std::uint64_t next_;                        ///< run that is to be added
};

namespace {

/// Judges that wait for the next block of runs: as many are made as threads ask at once.
class Judges {
 public:
  Judges(const Setup& setup, const Packs* packs) : setup_(setup), packs_(packs) {}

  std::unique_ptr<PackJudge> take() {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) return std::make_unique<PackJudge>(setup_, packs_);
    std::unique_ptr<PackJudge> judge = std::move(idle_.back());
    idle_.pop_back();
    return judge;
  }
  void give_back(std::unique_ptr<PackJudge> judge) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(judge));
  }

 private:
  const Setup& setup_;
  const Packs* packs_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<PackJudge>> idle_;
};

/// Makes these runs, or those until the campaign is stopped. Slow runs are handed over as they come.
void judge_runs(statistics::RunRange range, PackJudge& judge, Collector& collector) {
  constexpr Seconds kSlow(1);
  Tally sum;
  std::uint64_t from = range.first, next = range.first;
  auto begin = Clock::now();
  try {
    for (; next < range.last; ++next) {
      check_stop();
      if (collector.is_behind_the_end(next)) break;
      const CampaignVerdictOnRun made = judge(next);
      if (made.careful) check_stop();  // perhaps amid the run
      Tally tally = tally_of(next, made.verdict);
      tally.careful = made.careful ? 1 : 0;
      if (made.why) tally.open[static_cast<std::size_t>(*made.why)] = 1;
      add(tally, sum);
      collector.note(next, tally);
      if (!made.careful || Clock::now() < begin + kSlow) continue;
      collector.add({from, next + 1}, std::exchange(sum, {}));
      from = next + 1;
      begin = Clock::now();
    }
  } catch (const Stopped&) {
    // Those that are done count.
  }
  collector.add({from, next}, sum);
}

/// InputError when no claim is stated.
void require_a_claim(const Place& place, const std::vector<claims::Claim>& claims) {
  if (claims.empty())
    throw InputError(place, "the method makes no claims, so there is nothing to verify");
  for (const claims::Claim& claim : claims)
    if (claim.stated()) return;
  throw InputError(place, "no claim can be checked: there is no value for " +
                              claims.front().missing.front() + ", which '" + claims.front().name +
                              "' needs");
}

/// What the report needs of the setup, so that parts are concluded without it.
CampaignFacts facts_of(const Setup& setup, const CampaignOptions& options) {
  const model::RunTexts& texts = setup.events->texts;
  CampaignFacts facts;
  facts.different = hybrid::different_runs(setup.events->system, setup.events->scenario);
  facts.asked = options.runs.value_or(texts.campaign.runs);
  // A run that repeats another one says nothing.
  if (facts.different) facts.asked = std::min(facts.asked, *facts.different);
  facts.seed = options.seed.value_or(texts.campaign.seed);
  if (facts.asked == 0) throw InputError(texts.campaign.place, "a campaign needs at least one run");
  facts.confidence = options.confidence;
  facts.horizon = setup.horizon();
  facts.doubts = hybrid::doubts_about(texts.dynamics, texts.claims, setup.events->system.constants);
  facts.doubts.insert(facts.doubts.begin(), setup.unread.begin(), setup.unread.end());
  for (const auto& event : setup.events->system.dynamics.events)
    facts.events.push_back(event.is_built_in() ? "" : event.name);
  for (const claims::Claim& claim : setup.claims())
    facts.claims.push_back(
        {claim.name, claim.kind, claim.missing, growing_mode(*setup.events, claim)});
  return facts;
}

/// The careful run on the worst run of each claim. `proved`: the errors of packs are.
void repeat_carefully(const Setup& setup, bool proved, CampaignPart& part) {
  PackJudge judge(setup, nullptr);
  const std::vector<ClaimTally>& claims = part.tally.claims;
  for (std::size_t c = 0; c < claims.size(); ++c) {
    const ClaimTally& claim = claims[c];
    auto& careful = part.repeats[claim.run].careful;
    if (!careful) {
      std::vector<bool> holds;
      holds.reserve(claims.size());
      for (const ClaimTally& tally : claims)
        holds.push_back(proved && tally.run == claim.run &&
                        tally.worst.judgement == claims::Judgement::held);
      RunVerdict again = judge.careful(part.facts.seed, claim.run, holds);
      check_stop();  // perhaps amid the run
      careful = {std::move(again.findings), again.termination, std::move(again.message)};
    }
    require_agreement(claim.run, claim.worst.judgement, careful->findings[c].judgement);
  }
}

/// Whether the worst runs that violate do so when they are repeated.
void confirm_violations(const Setup& setup, CampaignPart& part) {
  const Tally& tally = part.tally;
  std::set<std::uint64_t> runs;
  if (tally.violations > 0) runs.insert(tally.worst->run);
  for (const ClaimTally& claim : tally.claims)
    if (claim.violations > 0) runs.insert(claim.run);
  Judge judge(setup);
  for (const std::uint64_t run : runs) {
    if (std::binary_search(tally.confirmed.begin(), tally.confirmed.end(), run)) continue;
    auto& confirmed = part.repeats[run].confirmed;
    if (confirmed) continue;
    const bool again = judge.confirm(part.facts.seed, run).confirmed;
    check_stop();  // perhaps amid the run
    confirmed = again;
  }
}

}  // namespace

statistics::RunRange add(const CampaignPart& more, CampaignPart& sum) {
  statistics::RunSet both = sum.runs;
  for (const statistics::RunRange& range : more.runs.ranges())
    if (const statistics::RunRange known = both.add(range); known.count() > 0) return known;
  sum.runs = std::move(both);
  add(more.tally, sum.tally);
  sum.figures.add(more.figures);
  for (const auto& [run, repeat] : more.repeats) {
    Repeat& own = sum.repeats[run];
    if (!own.careful) own.careful = repeat.careful;
    if (!own.confirmed) own.confirmed = repeat.confirmed;
  }
  return {};
}

Campaign::Campaign(const Setup& setup, const CampaignOptions& options)
    : setup_(&setup), threads_(options.threads), between_(options.between) {
  require_a_claim(setup.events->texts.method, setup.claims());
  facts_ = facts_of(setup, options);
  facts_.until_violated = options.until_violated;
  packs_ = make_packs(setup, facts_.asked);
  facts_.many_at_once = static_cast<bool>(packs_);
}

/// Whether packs decide most of the first runs; then they make the others too.
bool Campaign::packs_go_on(const PackJudge& first) const {
  return 2 * first.careful_count() <= std::min(facts_.asked, kFirstRuns);
}

void Campaign::make_range(statistics::RunRange range, const Packs* packs, const PackJudge* prepared,
                          std::uint64_t size, Collector& collector) const {
  Judges judges(*setup_, packs);
  parallel_for((range.count() + size - 1) / size, threads_, [&](std::size_t block) {
    const statistics::RunRange own{range.first + block * size,
                                   std::min(range.last, range.first + (block + 1) * size)};
    if (collector.is_behind_the_end(own.first)) return;
    std::unique_ptr<PackJudge> judge = judges.take();
    try {
      prepared ? judge->begin_as(*prepared) : judge->begin(facts_.seed, own.first, own.last);
    } catch (const Stopped&) {
      return;
    }
    judge_runs(own, *judge, collector);
    judges.give_back(std::move(judge));
  });
  check_stop();
}

/// The first kFirstRuns runs decide whether packs make the rest. Where work comes between, or the
/// first violation ends the campaign, ranges double from kFirstRuns on.
void Campaign::make_runs(statistics::RunRange range, CampaignPart& part, const Save& save) const {
  const std::vector<statistics::RunRange> missing = part.runs.missing_in(range);
  if (missing.empty() || part.ended()) return;
  std::uint64_t count = 0;
  for (const statistics::RunRange& stretch : missing) count += stretch.count();
  const Doing doing("runs", range.count(), range.count() - count);
  Collector collector(part, save, doing);
  try {
    PackJudge first(*setup_, packs_ ? &packs_ : nullptr);
    if (packs_) first.begin(facts_.seed, 0, std::min(facts_.asked, kFirstRuns));
    const Packs* const packs = packs_ && packs_go_on(first) ? &packs_ : nullptr;
    // Linear packs put runs of one law together; careful runs may be slow, and are shared out.
    const std::uint64_t shared = count / (std::uint64_t{4} * thread_count(threads_)) + 1;
    const std::uint64_t single = std::min(shared, kFirstRuns);
    const std::uint64_t size = packs == nullptr ? single : packs->linear ? 2048 : 256;
    const bool grows = (between_ && packs == nullptr) || facts_.until_violated;
    const auto work_between = [&] {
      if (between_ && part.tally.runs > 0) between_(part.tally.runs);
    };
    for (const statistics::RunRange& stretch : missing) {
      const statistics::RunRange early{stretch.first,
                                       packs_ ? std::min(stretch.last, kFirstRuns) : stretch.first};
      const statistics::RunRange late{std::max(stretch.first, packs_ ? kFirstRuns : 0),
                                      stretch.last};
      if (early.first < early.last)
        make_range(early, &packs_, &first, packs ? kFirstRuns : single, collector);
      work_between();
      std::uint64_t at_once = grows ? kFirstRuns : stretch.count();
      for (statistics::RunRange next = late; next.first < late.last && !part.ended();
           at_once *= 2) {
        next.last = next.first + std::min(late.last - next.first, std::max(at_once, size));
        make_range(next, packs, nullptr, size, collector);
        next.first = next.last;
        if (next.first < late.last) work_between();
      }
    }
  } catch (const Stopped&) {
    // What is done is there.
  }
  collector.finish();
}

void Campaign::repeat_worst(CampaignPart& part) const {
  if (part.tally.runs == 0) return;
  // A command that is stopped tells what it knows within a second.
  if (is_stopping()) {
    const Concluding concluding(0.5);
    confirm_violations(*setup_, part);
  }
  {
    const Concluding concluding(0.5);
    if (packs_) repeat_carefully(*setup_, packs_.linear != nullptr && packs_.any == nullptr, part);
  }
  check_stop();
  confirm_violations(*setup_, part);
}

Report run_campaign(const Setup& setup, const CampaignOptions& options) {
  const Campaign campaign(setup, options);
  CampaignPart part = campaign.begin();
  campaign.make_runs({0, campaign.asked()}, part);
  try {
    campaign.repeat_worst(part);
  } catch (const Stopped&) {
    // Then no violation is confirmed.
  }
  return conclude(part);
}

}  // namespace gainsmith::verify
