// The verdicts on the runs of a campaign: by packs where they run them, otherwise, and for what packs
// leave open, by the careful run, which also repeats some of the others: a check of the program.
//
//   errors that are estimated   one run in kSampled
//   errors that are proved      runs kSampled k^2, k = 0, 1, ...: linear packs are so fast that it
//                               would take most of the time
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "flights/flight_runner.h"
#include "packs/linear_runner.h"
#include "packs/pack_runner.h"
#include "verify/judge.h"

namespace gainsmith::verify {

/// A verdict, and whether the careful run has given it.
struct CampaignVerdictOnRun {
  RunVerdict verdict;
  bool careful = true;
  std::optional<packs::Why> why{};  ///< packs left it open
};

/// What packs run: dynamics that are linear, or any other; neither: all runs are careful.
struct Packs {
  std::unique_ptr<const linear::LinearSystem> linear;
  std::unique_ptr<const packs::PackSystem> any;
  std::optional<flights::FlightSystem> flights;  ///< of `any`, where they have a closed form

  explicit operator bool() const { return linear || any; }
};

/// None where the dynamics or a claim are of another kind. The setup must outlive it.
std::unique_ptr<const linear::LinearSystem> make_linear_packs(const Setup& setup);

/// For so many runs; few of no linear dynamics are careful. The setup must outlive it.
Packs make_packs(const Setup& setup, std::uint64_t runs);

/// Verdicts in blocks: begin(), then the runs of the block in any order.
class PackJudge {
 public:
  /// nullptr: all runs are careful. One for each thread; both must outlive it.
  PackJudge(const Setup& setup, const Packs* packs);

  /// Prepares runs first, ..., last - 1.
  void begin(std::uint64_t seed, std::uint64_t first, std::uint64_t last);
  /// Those that another one has prepared.
  void begin_as(const PackJudge& prepared);
  /// How many of them are careful.
  std::uint64_t careful_count() const;
  /// The verdict on one of them. std::logic_error where packs and the careful run contradict each
  /// other: that is a fault of the program.
  CampaignVerdictOnRun operator()(std::uint64_t run);
  /// By the careful run. `holds`: claims that are known to hold, as linear packs have proved.
  RunVerdict careful(std::uint64_t seed, std::uint64_t run, const std::vector<bool>& holds = {});

 private:
  /// Whether the careful run repeats this one, whatever packs say.
  bool is_repeated(std::uint64_t run) const;
  void reopen_nearest();

  const Setup* setup_;
  std::uint64_t seed_ = 0, first_ = 0;
  std::optional<packs::LinearRunner> linear_;
  std::vector<std::size_t> bounded_;  ///< claims `below` of linear packs
  std::optional<packs::PackRunner> packs_;
  std::optional<flights::FlightRunner> flights_;  ///< what they leave open is for packs_
  std::optional<Judge> judge_;                    ///< made when it is asked for
  std::vector<packs::PackVerdict> verdicts_;
};

/// The careful run alone, with what linear packs prove of its claims. `linear`: nullptr, or those of
/// the setup of the judge.
RunVerdict verdict_on_run(Judge& judge, const linear::LinearSystem* linear, std::uint64_t seed,
                          std::uint64_t run);

/// std::logic_error where one says held and the other violated.
void require_agreement(std::uint64_t run, claims::Judgement packs, claims::Judgement careful);

}  // namespace gainsmith::verify
