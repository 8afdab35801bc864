// A problem as YAML text, with its instance. The method may stand inline.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/problem_yaml.h"
#include "methods/methods.h"
#include "model/instance.h"

namespace gainsmith::tests {

struct YamlProblem {
  std::unique_ptr<model::Problem> problem;
  model::Instance instance;

  explicit YamlProblem(const std::string& text) {
    const io::MethodLibrary library{[](const std::string& name) { return methods::find(name); },
                                    methods::names()};
    problem = std::make_unique<model::Problem>(io::parse_problem(text, "test.yaml", library));
    instance = model::make_instance(*problem);
  }
};

}  // namespace gainsmith::tests
