#include "sdp/files/sdpa_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "base/double_double.h"
#include "base/error.h"
#include "base/number.h"
#include "base/stop.h"
#include "base/utf8.h"

namespace gainsmith::sdp {
namespace {

/// Numbers that a problem's matrices may hold (8 GB of doubles); beyond it the file is refused.
constexpr double kLargestProblem = 1e9;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == '{' || c == '}' || c == '(' ||
         c == ')';
}

/// Walks over the numbers of the text, keeping the place of the last one.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  int line() const { return line_; }
  bool at_end() const { return position_ >= text_.size(); }

  /// Skips spaces on this line; true when nothing is left on it.
  bool end_of_line() {
    while (!at_end() && is_space(text_[position_])) ++position_;
    return at_end() || text_[position_] == '\n';
  }

  void next_line() {
    check_stop();
    const std::size_t end = text_.find('\n', position_);
    position_ = std::min(end, text_.size());
    if (at_end()) return;
    line_start_ = ++position_;
    ++line_;
  }

  /// Skips lines with nothing on them; false at the end of the text.
  bool skip_blank_lines() {
    while (end_of_line()) {
      if (at_end()) return false;
      next_line();
    }
    return true;
  }

  void skip_comments() {
    while (!at_end()) {
      std::size_t first = position_;
      while (first < text_.size() && is_space(text_[first])) ++first;
      if (first >= text_.size()) return;
      if (text_[first] != '"' && text_[first] != '*' && text_[first] != '\n') return;
      next_line();
    }
  }

  /// The number at this place of the line; `what` for the message when there is none.
  double number(const char* what) {
    if (end_of_line())
      fail(std::string("expected ") + what +
           (at_end() ? ", found the end of the file" : ", found the end of the line"));
    token_ = position_;
    const char* first = text_.data() + position_;
    const char* last = text_.data() + text_.size();
    if (first != last && *first == '+' && first + 1 != last && first[1] != '-') ++first;
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error == std::errc::result_out_of_range) {
      fail_at_token(std::string(what) + " is out of the range of a double");
    } else if (error != std::errc() ||
               (end != last && !is_space(*end) && *end != '\n' && !remark_follows(*end))) {
      fail_at_token(std::string("expected ") + what + ", found '" + word() + "'");
    }
    if (!std::isfinite(value)) fail_at_token(std::string(what) + " is not finite");
    position_ = static_cast<std::size_t>(end - text_.data());
    value_ = value;
    return value;
  }

  /// What rounding took from the last number: the decimal as written minus its double.
  double rest() const;

  /// A whole number from `least` to `most`, possibly written as a real (3.0).
  int integer(const char* what, double least, double most) {
    const double value = number(what);
    if (value != std::floor(value))
      fail_at_token(std::string(what) + " must be a whole number, not '" + word() + "'");
    if (value < least || value > most)
      fail_at_token(std::string(what) + " must be from " + brief(least, 10) + " to " +
                    brief(most, 10) + ", not " + brief(value, 10));
    return static_cast<int>(value);
  }

  [[noreturn]] void fail(const std::string& message) const { throw_at(position_, message); }
  [[noreturn]] void fail_at_token(const std::string& message) const { throw_at(token_, message); }

 private:
  /// "=" may touch the number that a remark explains ("3=mDIM").
  static bool remark_follows(char c) { return c == '='; }

  /// The text at the last number, up to 24 characters, for messages.
  std::string word() const {
    std::size_t end = token_;
    while (end < text_.size() && end < token_ + 24 && !is_space(text_[end]) && text_[end] != '\n')
      ++end;
    return std::string(text_.substr(token_, end - token_));
  }

  [[noreturn]] void throw_at(std::size_t position, const std::string& message) const {
    int column = 1;
    for (std::size_t p = line_start_; p < position && p < text_.size(); ++p)
      if (!is_continuation(text_[p])) ++column;
    throw InputError(Place{file_, line_, column}, message);
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t position_ = 0;
  std::size_t token_ = 0;
  double value_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
};

