// Schemas from the tables of keys. Each level and each named form is one definition, which others
// refer to by name. Forms are read by recursive descent:
//   form    = one { " | " one }
//   one     = 'word' | "[" form { ", " form } "]" [ + ] | "{" form "}" [ 1 | + | ? ] | NAME     (1)
// Words of one form are one "enum"; rules between keys become "required" under oneOf, not, if.
#include "io/schema/schema.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/schema/keys.h"

namespace gainsmith::io {

namespace {

using Words = std::vector<std::string_view>;

constexpr const char* kDraft = "http://json-schema.org/draft-07/schema#";

/// "a,b" at commas.
Words split(std::string_view list) {
  Words names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    names.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

/// A name as a part of an address.
std::string id(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, ' ', '-');
  return text;
}

Json reference(std::string_view name) { return {{"$ref", "#/definitions/" + id(name)}}; }

/// The schema of objects that have the key.
Json has(std::string_view key) { return {{"required", Json::array({key})}}; }

/// One of them at least; a single one is itself.
Json any_of(Json alternatives) {
  if (alternatives.size() == 1) return alternatives.front();
  return {{"anyOf", std::move(alternatives)}};
}

constexpr const char* kNone = "none";
/// Levels whose parts a problem that is `like` another may replace one by one.
constexpr std::array kChanged = {&keys::method, &keys::component, &keys::log_plant};

std::string changed_name(const Level& level) { return "changed " + std::string(level.name); }

/// What each name is in a file, and how texts become schemas.
class SchemaWriter {
 public:
  SchemaWriter(std::span<const Level* const> levels, std::span<const NamedForm> forms, bool is_yaml)
      : levels_(levels), forms_(forms), is_yaml_(is_yaml) {}

  /// The schema of a document.
  Json document(const Level& root, const std::string& title) const {
    Json result = {{"$schema", kDraft}, {"title", title}};
    result.update(level(root));
    Json definitions = Json::object();
    for (const NamedForm& form : forms_) definitions[id(form.name)] = this->form(form.form);
    if (is_yaml_) definitions["matrices"] = matrices();
    for (const Level* one : levels_)
      if (one != &root) definitions[id(one->name)] = level(*one);
    result["definitions"] = std::move(definitions);
    return result;
  }

  /// A level that replaces parts of another one (variant_yaml.h): 'none' takes a part away, and a
  /// mapping of names is joined with the other one's. What is in such a mapping is replaced as a
  /// whole.
  Json changed(const Level& level) const {
    Json properties = Json::object();
    for (const Key& key : level.keys) {
      Json value = or_none(joined(form(key.form)));
      if (!key.text.empty()) value["description"] = key.text;
      properties[std::string(key.name)] = std::move(value);
    }
    return {{"description", "Replaces parts: " + std::string(level.text)},
            {"type", "object"},
            {"properties", properties},
            {"additionalProperties", false}};
  }

 private:
  static Json or_none(Json value) {
    return any_of(Json::array({std::move(value), {{"enum", {kNone}}}}));
  }

  /// The form of what is joined with another one.
  static Json joined(Json form) {
    // A section without entries changes none.
    const Json empty = {{"type", "null"}};
    for (const Level* level : kChanged)
      if (form == reference(level->name))
        return any_of(Json::array({reference(changed_name(*level)), empty}));
    if (form == reference("plant"))
      return any_of(Json::array({reference(changed_name(keys::log_plant)),
                                 reference(changed_name(keys::component)), empty}));
    if (!form.contains("additionalProperties")) return form;
    form["additionalProperties"] = or_none(joined(form["additionalProperties"]));
    form["type"] = {"object", "null"};
    form.erase("minProperties");
    form.erase("maxProperties");
    return form;
  }

