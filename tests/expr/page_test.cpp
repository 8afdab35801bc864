// docs/language.md holds the tables of functions and operators as the program has them.
#include <gtest/gtest.h>

#include <string>

#include "base/file.h"
#include "expr/binding/functions.h"

namespace gainsmith::expr {
namespace {

TEST(LanguagePage, HoldsTheTables) {
  const std::string page = read_text(GAINSMITH_PAGES "/language.md");
  for (const std::string& table : {operators_page(), functions_page()})
    EXPECT_NE(page.find("\n" + table + "\n"), std::string::npos)
        << "docs/language.md should have:\n\n"
        << table;
}

}  // namespace
}  // namespace gainsmith::expr
