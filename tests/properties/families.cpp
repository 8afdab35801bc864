#include "properties/families.h"

#include <stdexcept>

namespace gainsmith::tests::properties {

const std::vector<Family>& families() {
  static const std::vector<Family> list = [] {
    std::vector<Family> all;
    for (const auto& part :
         {stability_families(), bounded_real_families(), observer_families(), sampled_families(),
          switched_families(), kink_families(), interval_families(), singular_families()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return list;
}

const Family& family_of(std::uint64_t seed, std::uint64_t index, const std::string& only) {
  if (!only.empty()) {
    for (const Family& family : families())
      if (family.name == only) return family;
    throw std::invalid_argument("no family " + only);
  }
  int whole = 0;
  for (const Family& family : families()) whole += family.weight;
  // A stream of its own: the cases of one family do not depend on the weights of the others.
  constexpr std::uint64_t kChoice = 0x5eed;
  int left = static_cast<int>(RandomStream(seed ^ kChoice, index).uniform() * whole);
  for (const Family& family : families()) {
    left -= family.weight;
    if (left < 0) return family;
  }
  return families().back();
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
