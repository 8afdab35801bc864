// Names that C, MATLAB and Python take.
#include "export/identifiers.h"

#include <gtest/gtest.h>

namespace gainsmith::exports {
namespace {

TEST(Identifiers, WordsOfALanguageGetAnUnderscore) {
  EXPECT_EQ(Identifiers(Language::python)("lambda"), "lambda_");
  EXPECT_EQ(Identifiers(Language::c)("lambda"), "lambda");
  EXPECT_EQ(Identifiers(Language::c)("float"), "float_");
  EXPECT_EQ(Identifiers(Language::matlab)("end"), "end_");
  EXPECT_TRUE(is_reserved(Language::c, "register"));
  EXPECT_FALSE(is_reserved(Language::c, "reg"));
}

TEST(Identifiers, NamesThatTheCodeUsesGetAnUnderscore) {
  EXPECT_EQ(Identifiers(Language::python)("range"), "range_");
  EXPECT_EQ(Identifiers(Language::matlab)("power"), "power_");
  EXPECT_EQ(Identifiers(Language::c)("pow"), "pow_");
  EXPECT_EQ(Identifiers(Language::c)("gs3"), "gs3_");
  EXPECT_EQ(Identifiers(Language::python)("gsb3_0"), "gsb3_0_");
  EXPECT_EQ(Identifiers(Language::c)("gs"), "gs");
  EXPECT_EQ(Identifiers(Language::c)("gsx1"), "gsx1");
}

TEST(Identifiers, OtherSignsBecomeUnderscores) {
  Identifiers names(Language::matlab);
  EXPECT_EQ(names("ferrante-seuret-2021/t2-0.70"), "ferrante_seuret_2021_t2_0_70");
  EXPECT_EQ(names("2nd"), "x2nd");
  EXPECT_EQ(names("_L"), "x_L");
  EXPECT_EQ(names(""), "x");
}

TEST(Identifiers, EachNameIsGivenOnce) {
  Identifiers names(Language::c, {"motor_state"});
  EXPECT_EQ(names("motor_state"), "motor_state_");
  EXPECT_EQ(names("a.b"), "a_b");
  EXPECT_EQ(names("a b"), "a_b_");
}

}  // namespace
}  // namespace gainsmith::exports
