// A problem as YAML text, with its instance. The method may stand inline.
#pragma once

#include <memory>
#include <string>

#include "io/problem_yaml.h"
#include "methods/methods.h"
#include "model/bind.h"

namespace gainsmith::tests {

struct YamlProblem {
  std::shared_ptr<const model::Problem> problem;
  model::Instance instance;

  explicit YamlProblem(const std::string& text) {
    const io::MethodLibrary library{[](const std::string& name) { return methods::find(name); },
                                    methods::names()};
    problem = std::make_shared<const model::Problem>(io::parse_problem(text, "test.yaml", library));
    instance = model::bind(problem);
  }
};

}  // namespace gainsmith::tests
