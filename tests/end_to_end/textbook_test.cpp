// Textbook plants with A, C, T1, T2 alone: the first file that a newcomer writes, in seconds, in
// milliseconds and in 1/1024 s.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

using Json = nlohmann::ordered_json;

struct Plant {
  const char* name;
  const char* A;
  const char* C;
  const char* T1;  ///< s
  const char* T2;
  /// Whether the first gains are below the default bound, a number in the units of the file: then
  /// the digits do not depend on units that are powers of two.
  bool digits = true;
};

void PrintTo(const Plant& plant, std::ostream* out) { *out << plant.name; }

constexpr Plant kPlants[] = {
    {"double_integrator", "[0, 1; 0, 0]", "[1, 0]", "0.05", "0.2"},
    {"oscillator", "[0, 1; -1, 0]", "[1, 0]", "0.1", "0.5"},
    {"damped_oscillator", "[0, 1; -9, -0.6]", "[1, 0]", "0.05", "0.3"},
    {"dc_motor", "[0, 1, 0; 0, -2, 50; 0, -20, -500]", "[1, 0, 0]", "0.005", "0.02"},
    {"inverted_pendulum", "[0, 1; 9.81, 0]", "[1, 0]", "0.02", "0.1"},
    {"cart_pole", "[0, 1, 0, 0; 0, -0.1, 0.7, 0; 0, 0, 0, 1; 0, -0.5, 31, 0]",
     "[1, 0, 0, 0; 0, 0, 1, 0]", "0.005", "0.02"},
    {"magnetic_levitation", "[0, 1, 0; 980, 0, -2.8; 0, 0, -100]", "[1, 0, 0]", "0.001", "0.003",
     false},
    {"quarter_car", "[0, 1, 0, 0; -53, -3.3, 53, 3.3; 0, 0, 0, 1; 267, 16.7, -4267, -16.7]",
     "[1, 0, -1, 0]", "0.002", "0.008"},
    {"two_masses", "[0, 0, 1, 0; 0, 0, 0, 1; -1, 1, 0, 0; 1, -1, 0, 0]", "[1, 0, 0, 0]", "0.05",
     "0.2"},
    {"aircraft_pitch", "[-0.313, 56.7, 0; -0.0139, -0.426, 0; 0, 56.7, 0]", "[0, 0, 1]", "0.01",
     "0.05"},
    {"rc_ladder", "[-2, 1, 0; 1, -2, 1; 0, 1, -1]", "[0, 0, 1]", "0.1", "0.5"},
    {"rlc", "[-20, -1000; 1000, 0]", "[0, 1]", "1e-4", "5e-4"},
    {"two_tanks", "[-0.01, 0; 0.01, -0.02]", "[0, 1]", "5", "30"},
    {"cruise_control", "[-0.05]", "[1]", "0.1", "1"},
    {"unstable_first_order", "[2]", "[1]", "0.05", "0.2"},
    {"triple_integrator", "[0, 1, 0; 0, 0, 1; 0, 0, 0]", "[1, 0, 0]", "0.02", "0.1"},
    {"ball_and_beam", "[0, 1, 0, 0; 0, 0, 7, 0; 0, 0, 0, 1; 0, 0, 0, 0]",
     "[1, 0, 0, 0; 0, 0, 1, 0]", "0.01", "0.05"},
    {"satellite", "[0, 1, 0, 0; 0.03, 0, 0, 0.2; 0, 0, 0, 1; 0, -0.2, 0, 0]",
     "[1, 0, 0, 0; 0, 0, 1, 0]", "0.1", "1"},
    {"stirred_reactor", "[-1.2, -0.4; 2.5, 0.8]", "[0, 1]", "0.05", "0.2"},
    {"flexible_joint", "[0, 1, 0, 0; -48.6, -1.25, 48.6, 0; 0, 0, 0, 1; 19.5, 0, -19.5, 0]",
     "[1, 0, 0, 0; 0, 0, 1, 0]", "0.005", "0.02"}};

