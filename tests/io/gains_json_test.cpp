#include "io/json/gains_json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "bind/bind.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

const model::Statement& statement() {
  static const model::Statement kStatement = bind::bind(read_problem(kProblem)).design->statement;
  return kStatement;
}

/// A gain file in which every part stands, with random numbers of all magnitudes.
class RandomGains {
 public:
  explicit RandomGains(unsigned seed) : random_(seed) {}

  model::Gains make() {
    model::Gains gains;
    gains.version = "0.1.0";
    gains.problem_name = "small \"quoted\" \xC3\xBC";
    gains.verdict = static_cast<model::Verdict>(random_() % 3);
    gains.solver = {"optimal", "converged", "line\nline", 23,
                    number(),  number(),    number(),     "double"};
    gains.objective = number();
    if (random_() % 2 == 0) gains.objective_lower_bound = number();
    gains.gains = {{"L", matrix(2, 1)}, {"F", matrix(2, 2)}, {"H", matrix(1, 1)}};
    gains.unknowns = {{"P", matrix(3, 3)}, {"row", matrix(1, 3)}, {"empty", matrix(0, 0)}};
    gains.parameters = {{"delta", matrix(1, 1)}};
    if (random_() % 2 == 0) gains.report = {{"rank", matrix(3, 1)}};
    if (random_() % 2 == 0)
      gains.estimates = {{"L", "from estimates"}, {"rank", "estimate from below"}};
    using Kind = model::GainFunction::Kind;
    if (random_() % 2 == 0) {
      gains.gain_functions = {
          {"K", "tau", Kind::polynomial, "inv(P)*Y(tau)", {matrix(2, 1), matrix(2, 1)}},
          {"M", "s", Kind::formula, "Y(s)'*Y(s)", {}},
          {"N", "s", Kind::vertices, "Y(s)", {}}};
      gains.functions = {{"Y(tau)", "Y_0 + \"Y_1\"*tau", {}}};
    }
    if (random_() % 2 == 0) gains.searched = {{"T2", number()}, {"delta", number()}};
    for (int i = 0; i < 2; ++i)
      gains.margins.push_back({"flow", i == 0, number(), number(), number(), "tau = 0", i == 1});
    gains.bounds.push_back({"inv(P1)*Y", number(), number(), true});
    if (random_() % 2 == 0)
      gains.certificate = model::CertificateRecord{
          random_() % 2 == 0, number(), 31, {{"flow", matrix(2, 2)}}, "hull"};
    if (random_() % 2 == 0) gains.search = search();
    if (random_() % 2 == 0) gains.bases = {{"N", matrix(3, 2)}, {"none", matrix(3, 0)}};
    gains.statement = statement();
    gains.timings = {{"solve", number()}, {"total", 0.25}};
    return gains;
  }

 private:
  model::SearchRecord search() {
    model::SearchRecord record;
    record.figure = "largest T2";
    if (random_() % 2 == 0) {
      record.value = number();
      record.beyond = number();
      record.certificate =
          model::CertificateRecord{random_() % 2 == 0, number(), 100, {}, "vertices"};
    }
    record.joint_refinement = {number(), number(), true, "converged"};
    record.open = {number(), number()};
    record.over = {"delta", "eta"};
    record.at_end = {"eta"};
    record.evaluations = 17;
    record.feasible = 9;
    record.finished = true;
    return record;
  }
  double number() {
    constexpr double kEdges[] = {0.0, -0.0, 1e308, -1e308, 5e-324, -5e-324, 2.2e-308, 1, -3, 1e17};
    const auto kind = random_() % 20;
    if (kind < 10) return kEdges[kind];
    const auto value = std::bit_cast<double>(random_());
    return std::isfinite(value) ? value : 0.1;
  }
  numbers::Matrix matrix(int rows, int cols) {
    numbers::Matrix result(rows, cols);
    for (double& x : result.reshaped()) x = number();
    return result;
  }
  std::mt19937_64 random_;
};

TEST(Gains, WritingReadingAndWritingAgainGivesTheSameBytes) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string text = gains_text(RandomGains(seed).make());
    const model::Gains back = parse_gains(text, "g.json");
    ASSERT_EQ(gains_text(back), text) << "seed " << seed;
    ASSERT_TRUE(back.decimals.empty()) << "seed " << seed;
  }
}

