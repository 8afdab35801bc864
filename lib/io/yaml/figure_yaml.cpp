// Figures of runs. With the error e of an estimate and its covariance P or, of innovations r, S:
//   nees = e' inv(P) e   at a moment,    nis = r' inv(S) r   at all samples of an event         (1)
// (Bar-Shalom, Li, Kirubarajan 2001). Both become ordinary expressions of the language here.
#include "io/yaml/figure_yaml.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/nearest.h"
#include "expr/text/parser.h"
#include "io/yaml/expectation_yaml.h"

namespace gainsmith::io {

namespace {

using model::FigureKind;
using model::FigureText;

constexpr const char* kForms =
    "a figure is one of {at: {event: ..., count: ..., side: before}, value: v}, {at: {t: ...}, "
    "value: v}, {peak: v}, {least: v}, {settles: v, below: b}, {rms: v, over: [a, b]}, {integral: "
    "v, "
    "over: [a, b]}, {nees: e, covariance: P, at: {t: ...}}, {nis: r, covariance: S, at: {event: "
    "...}}, {count: event}, {passes: event}, {lost: event}, {ended: why}";

/// What is said of `ended` where several observers are compared.
constexpr const char* kOfRun = "it belongs in expect.run alone: all observers end with the run";

/// "at: {event: leave, count: 1, side: before}" or "at: {t: 10}".
void read_moment(const YamlFile& file, const YamlItem& item, FigureText& figure) {
  YamlMap map(file, item.value, "at", keys::moment);
  const auto event = map.find("event");
  const auto t = map.find("t");
  const auto count = map.find("count");
  const auto side = map.find("side");
  map.finish();
  if (event.has_value() == t.has_value() || (t && (count || side)))
    throw InputError(item.place, "at: expected {event: ..., count: 1, side: before} or {t: ...}");
  if (t) {
    figure.kind = FigureKind::at_time;
    figure.numbers = {file.expression(t->value, "t")};
    figure.title = "at t = " + figure.numbers.front().text->str();
    return;
  }
  figure.kind = FigureKind::at_event;
  figure.event = file.string(event->value, "event");
  if (count) {
    const double number = file.number(count->value, "count");
    figure.count = static_cast<std::int64_t>(number);
    if (!(number >= 1 && number <= 1e15 && number == static_cast<double>(figure.count)))
      throw InputError(file.place(count->value), "count: a whole number, 1 or more");
  }
  if (side) {
    const std::string word = file.string(side->value, "side");
    if (word != "before" && word != "after")
      throw InputError(file.place(side->value), "side: before or after");
    figure.after = word == "after";
  }
  figure.title = std::string(figure.after ? "after " : "before ") + figure.event + " " +
                 std::to_string(figure.count);
}

/// "nees" with the covariance and a moment, "nis" with an event. The number is e'*inv(P)*e.
void read_squares(const YamlFile& file, const YamlMap& map, const YamlItem& item,
                  const std::optional<YamlItem>& covariance, const std::optional<YamlItem>& at,
                  FigureText& figure) {
  if (!at || !covariance) throw InputError(map.place(), kForms);
  read_moment(file, *at, figure);
  const bool of_samples = item.key == "nis";
  if (of_samples) {
    YamlMap moment(file, at->value, "at", keys::moment);
    if (figure.kind != FigureKind::at_event || moment.find("count") || moment.find("side"))
      throw InputError(at->place, "nis: it is of all samples, 'at: {event: ...}'");
    figure.kind = FigureKind::nis;
    figure.title = "at " + figure.event;
  }
  figure.error = file.expression(item.value, item.key);
  const std::string e = figure.error->text->str();
  const std::string P = file.expression(covariance->value, covariance->key).text->str();
  figure.value = expr::parse(expr::Text::generated("(" + e + ")'*inv(" + P + ")*(" + e + ")",
                                                   figure.error->place(*figure.error->root)));
  figure.title = item.key + " " + e + " " + figure.title;
}

/// The figure of a mapping. `ending`: where its word goes, of a mapping of `expect`, which takes
/// other keys besides; null for others.
FigureText figure(const YamlFile& file, YamlMap& map, std::string* ending) {
  static const std::array<std::pair<const char*, FigureKind>, 8> kOfValues = {
      {{"peak", FigureKind::peak},
       {"least", FigureKind::least},
       {"settles", FigureKind::settles},
       {"rms", FigureKind::rms},
       {"integral", FigureKind::integral},
       {"count", FigureKind::count},
       {"passes", FigureKind::passes},
       {"lost", FigureKind::lost}}};
  FigureText result;
  result.place = map.place();
  int found = 0;
  if (const auto observer = map.find("observer"))
    result.observer = file.string(observer->value, "observer");
  const auto value = map.find("value");
  const auto below = map.find("below");
  const auto over = map.find("over");
  const auto at = map.find("at");
  const auto nees = map.find("nees"), nis = map.find("nis"), covariance = map.find("covariance");
  if (nees || nis) {
    found += (nees ? 1 : 0) + (nis ? 1 : 0) + (value ? 1 : 0);
    read_squares(file, map, nees ? *nees : *nis, covariance, at, result);
  } else if (at) {
    ++found;
    read_moment(file, *at, result);
    if (!value) throw InputError(at->place, "at: with the wanted value, 'value: ...'");
    result.value = file.expression(value->value, "value");
    result.title = result.value->text->str() + " " + result.title;
  }
  for (const auto& [key, kind] : kOfValues)
    if (const auto item = map.find(key)) {
      ++found;
      result.kind = kind;
      if (model::is_whole(kind))
        result.event = file.string(item->value, key);
      else
        result.value = file.expression(item->value, key);
      result.title = std::string(key) + " " + (result.value ? result.value->text->str() : result.event);
    }
  const auto ended = ending == nullptr ? std::nullopt : map.find("ended");
  if (ended) {
    ++found;
    result.kind = FigureKind::ended;
    result.title = "ended";
    *ending = file.string(ended->value, "ended");
    const std::vector<std::string> known = {"horizon", "escaped", "undefined",   "left",
                                            "stuck",   "zeno",    "chattering",  "sliding",
                                            "passes",  "full",    "interrupted", "lost"};
    if (std::find(known.begin(), known.end(), *ending) == known.end())
      throw InputError(file.place(ended->value),
                       "ended: unknown word '" + *ending + "'" + suggestion(*ending, known));
  }
  if (ending == nullptr) map.finish({{"ended", kOfRun}});
  // No kind was found: a misspelt key is named before all forms are listed.
  if (found == 0 && ending != nullptr) {
    for (const char* key : {"is", "relative", "absolute"}) map.find(key);
    map.finish();  // names what was misspelt
  }
  if (found != 1 || (covariance && !nees && !nis)) throw InputError(map.place(), kForms);
  if (below && ending != nullptr && result.kind != FigureKind::settles)
    throw InputError(below->place,
                     "below: 'below' alone is the level of 'settles'; what a figure is at "
                     "most is written is: {below: limit}");
  if (result.kind == FigureKind::settles && !below)
    throw InputError(map.place(), "settles: expected the level too, {settles: v, below: b}");
  if ((result.kind == FigureKind::settles) != below.has_value() ||
      (result.kind == FigureKind::rms || result.kind == FigureKind::integral) != over.has_value())
    throw InputError(map.place(), kForms);
  if (below) {
    result.numbers = {file.expression(below->value, "below")};
    result.title += " below " + result.numbers.front().text->str();
  }
  if (!over) return result;
  if (!over->value.IsSequence() || over->value.size() != 2)
    throw InputError(over->place, "over: expected [from, to]");
  for (const auto& end : over->value) result.numbers.push_back(file.expression(end, "over"));
  result.title +=
      " over [" + result.numbers[0].text->str() + ", " + result.numbers[1].text->str() + "]";
  return result;
}

/// {below: at most this, above: at least this}
void set_limits(const YamlFile& file, const YamlItem& is, model::ExpectedFigureText& result) {
  YamlMap map(file, is.value, "is", keys::limits);
  const auto limit = [&](const char* key) {
    const auto found = map.find(key);
    return found ? std::optional(file.expression(found->value, key)) : std::nullopt;
  };
  result.below = limit("below");
  result.above = limit("above");
  map.finish();
  if (!result.below && !result.above)
    throw InputError(is.place, "is: expected a value, or {below: limit, above: limit}");
}

/// A figure with the value or the limits that it is expected to have.
model::ExpectedFigureText expected(const YamlFile& file, const YAML::Node& node) {
  YamlMap map(file, node, "run", keys::expected_figure);
  model::ExpectedFigureText result;
  result.figure = figure(file, map, &result.ending);
  const auto is = map.find("is");
  result.relative = tolerance(file, map.find("relative"));
  result.absolute = tolerance(file, map.find("absolute"));
  map.finish();
  const FigureKind kind = result.figure.kind;
  const bool bounded = result.relative || result.absolute;
  if (kind == FigureKind::ended && (is || bounded))
    throw InputError(map.place(), "ended: says how the run ends; it has no 'is' and no tolerance");
  if (kind != FigureKind::ended && !is)
    throw InputError(map.place(), "expected 'is: value', or 'is: {below: limit}'");
  if (is && is->value.IsMap()) {
    set_limits(file, *is, result);
    if (bounded) throw InputError(is->place, "is: a tolerance is of a value; limits have none");
    return result;
  }
  const bool is_whole = kind == FigureKind::count || kind == FigureKind::passes;
  if (is && !bounded && !is_whole)
    throw InputError(is->place, "expected a tolerance, 'relative' or 'absolute'");
  if (is) result.is = file.expression(is->value, "is");
  return result;
}

/// The list of a key. InputError, with all forms of figures, for anything else.
const YAML::Node& list_of(const YamlItem& item) {
  if (!item.value.IsSequence())
    throw InputError(item.place, item.key + ": expected a list of figures; " + kForms);
  return item.value;
}

}  // namespace

std::vector<FigureText> figures(const YamlFile& file, const YamlItem& item) {
  std::vector<FigureText> result;
  for (const auto& entry : list_of(item)) {
    YamlMap map(file, entry, item.key, keys::figure);
    result.push_back(figure(file, map, nullptr));
  }
  return result;
}

FigureText figure_of(const YamlFile& file, const YamlItem& item) {
  YamlMap map(file, item.value, item.key, keys::figure);
  return figure(file, map, nullptr);
}

std::vector<model::ExpectedFigureText> expected_figures(const YamlFile& file,
                                                        const YamlItem& item) {
  std::vector<model::ExpectedFigureText> result;
  for (const auto& entry : list_of(item)) result.push_back(expected(file, entry));
  return result;
}

}  // namespace gainsmith::io