/// The plant with a unit of time of 1/unit s.
std::string file_of(const Plant& plant, const std::string& unit, const std::string& T2) {
  return std::string("problem: ") + plant.name + "\nmethod: sampled-data-hybrid\ndata:\n  A: \"" +
         plant.A + "/" + unit + "\"\n  C: \"" + plant.C + "\"\n  T1: " + plant.T1 + "*" + unit +
         "\n  T2: " + T2 + "*" + unit + "\n";
}

Json synthesized(const Plant& plant, const std::string& unit) {
  const Outcome outcome = gainsmith({"synth", "-", "--json"}, file_of(plant, unit, plant.T2));
  EXPECT_EQ(outcome.exit, 0) << plant.name << " in 1/" << unit << " s: " << outcome.out
                             << outcome.err;
  return outcome.exit == 0 ? outcome.json() : Json();
}

/// The elements of a scalar or a matrix, by row.
std::vector<double> numbers_of(const Json& value) {
  if (value.is_number()) return {value.get<double>()};
  std::vector<double> numbers;
  for (const Json& element : value)
    for (const double number : numbers_of(element)) numbers.push_back(number);
  return numbers;
}

class TextbookTest : public testing::TestWithParam<Plant> {};

/// Both gains are rates: of z by the held error, and of the held error.
TEST_P(TextbookTest, HasAnAnswerInEveryUnitOfTime) {
  const Json seconds = synthesized(GetParam(), "1");
  const Json milliseconds = synthesized(GetParam(), "1000");
  const Json binary = synthesized(GetParam(), "1024");
  if (seconds.empty() || binary.empty() || !GetParam().digits) return;
  for (const char* gain : {"L", "H"}) {
    const std::vector<double> in_seconds = numbers_of(seconds["gains"][gain]);
    const std::vector<double> in_binary = numbers_of(binary["gains"][gain]);
    ASSERT_EQ(in_seconds.size(), in_binary.size());
    for (std::size_t i = 0; i < in_seconds.size(); ++i)
      EXPECT_EQ(in_seconds[i], 1024 * in_binary[i]) << gain;
  }
}

INSTANTIATE_TEST_SUITE_P(Plants, TextbookTest, testing::ValuesIn(kPlants),
                         [](const auto& tested) { return tested.param.name; });

double limit_by_bisection(const std::string& text, const std::string& low,
                          const std::string& high) {
  const Outcome outcome =
      gainsmith({"bisect", "-", "--largest", "T2", "--in", low, high, "--json"}, text);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  return outcome.json()["result"]["search"]["value"];
}

/// Both ways of asking for the longest interval, in each unit of time.
TEST(TextbookLimitsTest, AreTheSameInEveryUnitOfTime) {
  const Plant& oscillator = kPlants[1];
  const double seconds = limit_by_bisection(file_of(oscillator, "1", "3"), "0.5", "3");
  EXPECT_EQ(limit_by_bisection(file_of(oscillator, "1024", "3"), "512", "3072"), 1024 * seconds);
  const double in_ms = limit_by_bisection(file_of(oscillator, "1000", "3"), "500", "3000");
  EXPECT_NEAR(in_ms / 1000, seconds, 1e-3);
  for (const auto& [unit, range] : {std::pair("1", "[0.5, 3]"), std::pair("1000", "[500, 3000]")}) {
    const Outcome explained = gainsmith(
        {"explain", "-"}, file_of(oscillator, unit, "3") + "negotiable: {T2: " + range + "}\n");
    // A scalar that synth searches is held.
    EXPECT_EQ(explained.exit, 3) << explained.err;
    const std::string expected = unit == std::string("1") ? "T2 at most 0.97" : "T2 at most 97";
    EXPECT_NE(explained.out.find(expected), std::string::npos) << explained.out;
  }
}

}  // namespace
}  // namespace gainsmith::tests
