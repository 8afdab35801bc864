#include "lanes/machine.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/sine.h"
#include "lanes/variants.h"
#include "numbers/graph/tape.h"

namespace gainsmith::lanes {
namespace {

using numbers::ScalarGraph;
using numbers::ScalarOp;

/// Sums, products, quotients, selections and constants at random; the last nodes are results.
struct RandomGraph {
  static constexpr int kInputs = 7;
  ScalarGraph graph;
  std::vector<std::vector<int>> results;

  explicit RandomGraph(unsigned seed, bool polynomials = true) {
    std::mt19937 random(seed);
    std::vector<int> nodes;
    for (int k = 0; k < kInputs; ++k) nodes.push_back(graph.input(k));
    const auto any = [&] { return nodes[random() % nodes.size()]; };
    for (int k = 0; k < 120; ++k) {
      switch (random() % 10) {
        case 0:
          nodes.push_back(graph.constant(0.25 * static_cast<double>(random() % 17) - 2));
          break;
        case 1:
          nodes.push_back(graph.subtract(any(), any()));
          break;
        case 2:
          nodes.push_back(graph.where(random() % 2 == 0, any(), any(), any()));
          break;
        case 3:
          nodes.push_back(graph.apply(ScalarOp::minimum, any(), any()));
          break;
        case 4:
          nodes.push_back(graph.apply(ScalarOp::abs, any()));
          break;
        case 5: {
          const int size = graph.apply(ScalarOp::abs, any());
          nodes.push_back(graph.divide(any(), graph.add(graph.constant(1), size)));
          break;
        }
        case 6:
          nodes.push_back(graph.multiply(any(), graph.constant(0.5)));
          break;
        case 7:
          nodes.push_back(graph.add(graph.multiply(any(), any()), any()));
          break;
        case 8: {
          // A polynomial by Horner's rule.
          const int x = any();
          int sum = graph.constant(0.5);
          for (unsigned power = 0; power < (polynomials ? 1 + seed % 4 : 1); ++power)
            sum = graph.add(graph.multiply(sum, x), graph.constant(0.25 * power - 0.3));
          nodes.push_back(sum);
          break;
        }
        default:
          nodes.push_back(graph.add(any(), any()));
      }
      // Products of products grow beyond all numbers.
      if (k % 10 == 9) {
        const int size = graph.apply(ScalarOp::abs, nodes.back());
        nodes.push_back(graph.divide(nodes.back(), graph.add(graph.constant(1), size)));
      }
    }
    for (int k = 0; k < 5; ++k)
      results.push_back({any(), nodes[nodes.size() - 1 - static_cast<std::size_t>(k)]});
  }
};

std::vector<std::vector<double>> run_all(const RandomGraph& one, const LaneCode& code,
                                         const Variant& variant, unsigned seed) {
  LaneMachine machine(code, variant);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int k = 0; k < RandomGraph::kInputs; ++k)
    for (std::size_t l = 0; l < kLanes; ++l)
      machine.input(static_cast<std::size_t>(k))[l] = number(random);
  machine.run();
  std::vector<std::vector<double>> values;
  for (std::size_t r = 0; r < one.results.size(); ++r)
    for (std::size_t e = 0; e < one.results[r].size(); ++e) {
      const double* const at = machine.result(r, e);
      values.emplace_back(at, at + kLanes);
    }
  return values;
}

TEST(LaneMachine, HasTheBitsOfOneRunAtATimeWithoutFusedProducts) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RandomGraph one(seed, false);
    const LaneCode code(one.graph, one.results, RandomGraph::kInputs);
    const auto lanes = run_all(one, code, *find_variant("v2"), seed);
    numbers::Tape tape(one.graph, one.results, RandomGraph::kInputs);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-2, 2);
    std::vector<std::vector<double>> inputs(RandomGraph::kInputs, std::vector<double>(kLanes));
    for (auto& input : inputs)
      for (double& x : input) x = number(random);
    for (std::size_t l = 0; l < kLanes; ++l) {
      for (std::size_t k = 0; k < inputs.size(); ++k) tape.inputs()[k] = inputs[k][l];
      if (!tape.run()) continue;
      std::size_t at = 0;
      for (std::size_t r = 0; r < one.results.size(); ++r)
        for (std::size_t e = 0; e < one.results[r].size(); ++e)
          EXPECT_EQ(tape(r, e), lanes[at++][l]) << "seed " << seed;
    }
  }
}

TEST(LaneMachine, HasTheSameBitsOnAllMachinesWithFusedProducts) {
  const Variant* const v3 = find_variant("v3");
  const Variant* const v4 = find_variant("v4");
  if (v3 == nullptr || v4 == nullptr) GTEST_SKIP() << "this machine is not x86-64-v4";
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RandomGraph one(seed);
    const LaneCode code(one.graph, one.results, RandomGraph::kInputs);
    EXPECT_EQ(run_all(one, code, *v3, seed), run_all(one, code, *v4, seed));
  }
}