TEST(Gains, AreReadBackToTheSameBits) {
  const model::Gains gains = RandomGains(1).make();
  const model::Gains back = parse_gains(gains_text(gains), "g.json");
  ASSERT_EQ(back.unknowns.size(), gains.unknowns.size());
  for (std::size_t i = 0; i < gains.unknowns.size(); ++i) {
    EXPECT_EQ(back.unknowns[i].first, gains.unknowns[i].first);
    const numbers::Matrix& a = back.unknowns[i].second;
    const numbers::Matrix& b = gains.unknowns[i].second;
    ASSERT_EQ(a.size(), b.size());
    for (Eigen::Index k = 0; k < a.size(); ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a(k)), std::bit_cast<std::uint64_t>(b(k)));
  }
  EXPECT_EQ(back.problem_name, gains.problem_name);
  EXPECT_EQ(back.solver.message, gains.solver.message);
  EXPECT_EQ(back.margins[1].holds, true);
  EXPECT_EQ(back.bounds[0].what, "inv(P1)*Y");
  EXPECT_EQ(*back.find("L"), gains.gains[0].second);
  EXPECT_EQ(back.find("nothing"), nullptr);
}

TEST(Gains, TimingsStandLastInABlockOfTheirOwn) {
  model::Gains gains = RandomGains(1).make();
  const std::string text = gains_text(gains);
  gains.timings = {{"solve", 17.0}};
  const std::string other = gains_text(gains);
  const std::size_t at = text.find("\n  \"timings\": {");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(other.substr(0, at), text.substr(0, at));
  EXPECT_EQ(text.find("\n  \"", at + 1), std::string::npos)
      << "something stands behind the timings";
}

TEST(Gains, AFileCutAnywhereIsRefused) {
  const std::string text = gains_text(RandomGains(3).make());
  // Without the line feed at its end alone it is still whole.
  EXPECT_EQ(gains_text(parse_gains(text.substr(0, text.size() - 1), "g.json")), text);
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    try {
      parse_gains(text.substr(0, length), "g.json");
      FAIL() << "the first " << length << " bytes were taken for a whole file";
    } catch (const InputError& error) {
      ASSERT_EQ(error.place().file, "g.json");
    }
  }
}

struct Edit {
  std::string pointer;  ///< of JSON
  Json value;
  std::string message;
};

TEST(Gains, ValuesOfTheWrongKindAreShownByTheirPath) {
  const Json document = to_json(RandomGains(4).make());
  const std::vector<Edit> edits = {
      {"/gainsmith", 1, "gainsmith: expected a text"},
      {"/gainsmith", "99", "gainsmith: expected the version"},
      {"/gainsmith", "0.1.0x", "gainsmith: expected the version"},
      {"/gainsmith", "", "gainsmith: expected the version"},
      {"/gainsmith", "99.0.0", "gainsmith: gainsmith 99.0.0 wrote this file"},
      {"/verdict", "perhaps", "verdict: expected yes, no or undecided"},
      {"/verdict", nullptr, "verdict: expected a text"},
      {"/objective", "1", "objective: expected a number"},
      {"/gains", Json::array(), "gains: expected an object"},
      {"/gains/F", "text", "gains.F: expected a list"},
      {"/gains/F", {1, 2}, "gains.F[0]: expected a list"},
      {"/gains/F/1", {1}, "gains.F[1]: a row of another length"},
      {"/gains/F/1/0", "1", "gains.F[1][0]: expected a number"},
      {"/gains/F/1/0", nullptr, "gains.F[1][0]: expected a number"},
      {"/margins", Json::object(), "margins: expected a list"},
      {"/margins/1/holds", 1, "margins[1].holds: expected true or false"},
      {"/bounds/0/active", "yes", "bounds[0].active: expected true or false"},
      {"/solver/iterations", 2.5, "solver.iterations: expected a whole number"},
      {"/solver/iterations", 10000000000, "solver.iterations: this whole number is too large"},
      {"/solver/iterations", 18446744073709551615U, "solver.iterations: this whole number"},
      {"/status", "infeasible", "status: differs from solver.status"},
      {"/cause", 3, "cause: expected a text"},
      {"/timings/solve", "fast", "timings.solve: expected a number"}};
  for (const Edit& edit : edits) {
    Json edited = document;
    edited[Json::json_pointer(edit.pointer)] = edit.value;
    const InputError error = input_error([&] { parse_gains(to_text(edited), "g.json"); });
    EXPECT_EQ(error.place().file, "g.json");
    EXPECT_GT(error.place().line, 0);
    EXPECT_GT(error.place().column, 0);
    EXPECT_NE(error.message().find(edit.message), std::string::npos) << error.what();
  }
}

