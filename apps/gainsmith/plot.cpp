#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/nearest.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/picture_file.h"
#include "gainsmith/system_figures.h"
#include "gainsmith/terminal.h"

namespace gainsmith::app {

namespace {

struct PlotOptions {
  std::string file;
  std::vector<std::string> set;
  std::vector<std::string> figures;
  std::string output;
  bool json = false;
};

/// Those of --figure, in their order there; without it all.
std::vector<SystemResult> chosen(std::vector<SystemResult> all, const PlotOptions& options) {
  if (all.empty())
    throw InputError({options.file},
                     "the problem asks for no pictures of linear systems: figures: {loop: {bode: "
                     "\"tf(1, [1, 2, 1])\"}}");
  if (options.figures.empty()) return all;
  std::vector<std::string> names;
  for (const SystemResult& one : all) names.push_back(one.name);
  std::vector<SystemResult> found;
  for (const std::string& name : options.figures) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      throw InputError({"--figure"},
                       "the problem has no figure '" + name + "'" + suggestion(name, names));
    found.push_back(all[static_cast<std::size_t>(at - names.begin())]);
  }
  return found;
}

/// "loop.svg" of one picture; of several "loop-NAME.svg", names with what a file may hold alone.
std::string file_of(const std::string& output, const std::string& name, bool single) {
  if (single) return output;
  std::string part;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
                       static_cast<unsigned char>(c) >= 0x80;
    part += plain ? c : '-';
  }
  const std::filesystem::path path(output);
  return (path.parent_path() / (path.stem().string() + "-" + part + path.extension().string()))
      .string();
}

ExitCode plot(const PlotOptions& options) {
  check_picture_name(options.output, "--output");
  prepare_outputs(options.file, {options.output});
  const LoadedGains loaded = load_designed(options.file, options.set);
  const std::vector<SystemResult> results = chosen(system_results(loaded), options);
  const Telling telling;
  ExitCode exit = ExitCode::yes;
  std::string text;
  io::Json document = io::Json::array();
  for (const SystemResult& one : results) {
    io::Json entry = one.data;
    entry["facts"] = one.facts;
    text += one.name + "\n";
    for (const std::string& fact : one.facts) text += "  " + fact + "\n";
    if (!one.missing.empty()) {
      text += "  no picture: " + one.missing + "\n";
      exit = ExitCode::undecided;
    } else if (!options.output.empty()) {
      const std::string file = file_of(options.output, one.name, results.size() == 1);
      write_picture(file, one.svg);
      entry["file"] = file;
      text += "  wrote " + file + "\n";
    }
    document.push_back(std::move(entry));
  }
  if (options.json)
    fmt::print("{}", io::to_text(document));
  else
    print_report(text, false);
  return exit;
}

}  // namespace

Command plot_command() {
  auto options = std::make_shared<PlotOptions>();
  return {
      "plot",
      "Draw Bode, Nyquist, step and pole pictures of the systems under figures:, with margins and "
      "peaks",
      {Option("file", options->file,
              "problem file (YAML), whose gains are then synthesized, or gain file (JSON)")
           .required(),
       set_option(options->set),
       Option("--figure", options->figures, "this figure alone; may be given again").named("NAME"),
       Option("-o,--output", options->output,
              "write the picture here (.svg, .pdf, .png); of several figures FILE-NAME.svg"),
       Option("--json", options->json, "print curves and numbers as JSON")},
      "Exit code: 0, 2 wrong input, 3 a figure uses a gain that has no value.\n"
      "Examples:\n"
      "  gainsmith plot problem.yaml\n"
      "  gainsmith plot gains.json --figure loop -o loop.pdf",
      [options] { return plot(*options); }};
}

}  // namespace gainsmith::app