TEST(LaneMachine, FeedsResultsBackToInputs) {
  // As it goes on, a code that feeds back has the bits of one that does not.
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomGraph one(seed);
    std::vector<int> next;
    for (int k = 0; k < RandomGraph::kInputs - 1; ++k) {
      const int bounded = one.graph.apply(ScalarOp::tanh, one.results[0][0]);
      next.push_back(k % 3 == 0   ? one.graph.input(1 + (k + 1) % (RandomGraph::kInputs - 1))
                     : k % 3 == 1 ? one.graph.add(bounded, one.graph.input(1 + k))
                                  : one.results[static_cast<std::size_t>(k) % 5][1]);
    }
    const LaneCode fed(one.graph, {next}, RandomGraph::kInputs, 1);
    const LaneCode plain(one.graph, {next}, RandomGraph::kInputs);
    LaneMachine a(fed), b(plain);
    for (std::size_t k = 0; k < RandomGraph::kInputs; ++k)
      for (std::size_t l = 0; l < kLanes; ++l)
        a.input(k)[l] = b.input(k)[l] = 0.01 * static_cast<double>(k * 7 + l) - 0.1;
    for (int step = 0; step < 3; ++step) {
      a.run();
      b.run();
      std::vector<std::vector<double>> values;
      for (std::size_t k = 0; k < next.size(); ++k)
        values.emplace_back(b.result(0, k), b.result(0, k) + kLanes);
      for (std::size_t k = 0; k < next.size(); ++k)
        std::copy(values[k].begin(), values[k].end(), b.input(1 + k));
      for (std::size_t k = 0; k < next.size(); ++k)
        for (std::size_t l = 0; l < kLanes; ++l)
          ASSERT_EQ(std::bit_cast<std::uint64_t>(a.input(1 + k)[l]),
                    std::bit_cast<std::uint64_t>(b.input(1 + k)[l]))
              << "seed " << seed << ", input " << k;
    }
  }
}

TEST(LaneMachine, PolynomialsAreThoseOfHornerToRounding) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int degree = 1; degree <= 12; ++degree) {
    std::vector<double> powers;
    for (int k = 0; k <= degree; ++k) powers.push_back(number(random));
    ScalarGraph graph;
    int sum = graph.constant(powers.back());
    for (int k = degree; k-- > 0;)
      sum = graph.add(graph.multiply(sum, graph.input(0)),
                      graph.constant(powers[static_cast<std::size_t>(k)]));
    const LaneCode code(graph, {{sum}}, 1);
    for (const Variant* const variant : variants()) {
      LaneMachine machine(code, *variant);
      for (std::size_t l = 0; l < kLanes; ++l) machine.input(0)[l] = number(random);
      machine.run();
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double x = machine.input(0)[l];
        long double exact = 0;
        double error = 0;
        for (int k = degree; k >= 0; --k) {
          exact = exact * x + powers[static_cast<std::size_t>(k)];
          error += (2 * k + 3) * 0x1p-53 * std::abs(powers[static_cast<std::size_t>(k)]) *
                   std::pow(std::abs(x), k);
        }
        EXPECT_LE(std::abs(static_cast<double>(machine.result(0, 0)[l] - exact)), error)
            << variant->name << ", degree " << degree;
      }
    }
  }
}

TEST(Sines, AreThoseOfOneNumberAtATime) {
  std::mt19937 random(5);
  for (const double range : {1.0, 1e3, 1e6}) {
    std::uniform_real_distribution<double> number(-range, range);
    for (int k = 0; k < 100; ++k) {
      alignas(64) std::array<double, kLanes> x{};
      for (double& one : x) one = number(random);
      for (const Variant* const variant : variants()) {
        alignas(64) std::array<double, kLanes> y = x;
        variant->sines(y.data());
        for (std::size_t l = 0; l < kLanes; ++l) EXPECT_EQ(y[l], sine(x[l])) << variant->name;
      }
    }
  }
}

TEST(Reached, AreTheLanesThatAreNotBelow) {
  alignas(64) std::array<double, kLanes> x{};
  for (std::size_t l = 0; l < kLanes; ++l) x[l] = static_cast<double>(l * 11 % kLanes);
  x[7] = NAN;
  for (const Variant* const variant : variants()) {
    const std::uint32_t bits = variant->reached(x.data(), 20);
    for (std::size_t l = 0; l < kLanes; ++l) EXPECT_EQ(bits >> l & 1U, x[l] < 20 ? 0U : 1U) << l;
  }
}

TEST(Uniforms, AreThoseOfTheStreams) {
  std::vector<std::uint64_t> runs(kLanes);
  for (std::size_t l = 0; l < kLanes; ++l) runs[l] = l * 0x123456789ULL + (l % 3);
  std::vector<double> out(kLanes);
  for (const Variant* const variant : variants())
    for (const std::uint64_t key : {0ULL, 1ULL, 0xfedcba9876543210ULL})
      for (const std::uint64_t draw : {0ULL, 7ULL, 0x100000003ULL}) {
        variant->uniforms(key, runs.data(), draw, 0.1, 0.7, out.data());
        for (std::size_t l = 0; l < kLanes; ++l)
          EXPECT_EQ(out[l], 0.1 + 0.7 * RandomStream(key, runs[l]).uniform_at(draw))
              << variant->name;
      }
}

