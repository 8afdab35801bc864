// A method from its sections: declarations, definitions, inequalities, gains, dynamics, claims.
// Names that occur twice are found at the end (model::check_names).
#include "io/yaml/method_yaml.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/nearest.h"
#include "io/yaml/blocks_yaml.h"
#include "io/yaml/claim_yaml.h"
#include "io/yaml/declaration_yaml.h"
#include "io/yaml/dynamics_yaml.h"
#include "io/yaml/method_node.h"
#include "io/yaml/search_yaml.h"
#include "model/names.h"

namespace gainsmith::io {

namespace {

/// "4" or "[2, 4]".
void read_degree(const YamlFile& file, const YamlItem& item, model::UnknownDeclaration& out) {
  if (!item.value.IsSequence()) {
    out.degree = file.expression(item.value, item.key);
    return;
  }
  if (item.value.size() != 2 || out.arguments.empty())
    throw InputError(file.place(item.value),
                     "degree: expected a whole number or, of a polynomial in the columns that 'of' "
                     "names, [least, largest] degree of its terms");
  out.least = file.expression(item.value[0], item.key);
  out.degree = file.expression(item.value[1], item.key);
}

/// "Y: n x p", "Y: {shape: n x p, help: ...}", "Y: {shape: n x p, of: tau, degree: 2}" or
/// "V: {shape: scalar, of: {x: 3}, degree: [2, 4]}".
model::UnknownDeclaration unknown(const YamlFile& file, const YamlItem& item) {
  model::UnknownDeclaration result;
  result.name = item.key;
  result.place = item.place;
  if (item.value.IsScalar()) {
    result.shape = model::parse_shape(file.scalar(item.value, item.key));
    return result;
  }
  YamlMap map(file, item.value, item.key, keys::unknown);
  result.shape = model::parse_shape(file.scalar(map.require("shape").value, "shape"));
  result.help = optional_string(file, map.find("help"));
  const auto of = map.find("of");
  if (of && of->value.IsMap())
    result.arguments = arguments_of(file, *of);
  else
    result.variable = optional_string(file, of);
  result.indices = indices(file, map.find("for"));
  const auto degree = map.find("degree");
  const auto in = map.find("in");
  map.finish();
  if (in && result.variable.empty())
    throw InputError(in->place,
                     "in: only of an unknown that is a function; say of which variable by 'of'");
  if (in) result.in = scalar_range(file, {"in", in->key_text, in->place, in->value});
  if (degree && result.variable.empty() && result.arguments.empty())
    throw InputError(degree->place,
                     "degree: only of an unknown that is a function; say of which "
                     "variable by 'of'");
  if (!degree && !result.arguments.empty())
    throw InputError(of->place, "a polynomial needs its degree, such as degree: [2, 4]");
  if (degree) read_degree(file, *degree, result);
  return result;
}

/// The entries of a mapping of declarations; `fallback` as of declaration().
std::vector<model::Declaration> declarations(const YamlFile& file,
                                             const std::optional<YamlItem>& item,
                                             const std::string& what, const char* fallback) {
  std::vector<model::Declaration> result;
  for (const YamlItem& entry : items_of(file, item, what))
    result.push_back(declaration(file, entry, fallback));
  return result;
}

/// "delta: 0.03", "delta: {default: 0.03, search: [1e-3, 10], help: ...}" or "delta:" (no default).
model::Parameter parameter(const YamlFile& file, const YamlItem& item) {
  model::Parameter result{item.key, std::nullopt, "", item.place};
  if (item.value.IsNull()) return result;
  if (!item.value.IsMap()) {
    result.fallback = file.expression(item.value, item.key);
    return result;
  }
  YamlMap map(file, item.value, item.key, keys::parameter);
  result.fallback = optional_expression(file, map.find("default"));
  result.help = optional_string(file, map.find("help"));
  if (const auto search = map.find("search"))
    result.search = scalar_range(file, {item.key, item.key_text, search->place, search->value});
  map.finish();
  return result;
}

/// Expressions with names.
std::vector<model::Named> named(const YamlFile& file, const std::optional<YamlItem>& item,
                                const std::string& what) {
  std::vector<model::Named> result;
  for (const YamlItem& entry : items_of(file, item, what))
    result.push_back({entry.key, file.expression(entry.value, entry.key), entry.place});
  return result;
}

/// "L: inv(P)*Y", "F(tau): inv(P)*Z(tau)" or "L(i in 1..N): inv(P(i))*Y(i)".
model::Gain gain(const YamlFile& file, const YamlItem& item) {
  const expr::Signature signature = expr::parse_signature(item.key_text);
  if (signature.parameters.size() > 1)
    throw InputError(item.place, "a gain is a matrix or a function of one variable");
  return {signature.name, file.expression(item.value, item.key), item.place,
          signature.parameters.empty() ? "" : signature.parameters.front(), signature.indices};
}

/// An index, a condition between indices, or a variable.
void add_forall(const expr::Text& text, model::Requirement& result) {
  const std::string& source = text.str();
  const bool ranges = source.find(" in ") != std::string::npos;
  if (ranges && source.find("..") != std::string::npos)
    result.indices.push_back(expr::parse_index(text));
  else if (!ranges && source.find_first_of("<>=!") != std::string::npos)
    result.conditions.push_back(expr::parse(text));
  else
    result.forall.push_back(parse_forall(text));
}

/// "by: sos", "where: ...", "degree: 4" or "degree: +2".
void read_sum_of_squares(const YamlFile& file, YamlMap& map, model::Requirement& result) {
  if (const auto by = map.find("by")) {
    const std::string way = file.string(by->value, "by");
    if (way != "sos")
      throw InputError(file.place(by->value),
                       "by: expected sos; synthesis.forall chooses among the other ways");
    result.sos = true;
  }
  if (const auto where = map.find("where"))
    for (const expr::Text& text : texts_of(file, *where)) result.where.push_back(expr::parse(text));
  const auto degree = map.find("degree");
  if (!degree) return;
  const std::string text = file.string(degree->value, "degree");
  // Of a degree: more than 99 is a mistake.
  constexpr std::size_t kDigits = 2;
  result.adds_degree = text.starts_with('+');
  const std::string digits = text.substr(result.adds_degree ? 1 : 0);
  const bool is_whole = !digits.empty() && digits.size() <= kDigits &&
                        digits.find_first_not_of("0123456789") == std::string::npos;
  if (!is_whole)
    throw InputError(file.place(degree->value),
                     "degree: expected a whole number, such as 4 or +2, not '" + text + "'");
  result.degree = std::stoi(digits);
}

/// "P > 0", or {that: ..., forall: [...]}, or blocks by the names of their rows (blocks_yaml.h).
model::Requirement requirement(const YamlFile& file, const YamlItem& item) {
  model::Requirement result;
  result.name = item.key;
  result.place = item.place;
  if (!item.value.IsMap()) {
    result.that = file.expression(item.value, item.key);
    return result;
  }
  YamlMap map(file, item.value, item.key, keys::requirement);
  const auto blocks = map.find("blocks");
  const auto is = map.find("is");
  if (blocks && is)
    result.that = named_blocks(file, *blocks, *is);
  else if (blocks || is)
    throw InputError(blocks ? blocks->place : is->place,
                     "blocks filled by name need both, blocks: {...} and is: < 0");
  const auto that = blocks ? map.find("that") : std::optional(map.require("that"));
  if (blocks && that) throw InputError(that->place, "either 'that' or 'blocks', not both");
  if (!blocks) result.that = file.expression(that->value, "that");
  if (const auto forall = map.find("forall"))
    for (const expr::Text& text : texts_of(file, *forall)) add_forall(text, result);
  read_sum_of_squares(file, map, result);
  map.finish();
  if (!result.conditions.empty() && result.indices.empty())
    throw InputError(result.conditions.front().place(*result.conditions.front().root),
                     "a condition chooses among indices, such as i in 1..N: there are none here");
  return result;
}

/// One of the tasks by which methods are listed.
std::string task_of(const YamlFile& file, const YamlItem& item) {
  std::string task = file.string(item.value, "task");
  const std::vector<std::string>& known = model::tasks();
  if (std::find(known.begin(), known.end(), task) == known.end())
    throw InputError(file.place(item.value),
                     "unknown task '" + task + "'" + suggestion(task, known));
  return task;
}

/// Why there is no campaign: for methods in which nothing moves.
void read_no_campaign(const YamlFile& file, const YamlItem& item, model::Method& method) {
  method.no_campaign = reason(file, item);
  const bool moves = method.has_dynamics || !method.claims.empty();
  if (moves)
    throw InputError(item.place,
                     "no campaign: the method has dynamics or claims; the reason is given where "
                     "nothing moves. A problem may have one of its own");
}

}  // namespace

std::string reason(const YamlFile& file, const YamlItem& item) {
  std::string text = file.string(item.value, item.key);
  if (text.empty()) throw InputError(item.place, item.key + ": expected the reason, as a text");
  return text;
}

/// Behind the last character a comma is read, which ends the last part.
std::vector<expr::Expression> parse_list(const expr::Text& text) {
  std::vector<expr::Expression> parts;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t at = 0; at <= text.str().size(); ++at) {
    const char c = at < text.str().size() ? text.str()[at] : ',';
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (c != ',' || (depth != 0 && at < text.str().size())) continue;
    parts.push_back(expr::parse(text.part(begin, at)));
    begin = at + 1;
  }
  return parts;
}

