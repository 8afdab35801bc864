#include "io/yaml/yaml_error.h"

#include <gtest/gtest.h>

#include <string>

#include "io/yaml/yaml.h"
#include "support/input_error.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

void expect(const std::string& text, int line, int column, const std::string& cure) {
  const InputError error = input_error([&] { YamlFile(text, "f"); });
  EXPECT_EQ(error.place(), (Place{"f", line, column})) << error.what();
  EXPECT_NE(error.message().find(cure), std::string::npos) << error.what();
}

TEST(YamlErrors, ATabInTheIndentation) {
  expect("a:\n\tb: 1\n", 2, 1, "no tab");
  expect("a:\n  b: 1\n  \tc: 2\n", 3, 3, "no tab");
  expect("a:\n\t- 1\n", 2, 1, "no tab");
}

TEST(YamlErrors, AFormulaThatMustBeQuoted) {
  expect("a:\n  b: *x\n", 2, 6, "begins with '*' must be quoted");
  expect("a: [P, *, I] > 0\n", 1, 4, "begins with '[' must be quoted");
  expect("a: *\n", 1, 4, "begins with '*' must be quoted");
  expect("a: {b: 1, c: *x}\n", 1, 14, "begins with '*' must be quoted");
  expect("a: &\nb: &\n", 1, 4, "begins with '&' must be quoted");
  expect("a: [P, Y; *, I] > 0\n", 1, 4, "begins with '[' must be quoted");
  expect("a: [P, Y] + 2\nb: 1\n", 1, 4, "begins with '[' must be quoted");
  expect("data: {A: diag([1, 0]), C: [[1, 0]]}\n", 1, 11, "quoted, such as \"diag([1, 2])\"");
  expect("a: {s: \"it's\", A: f([1]), b: g([2])}\n", 1, 19, "quoted, such as \"f([1, 2])\"");
  expect("a: b: c\n", 1, 5, "holds ': ' must be quoted");
}

TEST(YamlErrors, AMappingThatIsTornApart) {
  expect("a:\n  b: 1\n   c: 2\n", 3, 5, "begin in one column");
  expect("a:\n  b: 1\n c: 2\n", 3, 2, "begin in one column");
  expect("data\n  A: 1\n", 1, 5, "':' is missing");
  expect("problem motor\nmethod: m\n", 1, 8, "':' is missing");
  expect("a: 1\ndata {A: \"[1; 2]\"}\n", 2, 5, "':' is missing");
  expect("a: {forall: t in [0, T], that: x}\n", 1, 4, "in { } and [ ] a text with a comma");
}

TEST(YamlErrors, ABracketThatIsNotClosed) {
  expect("a: [1, 2\n", 1, 4, "a ']' is missing");
  expect("data:\n  A: [[0, 1], [-1, 0]\n  C: [[1, 0]]\n", 2, 6, "a ']' is missing");
  expect("a: '[' # [\nb: {c: 1, d: \"]\"\n", 2, 4, "a '}' is missing");
}

TEST(YamlErrors, AKeyWithoutASpaceBehindIt) {
  expect("data:\n  T1:0.1\n  T2: 1\n", 2, 6, "a space is missing behind the ':'");
}

TEST(YamlErrors, OthersKeepWhatTheReaderSays) {
  const InputError error = input_error([] { YamlFile("a: !<\n", "f"); });
  EXPECT_EQ(error.message().find("quoted"), std::string::npos) << error.what();
  EXPECT_EQ(error.message().substr(0, 5), "YAML:");
}

}  // namespace
}  // namespace gainsmith::io
