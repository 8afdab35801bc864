#include "io/yaml/declaration_yaml.h"

#include <string_view>
#include <utility>

namespace gainsmith::io {

std::optional<expr::Expression> optional_expression(const YamlFile& file,
                                                    const std::optional<YamlItem>& item) {
  if (!item) return std::nullopt;
  return file.expression(item->value, item->key);
}

std::string optional_string(const YamlFile& file, const std::optional<YamlItem>& item) {
  return item ? file.string(item->value, item->key) : "";
}

std::vector<expr::Text> texts_of(const YamlFile& file, const YamlItem& item) {
  std::vector<expr::Text> texts;
  if (item.value.IsSequence()) {
    for (const auto& entry : item.value) texts.push_back(file.scalar(entry, item.key));
  } else {
    texts.push_back(file.scalar(item.value, item.key));
  }
  return texts;
}

std::vector<expr::Index> indices(const YamlFile& file, const std::optional<YamlItem>& item) {
  std::vector<expr::Index> result;
  if (!item) return result;
  for (expr::Text& text : texts_of(file, *item))
    result.push_back(expr::parse_index(std::move(text)));
  return result;
}

std::vector<model::Argument> arguments_of(const YamlFile& file, const YamlItem& of) {
  std::vector<model::Argument> result;
  for (const YamlItem& argument : items_of(file, of, "of"))
    result.push_back({argument.key, model::parse_shape(file.scalar(argument.value, argument.key)),
                      argument.place});
  return result;
}

model::Declaration declaration(const YamlFile& file, const YamlItem& item, const char* fallback) {
  model::Declaration result;
  result.name = item.key;
  result.place = item.place;
  if (item.value.IsScalar()) {
    result.shape = model::parse_shape(file.scalar(item.value, item.key));
    return result;
  }
  if (item.value.IsSequence())
    throw InputError(file.place(item.value),
                     item.key + ": expected a shape, such as n x p, or {shape: n x p, " + fallback +
                         ": ...}; found a list");
  const bool has_default = std::string_view(fallback) == "default";
  YamlMap map(file, item.value, item.key, has_default ? keys::declaration : keys::state);
  result.shape = model::parse_shape(file.scalar(map.require("shape").value, "shape"));
  if (const auto value = map.find(fallback))
    result.fallback = matrix_of(file, *value, result.shape.is_column());
  result.help = optional_string(file, map.find("help"));
  if (has_default) {
    result.indices = indices(file, map.find("for"));
    const auto of = map.find("of");
    if (of) result.arguments = arguments_of(file, *of);
    if (of && !result.indices.empty())
      throw InputError(of->place, "of: a family of matrices has no arguments");
  }
  map.finish();
  return result;
}

}  // namespace gainsmith::io
