#include "gainsmith/summary.h"

#include <gtest/gtest.h>

namespace gainsmith::app {
namespace {

TEST(Summary, EigenvaluesAreShownAsNumbers) {
  EXPECT_EQ(eigenvalues_text(numbers::Matrix{{0.5, 0}, {-1, 2}, {-1, -2}, {-3, 0}, {-3, 0}}),
            "0.5, -1 +- 2i, -3, -3");
  EXPECT_EQ(eigenvalues_text(numbers::Matrix{{0, 0.25}, {0, -0.25}}), "0 +- 0.25i");
  EXPECT_EQ(eigenvalues_text(numbers::Matrix(0, 2)), "");
}

TEST(Summary, ReportsOfEigenvaluesAreShownSo) {
  model::Gains gains;
  gains.report = {{"poles", numbers::Matrix{{-1, 2}, {-1, -2}}},
                  {"table", numbers::Matrix{{-1, 2}, {-1, -2}}}};
  gains.eigenvalues = {"poles"};
  const std::string text = synthesis_summary(gains);
  EXPECT_NE(text.find("poles = -1 +- 2i\n"), std::string::npos) << text;
  EXPECT_NE(text.find("table = [-1, 2; -1, -2]\n"), std::string::npos) << text;
}

TEST(Summary, WideMatricesHaveARowOnEachLine) {
  model::Gains gains;
  gains.gains = {{"K", numbers::Matrix::Constant(1, 30, 1.25)},
                 {"P", numbers::Matrix::Constant(3, 15, 1.25)}};
  const std::string text = synthesis_summary(gains);
  EXPECT_NE(text.find("            P = [1.25, 1.25"), std::string::npos) << text;
  EXPECT_NE(text.find("1.25;\n                 1.25, "), std::string::npos) << text;
  EXPECT_NE(text.find("gains       K = [1.25, 1.25"), std::string::npos) << text;
}

}  // namespace
}  // namespace gainsmith::app
