#include "design/variants.h"

#include <memory>
#include <utility>

namespace gainsmith::design {

model::Problem with_method(model::Problem problem,
                           const std::function<void(model::Method&)>& change) {
  auto method = std::make_shared<model::Method>(*problem.method);
  change(*method);
  problem.method = std::move(method);
  return problem;
}

model::Problem without_gains(const model::Problem& problem) {
  model::Problem result = with_method(problem, [](model::Method& method) { method.gains.clear(); });
  result.search.reset();
  result.negotiable.clear();
  result.expect.reset();
  return result;
}

model::Problem without_objective(model::Problem problem) {
  return with_method(std::move(problem), [](model::Method& method) { method.minimize.reset(); });
}

model::Problem with_requirements(model::Problem problem, const std::set<std::string>& names) {
  return with_method(std::move(problem), [&](model::Method& method) {
    std::erase_if(method.require, [&](const model::Requirement& requirement) {
      return !names.contains(requirement.name);
    });
  });
}

}  // namespace gainsmith::design
