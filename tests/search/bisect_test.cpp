#include "search/bisect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "base/stop.h"

namespace gainsmith::search {
namespace {

BisectOptions options(bool largest, double tolerance) {
  BisectOptions result;
  result.largest = largest;
  result.tolerance.width = tolerance;
  return result;
}

/// A border anywhere, in either direction, on either scale: the bracket holds it and is narrow.
TEST(Bisect, BracketsTheBoundary) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.001, 0.999);
  for (int i = 0; i < 300; ++i) {
    const Axis range = i % 3 == 0 ? axis(1e-4, 10) : axis(-2, 5);
    const double border = range.at(uniform(random));
    const bool largest = i % 2 == 0;
    const auto question = [&](double value) {
      return (value <= border) == largest ? Answer::yes : Answer::no;
    };
    const Bisection found = bisect(question, range, options(largest, 1e-6));
    ASSERT_TRUE(found.yes && found.no && found.finished);
    EXPECT_FALSE(found.open);
    EXPECT_TRUE(found.breaks.empty());
    EXPECT_LE(std::abs(*found.yes - *found.no), 1e-6);
    EXPECT_LE(std::min(*found.yes, *found.no), border);
    EXPECT_GE(std::max(*found.yes, *found.no), border);
    EXPECT_EQ(question(*found.yes), Answer::yes);
    EXPECT_EQ(question(*found.no), Answer::no);
  }
}

/// From a guess near the border fewer values are asked; the bracket is as good.
TEST(Bisect, AGuessSavesQuestions) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  for (int i = 0; i < 200; ++i) {
    const double border = uniform(random);
    const bool largest = i % 2 == 0;
    int asked = 0;
    const auto question = [&](double value) {
      ++asked;
      return (value <= border) == largest ? Answer::yes : Answer::no;
    };
    BisectOptions warm = options(largest, 1e-5);
    warm.guess = i % 3 == 0 ? uniform(random) : border + 1e-4 * (uniform(random) - 0.5);
    const Bisection found = bisect(question, axis(0, 1), warm);
    ASSERT_TRUE(found.yes && found.no);
    EXPECT_LE(std::abs(*found.yes - *found.no), 1e-5);
    EXPECT_NEAR(*found.yes, border, 1e-5);
    if (i % 3 != 0) {
      EXPECT_LE(asked, 10);
    }
  }
}

/// Values near the border are undecided: each side is closed up to them and the rest is said.
TEST(Bisect, ReportsWhatIsUndecidedBetween) {
  for (const bool largest : {true, false}) {
    const auto question = [&](double value) {
      const double outward = largest ? value : -value;
      const double low = largest ? 0.40 : -0.45;
      const double high = largest ? 0.45 : -0.40;
      return outward <= low ? Answer::yes : outward < high ? Answer::undecided : Answer::no;
    };
    const Bisection found = bisect(question, axis(0, 1), options(largest, 1e-5));
    ASSERT_TRUE(found.yes && found.no && found.open && found.finished);
    EXPECT_NEAR(*found.yes, largest ? 0.40 : 0.45, 1e-5);
    EXPECT_NEAR(*found.no, largest ? 0.45 : 0.40, 1e-5);
    EXPECT_LE(std::abs(found.open->near_yes - *found.yes), 1e-5);
    EXPECT_LE(std::abs(found.open->near_no - *found.no), 1e-5);
  }
}

/// One undecided value where the border is: a yes is looked for on both of its sides.
TEST(Bisect, PassesAnUndecidedValueInsideTheYes) {
  const auto question = [](double value) {
    if (value == 0.5) return Answer::undecided;
    return value <= 0.6 ? Answer::yes : Answer::no;
  };
  const Bisection found = bisect(question, axis(0, 1), options(true, 1e-6));
  ASSERT_TRUE(found.yes && found.no);
  EXPECT_NEAR(*found.yes, 0.6, 1e-6);
  EXPECT_FALSE(found.open);
}

TEST(Bisect, AYesBeyondANoIsTakenAndReported) {
  const auto question = [](double value) {
    return value < 0.3 || (value > 0.6 && value < 0.8) ? Answer::yes : Answer::no;
  };
  const Bisection found = bisect(question, axis(0, 1), options(true, 1e-4));
  ASSERT_TRUE(found.yes && found.no);
  EXPECT_NEAR(*found.yes, 0.8, 1e-4);
  ASSERT_FALSE(found.breaks.empty());
  for (const double value : found.breaks) EXPECT_EQ(question(value), Answer::no);
}

TEST(Bisect, WholeRangesOfOneAnswer) {
  const auto always = [](Answer answer) { return [answer](double) { return answer; }; };
  const Bisection yes = bisect(always(Answer::yes), axis(0, 1), options(true, 1e-3));
  EXPECT_EQ(yes.yes, 1.0);
  EXPECT_FALSE(yes.no);
  EXPECT_FALSE(yes.open);
  EXPECT_EQ(bisect(always(Answer::yes), axis(0, 1), options(false, 1e-3)).yes, 0.0);
  const Bisection no = bisect(always(Answer::no), axis(0, 1), options(true, 1e-3));
  EXPECT_FALSE(no.yes);
  EXPECT_FALSE(no.no);
  EXPECT_EQ(no.samples.size(), 9U);
  const Bisection open = bisect(always(Answer::undecided), axis(0, 1), options(true, 1e-3));
  EXPECT_FALSE(open.yes);
  EXPECT_TRUE(open.finished);
}

