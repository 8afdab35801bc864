#include "model/shape_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/input_error.h"

namespace gainsmith::model {
namespace {

using expr::Shape;
using tests::input_error;

ShapeText shape(const std::string& text) { return parse_shape({text, "f"}); }

TEST(ShapeText, HasFiveForms) {
  EXPECT_EQ(shape("scalar").structure, Structure::scalar);
  EXPECT_EQ(shape("symmetric n").structure, Structure::symmetric);
  EXPECT_EQ(shape("diagonal n").structure, Structure::diagonal);
  EXPECT_EQ(shape("n x p").structure, Structure::full);
  EXPECT_TRUE(shape("n").is_column());
  EXPECT_FALSE(shape("n x 1").is_column());
  EXPECT_FALSE(shape("scalar").is_column());
}

TEST(ShapeText, SizesAreExpressionsInDimensions) {
  const Dimensions known = {{"n", 3}, {"p", 2}};
  EXPECT_EQ(resolve(shape("n x p"), known), (Shape{3, 2}));
  EXPECT_EQ(resolve(shape("n + p x 2*n"), known), (Shape{5, 6}));
  EXPECT_EQ(resolve(shape("symmetric n - 1"), known), (Shape{2, 2}));
  EXPECT_EQ(resolve(shape("diagonal p"), known), (Shape{2, 2}));
  EXPECT_EQ(resolve(shape("p"), known), (Shape{2, 1}));
  EXPECT_EQ(resolve(shape("2 x 3"), {}), (Shape{2, 3}));
  EXPECT_EQ(resolve(shape("scalar"), {}), (Shape{1, 1}));
}

TEST(ShapeText, AnUnknownDimensionLeavesTheShapeOpen) {
  EXPECT_EQ(resolve(shape("n x p"), {{"n", 3}}), std::nullopt);
  EXPECT_EQ(resolve(shape("symmetric n + 1"), {}), std::nullopt);
}

TEST(ShapeText, SizesThatAreNoWholeNumbersAreRefused) {
  const Dimensions known = {{"n", 3}};
  for (const char* text : {"n - 4", "n/2", "n x 0.5", "1e9", "1e300", "symmetric -1"})
    EXPECT_NE(input_error([&] { resolve(shape(text), known); }).message().find("whole number"),
              std::string::npos)
        << text;
}

TEST(ShapeText, MistakesAreShownWhereTheyAre) {
  const std::vector<std::pair<std::string, int>> cases = {{"", 1},
                                                          {"n x", 4},
                                                          {"x n", 1},
                                                          {"n x p x q", 7},
                                                          {"symmetric", 1},
                                                          {"scalar n", 1},
                                                          {"n p", 3},
                                                          {"n +", 4},
                                                          {"skalar", 1},
                                                          {"diagnal n", 1},
                                                          {"symmetric n x n", 13}};
  for (const auto& [text, column] : cases) {
    const InputError error = input_error([&] { shape(text); });
    EXPECT_EQ(error.place(), (Place{"f", 1, column})) << text << ": " << error.what();
  }
}

TEST(ShapeText, AMatrixInOneWordIsNoSize) {
  for (const auto& [text, meant] : std::vector<std::pair<std::string, std::string>>{
           {"nxn", "n x n"}, {"2x1", "2 x 1"}, {"n1Xm2", "n1 x m2"}, {"12xp", "12 x p"}}) {
    const InputError error = input_error([&, word = text] { shape(word); });
    EXPECT_EQ(error.place(), (Place{"f", 1, 1}));
    EXPECT_NE(error.message().find("is written " + meant), std::string::npos) << error.what();
  }
  // Names of dimensions that hold an x.
  for (const char* name : {"nx", "xn", "max", "n_x_n", "boxes"}) EXPECT_EQ(shape(name).text, name);
}

TEST(Learn, FindsDimensionsInAnActualShape) {
  Dimensions known;
  EXPECT_TRUE(learn(shape("n x p"), {2, 1}, known));
  EXPECT_EQ(known, (Dimensions{{"n", 2}, {"p", 1}}));
  EXPECT_TRUE(learn(shape("m"), {4, 1}, known));
  EXPECT_EQ(known.at("m"), 4);
}

TEST(Learn, SeesContradictions) {
  Dimensions known = {{"n", 2}};
  EXPECT_FALSE(learn(shape("n x n"), {2, 3}, known));
  EXPECT_FALSE(learn(shape("n"), {2, 2}, known));
  EXPECT_FALSE(learn(shape("symmetric n"), {2, 1}, known));
  EXPECT_FALSE(learn(shape("scalar"), {1, 2}, known));
  EXPECT_FALSE(learn(shape("n + 1 x 1"), {2, 1}, known));
  EXPECT_FALSE(learn(shape("2 x 2"), {2, 3}, known));
  EXPECT_TRUE(learn(shape("n + 1 x 1"), {3, 1}, known));
}

}  // namespace
}  // namespace gainsmith::model