  /// A list of matrices, those of a family: it contains a list of rows.
  static Json matrices() {
    const Json row = {{"type", "array"}};
    const Json rows = {{"type", "array"}, {"minItems", 1}, {"items", Json::array({row})}};
    const Json files = {{"type", "object"}};
    return {{"type", "array"},
            {"items", reference("datum")},
            {"contains", {{"anyOf", Json::array({rows, files})}}}};
  }

  /// A mapping with known keys. A key with a bracket, "f(x)", is a pattern of names.
  Json level(const Level& level) const {
    Json properties = Json::object();
    Json patterns = Json::object();
    Json required = Json::array();
    for (const Key& key : level.keys) {
      Json value = form(key.form);
      if (!key.text.empty()) value["description"] = key.text;
      if (key.name.ends_with(')'))
        patterns["\\("] = std::move(value);
      else
        properties[std::string(key.name)] = std::move(value);
      if (key.required) required.push_back(key.name);
    }
    Json result = {{"description", level.text}, {"type", "object"}, {"properties", properties}};
    if (!patterns.empty()) result["patternProperties"] = std::move(patterns);
    result["additionalProperties"] = level.rest.empty() ? Json(false) : form(level.rest);
    if (!required.empty()) result["required"] = std::move(required);
    Json rules = Json::array();
    for (const Rule& rule : level.rules) rules.push_back(this->rule(rule));
    if (!rules.empty()) result["allOf"] = std::move(rules);
    return result;
  }

  /// What keys ask of each other (Rule); at most one means no pair.
  static Json rule(const Rule& rule) {
    Json keys = Json::array();
    Json pairs = Json::array();
    const Words others = split(rule.others);
    for (std::size_t i = 0; i < others.size(); ++i) {
      keys.push_back(has(others[i]));
      for (std::size_t j = i + 1; j < others.size(); ++j)
        pairs.push_back({{"required", {others[i], others[j]}}});
    }
    const auto where = [&](Json then) {
      return Json{{"if", has(rule.key)}, {"then", std::move(then)}};
    };
    switch (rule.kind) {
      case Rule::Kind::exactly_one:
        return {{"oneOf", keys}};
      case Rule::Kind::at_most_one:
        return {{"not", any_of(pairs)}};
      case Rule::Kind::some:
        return any_of(keys);
      case Rule::Kind::needs:
        return where(any_of(keys));
      case Rule::Kind::excludes:
        return where({{"not", any_of(keys)}});
    }
    return {};
  }

  /// A form of Key as a schema.
  Json form(std::string_view text) const {
    std::size_t at = 0;
    return form(text, at);
  }

  /// From `at` to the end or the bracket that closes it.
  Json form(std::string_view text, std::size_t& at) const {
    Json alternatives = Json::array();
    Json words = Json::array();
    for (;;) {
      if (text[at] == '\'') {
        const std::size_t end = text.find('\'', at + 1);
        words.push_back(text.substr(at + 1, end - at - 1));
        at = end + 1;
      } else {
        alternatives.push_back(one(text, at));
      }
      if (!text.substr(at).starts_with(" | ")) break;
      at += 3;
    }
    if (!words.empty()) alternatives.push_back({{"enum", words}});
    return any_of(alternatives);
  }

  Json one(std::string_view text, std::size_t& at) const {
    if (text[at] == '[') return list(text, at);
    if (text[at] == '{') return mapping(text, at);
    const std::size_t begin = at;
    at = std::min({text.find(" |", at), text.find_first_of(",]}", at), text.size()});
    return named(text.substr(begin, at - begin));
  }

  /// A list of equal elements, or of as many as there are forms.
  Json list(std::string_view text, std::size_t& at) const {
    Json items = Json::array({form(text, ++at)});
    while (text[at] == ',') items.push_back(form(text, at += 2));
    ++at;
    Json result = {{"type", "array"}};
    if (items.size() > 1) {
      result["minItems"] = items.size();
      result["maxItems"] = items.size();
      result["items"] = std::move(items);
      return result;
    }
    result["items"] = std::move(items.front());
    if (is_at(text, '+', at)) result["minItems"] = 1;
    return result;
  }

