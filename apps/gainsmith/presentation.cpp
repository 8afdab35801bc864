#include "gainsmith/presentation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/nearest.h"
#include "base/number.h"
#include "drawing/arrange.h"

namespace gainsmith::app {

namespace {

/// "600x400": both numbers. Nothing for a text of another form.
std::optional<std::pair<double, double>> pair_of(const std::string& text, char mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return std::nullopt;
  const auto first = parse_decimal(text.substr(0, at)), second = parse_decimal(text.substr(at + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

void set_size(const std::string& text, const std::vector<drawing::Figure*>& figures) {
  constexpr double kLeast = 200, kMost = 10000;
  const auto size = pair_of(text, 'x');
  const auto fits = [](double length) { return length >= kLeast && length <= kMost; };
  if (!size || !fits(size->first) || !fits(size->second))
    throw InputError({"--size"},
                     "expected a width and a height from 200 to 10000, such as "
                     "600x400, not '" +
                         text + "'");
  for (drawing::Figure* figure : figures) {
    figure->width = size->first;
    figure->height = size->second;
  }
}

void set_window(const std::string& text, const std::vector<drawing::Figure*>& figures) {
  const auto window = pair_of(text, ':');
  if (!window || !(window->first < window->second))
    throw InputError({"--window"},
                     "expected a part of the axis below, such as 0:5, not '" + text + "'");
  for (drawing::Figure* figure : figures) drawing::cut(*figure, window->first, window->second);
}

void set_jump_width(const std::string& text, const std::vector<drawing::Figure*>& figures) {
  const auto width = parse_decimal(text);
  if (!width || !(*width > 0))
    throw InputError({"--jump-width"}, "expected a positive time, such as 0.1, not '" + text + "'");
  for (drawing::Figure* figure : figures) {
    drawing::spread_jumps(*figure, *width);
    figure->axis += " + " + brief(*width) + " j";
  }
}

void set_name(const std::string& text, const std::vector<drawing::Figure*>& figures) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0)
    throw InputError({"--name"}, "expected NAME=TEXT, such as x1=position, not '" + text + "'");
  const std::string name = text.substr(0, at);
  std::vector<std::string> known;
  bool found = false;
  for (drawing::Figure* figure : figures) {
    const auto names = drawing::names_in(*figure);
    known.insert(known.end(), names.begin(), names.end());
    found = drawing::rename(*figure, name, text.substr(at + 1)) || found;
  }
  if (!found)
    throw InputError({"--name"},
                     "the picture has no name '" + name + "'" + suggestion(name, known));
}

}  // namespace

std::vector<Option> presentation_options(Presentation& presentation, bool runs) {
  std::vector<Option> options;
  options.push_back(Option("--title", presentation.title, "the title of the picture"));
  options.push_back(Option("--size", presentation.size,
                           "its width and height, such as 600x400 (usual width: 900)")
                        .named("WIDTHxHEIGHT"));
  options.push_back(Option("--window", presentation.window,
                           "this part of the time, or of the frequency, such as 0:5")
                        .named("FROM:TO"));
  options.push_back(Option("--name", presentation.names,
                           "NAME=TEXT: another name for a curve or a panel, such as x1=position; "
                           "may be repeated"));
  if (runs)
    options.push_back(Option("--jump-width", presentation.jump_width,
                             "draw over the hybrid time t + W*j: each jump j takes W of the axis")
                          .named("W"));
  return options;
}

void present(const Presentation& presentation, const std::vector<drawing::Figure*>& figures) {
  if (!presentation.window.empty()) set_window(presentation.window, figures);
  if (!presentation.jump_width.empty()) set_jump_width(presentation.jump_width, figures);
  for (const std::string& name : presentation.names) set_name(name, figures);
  if (!presentation.size.empty()) set_size(presentation.size, figures);
  if (!presentation.title.empty())
    for (drawing::Figure* figure : figures) figure->title = presentation.title;
}

}  // namespace gainsmith::app
