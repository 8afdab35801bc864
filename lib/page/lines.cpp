// Breaking a formula into lines, by estimated widths in em.
//
// The markup is read back as a tree of boxes. A row without fences, and one with fences that is too
// wide, is taken apart into parts; each part knows how loose the operator before it is. A formula
// that is too wide is broken at all of its loosest operators, and then each line in the same
// manner.
#include "page/lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "page/element.h"
#include "page/symbol.h"

namespace gainsmith::page {

namespace {

constexpr double kNarrow = 15;  // em: a phone has room for it
constexpr double kLeast = 4;    // em: what is shorter is no line
constexpr int kNever = 1'000'000;

/// Operators at which lines break, from the loosest: behind a comma, before the others. The rows
/// are lists, logic, relations, signs and factors.
constexpr std::array<std::string_view, 5> kBreaks = {",", "∧∨", "=≺⪯≻⪰&lt;≤&gt;≥≠∼∈", "+−±",
                                                     "\u2062·×⊗∘⊘"};
/// The row of the signs in `kBreaks`.
constexpr int kSigns = 3;

/// An element of the markup, with views into it; `markup` is its own copy, which may change.
struct Box {
  std::string_view tag, text;
  std::string markup;
  std::vector<Box> inside;
  double width = 0;     ///< in em, an estimate for the widest fonts that the style sheet names
  int before = kNever;  ///< how loose a break before it is: the loosest is 0
};

/// Which of `kBreaks` an operator is one of.
int level_of(const Box& box) {
  for (int k = 0; box.tag == "mo" && k < std::ssize(kBreaks); ++k)
    if (kBreaks[static_cast<std::size_t>(k)].find(box.text) != std::string_view::npos) return k;
  return box.tag == "mspace" ? kSigns + 1 : kNever;
}

/// In em, of an element whose inside has its widths: scripts count 0.75, fractions and accents as
/// their widest part, a table as its widest columns.
double width_of(const Box& box) {
  double width = box.tag == "msqrt" || box.tag == "mtable" ? 0.7 : 0;
  if (box.tag == "mtable") {
    for (std::size_t j = 0; !box.inside.empty() && j < box.inside[0].inside.size(); ++j) {
      double column = 0;
      for (const Box& row : box.inside) column = std::max(column, row.inside[j].width);
      width += column + 0.9;
    }
    return width;
  }
  // What is raised or lowered is smaller; what is above each other is as wide as its widest part.
  const bool is_script = box.tag == "msub" || box.tag == "msup";
  const bool is_stacked = box.tag == "mfrac" || box.tag == "mover" || box.tag == "munder";
  for (const Box& one : box.inside) {
    const double size = is_script && &one != box.inside.data() ? 0.75 : 1;
    width = is_stacked ? std::max(width, one.width) : width + size * one.width;
  }
  const int level = level_of(box);
  if (level == 0) return 0.5;
  if (level != kNever) return box.text.empty() || box.text == "\u2062" ? 0.3 : 1.4;
  if (!box.inside.empty() && level_of(box.inside[0]) == kSigns) width -= 0.5;  // of one operand
  // Characters of UTF-8, without their later bytes.
  const auto letters = std::count_if(box.text.begin(), box.text.end(), [](char c) {
    return (static_cast<unsigned char>(c) >> 6) != 2;
  });
  const double letter = box.tag == "mo" ? 0.55 : letters == 1 ? 0.78 : 0.61;
  return width + letter * static_cast<double>(letters);
}

/// The first element of `rest`, which then begins behind it.
Box read(std::string_view& rest) {
  const std::string_view all = rest;
  Box box{all.substr(1, all.find_first_of(" />", 1) - 1), {}, {}, {}};
  rest.remove_prefix(all.find('>') + 1);
  if (all[all.find('>') - 1] != '/') {
    box.text = rest.substr(0, rest.find('<'));
    rest.remove_prefix(box.text.size());
    while (!rest.starts_with("</")) box.inside.push_back(read(rest));
    rest.remove_prefix(rest.find('>') + 1);
  }
  box.markup = all.substr(0, all.size() - rest.size());
  box.width = width_of(box);
  return box;
}

/// Adds the parts of a row, and of the rows in it, as far as they are not narrow.
void add(Box& box, int before, int depth, std::vector<Box>& parts) {
  const bool has_fences =
      !box.inside.empty() && box.inside[0].tag == "mo" && level_of(box.inside[0]) == kNever;
  if (box.tag != "mrow" || box.width <= (has_fences ? kNarrow : kLeast)) {
    box.before = before;
    parts.push_back(std::move(box));
    return;
  }
  if (has_fences) depth += kSigns + 2;
  for (Box& one : box.inside) {
    const bool is_first = &one == box.inside.data();
    const int level = level_of(one);
    if (!is_first && level > 0 && level != kNever) before = depth + level;
    add(one, std::exchange(before, level == 0 ? depth : kNever), depth, parts);
    // At the begin of a line "+" still has two operands; a sign in the middle has one.
    if (level == kSigns)
      parts.back().markup.insert(3, is_first ? R"( form="prefix")" : R"( form="infix")");
  }
}

/// The lines of parts; what has no break gets its width, for the style sheet to shrink it.
std::string lines(std::span<Box> parts) {
  std::string markup;
  double left = 0;
  int loosest = kNever;
  for (const Box& part : parts) {
    markup += part.markup;
    left += part.width;
    if (&part != parts.data()) loosest = std::min(loosest, part.before);
  }
  // What fits into one line is one, however many breaks it has.
  if (left <= kNarrow) return element("math", markup);
  if (loosest == kNever)
    return element("math", markup, "style=\"--w:" + std::to_string(std::lround(left + 0.5)) + "\"");
  markup.clear();
  std::size_t begin = 0;
  double width = 0;
  for (std::size_t k = 0; k < parts.size(); left -= parts[k++].width) {
    if (k > 0 && parts[k].before == loosest) {
      parts[k].before = kNever;
      // Neither line may be too short to be one.
      if (std::min(width, left) >= kLeast) {
        markup += lines(parts.subspan(begin, k - begin));
        begin = k;
        width = 0;
      }
    }
    width += parts[k].width;
  }
  markup += lines(parts.subspan(begin));
  return begin == 0 ? markup : element("span", markup, "class=\"part\"");
}

}  // namespace

/// The whole formula is one element where it fits.
std::string formula(std::string_view mathml) {
  const std::string whole = row(mathml);
  std::string_view rest = whole;
  Box box = read(rest);
  if (box.width <= kNarrow) return element("math", whole);
  std::vector<Box> parts;
  add(box, kNever, 0, parts);
  return lines(parts);
}

}  // namespace gainsmith::page