namespace {

/// Where the n of "R^n" begins; 0 of "R"; none of other texts.
std::optional<std::size_t> power_of_reals(const std::string& text) {
  if (text == "R") return 0;
  if (!text.starts_with('R')) return std::nullopt;
  const std::size_t sign = text.find_first_not_of(' ', 1);
  if (sign == std::string::npos || text[sign] != '^') return std::nullopt;
  return sign + 1;
}

}  // namespace

/// By the first character behind " in ": R, a bracket, a brace, conv or a name.
model::Forall parse_forall(const expr::Text& text) {
  using model::Over;
  const std::string& source = text.str();
  const auto fail = [&](std::size_t at) {
    throw InputError(
        text.place(at),
        "expected 'NAME in [low, high]', 'NAME in R^n', 'NAME in {a, b, ...}', 'NAME in VECTOR', "
        "'NAME in conv{A, B, ...}', or an index 'NAME in 1..N'");
  };
  const std::size_t in = source.find(" in ");
  if (in == std::string::npos) fail(0);
  const expr::Signature signature = expr::parse_signature(text.part(0, in));
  constexpr std::string_view kHull = "conv";
  std::size_t open = source.find_first_not_of(' ', in + 4);
  const std::size_t close = source.find_last_not_of(' ');
  const bool hull = open != std::string::npos && source.compare(open, kHull.size(), kHull) == 0;
  if (hull) open = source.find_first_not_of(' ', open + kHull.size());
  if (!signature.parameters.empty()) fail(0);
  if (open == std::string::npos || close < open) fail(in);
  if (const auto power = power_of_reals(source.substr(open, close + 1 - open))) {
    model::Forall forall{signature.name, Over::reals, {}, text.place(0)};
    if (*power > 0) forall.points = {expr::parse(text.part(open + *power, close + 1))};
    return forall;
  }
  const bool interval = !hull && source[open] == '[' && source[close] == ']';
  const bool set = source[open] == '{' && source[close] == '}';
  const bool name = std::isalpha(static_cast<unsigned char>(source[open])) != 0;
  if (!hull && name)
    return {signature.name,
            Over::set,
            {expr::parse(text.part(open, source.size()))},
            text.place(0),
            true};
  if (!interval && !set) fail(open);
  const Over over = interval ? Over::interval : hull ? Over::polytope : Over::set;
  model::Forall forall{signature.name, over, parse_list(text.part(open + 1, close)), text.place(0)};
  if (interval && forall.points.size() != 2) fail(open);
  return forall;
}

