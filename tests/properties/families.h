// Families of problems whose answer is known by construction. Each maker's file begins with the
// proof.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "properties/draw.h"

namespace gainsmith::tests::properties {

struct Case {
  std::string family;
  std::string text;  ///< the problem file
  bool yes = true;
  bool easy = false;  ///< balanced and well conditioned, far from the threshold: must be decided
};

struct Family {
  std::string name;
  int weight;  ///< its part of all cases
  std::function<Case(Draw& draw)> make;
};

const std::vector<Family>& families();

/// Thin, far or singular sets of solutions: many of them may be undecided, none wrong.
const std::vector<Family>& edge_families();

/// The family of case `index`: the one named `only`, or one drawn by weight: of families() when
/// `only` is empty, of edge_families() for "edges", of both for "all".
const Family& family_of(std::uint64_t seed, std::uint64_t index, const std::string& only = {});

/// That tests take.
constexpr std::uint64_t kSeed = 0xC1C1C1;

/// Case `index` of a seed.
Case make_case(std::uint64_t seed, std::uint64_t index, const std::string& only = {},
               std::optional<OtherUnits> others = {});

// By theme.
std::vector<Family> stability_families();
std::vector<Family> bounded_real_families();
std::vector<Family> observer_families();
std::vector<Family> sampled_families();
std::vector<Family> switched_families();
std::vector<Family> kink_families();
std::vector<Family> interval_families();
std::vector<Family> singular_families();
std::vector<Family> narrow_families();
std::vector<Family> chain_families();

}  // namespace gainsmith::tests::properties
