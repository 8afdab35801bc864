// A problem from its sections, in an order in which later ones may ask earlier ones: the method
// first, then data, choices, search, campaign, and settings from outside last.
#include "io/yaml/problem_yaml.h"

#include <map>
#include <memory>

#include "base/nearest.h"
#include "base/number.h"
#include "expr/text/work.h"
#include "io/setting.h"
#include "io/sources.h"
#include "io/yaml/component_yaml.h"
#include "io/yaml/data_file_yaml.h"
#include "io/yaml/expectation_yaml.h"
#include "io/yaml/figure_yaml.h"
#include "io/yaml/method_node.h"
#include "io/yaml/method_yaml.h"
#include "io/yaml/scalar_data.h"
#include "io/yaml/search_yaml.h"
#include "io/yaml/synthesis_yaml.h"
#include "io/yaml/system_figure_yaml.h"
#include "io/yaml/variant_yaml.h"

namespace gainsmith::io {

namespace {

/// The method in the problem itself, or the one of the library that it names.
std::shared_ptr<const model::Method> method_of(const YamlFile& file, const YamlItem& item,
                                               const std::string& problem,
                                               const MethodLibrary& library, bool has_figures) {
  if (item.value.IsMap())
    return std::make_shared<model::Method>(method_from(file, item.value, problem, has_figures));
  const std::string name = file.string(item.value, "method");
  const auto text = library.text(name);
  if (!text) throw InputError(file.place(item.value), unknown_method(name, library.names));
  return std::make_shared<model::Method>(parse_method(*text, model::method_file(name)));
}

/// With the place of the key instead of that of the value.
void add(model::Value value, const YamlItem& item, std::vector<model::Value>& values) {
  value.place = item.place;
  values.push_back(std::move(value));
}

model::Let definition(const YamlFile& file, const YamlItem& item) {
  return {expr::parse_signature(item.key_text), file.expression(item.value, item.key), item.place};
}

/// InputError for "A(1,2): ...", where A is no function. "A(x): ..." is one, at the wrong place.
void refuse_element(const YamlItem& entry, const model::Method& method) {
  const std::size_t bracket = entry.key.find('(');
  const std::string name = entry.key.substr(0, bracket);
  const std::size_t first = entry.key.find_first_not_of(' ', bracket + 1);
  const bool is_index =
      first != std::string::npos &&
      (entry.key[first] == ':' || (entry.key[first] >= '0' && entry.key[first] <= '9'));
  if (!is_index) return;
  for (const model::Declaration& datum : method.data)
    if (datum.name == name && datum.arguments.empty())
      throw InputError(entry.place, "a datum is given as a whole, not by its elements: '" + name +
                                        ": VALUE', of a matrix as in 'A: \"[0, 1; -1, 0]\"'");
}

/// "A: ..." is a matrix, "f(x): ..." a function.
void read_data(const YamlFile& file, const std::optional<YamlItem>& item, model::Problem& problem) {
  for (const YamlItem& entry : items_of(file, item, "data")) {
    if (entry.key.find('(') != std::string::npos) {
      refuse_element(entry, *problem.method);
      problem.functions.push_back(definition(file, entry));
    } else {
      add(datum_of(file, entry), entry, problem.data);
    }
  }
}

/// How the times between events are drawn: "uniform", {constant: T} or {list: [T1, T2]}.
model::SamplingLaw law(const YamlFile& file, const YAML::Node& node) {
  using Kind = model::LawKind;
  static const std::vector<std::string> kWords = {"uniform",  "extremes", "sinusoid",
                                                  "constant", "list",     "golden"};
  model::SamplingLaw result;
  result.place = file.place(node);
  if (node.IsScalar()) {
    const std::string& word = node.Scalar();
    if (word == "uniform") return {Kind::uniform, {}, result.place};
    if (word == "extremes") return {Kind::extremes, {}, result.place};
    if (word == "sinusoid") return {Kind::sinusoid, {}, result.place};
    if (word == "golden") return {Kind::golden, {}, result.place};
    if (word == "constant" || word == "list")
      throw InputError(result.place,
                       "sampling: '" + word + "' needs its value: {" + word + ": ...}");
    throw InputError(result.place,
                     "sampling: unknown law '" + word + "'" + suggestion(word, kWords));
  }
  YamlMap map(file, node, "sampling", keys::law);
  const auto constant = map.find("constant");
  const auto list = map.find("list");
  map.finish();
  if (constant.has_value() == list.has_value())
    throw InputError(result.place, "sampling: expected {constant: value} or {list: [values]}");
  if (constant) {
    result.kind = Kind::constant;
    result.values.push_back(file.expression(constant->value, "constant"));
    return result;
  }
  result.kind = Kind::list;
  if (!list->value.IsSequence() || list->value.size() == 0)
    throw InputError(file.place(list->value), "list: expected a list of intervals");
  for (const auto& entry : list->value) result.values.push_back(file.expression(entry, "list"));
  return result;
}

/// "{center: [1, 0], matrix: P, level: 2}": center, matrix, level.
std::vector<model::Value> ellipsoid_of(const YamlFile& file, const YamlItem& item) {
  YamlMap map(file, item.value, "ellipsoid", keys::ellipsoid);
  const auto center = map.find("center");
  const auto level = map.find("level");
  const YamlItem matrix = map.require("matrix");
  map.finish();
  const auto value = [&](const std::optional<YamlItem>& given, const char* otherwise) {
    if (given) return value_of(file, *given);
    const expr::Text text = expr::Text::generated(otherwise, item.place);
    return model::Value{item.key, expr::parse(text), false, item.place};
  };
  return {value(center, "0"), value_of(file, matrix), value(level, "1")};
}

/// Where a state starts: a value, or what it is drawn from.
model::InitialValue initial(const YamlFile& file, const YamlItem& item) {
  using Kind = model::StartKind;
  model::InitialValue result{item.key, Kind::expression, {}, item.place};
  if (!item.value.IsMap() || names_file(item.value)) {
    result.values.push_back(value_of(file, item));
    return result;
  }
  YamlMap map(file, item.value, item.key, keys::start);
  const auto box = map.find("box");
  const auto list = map.find("list");
  const auto ellipsoid = map.find("ellipsoid");
  auto around = spread(file, map, "0", "1");
  map.finish();
  if (box.has_value() + list.has_value() + ellipsoid.has_value() + around.has_value() != 1)
    throw InputError(item.place, item.key +
                                     ": expected a value, {box: [low, high]}, {list: [values]}, "
                                     "{ellipsoid: {center: ..., matrix: ...}}, {normal: deviation} "
                                     "or {lognormal: deviation}");
  if (around)
    return {item.key, around->is_normal ? Kind::normal : Kind::lognormal, std::move(around->values),
            item.place, around->covariance};
  if (ellipsoid) {
    result.kind = Kind::ellipsoid;
    result.values = ellipsoid_of(file, *ellipsoid);
    return result;
  }
  result.kind = box ? Kind::box : Kind::list;
  const YamlItem& source = box ? *box : *list;
  if (!source.value.IsSequence() || source.value.size() == 0 || (box && source.value.size() != 2))
    throw InputError(file.place(source.value),
                     box ? "box: expected [low, high]" : "list: expected a list of values");
  for (const auto& entry : source.value)
    result.values.push_back(value_of(file, {item.key, item.key_text, file.place(entry), entry}));
  return result;
}

/// A law, a list of laws, or those of each event: {sample: [uniform, extremes], tick: golden}.
void read_sampling(const YamlFile& file, const YAML::Node& node, const std::string& event,
                   const model::Method& method, model::Campaign& result) {
  // A mapping without the keys of a law has events as keys.
  const bool by_event = event.empty() && node.IsMap() && !node["constant"] && !node["list"];
  if (by_event) {
    const YamlMap map(file, node, "sampling");
    for (const YamlItem& item : map.items())
      read_sampling(file, item.value, item.key, method, result);
    return;
  }
  const auto add = [&](const YAML::Node& entry) {
    result.sampling.push_back(law(file, entry));
    result.sampling.back().event = event;
  };
  if (!node.IsSequence()) return add(node);
  if (node.size() == 0) throw InputError(file.place(node), "sampling: expected a law at least");
  for (const auto& entry : node) add(entry);
}

/// A number of [least, most].
double tolerance(const YamlFile& file, const YamlItem& item, double least, double most) {
  const double value = file.number(item.value, item.key);
  if (value >= least && value <= most) return value;
  throw InputError(file.place(item.value), item.key + ": expected a number from " + brief(least) +
                                               " to " + brief(most) + ", found " + brief(value));
}

/// {relative: 1e-8, absolute: 1e-10}, or {absolute: {x: 1e-6, nominal.S: 1e-9}}.
model::RunAccuracy accuracy(const YamlFile& file, const YamlItem& item) {
  constexpr double kLeastRelative = 1e-12;
  constexpr double kMostRelative = 1e-2;
  constexpr double kLeastAbsolute = 1e-100;
  constexpr double kMostAbsolute = 1e100;
  model::RunAccuracy result;
  result.place = item.place;
  YamlMap map(file, item.value, "accuracy", keys::accuracy);
  if (const auto relative = map.find("relative"))
    result.relative = tolerance(file, *relative, kLeastRelative, kMostRelative);
  if (const auto absolute = map.find("absolute")) {
    if (absolute->value.IsMap()) {
      for (const YamlItem& entry : items_of(file, absolute, "absolute"))
        result.states.push_back(
            {entry.key, tolerance(file, entry, kLeastAbsolute, kMostAbsolute), entry.place});
    } else {
      result.absolute = tolerance(file, *absolute, kLeastAbsolute, kMostAbsolute);
    }
  }
  map.finish();
  return result;
}

/// `campaign:`; an absent one is that with the defaults.
model::Campaign campaign(const YamlFile& file, const std::optional<YamlItem>& item,
                         const model::Method& method) {
  model::Campaign result;
  if (!item) return result;
  YamlMap map(file, item->value, "campaign", keys::campaign);
  result.place = item->place;
  if (const auto runs = map.find("runs")) result.runs = whole(file, *runs, 1);
  if (const auto seed = map.find("seed")) result.seed = whole(file, *seed, 0);
  if (const auto horizon = map.find("horizon"))
    result.horizon = file.expression(horizon->value, "horizon");
  if (const auto item_of = map.find("accuracy")) result.accuracy = accuracy(file, *item_of);
  if (const auto first = map.find("first")) result.first = file.expression(first->value, "first");
  if (const auto sampling = map.find("sampling"))
    read_sampling(file, sampling->value, "", method, result);
  for (const YamlItem& entry : items_of(file, map.find("initial"), "initial"))
    result.initial.push_back(initial(file, entry));
  map.finish();
  return result;
}

/// "cf: {box: [0.08, 0.12]}", "cf: {box: [0.08, 0.12], sampling: vertices}", "A: {vertices: [A1,
/// A2]}", or of a family "A: {vertices: As}".
model::UncertainText uncertain(const YamlFile& file, const YamlItem& item) {
  const std::string forms =
      item.key +
      ": expected {box: [low, high]}, {vertices: [values]}, {normal: deviation} or "
      "{lognormal: deviation}";
  if (!item.value.IsMap()) throw InputError(file.place(item.value), forms);
  YamlMap map(file, item.value, item.key, keys::uncertain);
  const auto box = map.find("box");
  const auto vertices = map.find("vertices");
  const auto sampling = map.find("sampling");
  auto around = spread(file, map, item.key, item.key);
  map.finish();
  if (box.has_value() + vertices.has_value() + around.has_value() != 1)
    throw InputError(item.place, forms);
  using Kind = model::Dynamics::NoiseKind;
  model::UncertainText result;
  result.name = item.key;
  result.place = item.place;
  const auto value = [&](const YAML::Node& node) {
    return value_of(file, {item.key, item.key_text, file.place(node), node});
  };
  if (box && (!box->value.IsSequence() || box->value.size() != 2))
    throw InputError(box->place, "box: expected [low, high]");
  if (box)
    for (const auto& end : box->value) result.values.push_back(value(end));
  if (sampling) {
    const std::string word = file.string(sampling->value, "sampling");
    const Place place = file.place(sampling->value);
    if (!box) throw InputError(place, "sampling: of a box");
    if (word != "uniform" && word != "vertices")
      throw InputError(place, "sampling: unknown word '" + word + "'" +
                                  suggestion(word, {"uniform", "vertices"}));
    if (word == "vertices") result.kind = Kind::corners;
  }
  if (around) {
    result.kind = around->is_normal ? Kind::normal : Kind::lognormal;
    result.values = std::move(around->values);
    result.covariance = around->covariance;
  }
  if (!vertices) return result;
  result.kind = Kind::vertices;
  if (!vertices->value.IsSequence()) {
    result.values.push_back(value(vertices->value));
    return result;
  }
  if (vertices->value.size() == 0)
    throw InputError(vertices->place, "vertices: expected a value at least");
  for (const auto& entry : vertices->value) result.values.push_back(value(entry));
  return result;
}

/// "x: [rad, rad/s]", "u: V".
model::UnitText unit(const YamlFile& file, const YamlItem& item) {
  model::UnitText result{item.key, {}, item.place};
  const auto add = [&](const YAML::Node& node) {
    result.units.push_back(file.string(node, item.key));
  };
  if (!item.value.IsSequence()) {
    add(item.value);
    return result;
  }
  if (item.value.size() == 0)
    throw InputError(item.place, item.key + ": expected a unit, or one for each element");
  for (const auto& entry : item.value) add(entry);
  return result;
}

/// What to do with keys that are at the wrong level.
std::map<std::string, std::string> advice_on_keys(const model::Method& method) {
  std::map<std::string, std::string> advice;
  for (const char* key :
       {"assume", "unknowns", "require", "necessary", "minimize", "gains", "plant", "observer",
        "observers", "events", "order", "inputs", "noise", "timer", "signals", "claims"})
    advice[key] =
        "it belongs to the method; 'gainsmith methods NAME' prints one, to be put under 'method'";
  for (const auto& datum : method.data) advice[datum.name] = "it belongs under 'data'";
  for (const auto& parameter : method.parameters)
    advice[parameter.name] = "it belongs under 'parameters'";
  return advice;
}

}  // namespace

std::string unknown_method(const std::string& name, const std::vector<std::string>& names) {
  // What other programs call some of the methods.
  static const std::map<std::string, std::string> kElsewhere = {
      {"hinfsyn", "output-feedback"},
      {"mixsyn", "output-feedback"},
      {"h2syn", "h2-state-feedback"},
      {"hinfnorm", "hinf-norm"},
      {"norm", "hinf-norm"},
      {"dlqr", "discrete-lqr"},
      {"lqe", "kalman"},
      {"dlqe", "discrete-kalman"},
      {"lqg", "kalman"},
      {"ekf", "nonlinear-observer"},
      {"place", "observer"},
      {"luenberger", "observer"},
      {"quadstab", "quadratic-stability"}};
  if (const auto found = kElsewhere.find(name); found != kElsewhere.end())
    return "unknown method '" + name + "'; did you mean '" + found->second +
           "'? ('gainsmith methods' lists them by task)";
  return "unknown method '" + name + "'" +
         suggestion(name, names, "; 'gainsmith methods' lists them by task");
}

model::Problem parse_problem(const std::string& text, const std::string& file,
                             const MethodLibrary& library,
                             const std::vector<model::Setting>& settings) {
  Sources sources(file);
  return parse_problem(text, file, library, settings, sources);
}

model::Problem parse_problem(const std::string& text, const std::string& file,
                             const MethodLibrary& library,
                             const std::vector<model::Setting>& settings, Sources& sources) {
  expr::count_problem();
  YamlFile yaml(text, file, &sources);
  YamlMap map(yaml, with_what_it_is_like(yaml, library), "problem", keys::problem);
  model::Problem problem;
  problem.file = file;
  problem.text = text;
  problem.name = yaml.string(map.require("problem").value, "problem", "");
  const YamlItem method = map.require("method");
  problem.method_place = method.place;
  problem.method = method_of(yaml, method, problem.name, library, map.find("figures").has_value());
  problem.method_name = problem.method->name;
  read_data(yaml, map.find("data"), problem);
  for (const YamlItem& item : items_of(yaml, map.find("let"), "let"))
    problem.let.push_back(definition(yaml, item));
  for (const YamlItem& item : items_of(yaml, map.find("figures"), "figures"))
    problem.figures.push_back(system_figure(yaml, item));
  declare_scalars(problem);
  for (const YamlItem& item : items_of(yaml, map.find("parameters"), "parameters"))
    add(value_of(yaml, item), item, problem.parameters);
  problem.synthesis = synthesis(yaml, map.find("synthesis"));
  if (const auto search = map.find("search"))
    problem.search = search_from(yaml, *search, *problem.method);
  problem.negotiable = scalar_ranges(yaml, map.find("negotiable"), "negotiable", *problem.method);
  const auto reason_item = map.find("no campaign");
  const auto campaign_item = map.find("campaign");
  if (reason_item && campaign_item)
    throw InputError(reason_item->place, "either 'campaign' or 'no campaign', not both");
  if (reason_item) problem.no_campaign = reason(yaml, *reason_item);
  if (campaign_item && !problem.method->no_campaign.empty())
    throw InputError(campaign_item->place, "the method " + problem.method_name +
                                               " has no campaign: " + problem.method->no_campaign);
  problem.campaign = campaign(yaml, campaign_item, *problem.method);
  if (const auto expect = map.find("expect")) problem.expect = expectation_from(yaml, *expect);
  if (const auto compare = map.find("compare")) problem.compare = figures(yaml, *compare);
  for (const YamlItem& item : items_of(yaml, map.find("report"), "report"))
    problem.report.push_back({item.key, yaml.expression(item.value, item.key), item.place});
  for (const YamlItem& item : items_of(yaml, map.find("uncertain"), "uncertain"))
    problem.uncertain.push_back(uncertain(yaml, item));
  for (const YamlItem& item : items_of(yaml, map.find("units"), "units"))
    problem.units.push_back(unit(yaml, item));
  for (const YamlItem& item : items_of(yaml, map.find("covariance"), "covariance"))
    problem.covariances.push_back(
        {item.key, yaml.string(item.value, item.key), item.place, yaml.place(item.value)});
  map.finish(advice_on_keys(*problem.method));
  // Settings replace values that were read, so they come last; then all files are known.
  set_values(settings, sources, problem);
  problem.files = sources.files();
  return problem;
}

}  // namespace gainsmith::io