TEST(Bisect, NoNoAnywhereLeavesTheOuterEndOpen) {
  const auto question = [](double value) { return value <= 0.4 ? Answer::yes : Answer::undecided; };
  const Bisection found = bisect(question, axis(0, 1), options(true, 1e-4));
  EXPECT_NEAR(*found.yes, 0.4, 1e-4);
  EXPECT_FALSE(found.no);
  ASSERT_TRUE(found.open);
  EXPECT_EQ(found.open->near_no, 1.0);
}

TEST(Bisect, EndsAtItsEvaluationsAtDoublePrecisionAndWhenItIsStopped) {
  int asked = 0;
  const Question question = [&](double value) {
    ++asked;
    return value <= 1.0 / 3 ? Answer::yes : Answer::no;
  };
  BisectOptions few = options(true, 1e-12);
  few.evaluations = 12;
  const Bisection cut = bisect(question, axis(0, 1), few);
  EXPECT_EQ(asked, 12);
  EXPECT_FALSE(cut.finished);
  ASSERT_TRUE(cut.yes && cut.no);
  EXPECT_LE(*cut.yes, 1.0 / 3);

  const Bisection sharp = bisect(question, axis(0, 1), options(true, 1e-300));
  EXPECT_TRUE(sharp.finished);
  EXPECT_EQ(*sharp.yes, 1.0 / 3);
  EXPECT_EQ(*sharp.no, std::nextafter(1.0 / 3, 1.0));

  const Question stopped = [&](double value) {
    if (asked == 3) throw Stopped();
    return question(value);
  };
  asked = 0;
  const Bisection open = bisect(stopped, axis(0, 1), options(true, 1e-6));
  EXPECT_FALSE(open.finished);
  EXPECT_EQ(open.samples.size(), 3U);
}

TEST(Bisect, ARelativeToleranceMeansDigits) {
  for (const bool largest : {true, false}) {
    BisectOptions relative = options(largest, 1e-4);
    relative.tolerance.relative = true;
    for (const double border : {3e-6, 2e-3, 0.7}) {
      const auto question = [&](double value) {
        return (value <= border) == largest ? Answer::yes : Answer::no;
      };
      const Bisection found = bisect(question, axis(1e-6, 1), relative);
      ASSERT_TRUE(found.yes && found.no);
      EXPECT_LE(std::abs(*found.yes - *found.no), 1e-4 * border * (1 + 1e-9));
      relative.guess = 1.1 * border;
      EXPECT_NEAR(*bisect(question, axis(1e-6, 1), relative).yes, border, 1.1e-4 * border);
      relative.guess.reset();
    }
  }
  BisectOptions relative = options(true, 1e-4);
  relative.tolerance.relative = true;
  EXPECT_THROW(bisect([](double) { return Answer::yes; }, axis(-1, 1), relative),
               std::invalid_argument);
}

/// A window that the spread misses is found from a value known to lie in it.
TEST(Bisect, AKnownValueIsAskedToo) {
  const auto question = [](double value) {
    return value > 0.29 && value < 0.31 ? Answer::yes : Answer::no;
  };
  BisectOptions with = options(true, 1e-4);
  EXPECT_FALSE(bisect(question, axis(0, 1), with).yes);
  with.known = 0.3;
  EXPECT_NEAR(bisect(question, axis(0, 1), with).yes.value(), 0.31, 1e-4);
  for (const double useless : {-1.0, 0.0, 0.5, 2.0}) {
    with.known = useless;
    EXPECT_EQ(bisect(question, axis(0, 1), with).samples.size(), 9U);
  }
}

/// Values that make no sense end neither side of the bracket.
TEST(Bisect, RefusedValuesAreNeitherYesNorNo) {
  const auto question = [](double value) {
    if (value > 0.7) return Answer::refused;
    return value <= 0.4 ? Answer::yes : Answer::no;
  };
  const Bisection found = bisect(question, axis(0, 1), options(true, 1e-4));
  EXPECT_NEAR(found.yes.value(), 0.4, 1e-4);
  EXPECT_NEAR(found.no.value(), 0.4, 1e-4);
  const auto to_the_refused = [](double value) {
    return value > 0.7 ? Answer::refused : Answer::yes;
  };
  const Bisection open = bisect(to_the_refused, axis(0, 1), options(true, 1e-4));
  EXPECT_NEAR(open.yes.value(), 0.7, 1e-4);
  EXPECT_FALSE(open.no);
}

TEST(Bisect, RefusesEmptyRangesAndTolerances) {
  const Question question = [](double) { return Answer::yes; };
  EXPECT_THROW(bisect(question, axis(1, 1), options(true, 1e-3)), std::invalid_argument);
  EXPECT_THROW(bisect(question, axis(2, 1), options(true, 1e-3)), std::invalid_argument);
  EXPECT_THROW(bisect(question, axis(0, INFINITY), options(true, 1e-3)), std::invalid_argument);
  EXPECT_THROW(bisect(question, axis(0, 1), options(true, 0)), std::invalid_argument);
  EXPECT_THROW(bisect(question, axis(0, 1), options(true, std::nan(""))), std::invalid_argument);
}

TEST(Bisect, SamplesSayInWhichOrderTheyWereAsked) {
  std::vector<double> asked;
  const auto question = [&](double value) {
    asked.push_back(value);
    return value < 0.3 ? Answer::yes : Answer::no;
  };
  const Bisection found = bisect(question, {0, 1, false}, options(true, 1e-3));
  ASSERT_EQ(found.samples.size(), asked.size());
  for (const Sample& sample : found.samples)
    EXPECT_EQ(sample.value, asked.at(static_cast<std::size_t>(sample.order)));
}

}  // namespace
}  // namespace gainsmith::search
