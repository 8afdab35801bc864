// A number that other data name becomes a datum of the method: "A: [[0, a], [1, 0]]" with "a: 2"
// needs no declaration of a. The method is copied for it.
#include "io/yaml/scalar_data.h"

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/named.h"
#include "expr/binding/compile.h"
#include "model/names.h"

namespace gainsmith::io {

namespace {

void add_names(const model::Value& value, std::set<std::string>& names) {
  if (value.value.root) names.merge(names_in(value.value));
  for (const model::Value& member : value.matrices) add_names(member, names);
}

/// What the values of data, apart from this one, and the definitions of the problem name.
std::set<std::string> read_beside(const model::Value& self, const model::Problem& problem) {
  std::set<std::string> names;
  for (const model::Value& value : problem.data)
    if (value.name != self.name) add_names(value, names);
  for (const auto* list : {&problem.functions, &problem.let})
    for (const model::Let& let : *list) names.merge(names_in(let.body));
  for (const model::SystemFigureText& figure : problem.figures)
    for (const auto& system : figure.systems) names.merge(names_in(system.text));
  return names;
}

/// Whether the method has a datum or a parameter of the name.
bool is_declared(const std::string& name, const model::Method& method) {
  return has_named(method.data, name) || has_named(method.parameters, name);
}

/// A matrix that is written out, or read from a file, is none.
bool may_be_scalar(const model::Value& value) {
  return value.matrices.empty() && value.source.empty() && value.value.root &&
         value.value.root->kind != expr::NodeKind::block;
}

}  // namespace

void declare_scalars(model::Problem& problem) {
  std::vector<model::Declaration> scalars;
  for (const model::Value& value : problem.data) {
    if (is_declared(value.name, *problem.method) || !may_be_scalar(value)) continue;
    if (!read_beside(value, problem).contains(value.name)) continue;
    model::Declaration scalar;
    scalar.name = value.name;
    // A transfer function is a system; any other value is a number here.
    const char* shape = expr::makes_system(*value.value.root) ? "system" : "scalar";
    scalar.shape = model::parse_shape(expr::Text::generated(shape, value.place));
    scalar.place = value.place;
    scalars.push_back(std::move(scalar));
  }
  if (scalars.empty()) return;
  auto method = std::make_shared<model::Method>(*problem.method);
  for (const model::Declaration& scalar : scalars) {
    method->data.insert(method->data.begin() + (&scalar - scalars.data()), scalar);
    try {
      // The name may be one of the method that is no datum: an unknown, a state, a definition.
      model::check_names(*method);
    } catch (const InputError& error) {
      throw InputError(scalar.place, "the method " + method->name + " has no datum '" +
                                         scalar.name + "', and has this name already (" +
                                         error.message() + "): give the number another name");
    }
  }
  problem.method = std::move(method);
}

}  // namespace gainsmith::io
