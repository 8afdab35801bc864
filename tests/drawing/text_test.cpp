#include "drawing/text.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "drawing/xml.h"

namespace gainsmith::drawing {
namespace {

TEST(EscapedText, HasNoMarkup) {
  EXPECT_EQ(escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(escaped("x\xCC\x82\xE2\x82\x81 \xF0\x9D\x9C\x8F"),
            "x\xCC\x82\xE2\x82\x81 \xF0\x9D\x9C\x8F");
  EXPECT_EQ(escaped("two\r\nlines\t"), "two  lines ");
}

TEST(EscapedText, ReplacesWhatXmlDoesNotHave) {
  const std::string replaced = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped(std::string("a\0b", 3)), "a" + replaced + "b");
  EXPECT_EQ(escaped("\x1B"), replaced);
  EXPECT_EQ(escaped("\xC3"), replaced);
  EXPECT_EQ(escaped("\xC0\x80"), replaced + replaced);
  EXPECT_EQ(escaped("\xE2\x82"), replaced + replaced);
  EXPECT_EQ(escaped("\xED\xA0\x80"), replaced + replaced + replaced);
  EXPECT_EQ(escaped("\xEF\xBF\xBF"), replaced + replaced + replaced);
  EXPECT_EQ(escaped("\xF4\x90\x80\x80x"), replaced + replaced + replaced + replaced + "x");
}

TEST(EscapedText, OfRandomBytesIsWellFormed) {
  RandomStream draw(1, 0);
  const std::string likely = "<>&\"'\n\xC3\xA9\xE2\x82\x81\xF0\x9D\x9C\x8F\xED\xEF\xBF";
  for (int k = 0; k < 20000; ++k) {
    std::string bytes;
    for (int i = 0; i < 6; ++i)
      bytes += draw.uniform() < 0.3 ? static_cast<char>(256 * draw.uniform() - 128)
                                    : likely[static_cast<std::size_t>(
                                          draw.uniform() * static_cast<double>(likely.size()))];
    const std::string safe = escaped(bytes);
    std::string element = "<a b=\"";
    element.append(safe).append("\">").append(safe).append("</a>");
    ASSERT_TRUE(test::read_xml(element)) << safe;
  }
}

TEST(ShortenedText, FitsAndBeginsLikeTheWhole) {
  RandomStream draw(2, 0);
  for (int k = 0; k < 2000; ++k) {
    std::string text;
    const int length = static_cast<int>(60 * draw.uniform());
    for (int i = 0; i < length; ++i)
      text += draw.uniform() < 0.2 ? std::string("\xCF\x84")
                                   : std::string(1, static_cast<char>(32 + 94 * draw.uniform()));
    const double width = 20 + 300 * draw.uniform();
    const std::string part = shortened(text, 12, width);
    ASSERT_LE(text_width(part, 12), width);
    if (text_width(text, 12) <= width) {
      ASSERT_EQ(part, text);
    } else {
      ASSERT_TRUE(part.ends_with("\xE2\x80\xA6"));
      ASSERT_TRUE(text.starts_with(part.substr(0, part.size() - 3)));
      ASSERT_GT(text_width(part, 12), width - 13);  // one character more would not fit
      ASSERT_TRUE(test::read_xml("<a>" + escaped(part) + "</a>"));
      ASSERT_EQ(escaped(part).find("\xEF\xBF\xBD"), std::string::npos) << "cut within a character";
    }
  }
}

TEST(TextWidth, CountsCharactersAndNotBytes) {
  EXPECT_EQ(text_width("x\xCC\x82", 10), text_width("x", 10));
  EXPECT_LT(text_width("ill", 10), text_width("WWW", 10));
  EXPECT_EQ(text_width("ab", 24), 2 * text_width("ab", 12));
  EXPECT_EQ(text_width("", 12), 0);
}

}  // namespace
}  // namespace gainsmith::drawing
