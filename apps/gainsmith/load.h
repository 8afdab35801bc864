// Problems and gain files, read with the program's own methods.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gainsmith/command_line.h"
#include "io/yaml/problem_yaml.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::app {

/// The methods that are built into the program.
io::MethodLibrary built_in_methods();

/// "--set NAME=VALUE" of a command that reads problems; `set` takes the texts.
Option set_option(std::vector<std::string>& set);

/// Reads a problem file, sets values and adds what the command line says of it, and binds it: all
/// that can be checked without solving is checked. `set`: "NAME=VALUE".
model::Instance load_problem(const std::filesystem::path& path,
                             const std::vector<std::string>& set = {},
                             const std::function<void(model::Problem&)>& add = {});

/// Whether a file is what synth writes, or was: it need not be whole. Standard input and pipes
/// are none.
bool is_gain_file(const std::filesystem::path& path);

/// What `--effort` says of a problem, for load_problem().
std::function<void(model::Problem&)> effort(const std::string& word);

/// InputError when problem or method say why nothing is simulated, or not for how long.
void refuse_without_campaign(const model::Design& design, const std::string& file);

/// A gain file with the problem that it states.
struct LoadedGains {
  model::Gains gains;
  model::Instance stated;
};

/// One of several designs that are laid side by side; of a single one without a name.
struct NamedDesign {
  std::string name;
  LoadedGains loaded;

  /// "a: x" of x.
  std::string label(const std::string& of) const { return name.empty() ? of : name + ": " + of; }
};

/// Reads a gain file, not the problem in it. InputError for what is no gain file.
model::Gains read_gains(const std::filesystem::path& path);

/// InputError for what is no gain file, and for one without gains: its verdict is no, or undecided.
LoadedGains load_gains(const std::filesystem::path& path);

/// The same, or a problem file whose gains are formulas: they are evaluated. InputError for one
/// whose gains must be searched, and for values to be set in a gain file.
LoadedGains load_run(const std::filesystem::path& path, const std::vector<std::string>& set = {});

/// A gain file, or a problem file, whose gains are synthesized: without a solution they have no
/// values. InputError for values to be set in a gain file.
LoadedGains load_designed(const std::filesystem::path& path,
                          const std::vector<std::string>& set = {});

}  // namespace gainsmith::app
