// Values from outside. A name is sought among data, parameters, definitions, the search and the
// choices of `synthesis`, in this order.
#include "io/setting.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/named.h"
#include "base/nearest.h"
#include "expr/text/parser.h"
#include "io/schema/keys.h"
#include "io/yaml/search_yaml.h"
#include "io/yaml/synthesis_yaml.h"
#include "io/yaml/yaml.h"
#include "model/names.h"

namespace gainsmith::io {

namespace {

/// Puts a value in the place of the one of its name, or adds it.
template <class Item, class NameOf>
void replace_item(std::vector<Item>& items, Item item, NameOf name_of) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const Item& known) {
    return name_of(known) == name_of(item);
  });
  if (found == items.end())
    items.push_back(std::move(item));
  else
    *found = std::move(item);
}

/// One setting. Its text is read as a file of its own, whose name in errors is the option.
class Setter {
 public:
  Setter(const model::Setting& setting, Sources& sources, model::Problem& problem)
      : setting_(setting),
        option_(sources.shown_option("--set " + setting.name)),
        sources_(sources),
        problem_(problem),
        name_(setting.name.substr(0, setting.name.find_first_of("(["))) {}

  void run() {
    const model::Method& method = *problem_.method;
    const auto named = [&](const auto& item) { return item.name == name_; };
    const auto signed_as = [&](const model::Let& let) { return let.signature.name == name_; };
    const auto has = [](const auto& items, const auto& test) {
      return std::any_of(items.begin(), items.end(), test);
    };
    const auto by_name = [](const auto& item) { return item.name; };
    const auto datum = std::find_if(method.data.begin(), method.data.end(), named);
    const bool in_method = is_in_problem(method) && has(method.let, signed_as);
    if (datum != method.data.end() && !datum->arguments.empty()) {
      define(problem_.functions);
    } else if (datum != method.data.end()) {
      refuse_index();
      replace_item(problem_.data, value(), by_name);
    } else if (has(method.parameters, named)) {
      refuse_index();
      replace_item(problem_.parameters, value(), by_name);
    } else if (has(problem_.let, signed_as) || in_method) {
      const auto is_value = [&](const model::Let& let) {
        return signed_as(let) && let.signature.parameters.empty() && let.signature.indices.empty();
      };
      if (has(problem_.let, is_value) || (in_method && has(method.let, is_value))) refuse_index();
      define(problem_.let);
    } else if (name_ == model::kSearch) {
      refuse_index();
      refuse_empty();
      const YamlFile file(setting_.value, option_, &sources_);
      problem_.search = search_from(file, {name_, {}, {option_, 1, 1}, file.root()}, method);
    } else if (const auto choice = choices().find(name_); choice != choices().end()) {
      refuse_index();
      choose(choice->second);
    } else {
      refuse_unknown(method);
    }
  }

 private:
  using Choice = void (*)(const YamlFile&, const YamlItem&, model::SynthesisOptions&);

  /// The numbers of `synthesis`, where no datum has their name.
  static const std::map<std::string, Choice>& choices() {
    static const std::map<std::string, Choice> kChoices = {{model::kGainBound, set_gain_bound},
                                                           {"margin", set_margin}};
    return kChoices;
  }

  void choose(Choice choice) {
    refuse_empty();
    const YamlFile file(setting_.value, option_, &sources_);
    choice(file, {name_, {}, {option_, 1, 1}, file.root()}, problem_.synthesis);
  }

  void refuse_empty() const {
    if (setting_.value.find_first_not_of(" \t\r\n") == std::string::npos)
      throw InputError({option_}, "expected NAME=VALUE; there is no value");
  }

  /// "A(1,2)": only functions have something in brackets.
  void refuse_index() const {
    if (name_ != setting_.name)
      throw InputError({option_}, "--set gives a whole value, not an element: --set '" + name_ +
                                      "=VALUE', of a matrix as in 'A=[0, 1; -1, 0]'");
  }

  /// A method of the problem's own has no text beside that of the problem.
  static bool is_in_problem(const model::Method& method) { return method.text.empty(); }

  [[noreturn]] void refuse_unknown(const model::Method& method) const {
    const std::string key = name_.substr(name_.rfind('.') + 1);  // of "campaign.horizon" too
    if (keys::campaign.find(key) != nullptr)
      throw InputError({option_}, "'" + key +
                                      "' is a key of the campaign, which is set in the problem "
                                      "file; --runs and --seed are options of run and verify");
    if (has_named(method.unknowns, name_))
      throw InputError(
          {option_},
          "'" + name_ +
              "' is an unknown, which the solver finds; an inequality in the problem asks "
              "for less or more of it, such as 'method: {" +
              (is_in_problem(method) ? "" : "like: " + method.name + ", ") +
              "require: {enough: " + name_ + " <= " + setting_.value + "}}'");
    std::vector<std::string> known;
    for (const auto& datum : method.data) known.push_back(datum.name);
    for (const auto& parameter : method.parameters) known.push_back(parameter.name);
    for (const model::Let& let : problem_.let) known.push_back(let.signature.name);
    if (is_in_problem(method))
      for (const model::Let& let : method.let) known.push_back(let.signature.name);
    for (const auto& [choice, set] : choices()) known.push_back(choice);
    known.emplace_back(model::kSearch);
    throw InputError({option_}, "the problem has no datum, parameter or definition '" + name_ +
                                    "'" + suggestion(name_, known));
  }

  /// The value as an entry of a problem file; a formula by itself when it has a ';'.
  model::Value value() {
    refuse_empty();
    // YAML would need quotes around it, which a shell takes away.
    if (setting_.value.find(';') != std::string::npos)
      return {name_, expr::parse(expr::Text(setting_.value, option_)), false, {option_, 1, 1}};
    const YamlFile file(setting_.value, option_, &sources_);
    model::Value result = datum_of(file, {name_, {}, {option_, 1, 1}, file.root()});
    result.place = {option_, 1, 1};
    return result;
  }

  /// A function or a definition: "f(x)" with its body.
  void define(std::vector<model::Let>& list) {
    const model::Let let{
        expr::parse_signature(expr::Text(setting_.name, option_)), value().value, {option_, 1, 1}};
    replace_item(list, let, [](const model::Let& known) { return known.signature.name; });
  }

  const model::Setting& setting_;
  std::string option_;
  Sources& sources_;
  model::Problem& problem_;
  std::string name_;
};

/// A scalar that has a value is not searched.
void leave_out_of_search(const std::string& name, model::Problem& problem) {
  if (!problem.search) return;
  model::Search& search = *problem.search;
  if (search.extreme && search.extreme->name == name) search.extreme.reset();
  std::erase_if(search.over, [&](const model::ScalarRange& range) { return range.name == name; });
  if (!search.extreme && search.over.empty()) problem.search.reset();
}

}  // namespace

void set_values(const std::vector<model::Setting>& settings, Sources& sources,
                model::Problem& problem) {
  for (const model::Setting& setting : settings) {
    for (const model::Setting& known : problem.settings)
      if (known.name == setting.name)
        throw InputError({sources.shown_option("--set " + setting.name)}, "this is given twice");
    Setter(setting, sources, problem).run();
    problem.settings.push_back(setting);
  }
  for (const model::Setting& setting : settings) leave_out_of_search(setting.name, problem);
}

}  // namespace gainsmith::io
