#include "base/visible.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace gainsmith {
namespace {

TEST(Visible, WhatIsNoTextIsWrittenOut) {
  EXPECT_EQ(visible("a\x1b[31mb\x7f\r"), "a\\x1b[31mb\\x7f\\x0d");
  EXPECT_EQ(visible(std::string(1, '\0')), "\\x00");
  EXPECT_EQ(visible("a\nb\tc"), "a\nb\tc");
  EXPECT_EQ(visible("a\nb\tc", ""), "a\\x0ab\\x09c");
  // C1 (two bytes in UTF-8), ends of lines and paragraphs, directions.
  EXPECT_EQ(visible("\xc2\x9b"), "\\xc2\\x9b");
  for (const char* one : {"\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xa9", "\xe2\x80\xae",
                          "\xe2\x81\xa6", "\xe2\x81\xa9", "\xe2\x80\x8e", "\xe2\x80\x8f"})
    EXPECT_EQ(control_character(std::string("a") + one), 1U) << visible(one);
}

TEST(Visible, TextsStayAsTheyAre) {
  for (const char* text :
       {"", "motor 2, \"x\" \\ <&>", "\xc3\xa9\xc3\xbc\xc2\xb2", "\xe2\x80\xa6\xe2\x80\x94",
        "\xe6\xb8\xa9\xe5\xba\xa6", "\xf0\x9f\x98\x80", "\xc2", "\xe2\x80"}) {
    EXPECT_EQ(visible(text, ""), text);
    EXPECT_EQ(control_character(text), std::string::npos);
  }
}

TEST(Visible, ErrorsQuoteNothingThatATerminalObeys) {
  const InputError error({"a\x1b]0;b.yaml", 1, 2}, "unknown key '\x1b[2J'");
  EXPECT_EQ(std::string(error.what()), "a\\x1b]0;b.yaml:1:2: unknown key '\\x1b[2J'");
  EXPECT_EQ(error.message(), "unknown key '\\x1b[2J'");
  EXPECT_EQ(error.place().file, "a\x1b]0;b.yaml");
}

}  // namespace
}  // namespace gainsmith