// With M the digits as a whole number and P = 10^|e|: rest = (M - value P)/P or M P - value. Digits
// beyond the thirtieth are below what double-double holds.
double Scanner::rest() const {
  // Where powers of ten leave the range, nothing is said of the rest.
  constexpr int kMostDigits = 30, kLargestExponent = 200;
  DoubleDouble mantissa(0);
  int digits = 0, exponent = 0;
  bool after_point = false, fraction = false;
  std::size_t p = token_;
  for (; p < position_ && text_[p] != 'e' && text_[p] != 'E'; ++p) {
    const char c = text_[p];
    if (c == '.') after_point = true;
    if (c < '0' || c > '9') continue;
    if (digits >= kMostDigits) {
      exponent += after_point ? 0 : 1;
      continue;
    }
    mantissa = mantissa * 10.0 + DoubleDouble(c - '0');
    if (mantissa.hi() != 0) ++digits;
    if (after_point) {
      --exponent;
      fraction = fraction || c != '0';
    }
  }
  if (mantissa.hi() == 0 || (!fraction && p >= position_ && digits <= 15)) return 0;
  if (p < position_) {
    int written = 0;
    p += text_[p + 1] == '+' ? 2 : 1;
    std::from_chars(text_.data() + p, text_.data() + position_, written);
    exponent += written;
  }
  if (std::abs(exponent) > kLargestExponent) return 0;
  // 10^|e| by squaring.
  DoubleDouble power(1), square(10);
  for (int e = std::abs(exponent); e > 0; e /= 2, square *= square)
    if (e % 2 == 1) power *= square;
  const DoubleDouble value(std::abs(value_));
  const DoubleDouble left =
      exponent < 0 ? (mantissa - value * power) / power : mantissa * power - value;
  return value_ < 0 ? -left.hi() : left.hi();
}

