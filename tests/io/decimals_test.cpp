// A gain file is read with its decimals: what a proof computes with is what is printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/number.h"
#include "bind/bind.h"
#include "io/json/gains_json.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using Texts = std::vector<std::string>;

/// Gains with every kind of matrix, none of them with decimals of its own.
model::Gains plain_gains() {
  model::Gains gains;
  gains.version = "0.1.0";
  gains.gains = {{"L", numbers::Matrix{{0.1, 0.2}, {0.3, -4}}}, {"H", numbers::Matrix{{5.5}}}};
  gains.gain_functions = {{"K",
                           "tau",
                           model::GainFunction::Kind::polynomial,
                           "inv(P)*Y(tau)",
                           {numbers::Matrix{{1}, {2.5}}, numbers::Matrix{{1. / 3}, {1e-9}}}}};
  gains.unknowns = {{"P", numbers::Matrix{{7, 0.7}, {0.7, 8}}}, {"H", numbers::Matrix{{6.5}}}};
  gains.report = {{"rank", numbers::Matrix{{2}}}};
  gains.parameters = {{"delta", numbers::Matrix{{0.03}}}};
  gains.searched = {{"T2", 1.1}, {"delta", 0.03}};
  gains.certificate = model::CertificateRecord{
      true, 0.5, 31, {{"flow", numbers::Matrix{{1, 0}, {0, 1}}}}, "problem"};
  gains.statement = bind::bind(read_problem(kProblem)).design->statement;
  return gains;
}

/// The document with a number replaced by a decimal.
void edit(Json& document, const std::string& pointer, const std::string& decimal) {
  document.at(Json::json_pointer(pointer)) = decimal_json(decimal);
}

/// With the hash of the decimals that stand there.
std::string hashed_text(Json document) {
  const model::Gains edited = parse_gains(to_text(document), "g.json");
  EXPECT_TRUE(edited.is_edited);
  document["proof"]["sha256"] = model::results_hash(edited);
  return to_text(document);
}

const std::string kFortyDigits = "0.1000000000000000055511151231257827021181";

TEST(Decimals, OfAFileAreKeptWhole) {
  Json document = to_json(plain_gains());
  edit(document, "/gains/L/0/0", kFortyDigits);
  edit(document, "/gains/L/1/1", "-3.9999999999999999999999999999999999999999");
  edit(document, "/gain_functions/K/coefficients/1/0/0",
       "0.3333333333333333333333333333333333333333");
  edit(document, "/unknowns/P/0/1", "0.7");
  edit(document, "/unknowns/H", "65e-1");
  edit(document, "/parameters/delta", "0.03");
  edit(document, "/searched/T2", "1.1");
  edit(document, "/certificate/multipliers/flow/1/1", "1.0");
  const std::string text = hashed_text(document);
  const model::Gains gains = parse_gains(text, "g.json");
  EXPECT_FALSE(gains.is_edited);
  EXPECT_EQ(gains_text(gains), text);

  EXPECT_EQ(decimals_of(gains, "L")->elements,
            (Texts{kFortyDigits, "0.2", "0.3", "-3.9999999999999999999999999999999999999999"}));
  EXPECT_EQ(decimals_of(gains, "L")->shape, (expr::Shape{2, 2}));
  EXPECT_EQ(decimals_of(gains, "K_0")->elements, (Texts{"1", "2.5"}));
  EXPECT_EQ(decimals_of(gains, "K_1")->elements,
            (Texts{"0.3333333333333333333333333333333333333333", "1e-09"}));
  EXPECT_EQ(decimals_of(gains, "K_1")->key, "gain_functions.K.coefficients[1]");
  EXPECT_EQ(decimals_of(gains, "P")->elements, (Texts{"7", "0.7", "0.7", "8"}));
  EXPECT_EQ(decimals_of(gains, "delta")->elements, Texts{"0.03"});
  EXPECT_EQ(decimals_of(gains, "T2")->elements, Texts{"1.1"});
  EXPECT_EQ(gains.find("L")->operator()(1, 1), -4) << "its double is the nearest one";
  EXPECT_EQ(gains.searched.at("T2"), 1.1);
}

/// As state() does: a gain before an unknown of the same name.
TEST(Decimals, OfANameAreThoseOfTheGainFirst) {
  Json document = to_json(plain_gains());
  edit(document, "/unknowns/H", "65e-1");
  const model::Gains gains = parse_gains(to_text(document), "g.json");
  EXPECT_EQ(decimals_of(gains, "H")->elements, Texts{"5.5"});
  EXPECT_EQ(decimals_of(gains, "H")->key, "gains.H");
  EXPECT_EQ(decimals_of(gains, "delta")->key, "parameters.delta");
  EXPECT_FALSE(decimals_of(gains, "rank"));
  EXPECT_FALSE(decimals_of(gains, "K"));
  EXPECT_FALSE(decimals_of(gains, "K_2"));
}

