#include "packs/pack_runner.h"

#include <algorithm>

#include "base/words.h"
#include "packs/lane_set.h"

namespace gainsmith::packs {

std::string to_string(Why why) {
  return word_of<Why::jumps>(
      why,
      {"a claim is not certain at their accuracy", "the sign of a condition is not certain",
       "it is not certain which event comes first", "a text has no value",
       "a value leaves its range", "steps are short, or many", "jumps follow each other at once"});
}

bool PackVerdict::violated() const {
  return std::ranges::any_of(findings, &claims::Finding::violated);
}

PackRunner::PackRunner(const PackSystem& system) : lanes_(std::make_unique<LaneSet>(system)) {}
PackRunner::PackRunner(PackRunner&&) noexcept = default;
PackRunner& PackRunner::operator=(PackRunner&&) noexcept = default;
PackRunner::~PackRunner() = default;

std::vector<PackVerdict> PackRunner::run(std::uint64_t seed, std::uint64_t first,
                                         std::uint64_t last) {
  std::vector<PackVerdict> verdicts(static_cast<std::size_t>(last - first));
  decide(seed, first, verdicts);
  return verdicts;
}

void PackRunner::decide(std::uint64_t seed, std::uint64_t first,
                        std::vector<PackVerdict>& verdicts) {
  lanes_->run(seed, first, verdicts);
}

}  // namespace gainsmith::packs