/// m, the blocks and c; leaves the scanner at the first entry.
Problem read_header(Scanner& in, std::size_t length) {
  const auto most = static_cast<double>(std::min<std::size_t>(length, 1'000'000'000));
  Problem problem;
  in.skip_comments();
  in.skip_blank_lines();
  const int m = in.integer("the number of variables", 0, most);
  in.next_line();
  in.skip_blank_lines();
  const int blocks = in.integer("the number of blocks", 1, most);
  in.next_line();
  double numbers = 0;
  for (int b = 0; b < blocks; ++b) {
    in.skip_blank_lines();
    const int size = in.integer("a block size", -1e9, 1e9);
    if (size == 0) in.fail_at_token("a block has no rows");
    const double n = std::abs(size);
    numbers += size < 0 ? n : n * n;
    if (numbers > kLargestProblem) in.fail_at_token("the blocks are too large (over 10^9 numbers)");
    problem.blocks.push_back({std::abs(size), size < 0});
  }
  in.next_line();
  for (int i = 0; i < m; ++i) {
    in.skip_blank_lines();
    problem.c.push_back(in.number("a cost"));
    problem.c_rest.push_back(in.rest());
  }
  if (m > 0 && !in.end_of_line()) in.fail("more than " + std::to_string(m) + " costs on this line");
  if (m > 0) in.next_line();
  problem.f.resize(static_cast<std::size_t>(m) + 1);
  return problem;
}

struct NumberedEntry {
  int matrix = 0;
  Entry entry;
};

/// One entry line; empty at the end of the text.
std::optional<NumberedEntry> read_entry(Scanner& in, const Problem& problem) {
  if (!in.skip_blank_lines()) return std::nullopt;
  NumberedEntry result;
  result.matrix = in.integer("the number of a matrix", 0, problem.m());
  result.entry.block =
      in.integer("the number of a block", 1, static_cast<double>(problem.blocks.size())) - 1;
  const Block& block = problem.blocks[static_cast<std::size_t>(result.entry.block)];
  result.entry.row = in.integer("a row", 1, block.size) - 1;
  result.entry.column = in.integer("a column", 1, block.size) - 1;
  if (block.diagonal && result.entry.row != result.entry.column)
    in.fail_at_token("an off-diagonal entry in a diagonal block");
  if (result.entry.row > result.entry.column) std::swap(result.entry.row, result.entry.column);
  result.entry.value = in.number("a value");
  result.entry.rest = in.rest();
  if (!in.end_of_line()) in.fail("more than five numbers on the line of an entry");
  in.next_line();
  return result;
}

/// Entries are ordered, and the same, by their place alone.
auto place_of(const Entry& e) { return std::tie(e.block, e.row, e.column); }

bool before(const Entry& a, const Entry& b) { return place_of(a) < place_of(b); }

/// The first place of `list` that occurs twice.
std::optional<Entry> find_duplicate(const std::vector<Entry>& list) {
  bool increasing = true;
  for (std::size_t k = 1; k < list.size() && increasing; ++k)
    increasing = before(list[k - 1], list[k]);
  if (increasing) return std::nullopt;
  std::vector<Entry> sorted = list;
  std::sort(sorted.begin(), sorted.end(), before);
  const auto twice =
      std::adjacent_find(sorted.begin(), sorted.end(),
                         [](const Entry& a, const Entry& b) { return place_of(a) == place_of(b); });
  if (twice == sorted.end()) return std::nullopt;
  return *twice;
}

/// Reads again, to name the lines: only a file that is refused pays for it.
[[noreturn]] void refuse_duplicate(Scanner in, const Problem& problem, int matrix,
                                   const Entry& twice, const std::string& file) {
  int first_line = 0;
  for (;;) {
    in.skip_blank_lines();
    const int line = in.line();
    const auto read = read_entry(in, problem);
    if (!read) break;
    if (read->matrix != matrix || place_of(read->entry) != place_of(twice)) continue;
    if (first_line == 0) {
      first_line = line;
      continue;
    }
    throw InputError(Place{file, line, 1},
                     "matrix " + std::to_string(matrix) + ", block " +
                         std::to_string(twice.block + 1) + ": entry (" +
                         std::to_string(twice.row + 1) + ", " + std::to_string(twice.column + 1) +
                         ") or its mirror image was given on line " + std::to_string(first_line) +
                         " already; give each once, in one triangle");
  }
  throw InputError(Place{file, 0, 0}, "an entry is given twice");
}

}  // namespace

Problem read_sdpa(std::string_view text, const std::string& file_name) {
  Scanner in(text, file_name);
  Problem problem = read_header(in, text.size());
  const Scanner entries = in;
  while (const auto read = read_entry(in, problem))
    problem.f[static_cast<std::size_t>(read->matrix)].push_back(read->entry);
  for (std::size_t i = 0; i < problem.f.size(); ++i) {
    if (const auto twice = find_duplicate(problem.f[i]))
      refuse_duplicate(entries, problem, static_cast<int>(i), *twice, file_name);
    std::erase_if(problem.f[i], [](const Entry& e) { return e.value == 0; });
  }
  return problem;
}

std::string write_sdpa(const Problem& problem, const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) text += "* " + remark + "\n";
  text += std::to_string(problem.m()) + "\n" + std::to_string(problem.blocks.size()) + "\n";
  for (const Block& block : problem.blocks)
    text += std::to_string(block.diagonal ? -block.size : block.size) + " ";
  text += "\n";
  for (const double cost : problem.c) text += decimal17(cost) + " ";
  text += "\n";
  for (std::size_t i = 0; i < problem.f.size(); ++i)
    for (const Entry& entry : problem.f[i])
      text += std::to_string(i) + " " + std::to_string(entry.block + 1) + " " +
              std::to_string(entry.row + 1) + " " + std::to_string(entry.column + 1) + " " +
              decimal17(entry.value) + "\n";
  return text;
}

}  // namespace gainsmith::sdp
