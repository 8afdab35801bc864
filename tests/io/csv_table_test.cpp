// Tables of CSV as they come: what is read, and where what is wrong stands.
#include "io/matrix/csv_table.h"

#include <gtest/gtest.h>

#include <string>

#include "io/matrix/csv.h"
#include "support/input_error.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

CsvTable table(const std::string& text) { return {text, "log.csv"}; }

double number(const CsvTable& table, std::size_t row, const std::string& column) {
  return table.number(row, table.column(column, {})).value();
}

TEST(CsvTable, ReadsNumbersByTheirColumns) {
  const CsvTable log = table("t,angle,event\n0,1.5,\n0.25,-2e-3,sample\n");
  ASSERT_EQ(log.rows(), 2U);
  EXPECT_EQ(number(log, 0, "t"), 0);
  EXPECT_EQ(number(log, 0, "angle"), 1.5);
  EXPECT_EQ(number(log, 1, "t"), 0.25);
  EXPECT_EQ(number(log, 1, "angle"), -2e-3);
  EXPECT_EQ(log.text(1, 2), "sample");
  EXPECT_FALSE(log.number(0, 2));
}

TEST(CsvTable, ForgivesWhatSpreadsheetsWrite) {
  const std::string quoted =
      "\xEF\xBB\xBF\"t\" , \"the, \"\"angle\"\"\"\r\n\r\n 0 ,\" 1\"\r\n1 , 2";
  const CsvTable log = table(quoted);
  ASSERT_EQ(log.rows(), 2U);
  EXPECT_EQ(log.text(0, 1), " 1");
  EXPECT_EQ(number(log, 1, "the, \"angle\""), 2);
  EXPECT_EQ(number(log, 0, "t"), 0);
  EXPECT_EQ(table("t\r0\r1").rows(), 2U);
}

TEST(CsvTable, ReadsWhatIsWrittenHere) {
  std::string text;
  const std::string cells[] = {"a,b", "say \"x\"", "two\nlines", ""};
  const std::string names[] = {"p", "q", "r", "s"};
  add_csv_line(names, text);
  add_csv_line(cells, text);
  const CsvTable log = table(text);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(log.text(0, k), cells[k]);
}

TEST(CsvTable, SaysWhereWhatIsWrongStands) {
  struct Case {
    std::string text;
    int line, column;
    std::string message;
  };
  for (const Case& one :
       {Case{"", 1, 1, "the file is empty"}, Case{"\n\n", 1, 1, "empty"},
        Case{"t,u\n", 1, 1, "there is no row"},
        Case{"0,1\n1,2\n", 1, 1, "expected a line of column names"},
        Case{"t,u,t\n1,2,3\n", 1, 5, "two columns 't'"}, Case{"t;u\n1;2\n", 1, 1, "semicolons"},
        Case{"t,u\n1,2\n3\n", 3, 1, "the row has 1 cells, the first line 2"},
        Case{"t,u\n\n1,2,3\n", 3, 1, "the row has 3 cells"},
        Case{"t,u\n1,\"2\n", 2, 3, "not closed"},
        Case{"t,u\n1,\"2\"x\n", 2, 6, "after a quoted cell"},
        Case{"\n\n0,1\n1,2\n", 3, 1, "expected a line of column names"},
        Case{"\nt,u,t\n1,2,3\n", 2, 5, "two columns 't'"},
        Case{"t,\"a\nb\",t\n1,2,3\n", 2, 4, "two columns 't'"},
        Case{"t,\"a\nb\"x\n", 2, 3, "after a quoted cell"}}) {
    const InputError error = input_error([&] { table(one.text); });
    EXPECT_EQ(error.place(), (Place{"log.csv", one.line, one.column})) << one.text;
    EXPECT_NE(error.message().find(one.message), std::string::npos) << error.message();
  }
}

TEST(CsvTable, SaysWhichCellIsNoNumber) {
  const CsvTable log = table("t,u\n\"a\nb\",1\n0,nan\n1, inf\n2,\"0x1\"\n3,1e999\n");
  EXPECT_EQ(log.rows(), 5U);
  const auto refused = [&](std::size_t row, std::size_t column) {
    return input_error([&] { log.number(row, column); });
  };
  EXPECT_EQ(refused(0, 0).place(), (Place{"log.csv", 2, 1}));
  EXPECT_EQ(refused(1, 1).place(), (Place{"log.csv", 4, 3}));
  EXPECT_EQ(refused(2, 1).place(), (Place{"log.csv", 5, 4}));
  EXPECT_EQ(refused(3, 1).place(), (Place{"log.csv", 6, 3}));
  EXPECT_EQ(refused(4, 1).message(), "the column u needs finite decimal numbers, not '1e999'");
  const InputError none = input_error([&] { log.column("U", {"p.yaml", 7, 3}); });
  EXPECT_EQ(none.place(), (Place{"p.yaml", 7, 3}));
  EXPECT_NE(none.message().find("log.csv has no column 'U'; did you mean 'u'?"), std::string::npos)
      << none.message();
}

}  // namespace
}  // namespace gainsmith::io
