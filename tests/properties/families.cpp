#include "properties/families.h"

#include <stdexcept>

namespace gainsmith::tests::properties {

namespace {

std::vector<Family> joined(const std::vector<std::vector<Family>>& parts) {
  std::vector<Family> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> list = joined(
      {stability_families(), bounded_real_families(), observer_families(), sampled_families(),
       switched_families(), kink_families(), interval_families(), singular_families()});
  return list;
}

const std::vector<Family>& edge_families() {
  static const std::vector<Family> list = joined({narrow_families(), chain_families()});
  return list;
}

const Family& family_of(std::uint64_t seed, std::uint64_t index, const std::string& only) {
  static const std::vector<Family> both = joined({families(), edge_families()});
  const auto& choice = only.empty() ? families() : only == "edges" ? edge_families() : both;
  if (!only.empty() && only != "edges" && only != "all") {
    for (const Family& family : both)
      if (family.name == only) return family;
    throw std::invalid_argument("no family " + only);
  }
  int whole = 0;
  for (const Family& family : choice) whole += family.weight;
  // A stream of its own: the cases of one family do not depend on the weights of the others.
  constexpr std::uint64_t kChoice = 0x5eed;
  int left = static_cast<int>(RandomStream(seed ^ kChoice, index).uniform() * whole);
  for (const Family& family : choice) {
    left -= family.weight;
    if (left < 0) return family;
  }
  return choice.back();
}

Case make_case(std::uint64_t seed, std::uint64_t index, const std::string& only,
               std::optional<OtherUnits> others) {
  Draw draw(seed, index, others);
  Case made = family_of(seed, index, only).make(draw);
  made.text = "# " + made.family + ", seed " + std::to_string(seed) + ", case " +
              std::to_string(index) + ": " + (made.yes ? "yes" : "no") +
              (made.easy ? ", easy" : "") + "\nproblem: " + made.family + "/" +
              std::to_string(index) + "\n" + made.text;
  return made;
}

}  // namespace gainsmith::tests::properties
