#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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

/// Of each picture; InputError where two would be one file.
std::vector<std::string> files_of(const std::string& output,
                                  const std::vector<SystemResult>& results) {
  std::vector<std::string> files;
  for (const SystemResult& one : results) {
    files.push_back(output.empty() ? "" : file_of(output, one.name, results.size() == 1));
    if (!output.empty() && std::count(files.begin(), files.end(), files.back()) > 1)
      throw InputError({"--output"}, "two pictures would be " + files.back() +
                                         ": give the figures other names, or one with --figure");
  }
  return files;
}

ExitCode plot(const PlotOptions& options) {
  check_picture_name(options.output, "--output");
  prepare_outputs(options.file, {options.output});
  const LoadedGains loaded = load_designed(options.file, options.set);
  if (loaded.stated.design->pictures.empty())
    throw InputError({options.file},
                     "the problem asks for no pictures of linear systems: figures: {loop: {bode: "
                     "\"tf(1, [1, 2, 1])\"}}");
  const std::vector<SystemResult> results = system_results(loaded, options.figures);
  const std::vector<std::string> files = files_of(options.output, results);
  const Telling telling;
  ExitCode exit = ExitCode::yes;
  std::string text;
  io::Json document = io::Json::array();
  for (std::size_t k = 0; k < results.size(); ++k) {
    const SystemResult& one = results[k];
    io::Json entry = one.data;
    entry["facts"] = one.facts;
    text += one.name + "\n";
    for (const std::string& fact : one.facts) text += "  " + fact + "\n";
    if (!one.missing.empty()) {
      text += "  no picture: " + one.missing + "\n";
      exit = ExitCode::undecided;
    } else if (!options.output.empty()) {
      write_picture(files[k], one.svg);
      entry["file"] = files[k];
      text += "  wrote " + files[k] + "\n";
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
