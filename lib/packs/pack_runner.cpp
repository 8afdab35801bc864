#include "packs/pack_runner.h"

#include <algorithm>

#include "packs/lane_set.h"

namespace gainsmith::packs {

std::string to_string(Why why) {
  switch (why) {
    case Why::claim:
      return "a claim is not certain at their accuracy";
    case Why::sign:
      return "the sign of a condition is not certain";
    case Why::order:
      return "it is not certain which event comes first";
    case Why::no_value:
      return "a text has no value";
    case Why::range:
      return "a value leaves its range";
    case Why::steps:
      return "steps are short, or many";
    case Why::jumps:
      return "jumps follow each other at once";
  }
  return "?";
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
