// Mutants of valid files: each is read or refused, in little memory, and what is read stands in it.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "base/file.h"
#include "bind/bind.h"
#include "fuzz/heap.h"
#include "fuzz/mutator.h"
#include "fuzz/readers.h"
#include "io/json/gains_json.h"
#include "io/problem_text.h"

namespace gainsmith::fuzz {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr std::uint64_t kMutants = 10'000;
#else
constexpr std::uint64_t kMutants = 1'000;
#endif
constexpr std::size_t kMemory = 200'000'000;

using Files = std::vector<std::string>;
using Read = std::function<bool(const std::string&)>;

/// The bytes of a file that a test shows, as C++ spells them.
std::string spelt(const std::string& bytes) {
  constexpr std::size_t kMost = 4096;
  return ::testing::PrintToString(bytes.substr(0, kMost));
}

/// Whether `bytes` are read; the test fails when that ends in another way than by a refusal.
bool tried(const Read& read, const std::string& bytes, const std::string& which) {
  try {
    const HeapLimit limit(kMemory);
    return read(bytes);
  } catch (const std::exception& error) {
    ADD_FAILURE() << which << ": " << error.what() << "\n" << spelt(bytes);
    return false;
  }
}

void expect_read_or_refused(const Read& read, const Files& files,
                            std::uint64_t mutants = kMutants) {
  for (const std::string& file : files)
    EXPECT_TRUE(tried(read, file, "a file that is valid")) << spelt(file);
  std::uint64_t count = 0;
  for (std::uint64_t number = 0; number < mutants && !::testing::Test::HasFailure(); ++number) {
    const std::string& file = files[number % files.size()];
    const std::string& other = files[number / files.size() % files.size()];
    count += tried(read, Mutator(number)(file, other), "mutant " + std::to_string(number)) ? 1 : 0;
  }
  EXPECT_GT(count, 0U) << "every mutant was refused: the test does not reach far";
  EXPECT_LT(count, mutants);
}

std::string data(const std::string& name) {
  return read_text(std::string(GAINSMITH_TEST_DATA) + "/" + name);
}

/// A number as this machine stores it, or the other way round.
template <class Number>
std::string stored(Number value, bool swapped = false) {
  const auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
  std::string result(bytes.begin(), bytes.end());
  return swapped ? std::string(result.rbegin(), result.rend()) : result;
}

/// A file .npy of version 1.
template <class Number>
std::string npy(const std::string& type, const std::string& shape, bool by_columns,
                const std::vector<Number>& elements) {
  std::string header = "{'descr': '" + type +
                       "', 'fortran_order': " + (by_columns ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  std::string file =
      "\x93NUMPY" + std::string{1, 0} + stored(static_cast<std::uint16_t>(118)) + header;
  for (const Number element : elements) file += stored(element, type[0] == '>');
  return file;
}

std::string gain_file() {
  const model::DesignPtr design = io::bound(io::kProblem);
  model::Gains gains;
  gains.version = "0.1.0";
  gains.problem_name = "small";
  gains.verdict = model::Verdict::yes;
  gains.solver = {"optimal", "converged", "", 9, 1e-9, 1e-9, 1e-9, "double"};
  gains.gains = {{"L", numbers::Matrix{{0.25}, {-3}}}, {"H", numbers::Matrix{{1.5e-3}}}};
  gains.unknowns = {{"P", numbers::Matrix{{2, 0.5}, {0.5, 1}}}};
  gains.margins = {{"flow", 0, 1.5, 0.5, 1e-12, "tau = 0", false}};
  gains.statement = design->statement;
  gains.timings = {{"total", 0.25}};
  return io::gains_text(gains);
}

TEST(Mutants, OfYaml) {
  const std::string aliases =
      io::replaced(io::replaced(io::kProblem, "A: [[0.2, -1.01]", "A: &a [&r [0.2, -1.01]"),
                   "{list: [[1, 2], [3, 4]]}", "{list: [*r, *r]}");
  expect_read_or_refused(
      read_yaml, {io::kProblem, aliases,
                  "problem: a\nmethod: own\ndata: {A: [[1, 2], [3, 4]]}\n---\n" + io::kMethod});
}

TEST(Mutants, OfFormulas) {
  expect_read_or_refused(read_language, {"[P*A + A'*P + mu(tau)*P, C'; *, -g*I] < 0",
                                         "Q: C'*C\nh(t): expm(A*t)\nnorm(h(0.5)*Q)",
                                         "[C*expm(A*T2)*C', 0; 0, 1] + 1e-3*eye(2)"});
}

TEST(Mutants, OfJson) {
  expect_read_or_refused(
      read_json,
      {gain_file(), "{\"A\": [[1, -2.5e-3], [3, 0.1]], \"B\": {\"C\": [1, 2]}}\n", "[1.5, -2, 3e5]",
       "{\"gains\": {\"L\": [[0.25], [1e-320]]}, \"x\": \"\\u00e9\\n\"}"});
}

TEST(Mutants, OfCsv) {
  expect_read_or_refused(read_csv, {"t,y,\"z, 1\"\r\n0,1.5,-2\r\n0.1,,3e-3\r\n0.2,+.5,7\r\n",
                                    "0.2, -1.01\n1,0\n", "\xEF\xBB\xBFx1,x2\n\"1\",2\n\n3,4e2\n"});
}

TEST(Mutants, OfNumPy) {
  expect_read_or_refused(read_npy,
                         {npy<double>("<f8", "(2, 3)", false, {0.1, -2, 3e5, 4, 5, 6.25}),
                          npy<float>(">f4", "(2, 2)", true, {0.5F, -1, 2.25F, 3}),
                          npy<std::int16_t>("<i2", "(3,)", false, {-300, 2, 3}),
                          npy<std::uint64_t>(">u8", "()", false, {18446744073709551615U})});
}

TEST(Mutants, OfMat) {
  expect_read_or_refused(read_mat, {data("plant-v6.mat"), data("kinds-v6.mat")});
}

TEST(Mutants, OfCompressedMat) {
  for (const std::string kind : {"plant", "kinds"}) {
    const std::string plain = data(kind + "-v6.mat");
    expect_read_or_refused(
        [&](const std::string& bytes) { return read_compressed_mat(bytes, plain + bytes); },
        {data(kind + "-v7.mat")}, kMutants / 2);
  }
}

TEST(Mutants, OfSdpa) {
  expect_read_or_refused(
      read_sdpa,
      {"\"a comment\n2 = m\n2 = blocks\n2 -1\n1.0, 1.0\n0 1 1 2 -1.0\n1 1 1 1 1.0\n2 1 2 2 "
       "1e0\n2 2 1 1 1\n",
       "3\n1\n{3}\n{0.5, -1, 2e-3}\n0 1 1 1 1\n1 1 1 2 0.3333333333333333333\n2 1 2 3 -7\n"
       "3 1 3 3 1.5\n"});
}

}  // namespace
}  // namespace gainsmith::fuzz
