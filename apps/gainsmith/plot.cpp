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
#include "gainsmith/presentation.h"
#include "gainsmith/several_designs.h"
#include "gainsmith/system_figures.h"
#include "gainsmith/terminal.h"

namespace gainsmith::app {

namespace {

struct PlotOptions {
  std::vector<std::string> files;
  Presentation presentation;
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
  for (const SystemResult& result : results) {
    files.push_back(output.empty() ? "" : file_of(output, result.name, results.size() == 1));
    if (!output.empty() && std::count(files.begin(), files.end(), files.back()) > 1)
      throw InputError({"--output"}, "two pictures would be " + files.back() +
                                         ": give the figures other names, or one with --figure");
  }
  return files;
}

std::vector<NamedDesign> designs_of(const PlotOptions& options) {
  std::vector<NamedDesign> designs;
  const std::vector<std::string> names = names_of_files(options.files);
  for (std::size_t k = 0; k < options.files.size(); ++k)
    designs.push_back(
        {options.files.size() == 1 ? "" : names[k], load_designed(options.files[k], options.set)});
  return designs;
}

ExitCode plot(const PlotOptions& options) {
  check_picture_name(options.output, "--output");
  if (!options.presentation.empty() && options.output.empty())
    throw InputError({options.files.front()},
                     "--title, --size, --window and --name are about a picture: give -o FILE");
  for (const std::string& file : options.files) prepare_outputs(file, {options.output});
  const std::vector<NamedDesign> designs = designs_of(options);
  if (designs.front().loaded.stated.design->pictures.empty())
    throw InputError({options.files.front()},
                     "the problem asks for no pictures of linear systems: figures: {loop: {bode: "
                     "\"tf(1, [1, 2, 1])\"}}");
  std::vector<SystemResult> results = system_results(designs, options.figures);
  std::vector<drawing::Figure*> figures;
  for (SystemResult& result : results) figures.push_back(&result.figure);
  if (!options.presentation.title.empty() && results.size() > 1 && options.figures.size() != 1)
    throw InputError({"--title"}, "of several pictures each has its own: choose one with --figure");
  present(options.presentation, figures);
  const std::vector<std::string> files = files_of(options.output, results);
  const Telling telling;
  ExitCode exit = ExitCode::yes;
  std::string text;
  io::Json document = io::Json::array();
  for (std::size_t k = 0; k < results.size(); ++k) {
    const SystemResult& result = results[k];
    io::Json entry = result.data;
    entry["facts"] = result.facts;
    text += result.name + "\n";
    for (const std::string& fact : result.facts) text += "  " + fact + "\n";
    if (!result.missing.empty()) {
      text += "  no picture: " + result.missing + "\n";
      exit = ExitCode::undecided;
    } else if (!options.output.empty()) {
      write_picture(files[k], drawing::svg(result.figure));
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
  Command command{
      "plot",
      "Draw Bode, Nyquist, step and pole pictures of the systems under figures:, with margins and "
      "peaks",
      {Option("files", options->files,
              "problem file (YAML), whose gains are then synthesized, or gain file (JSON); several "
              "are drawn over each other")
           .required(),
       set_option(options->set),
       Option("--figure", options->figures, "this figure alone; may be given again").named("NAME"),
       Option("-o,--output", options->output,
              "write the picture here (.svg, .pdf, .png); of several figures FILE-NAME.svg"),
       Option("--json", options->json, "print curves and numbers as JSON")},
      "Exit code: 0, 2 wrong input, 3 a figure uses a gain that has no value.\n"
      "Examples:\n"
      "  gainsmith plot problem.yaml\n"
      "  gainsmith plot gains.json --figure loop -o loop.pdf --size 600x400\n"
      "  gainsmith plot slow.json fast.json -o both.svg",
      [options] { return plot(*options); }};
  for (const Option& option : presentation_options(options->presentation, false))
    command.options.push_back(option);
  return command;
}

}  // namespace gainsmith::app
