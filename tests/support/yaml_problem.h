// A problem as YAML text, with its instance. The method may stand inline.
#pragma once

#include <memory>
#include <string>

#include "bind/bind.h"
#include "io/yaml/problem_yaml.h"
#include "methods/methods.h"
#include "model/gains.h"

namespace gainsmith::tests {

/// [[0.5, 2], [..]], with all digits.
inline std::string matrix_yaml(const numbers::Matrix& matrix) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    text += i > 0 ? ", [" : "[";
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += (j > 0 ? ", " : "") + model::printed(matrix(i, j));
    text += "]";
  }
  return text + "]";
}

struct YamlProblem {
  std::shared_ptr<const model::Problem> problem;
  model::Instance instance;

  explicit YamlProblem(const std::string& text) {
    const io::MethodLibrary library{[](const std::string& name) { return methods::find(name); },
                                    methods::names()};
    problem = std::make_shared<const model::Problem>(io::parse_problem(text, "test.yaml", library));
    instance = bind::bind(problem);
  }
};

}  // namespace gainsmith::tests
