#include "base/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace gainsmith {
namespace {

TEST(EditDistance, EachEditCostsOneAndCaseHalf) {
  EXPECT_EQ(doubled_edit_distance("delta", "delta"), 0);
  EXPECT_EQ(doubled_edit_distance("delt", "delta"), 2);
  EXPECT_EQ(doubled_edit_distance("deltaa", "delta"), 2);
  EXPECT_EQ(doubled_edit_distance("dexta", "delta"), 2);
  EXPECT_EQ(doubled_edit_distance("detla", "delta"), 2);
  EXPECT_EQ(doubled_edit_distance("Delta", "delta"), 1);
  EXPECT_EQ(doubled_edit_distance("", "abc"), 6);
}

TEST(EditDistance, IsSymmetricAndBoundedByTheLongerWord) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> letter(0, 3);
  std::uniform_int_distribution<std::size_t> length(0, 8);
  for (int i = 0; i < 500; ++i) {
    const auto word = [&] {
      std::string text(length(random), ' ');
      for (char& c : text) c = "abAB"[letter(random)];
      return text;
    };
    const std::string a = word();
    const std::string b = word();
    const int distance = doubled_edit_distance(a, b);
    EXPECT_EQ(distance, doubled_edit_distance(b, a)) << a << " " << b;
    EXPECT_LE(distance, 2 * static_cast<int>(std::max(a.size(), b.size()))) << a << " " << b;
    EXPECT_GE(distance, 2 * std::abs(static_cast<int>(a.size()) - static_cast<int>(b.size())));
    EXPECT_EQ(distance == 0, a == b) << a << " " << b;
  }
}

TEST(Nearest, FindsTheLikelyMisspelling) {
  const std::vector<std::string> known = {"delta", "eta", "a1", "sampling"};
  EXPECT_EQ(nearest("dleta", known), "delta");
  EXPECT_EQ(nearest("Sampling", known), "sampling");
  EXPECT_EQ(nearest("SAMPLING", known), "sampling");
  EXPECT_EQ(nearest("smplin", known), "sampling");
  EXPECT_EQ(nearest("horizon", known), std::nullopt);
}

TEST(Nearest, TiesGoToTheFirst) {
  EXPECT_EQ(nearest("ab", {"ac", "ad"}), "ac");
  EXPECT_EQ(nearest("ab", {"ad", "ac"}), "ad");
}

TEST(Suggestion, NamesTheNearestOrListsWhatIsKnown) {
  EXPECT_EQ(suggestion("dleta", {"delta", "eta"}), "; did you mean 'delta'?");
  EXPECT_EQ(suggestion("horizon", {"delta", "eta"}), "; known: delta, eta");
  EXPECT_EQ(suggestion("horizon", {}), "");
}

TEST(Suggestion, NamesThatShareAWordComeBeforeAListOfAll) {
  const std::vector<std::string> known = {"detectability", "sampled-data-hybrid",
                                          "sampled-state-feedback", "output-predictor"};
  EXPECT_EQ(suggestion("sampled-data", known), "; did you mean one of these: sampled-data-hybrid?");
  EXPECT_EQ(suggestion("sampled", known),
            "; did you mean one of these: sampled-data-hybrid, sampled-state-feedback?");
  EXPECT_EQ(suggestion("sampledsyn", known, "; see the list"),
            "; did you mean one of these: sampled-data-hybrid, sampled-state-feedback?");
  EXPECT_EQ(suggestion("unknown", known, "; see the list"), "; see the list");
  EXPECT_EQ(suggestion("kalman", {"kal-man", "other"}), "; did you mean 'kal-man'?");
  EXPECT_EQ(suggestion("a-b-c", {"a-x-y", "b-z-q"}), "; known: a-x-y, b-z-q");
}

TEST(Suggestion, ListsAtMostTwelve) {
  std::vector<std::string> known;
  std::string expected = "; known: ";
  for (int i = 0; i < 13; ++i) {
    known.push_back("number" + std::to_string(i));
    if (i < 12) expected += (i > 0 ? ", " : "") + known.back();
  }
  EXPECT_EQ(suggestion("x", known), expected + ", ...");
  known.pop_back();
  EXPECT_EQ(suggestion("x", known), expected);
}

}  // namespace
}  // namespace gainsmith