/// Units in the last place between two numbers.
double places_between(double a, double b) {
  if (a == b) return 0;
  if (!std::isfinite(a) || !std::isfinite(b)) return std::isnan(a) && std::isnan(b) ? 0 : 1e300;
  const double unit = std::max(std::nextafter(std::abs(b), INFINITY) - std::abs(b), 0x1p-1074);
  return std::abs(a - b) / unit;
}

struct Function {
  const char* name;
  ScalarOp op;
  double (*exact)(double);
  std::vector<double> at;
};

std::vector<double> numbers_between(double low, double high) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(low, high);
  std::vector<double> all(32 * 1000);
  for (double& one : all) one = number(random);
  return all;
}

TEST(LaneMachine, FunctionsAreRightToFourPlaces) {
  std::vector<double> small = numbers_between(-1, 1);
  for (double& one : small) one = std::ldexp(one, -static_cast<int>(std::abs(one) * 1e4) % 60);
  // Next to multiples of pi/2, where the value is what is left of nearly everything.
  std::vector<double> quarters;
  for (int k = 1; k <= 3200; ++k) quarters.push_back(k * 1.5707963267948966);
  const auto with = [](std::vector<double> list, const std::vector<double>& more) {
    list.insert(list.end(), more.begin(), more.end());
    while (list.size() % kLanes != 0) list.push_back(0);
    return list;
  };
  const std::vector<double> ends{0.0, -0.0, INFINITY, -INFINITY, NAN, 1e300, -1e300, 5e-324};
  using Of = double (*)(double);
  const Of sine = std::sin, cosine = std::cos, exponential = std::exp, tangent = std::tanh;
  const std::vector<double> angles =
      with(with(with(numbers_between(-20, 20), quarters), numbers_between(-3e6, 3e6)), ends);
  const std::vector<Function> functions{
      {"sin", ScalarOp::sin, sine, with(angles, small)},
      {"cos", ScalarOp::cos, cosine, with(angles, small)},
      {"exp", ScalarOp::exp, exponential,
       with(with(with(numbers_between(-3, 3), numbers_between(-760, 720)), ends), small)},
      {"tanh", ScalarOp::tanh, tangent,
       with(with(with(numbers_between(-30, 30), small), numbers_between(-1, 1)), ends)}};
  for (const Function& one : functions) {
    ScalarGraph graph;
    const LaneCode code(graph, {{graph.apply(one.op, graph.input(0))}}, 1);
    std::vector<std::vector<double>> by_variant;
    for (const Variant* const variant : variants()) {
      LaneMachine machine(code, *variant);
      std::vector<double>& values = by_variant.emplace_back();
      double worst = 0;
      for (std::size_t first = 0; first < one.at.size(); first += kLanes) {
        std::copy_n(one.at.begin() + static_cast<std::ptrdiff_t>(first), kLanes, machine.input(0));
        machine.run();
        for (std::size_t l = 0; l < kLanes; ++l) {
          const double value = machine.result(0, 0)[l];
          values.push_back(value);
          const double places = places_between(value, one.exact(one.at[first + l]));
          EXPECT_LE(places, 4) << one.name << '(' << one.at[first + l] << ") = " << value << " in "
                               << variant->name;
          worst = std::max(worst, places);
        }
      }
      EXPECT_LE(worst, 4) << one.name << " in " << variant->name;
    }
    if (by_variant.size() < 3) continue;
    for (std::size_t k = 0; k < one.at.size(); ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(by_variant[1][k]),
                std::bit_cast<std::uint64_t>(by_variant[2][k]))
          << one.name << '(' << one.at[k] << ')';
  }
}

TEST(LaneMachine, MarksTheLanesInWhichSomethingHasNoValue) {
  ScalarGraph graph;
  const int x = graph.input(0);
  const int root = graph.apply(ScalarOp::sqrt, x);
  const int log = graph.apply(ScalarOp::log, x);
  // A fault counts although no result needs what has none.
  graph.divide(graph.constant(1), x);
  const LaneCode code(graph, {{root}, {log}}, 1);
  for (const Variant* const variant : variants()) {
    LaneMachine machine(code, *variant);
    for (std::size_t l = 0; l < kLanes; ++l)
      machine.input(0)[l] = l == 3 ? 0 : l == 7 ? -1 : static_cast<double>(l) + 0.5;
    machine.run();
    EXPECT_EQ(machine.faults(), (1U << 3) | (1U << 7)) << variant->name;
    EXPECT_EQ(machine.result(0, 0)[5], std::sqrt(5.5));
    EXPECT_EQ(machine.result(1, 0)[5], std::log(5.5));
    // What is computed one by one is left out where a lane is not active; that is no fault.
    machine.run(1U << 5);
    EXPECT_EQ(machine.faults() & (1U << 5), 0U);
  }
}

TEST(LaneMachine, KnowsNoOtherVariants) {
  EXPECT_EQ(find_variant("v5"), nullptr);
  EXPECT_NE(find_variant("v2"), nullptr);
}

}  // namespace
}  // namespace gainsmith::lanes
