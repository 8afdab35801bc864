// The matrix language gives a value or an InputError at a place inside the text.
//
// The last line is an expression. Each line before it is a definition, "name(a, b): expression",
// that the expression may use, beside the names of world().
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "fuzz/places.h"
#include "fuzz/readers.h"
#include "numbers/types/real.h"

namespace gainsmith::expr {
namespace {

using numbers::Matrix;

const std::string kFile = "fuzz";

struct World {
  Scope scope;
  numbers::Values values;

  void set(const std::string& name, const Matrix& value, bool known) {
    scope.symbols[name] = {numbers::shape_of(value), known};
    values[name] = value;
  }
};

/// Data with values, unknowns without, a dimension each, and definitions with 0, 1 and 2
/// parameters.
World world() {
  World world;
  world.scope.dimensions = {{"n", 2}, {"p", 1}};
  const Matrix plant{{0.2, -1.01}, {1, 0}};
  const Matrix unknown{{2, 0.5}, {0.5, 1}};
  for (const char* name : {"A", "F", "J"}) world.set(name, plant, true);
  for (const char* name : {"C", "Hc", "Hd"}) world.set(name, Matrix{{0.5, -1}}, true);
  for (const char* name : {"T1", "T2", "delta", "tol"}) world.set(name, Matrix{{0.7}}, true);
  for (const char* name : {"P", "X", "Z"}) world.set(name, unknown, false);
  for (const char* name : {"L", "Y", "z", "e"}) world.set(name, Matrix{{0.3}, {-2}}, false);
  for (const char* name : {"g", "tau", "y"}) world.set(name, Matrix{{1.5}}, false);
  const auto define = [&](const std::string& name, std::vector<std::string> parameters,
                          const std::string& body) {
    world.scope.definitions[name] = {std::move(parameters), parse({body, "world"})};
  };
  define("Q", {}, "C'*C");
  define("mu", {"t"}, "exp(g*t) - 1");
  define("f", {"a", "b"}, "[a, b; *, I]");
  world.scope.known = std::make_shared<numbers::KnownDoubles>(world.values);
  return world;
}

void define(std::string_view line, Position start, Scope& scope) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const Signature left = parse_signature({std::string(line.substr(0, colon)), kFile, start});
  start.column += code_points(line.substr(0, colon + 1));
  scope.definitions[left.name] = {left.parameters,
                                  parse({std::string(line.substr(colon + 1)), kFile, start})};
}

void run(const std::string_view whole) {
  static const World kWorld = world();
  World here = kWorld;
  Position start;
  std::string_view text = whole;
  for (std::size_t end; (end = text.find('\n')) != std::string_view::npos; ++start.line) {
    define(text.substr(0, end), start, here.scope);
    text.remove_prefix(end + 1);
  }
  const Expression expression = parse({std::string(text), kFile, start});
  if (expression.root->kind == NodeKind::compare) {
    for (const CompiledRelation& relation : compile_relations(expression, here.scope))
      numbers::evaluate(relation.difference, here.values);
    return;
  }
  // Both must be tried: with an expected shape a bare I or 0 has a size.
  try {
    numbers::evaluate(compile(expression, here.scope, Shape{2, 2}), here.values);
  } catch (const InputError& error) {
    require_place(error, kFile, whole);
  }
  numbers::evaluate(compile(expression, here.scope), here.values);
}

}  // namespace
}  // namespace gainsmith::expr

bool gainsmith::fuzz::read_language(std::string_view bytes) {
  try {
    expr::run(bytes);
    return true;
  } catch (const InputError& error) {
    require_place(error, expr::kFile, bytes);
    return false;
  }
}