  /// A mapping of the user's names.
  Json mapping(std::string_view text, std::size_t& at) const {
    Json result = {{"type", "object"}, {"additionalProperties", form(text, ++at)}};
    ++at;
    const bool single = is_at(text, '1', at);
    const bool filled = single || is_at(text, '+', at);
    if (filled) result["minProperties"] = 1;
    if (single) result["maxProperties"] = 1;
    if (is_at(text, '?', at)) result["type"] = {"object", "null"};
    return result;
  }

  /// Takes the mark where it is there.
  static bool is_at(std::string_view text, char mark, std::size_t& at) {
    if (at >= text.size() || text[at] != mark) return false;
    ++at;
    return true;
  }

  /// A number of YAML may be quoted.
  Json number(const char* type) const {
    if (!is_yaml_) return {{"type", type}};
    const char* const decimal = "^[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?$";
    return {{"type", {"number", "string"}}, {"pattern", decimal}};
  }

  /// A scalar by its word, or a reference to a level or a form.
  Json named(std::string_view name) const {
    if (name == "text")
      return {{"type", is_yaml_ ? Json{"string", "number", "boolean"} : Json("string")}};
    if (name == "number") return number("number");
    if (name == "whole") return number("integer");
    if (name == "truth") return {{"type", "boolean"}};
    if (name == "never") return {{"not", Json::object()}};
    if (name == "nothing") return {{"type", "null"}};
    return reference(name);
  }

  std::span<const Level* const> levels_;
  std::span<const NamedForm> forms_;
  bool is_yaml_;
};

/// Of a problem that is like another one. What replaces a part of that one may be a part of a
/// part, or `none`, so only keys are checked.
Json variant_schema(const Json& whole) {
  Json variant = {{"description", "A problem that replaces parts of another one"},
                  {"type", "object"},
                  {"additionalProperties", false},
                  {"required", {"problem"}}};
  for (const auto& [key, form] : whole["properties"].items())
    variant["properties"][key] = {{"description", form.value("description", "")}};
  for (const char* own : {"problem", "expect"})
    variant["properties"][own] = whole["properties"][own];
  variant["properties"]["like"] = {{"type", "string"},
                                   {"description", "the file of the other one"}};
  return variant;
}

}  // namespace

Json problem_schema() {
  const SchemaWriter writer(problem_levels(), problem_forms(), true);
  Json schema = writer.document(keys::problem, "gainsmith problem");
  Json whole = Json::object();
  for (const char* part :
       {"description", "type", "properties", "additionalProperties", "required", "allOf"}) {
    whole[part] = std::move(schema[part]);
    schema.erase(part);
  }
  for (const Level* level : kChanged)
    schema["definitions"][id(changed_name(*level))] = writer.changed(*level);
  Json& method = schema["definitions"][id(changed_name(keys::method))];
  method["properties"]["like"] = {{"type", "string"},
                                  {"description", "the built-in method that it replaces parts of"}};
  method["allOf"] = Json::array({{{"not", {{"required", {"observer", "observers"}}}}}});
  const Json changed = reference(changed_name(keys::method));
  whole["properties"]["method"]["anyOf"].push_back(
      {{"allOf", Json::array({changed, has("like")})}});
  schema["definitions"]["variant"] = variant_schema(whole);
  schema["definitions"]["problem"] = std::move(whole);
  schema["if"] = has("like");
  schema["then"] = reference("variant");
  schema["else"] = reference("problem");
  return schema;
}

Json method_schema() {
  Json schema = SchemaWriter(problem_levels(), problem_forms(), true)
                    .document(keys::method, "gainsmith method");
  schema["required"] = {"method"};
  return schema;
}

Json gain_file_schema() {
  return SchemaWriter(gain_file_levels(), gain_file_forms(), false)
      .document(*gain_file_levels().front(), "gainsmith gain file");
}

}  // namespace gainsmith::io
