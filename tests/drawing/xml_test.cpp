#include "drawing/xml.h"

#include <gtest/gtest.h>

namespace gainsmith::test {
namespace {

TEST(ReadXml, GivesElementsWithAttributesAndText) {
  const auto found = read_xml("<a x=\"1 &amp; 2\"><b/>\n<c>d &lt;</c></a>\n");
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 3);
  EXPECT_EQ((*found)[0].attributes.at("x"), "1 & 2");
  EXPECT_EQ((*found)[2].name, "c");
  EXPECT_EQ((*found)[2].text, "d <");
}

TEST(ReadXml, RefusesWhatIsNotWellFormed) {
  for (const char* text :
       {"", "a", "<a>", "<a></b>", "<a/><a/>", "<a x=1/>", "<a x=\"1/>", "<a x=\"<\"/>", "<a>&</a>",
        "<a>&nbsp;</a>", "<a x=\"1\" x=\"2\"/>", "<a x=\"1\"y=\"2\"/>", "<a>\x01</a>",
        "<a>\xC3</a>", "<a>\xC0\x80</a>", "<a>\xED\xA0\x80</a>", "<a>\xEF\xBF\xBF</a>",
        "<a>\xFF</a>", "<a><b></a></b>"})
    EXPECT_FALSE(read_xml(text)) << text;
}

}  // namespace
}  // namespace gainsmith::test