TEST(Decimals, InMemoryAreThoseOfTheFileThatWouldBeWritten) {
  const model::Gains gains = plain_gains();
  const model::Gains back = parse_gains(gains_text(gains), "g.json");
  EXPECT_TRUE(back.decimals.empty()) << "17 digits need no second copy";
  const Json document = to_json(gains);
  for (const auto& [name, pointer] :
       std::vector<std::pair<std::string, std::string>>{{"L", "/gains/L"},
                                                        {"H", "/gains/H"},
                                                        {"K_0", "/gain_functions/K/coefficients/0"},
                                                        {"K_1", "/gain_functions/K/coefficients/1"},
                                                        {"P", "/unknowns/P"},
                                                        {"delta", "/parameters/delta"},
                                                        {"T2", "/searched/T2"}}) {
    const model::Decimals decimals = decimals_of(gains, name).value();
    std::string written = to_text(document.at(Json::json_pointer(pointer)));
    for (const char sign : {'[', ']', ' ', ','})
      std::replace(written.begin(), written.end(), sign, '\n');
    Texts elements;
    std::istringstream words(written);
    for (std::string word; words >> word;) elements.push_back(word);
    EXPECT_EQ(decimals.elements, elements) << name;
    EXPECT_EQ(decimals_of(back, name)->elements, elements) << name;
  }
}

TEST(Decimals, OfNegativeZeroKeepItsSign) {
  model::Gains gains = plain_gains();
  gains.gains[1].second(0, 0) = -0.0;
  EXPECT_EQ(decimals_of(gains, "H")->elements, Texts{"-0.0"});
  const model::Gains back = parse_gains(gains_text(gains), "g.json");
  EXPECT_TRUE(std::signbit(back.gains[1].second(0, 0)));
  EXPECT_TRUE(back.decimals.empty());
}

/// What was changed after reading is what is written.
TEST(Decimals, GiveWayToAnotherValue) {
  Json document = to_json(plain_gains());
  edit(document, "/gains/L/0/0", kFortyDigits);
  edit(document, "/gains/L/0/1", "2e-1");
  edit(document, "/searched/T2", "1.10");
  model::Gains gains = parse_gains(to_text(document), "g.json");
  gains.gains[0].second(0, 0) = 17;
  gains.searched["T2"] = 1.2;
  EXPECT_EQ(decimals_of(gains, "L")->elements[0], "17");
  EXPECT_EQ(decimals_of(gains, "L")->elements[1], "2e-1");
  EXPECT_EQ(decimals_of(gains, "T2")->elements[0], "1.2");
  const model::Gains back = parse_gains(gains_text(gains), "g.json");
  EXPECT_EQ(back.gains[0].second, gains.gains[0].second);
  gains.gains[0].second = numbers::Matrix{{1, 2, 3}};
  EXPECT_EQ(decimals_of(gains, "L")->elements, (Texts{"1", "2", "3"}));
}

/// Random decimals of all lengths, in all places of a matrix.
TEST(Decimals, OfAnyLengthSurvive) {
  std::mt19937 random(1);
  const auto digits = [&](std::size_t count) {
    std::string text;
    while (text.size() < count) text += static_cast<char>('0' + random() % 10);
    return text;
  };
  for (int i = 0; i < 300; ++i) {
    Json document = to_json(plain_gains());
    Texts expected;
    for (const char* place : {"/0/0", "/0/1", "/1/0", "/1/1"}) {
      expected.push_back((random() % 2 == 0 ? "-" : "") + std::to_string(random() % 100) + "." +
                         digits(1 + random() % 60) +
                         (random() % 2 == 0 ? "" : "e" + std::to_string(int(random() % 40) - 20)));
      edit(document, std::string("/gains/L") + place, expected.back());
    }
    const std::string text = hashed_text(document);
    const model::Gains gains = parse_gains(text, "g.json");
    ASSERT_EQ(gains_text(gains), text);
    ASSERT_EQ(decimals_of(gains, "L")->elements, expected);
    for (int k = 0; k < 4; ++k)
      ASSERT_EQ(gains.find("L")->operator()(k / 2, k % 2),
                parse_decimal(expected[static_cast<std::size_t>(k)]));
  }
}

TEST(Decimals, MistakesBesideThemHaveTheirPath) {
  Json document = to_json(plain_gains());
  edit(document, "/gains/L/0/0", kFortyDigits);
  document["gains"]["L"][1][0] = "0.3";
  EXPECT_EQ(tests::input_error([&] { parse_gains(to_text(document), "g.json"); }).message(),
            "gains.L[1][0]: expected a number");
  document["gains"]["L"][1] = {1};
  EXPECT_EQ(tests::input_error([&] { parse_gains(to_text(document), "g.json"); }).message(),
            "gains.L[1]: a row of another length");
  Json whole = to_json(plain_gains());
  edit(whole, "/solver/iterations", "23.0");
  EXPECT_EQ(tests::input_error([&] { parse_gains(to_text(whole), "g.json"); }).message(),
            "solver.iterations: expected a whole number");
}

}  // namespace
}  // namespace gainsmith::io