TEST(Gains, EveryKeyThatIsNotOptionalMustBeThere) {
  model::Gains gains = RandomGains(5).make();
  gains.objective.reset();
  gains.objective_lower_bound.reset();
  gains.certificate.reset();
  gains.searched.clear();
  gains.gain_functions.clear();
  gains.functions.clear();
  gains.report.clear();
  gains.search.reset();
  const Json document = to_json(gains);
  parse_gains(to_text(document), "g.json");
  for (const auto& [key, value] : document.items()) {
    if (key == "status" || key == "cause") continue;  // for readers; they stand under solver too
    if (key == "proof") continue;                     // a file without it is taken as it is
    Json without = document;
    without.erase(key);
    const InputError error = input_error([&] { parse_gains(to_text(without), "g.json"); });
    EXPECT_EQ(error.message(), "the key '" + key + "' is missing");
  }
}

TEST(Gains, UnknownKeysAreRefusedWithTheNearestOne) {
  const Json document = to_json(RandomGains(4).make());
  const std::vector<std::pair<std::string, std::string>> edits = {
      {"/gian", "unknown key 'gian'; known: "},
      {"/objectives", "unknown key 'objectives'; did you mean 'objective'?"},
      {"/solver/Status", "solver: unknown key 'Status'; did you mean 'status'?"},
      {"/margins/1/hold", "margins[1]: unknown key 'hold'; did you mean 'holds'?"},
      {"/bounds/0/comment", "bounds[0]: unknown key 'comment'; known: "},
      {"/statement/method_txt", "statement: unknown key 'method_txt'; did you mean"}};
  for (const auto& [pointer, message] : edits) {
    Json edited = document;
    edited[Json::json_pointer(pointer)] = 1;
    const InputError error = input_error([&] { parse_gains(to_text(edited), "g.json"); });
    EXPECT_EQ(error.message().substr(0, message.size()), message);
    EXPECT_GT(error.place().line, 0);
  }
  Json misspelt = document;
  misspelt["margin"] = misspelt["margins"];
  misspelt.erase("margins");
  EXPECT_EQ(input_error([&] { parse_gains(to_text(misspelt), "g.json"); }).message(),
            "unknown key 'margin'; did you mean 'margins'?");
}

TEST(Gains, AnEditedStatementIsDetectedByItsHash) {
  const Json document = to_json(RandomGains(6).make());
  for (const char* key : {"method_text", "problem_text", "sha256"}) {
    Json edited = document;
    std::string text = edited["statement"][key];
    text.back() = text.back() == 'a' ? 'b' : 'a';
    edited["statement"][key] = text;
    const InputError error = input_error([&] { parse_gains(to_text(edited), "g.json"); });
    EXPECT_NE(error.message().find("was edited"), std::string::npos) << error.what();
  }
}

TEST(Gains, TextMayNotMoveBetweenMethodAndProblem) {
  model::Statement a{"m", "ab", "f", "c", ""};
  model::Statement b{"m", "a", "f", "bc", ""};
  EXPECT_NE(model::statement_hash(a), model::statement_hash(b));
}

TEST(Gains, StateTheirProblem) {
  const model::Gains gains = parse_gains(gains_text(RandomGains(7).make()), "g.json");
  const model::Problem problem = stated_problem(gains, "g.json");
  EXPECT_EQ(problem.text, kProblem);
  EXPECT_EQ(problem.method->text, methods::find("sampled-data-hybrid"));
  EXPECT_EQ(problem.file, "g.json (p.yaml)");
}

TEST(Gains, RandomBytesAreRefusedOrRead) {
  const std::string text = gains_text(RandomGains(8).make());
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string mutated = text;
    for (int k = 0; k < 3; ++k)
      mutated[random() % mutated.size()] = static_cast<char>(random() % 256);
    try {
      parse_gains(mutated, "g.json");
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace gainsmith::io
