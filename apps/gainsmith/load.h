// Problems and gain files, read with the program's own methods.
#pragma once

#include <filesystem>
#include <memory>

#include "io/problem_yaml.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::app {

/// A problem and its instance; the instance points into the problem.
struct Loaded {
  std::unique_ptr<model::Problem> problem;
  model::Instance instance;
};

/// The methods that are built into the program.
io::MethodLibrary built_in_methods();

/// Reads a problem file and checks all that can be checked without solving.
Loaded load_problem(const std::filesystem::path& path);

/// A gain file with the problem that it states.
struct LoadedGains {
  model::Gains gains;
  Loaded stated;
};

LoadedGains load_gains(const std::filesystem::path& path);

}  // namespace gainsmith::app
