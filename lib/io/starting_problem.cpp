// A problem to begin with, as text: comments and order are for a person, so it is put together by
// lines and not by a writer of YAML.
#include "io/starting_problem.h"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "io/yaml/yaml.h"

namespace gainsmith::io {

namespace {

/// A double-quoted text of YAML.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// A scalar, or lists of them, on one line; `key` is that of a mapping around it.
std::string on_a_line(const YAML::Node& node) {
  if (node.IsScalar()) return node.Tag() == "!" ? quoted(node.Scalar()) : node.Scalar();
  std::string text;
  for (const auto& element : node) text += (text.empty() ? "" : ", ") + on_a_line(element);
  return "[" + text + "]";
}

/// "SHAPE: HELP; DEFAULT unless given", as far as there is such.
std::string remark(const std::string& shape, const std::string& help, const std::string& fallback) {
  std::string text = shape;
  if (!help.empty()) text += (text.empty() ? "" : ": ") + help;
  if (!fallback.empty()) text += (text.empty() ? "" : "; ") + fallback + " unless given";
  return text;
}

std::string text_of(const std::optional<expr::Expression>& expression) {
  return expression ? expression->text->str() : "";
}

/// What a parameter is without a value.
std::string otherwise(const model::Parameter& parameter) {
  if (parameter.fallback || !parameter.search) return text_of(parameter.fallback);
  return "searched in [" + text_of(parameter.search->low) + ", " + text_of(parameter.search->high) +
         "]";
}

/// "f(x)" of a function, "A" of a matrix.
std::string key_of(const model::Declaration& datum) {
  std::string arguments;
  for (const model::Argument& argument : datum.arguments)
    arguments += (arguments.empty() ? "(" : ", ") + argument.name;
  return datum.name + (arguments.empty() ? "" : arguments + ")");
}

/// "n, x: n" of a function, "n x m" of a matrix, "n x n for i in 1..N" of a family.
std::string shape_of(const model::Declaration& datum) {
  std::string text = datum.shape.text;
  for (const model::Argument& argument : datum.arguments)
    text += ", " + argument.name + ": " + argument.shape.text;
  for (const expr::Index& index : datum.indices)
    text += (&index == &datum.indices.front() ? " for each " : ", ") + index.name;
  return text;
}

/// Without their ends.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
  }
  return lines;
}

/// The method's text below 'method:', without what only the list of methods reads.
std::string indented(const std::string& method) {
  std::string text;
  for (const std::string& line : lines_of(method)) {
    const std::string key = line.substr(0, line.find(':'));
    if (key == "method" || key == "task" || key == "example") continue;
    text += (line.empty() ? "" : "  " + line) + "\n";
  }
  return text;
}

/// Writes the problem; the example is parsed for its keys and copied by its lines.
class Writer {
 public:
  explicit Writer(const std::string& example) : file_(example, "the example") {
    for (const auto& entry : file_.root()) keys_.push_back(entry.first);
  }

  std::string text(const model::Method& method, const std::string& own) {
    text_ =
        "# " + method.summary + "\n# 'gainsmith run' of this file designs, simulates and judges; ";
    text_ += own.empty() ? "'gainsmith methods " + method.name + "' prints the method.\n"
                         : "the method is a copy of '" + method.name + "', to be changed.\n";
    text_ +=
        "problem: mine\nmethod:" + (own.empty() ? " " + method.name + "\n" : "\n" + indented(own));
    if (!method.data.empty()) text_ += "data:\n";
    for (const model::Declaration& datum : method.data)
      add("data", key_of(datum), remark(shape_of(datum), datum.help, text_of(datum.fallback)),
          datum.fallback);
    if (!method.parameters.empty()) text_ += "parameters:\n";
    for (const model::Parameter& parameter : method.parameters)
      add("parameters", parameter.name, remark("", parameter.help, otherwise(parameter)),
          parameter.fallback);
    copy_others();
    return std::move(text_);
  }

 private:
  std::optional<YAML::Node> section(const std::string& name) const {
    const YAML::Node found = file_.root()[name];
    return found ? std::optional(found) : std::nullopt;
  }

  /// The entry with its remark; one without a value in the example is a remark with its default.
  void add(const std::string& where, const std::string& key, const std::string& remark,
           const std::optional<expr::Expression>& fallback) {
    text_ += "  # " + remark + "\n";
    const std::string name = key.substr(0, key.find('('));
    if (const auto values = section(where))
      for (const auto& entry : *values) {
        const std::string found = entry.first.Scalar();
        if (found.substr(0, found.find('(')) != name) continue;
        const bool comma = found.find(',') != std::string::npos;
        text_ += "  " + (comma ? quoted(found) : found) + ": " + on_a_line(entry.second) + "\n";
        return;
      }
    text_ += "  # " + key + ": " + text_of(fallback) + "\n";
  }

  /// The lines of the other keys, unchanged, without comments between them.
  void copy_others() {
    const std::set<std::string> written = {"problem",    "method", "data",   "parameters",
                                           "negotiable", "expect", "compare"};
    const std::vector<std::string> lines = lines_of(file_.text());
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      if (written.contains(keys_[k].Scalar())) continue;
      const auto first = static_cast<std::size_t>(keys_[k].Mark().line);
      auto last =
          k + 1 < keys_.size() ? static_cast<std::size_t>(keys_[k + 1].Mark().line) : lines.size();
      // Comments at the end belong to the next key, or to nothing.
      while (last > first && (lines[last - 1].empty() || lines[last - 1].front() == '#')) --last;
      for (std::size_t at = first; at < last; ++at) text_ += lines[at] + "\n";
    }
  }

  YamlFile file_;
  std::vector<YAML::Node> keys_;
  std::string text_;
};

}  // namespace

std::string starting_problem(const model::Method& method, const std::string& example,
                             const std::string& own) {
  return Writer(example).text(method, own);
}

}  // namespace gainsmith::io
