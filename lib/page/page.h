// The whole page: one file that needs no other, no network and no script.
//
// It shows what a gain file, a campaign and a run say, and the problem in mathematics beside it. It
// computes no result and proves nothing again. Formulas are MathML Core, pictures are SVG; the page
// is HTML that is well-formed XML, and the same results give the same bytes.
//
// page puts the sections of all problems together; results and campaign write those of one.
// statement and motion print problem and dynamics, squares the sums of squares, by mathml for
// expressions and symbol for names, numbers and matrices. notation says what names represent. rows
// and lines lay formulas out, element makes markup, style is the style sheet.
#pragma once

#include <string>
#include <vector>

#include "page/results.h"

namespace gainsmith::page {

/// Designs side by side.
struct Comparison {
  struct Row {
    std::string what;
    std::vector<std::string> values;  ///< of each design; after them the difference, of two
  };
  std::vector<std::string> names;  ///< of the designs
  std::vector<Row> rows;
  std::vector<SystemFigure> figures;  ///< of all in one
};

/// The page of one problem, or of many: a table of all, then each problem folded. The same results
/// give the same bytes. Well-formed XML, whatever the texts hold.
std::string page(const std::vector<Results>& results, const std::string& title);
/// The same with a comparison first.
std::string page(const std::vector<Results>& results, const std::string& title,
                 const Comparison& comparison);

/// How many bytes a page should have at most: the largest pictures of many problems are left out
/// for it.
constexpr std::size_t page_size = 3'000'000;

}  // namespace gainsmith::page
