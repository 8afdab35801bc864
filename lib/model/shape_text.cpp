#include "model/shape_text.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "base/nearest.h"
#include "expr/binding/compile.h"
#include "expr/text/foreign_words.h"
#include "expr/text/parser.h"
#include "numbers/types/real.h"

namespace gainsmith::model {

namespace {

/// The words of the text with their offsets, cut at spaces.
struct Word {
  std::string text;
  std::size_t offset;
};

std::vector<Word> words_of(const std::string& text) {
  std::vector<Word> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(' ', at);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    words.push_back({text.substr(begin, end - begin), begin});
    at = end;
  }
  return words;
}

constexpr const char* kShapes =
    "; a shape is n x p, n, scalar, symmetric n, diagonal n or system n p x m";

/// "nxn", "2x1", "n1xm2": letters and numbers of the usual sizes, with x between.
bool is_glued_product(const std::string& word) {
  const std::size_t cross = word.find_first_of("xX", 1);
  if (cross == std::string::npos || cross + 1 == word.size()) return false;
  const auto is_size = [](std::string_view text) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const bool letter = std::isalpha(static_cast<unsigned char>(text.front())) != 0;
    return (letter || is_digit(text.front())) &&
           std::all_of(text.begin() + 1, text.end(), is_digit);
  };
  const std::string_view all = word;
  return is_size(all.substr(0, cross)) && is_size(all.substr(cross + 1));
}

std::string spaced_product(const std::string& word) {
  const std::size_t cross = word.find_first_of("xX", 1);
  return word.substr(0, cross) + " x " + word.substr(cross + 1);
}

/// A size that depends on dimension names alone; none while one of them is unknown.
std::optional<int> size_of(const expr::Expression& expression, const Dimensions& dimensions) {
  expr::Scope scope;
  scope.dimensions = dimensions;
  for (const std::string& name : names_in(expression))
    if (!dimensions.contains(name)) return std::nullopt;
  const double value = numbers::evaluate(expr::compile(expression, scope, expr::Shape{}), {})(0, 0);
  constexpr double kLargest = 1e6;
  if (!(value >= 0 && value <= kLargest) || std::trunc(value) != value)
    throw InputError(expression.place(*expression.root),
                     "a size must be a whole number, not " + expression.text->str());
  return static_cast<int>(value);
}

/// A name that is not known gets the size; anything else must have it where its value is known.
bool learn_size(const expr::Expression& expression, int actual, Dimensions& dimensions) {
  if (expression.root->kind == expr::NodeKind::name)
    return dimensions.emplace(expression.root->text, actual).first->second == actual;
  const auto known = size_of(expression, dimensions);
  return !known || *known == actual;
}

}  // namespace

ShapeText parse_shape(const expr::Text& text) {
  ShapeText shape;
  shape.text = text.str();
  shape.place = text.place(0);
  const auto words = words_of(text.str());
  const std::size_t length = text.str().size();
  const auto size = [&](std::size_t begin, std::size_t end) {
    try {
      return expr::parse(text.part(begin, end));
    } catch (const InputError& error) {
      throw InputError(error.place(), error.message() + kShapes);
    }
  };
  if (words.size() == 1 && words[0].text == "scalar") return shape;
  if (!words.empty() && words[0].text == "system") {
    shape.structure = Structure::full;
    shape.system = true;
    if (words.size() > 1)
      shape.states = size(words[1].offset, words[1].offset + words[1].text.size());
    if (words.size() <= 2) return shape;
    const std::size_t begin = words[2].offset, cross = shape.text.find(" x ", begin);
    if (cross == std::string::npos)
      throw InputError(shape.place, "expected system, system n or system n p x m");
    shape.rows = size(begin, cross);
    shape.cols = size(cross + 2, length);
    return shape;
  }
  if (words.size() >= 2 && (words[0].text == "symmetric" || words[0].text == "diagonal")) {
    shape.structure = words[0].text == "symmetric" ? Structure::symmetric : Structure::diagonal;
    shape.rows = size(words[1].offset, length);
    return shape;
  }
  if (const std::size_t bracket = shape.text.find('(');
      bracket != std::string::npos && !expr::advice_on(shape.text.substr(0, bracket)).empty())
    throw InputError(shape.place, "'" + shape.text + "' is no shape" + kShapes);
  if (words.size() == 1 && is_glued_product(words[0].text))
    throw InputError(shape.place, "'" + shape.text + "' is one word; a matrix is written " +
                                      spaced_product(words[0].text));
  static const std::vector<std::string> kStructures = {"scalar", "symmetric", "diagonal", "system"};
  if (!words.empty() && words.size() <= 2)
    if (const auto near = nearest(words[0].text, kStructures))
      throw InputError(
          shape.place,
          words[0].text == *near
              ? "expected " + *near + (*near == "scalar" ? " alone" : " n")
              : "unknown shape '" + words[0].text + "'; did you mean '" + *near + "'?");
  shape.structure = Structure::full;
  for (const Word& word : words) {
    if (word.text != "x") continue;
    shape.rows = size(0, word.offset);
    shape.cols = size(word.offset + 1, length);
    return shape;
  }
  if (words.empty())
    throw InputError(shape.place, "expected a shape: n x p, n, scalar, symmetric n or diagonal n");
  shape.rows = size(0, length);
  return shape;
}

std::optional<expr::Shape> resolve(const ShapeText& shape, const Dimensions& dimensions) {
  if (shape.system) return std::nullopt;
  if (shape.structure == Structure::scalar) return expr::Shape{};
  const auto rows = size_of(*shape.rows, dimensions);
  if (!rows) return std::nullopt;
  if (shape.structure != Structure::full) return expr::Shape{*rows, *rows};
  if (!shape.cols) return expr::Shape{*rows, 1};
  const auto cols = size_of(*shape.cols, dimensions);
  if (!cols) return std::nullopt;
  return expr::Shape{*rows, *cols};
}

bool learn_system(const ShapeText& shape, expr::Shape whole, int states, Dimensions& dimensions) {
  if (shape.states && !learn_size(*shape.states, states, dimensions)) return false;
  return !shape.rows || (learn_size(*shape.rows, whole.rows - states, dimensions) &&
                         learn_size(*shape.cols, whole.cols - states, dimensions));
}

bool learn(const ShapeText& shape, expr::Shape actual, Dimensions& dimensions) {
  if (shape.structure == Structure::scalar) return actual.is_scalar();
  if (shape.system) return false;
  if (!learn_size(*shape.rows, actual.rows, dimensions)) return false;
  if (shape.structure != Structure::full) return actual.is_square();
  if (!shape.cols) return actual.cols == 1;
  return learn_size(*shape.cols, actual.cols, dimensions);
}

}  // namespace gainsmith::model
