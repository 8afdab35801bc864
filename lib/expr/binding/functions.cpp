// The rows of operations.def as tables, in the order of the page. All are made at compile time.
#include "expr/binding/functions.h"

#include <algorithm>
#include <array>

#include "base/named.h"

namespace gainsmith::expr {

namespace {

/// The number of names in "x, lo, hi".
constexpr int count_of(std::string_view parameters) {
  return 1 + static_cast<int>(std::ranges::count(parameters, ','));
}

#define FUNCTION(op, operands, rule, name, usage, meaning, example, value) \
  Function{Op::op, name, operands, operands, usage, meaning, example, value},
#define COMPOSED(name, method, fewest, most, usage, meaning, example, value) \
  Function{Composed::name, #name, fewest, most, usage, meaning, example, value},
#define WRITTEN(name, parameters, text, fault, ...)                                             \
  Function{Written{parameters, text, fault}, #name, count_of(parameters), count_of(parameters), \
           __VA_ARGS__},
constexpr std::array kFunctions = {
#include "expr/operations.def"
};

#define OPERATOR(usage, name, remark, example, value) Operator{usage, name, remark, example, value},
constexpr std::array kOperators = {
#include "expr/operations.def"
};

std::string example_cell(std::string_view example, std::string_view value) {
  return "`" + std::string(example) + "` is `" + std::string(value) + "`";
}

}  // namespace

std::span<const Function> functions() { return kFunctions; }

std::span<const Operator> operators() { return kOperators; }

const Function* find_function(std::string_view name) { return find_named(kFunctions, name); }

bool is_reserved(std::string_view name) {
  constexpr std::array<std::string_view, 7> kWords = {"I",  "pi",  "derivative", "and",
                                                      "or", "not", "end"};
  return std::find(kWords.begin(), kWords.end(), name) != kWords.end() ||
         find_function(name) != nullptr;
}

std::vector<std::string> function_names() { return names_of_all(kFunctions); }

std::string functions_page() {
  std::string page = "| function | | example |\n|---|---|---|\n";
  for (const Function& function : kFunctions)
    page += "| `" + std::string(function.usage) + "` | " + std::string(function.meaning) + " | " +
            example_cell(function.example, function.value) + " |\n";
  return page;
}

std::string operators_page() {
  std::string page = "| operator | | | example |\n|---|---|---|---|\n";
  for (const Operator& row : kOperators)
    page += "| " + std::string(row.usage) + " | " + std::string(row.name) + " | " +
            std::string(row.remark) + (row.remark.empty() ? "| " : " | ") +
            example_cell(row.example, row.value) + " |\n";
  return page;
}

}  // namespace gainsmith::expr