constexpr const char* kOfProblem = "it belongs to the problem, beside 'method'";

model::Method method_from(const YamlFile& file, const YAML::Node& node, const std::string& problem,
                          bool may_state_nothing) {
  YamlMap map(file, node, "method", keys::method);
  model::Method method;
  method.file = file.file(node);
  const auto name =
      problem.empty() ? std::optional<YamlItem>(map.require("method")) : map.find("method");
  method.name = name ? file.string(name->value, "method", "") : problem;
  method.source = optional_string(file, map.find("source"));
  method.summary = optional_string(file, map.find("summary"));
  if (const auto task = map.find("task")) method.task = task_of(file, *task);
  method.example = optional_string(file, map.find("example"));
  method.data = declarations(file, map.find("data"), "data", "default");
  for (const YamlItem& item : items_of(file, map.find("parameters"), "parameters"))
    method.parameters.push_back(parameter(file, item));
  method.assume = named(file, map.find("assume"), "assume");
  for (const YamlItem& item : items_of(file, map.find("unknowns"), "unknowns"))
    method.unknowns.push_back(unknown(file, item));
  for (const YamlItem& item : items_of(file, map.find("let"), "let"))
    method.let.push_back(
        {expr::parse_signature(item.key_text), file.expression(item.value, item.key), item.place});
  for (const YamlItem& item : items_of(file, map.find("require"), "require"))
    method.require.push_back(requirement(file, item));
  for (const YamlItem& item : items_of(file, map.find("necessary"), "necessary"))
    method.necessary.push_back(requirement(file, item));
  for (const model::Requirement& requirement : method.necessary)
    for (const model::Requirement& other : method.require)
      if (requirement.name == other.name)
        throw InputError(requirement.place,
                         "'" + requirement.name + "' is under 'require' already");
  method.minimize = optional_expression(file, map.find("minimize"));
  for (const YamlItem& item : items_of(file, map.find("gains"), "gains"))
    method.gains.push_back(gain(file, item));
  method.report = named(file, map.find("report"), "report");
  read_dynamics(file, map, method);
  method.signals = named(file, map.find("signals"), "signals");
  for (const YamlItem& item : items_of(file, map.find("claims"), "claims"))
    method.claims.push_back(claim(file, item));
  if (const auto reason = map.find("no campaign")) read_no_campaign(file, *reason, method);
  // Words of other programs get the key that is meant.
  map.finish({{"maximize", "write minimize: -(...)"},
              {"maximise", "write minimize: -(...)"},
              {"objective", "write minimize: ..."},
              {"cost", "write minimize: ..."},
              {"variables", "write unknowns: {P: symmetric n, ...}"},
              {"decision variables", "write unknowns: {P: symmetric n, ...}"},
              {"constraints", "write require: {name: inequality, ...}"},
              {"inequalities", "write require: {name: inequality, ...}"},
              {"lmis", "write require: {name: inequality, ...}"},
              {"subject to", "write require: {name: inequality, ...}"},
              {"campaign", kOfProblem},
              {"compare", kOfProblem},
              {"expect", kOfProblem},
              {"figures", kOfProblem},
              {"negotiable", kOfProblem},
              {"search", kOfProblem},
              {"synthesis", kOfProblem}});
  if (!may_state_nothing && method.require.empty() && !method.minimize && !method.has_dynamics &&
      method.report.empty())
    throw InputError(map.place(), "the method '" + method.name +
                                      "' has no inequality under 'require' and no dynamics");
  model::check_names(method);
  return method;
}

model::Method parse_method(const std::string& text, const std::string& file) {
  const YamlFile yaml(text, file);
  model::Method method = method_from(yaml, yaml.root(), "");
  method.text = text;
  return method;
}

}  // namespace gainsmith::io
