#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/nearest.h"
#include "base/number.h"
#include "bind/stated.h"
#include "design/single_precision.h"
#include "export/files.h"
#include "export/identifiers.h"
#include "gainsmith/commands.h"
#include "gainsmith/gain_check.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/run_figure.h"
#include "gainsmith/terminal.h"
#include "io/json/gains_json.h"
#include "model/names.h"
#include "model/stated_file.h"

namespace gainsmith::app {

namespace {

struct ExportOptions {
  std::string gains;
  std::string target;
  std::string output;
  bool single = false;
};

const std::vector<std::string> kTargets = {"c", "matlab", "python", "json", "csv", "mat", "latex"};

std::string target_error(const std::string& word) {
  if (std::find(kTargets.begin(), kTargets.end(), word) != kTargets.end()) return {};
  return "unknown target '" + word + "'" + suggestion(word, kTargets);
}

/// "motor" of "build/motor.h"; the problem's name where the text goes to standard output.
std::string name_of(const ExportOptions& options, const model::Gains& gains) {
  const bool to_file = !options.output.empty() && options.output != "-";
  return to_file ? std::filesystem::path(options.output).stem().string() : gains.problem_name;
}

std::string json_file(const exports::Content& content,
                      const std::vector<exports::GainMatrix>& matrices) {
  io::Json gains = io::Json::object();
  for (const exports::GainMatrix& gain : matrices) gains[gain.name] = io::matrix_json(gain.value);
  return io::to_text({{"problem", content.problem},
                      {"method", content.method},
                      {"gainsmith", content.version},
                      {"gain_file_sha256", content.file_hash},
                      {"statement_sha256", content.statement_hash},
                      {"gains", std::move(gains)}});
}

/// One file a matrix: gains.csv gives gains-L.csv, gains-F.csv.
void write_csv(const ExportOptions& options, const std::vector<exports::GainMatrix>& matrices) {
  const std::filesystem::path path = options.output;
  for (const exports::GainMatrix& gain : matrices) {
    std::filesystem::path own = path;
    own.replace_filename(path.stem().string() + "-" + gain.name + path.extension().string());
    write_atomically(own, exports::csv_text(gain.value));
    say("wrote " + own.string() + "\n");
  }
}

/// The text of one file. What it has no form for is added to the notes.
std::string text_of_target(const ExportOptions& options, const std::string& name,
                           exports::Content& content) {
  if (options.target == "c") return exports::c_file(content, name);
  if (options.target == "matlab") return exports::matlab_file(content, name);
  if (options.target == "python") return exports::python_file(content, name);
  return {};
}

/// "gainsmith synth motor.yaml --set margin=1e-06 -o gains.json".
std::string synth_command_with(const design::SinglePrecisionRemedy& remedy,
                               const ExportOptions& options, const model::Gains& gains) {
  std::vector<model::Setting> settings = gains.statement.settings;
  std::erase_if(settings, [&](const auto& setting) { return setting.name == remedy.name; });
  settings.push_back({remedy.name, brief(remedy.value)});
  return "gainsmith synth " + model::problem_words(gains.statement.problem_file, settings) +
         " -o " + model::quoted(options.gains);
}

/// What to do where gains do not hold at single precision.
void advise(const ExportOptions& options, const LoadedGains& loaded) {
  if (loaded.gains.search) {
    say("the gains lie where a search ended: fix what was searched at a value that asks for "
        "less\n");
    return;
  }
  const auto remedy = design::remedy_at_single(loaded.stated, loaded.gains, {});
  if (!remedy) {
    say("neither a larger margin nor a smaller gain_bound gives gains that hold there: ask for "
        "less, or export without --float\n");
    return;
  }
  std::string price;
  if (remedy->objective && loaded.gains.objective)
    price = fmt::format(" (objective {} instead of {})", brief(*remedy->objective),
                        brief(*loaded.gains.objective));
  say(fmt::format("a {} gives gains that hold there{}:\n  {}\n",
                  remedy->name == model::kGainBound ? "smaller gain_bound" : "larger margin", price,
                  synth_command_with(*remedy, options, loaded.gains)));
}

/// The gains at single precision, with the margins that were shown there; none after a word on what
/// was not shown.
std::optional<model::Gains> rounded(const ExportOptions& options, const LoadedGains& loaded,
                                    ExitCode& exit) {
  LoadedGains single{design::rounded_to_single(loaded.stated, loaded.gains), loaded.stated};
  const design::GainCheck check = check_gains(single);
  if (check.verdict == model::Verdict::yes) {
    single.gains.margins = check.margins;
    return std::move(single.gains);
  }
  const std::string which = not_shown_text(check);
  say(fmt::format("gainsmith: {}: at single precision {}{}{}; nothing is written\n",
                  loaded.gains.file,
                  check.verdict == model::Verdict::no ? "the inequalities do not hold"
                                                      : "the inequalities are not shown",
                  which.empty() ? "" : ": ", which));
  exit = exit_of(check.verdict);
  advise(options, loaded);
  return std::nullopt;
}

/// False, after a word on it, for gains whose file says yes and for which an inequality does not
/// hold: they were changed.
bool hold(const ExportOptions& options, const LoadedGains& loaded) {
  if (loaded.gains.verdict != model::Verdict::yes) return true;
  const design::GainCheck check = check_gains(loaded);
  if (check.verdict != model::Verdict::no) return true;
  const std::string which = not_shown_text(check);
  say(fmt::format(
      "gainsmith: {}: the inequalities do not hold at these gains{}{}; nothing is "
      "written ('gainsmith check {}' has the margins)\n",
      loaded.gains.file, which.empty() ? "" : ": ", which, model::quoted(options.gains)));
  return false;
}

void check_output(const ExportOptions& options) {
  const bool to_stdout = options.output.empty() || options.output == "-";
  if (to_stdout && (options.target == "csv" || options.target == "mat"))
    throw InputError({"-o"},
                     options.target == "csv"
                         ? "each matrix has a file of its own: -o gains.csv gives gains-L.csv"
                         : "a MAT-file is no text: -o gains.mat says where it goes");
  if (options.target == "matlab" && !to_stdout) {
    const std::string stem = std::filesystem::path(options.output).stem().string();
    if (exports::Identifiers(exports::Language::matlab)(stem) != stem)
      throw InputError({options.output},
                       "MATLAB calls a function by the name of its file, and '" + stem +
                           "' cannot be one: choose a name of letters, digits and "
                           "underscores, none of MATLAB's own");
  }
}

bool has_observer(const model::Design& design) {
  return design.dynamics &&
         std::any_of(design.dynamics->components.begin(), design.dynamics->components.end(),
                     [](const auto& one) { return one.observer; });
}

ExitCode export_gains(const ExportOptions& options) {
  check_output(options);
  prepare_outputs(options.gains, {options.output});
  LoadedGains loaded = load_gains(options.gains);
  const model::Design& design = *loaded.stated.design;
  if (design.gains.empty() && !has_observer(design))
    throw InputError({options.gains},
                     "there is nothing to export: the problem has no observer, and no gains; name "
                     "values under 'gains', as in gains: {xopt: x}");
  ExitCode exit = ExitCode::yes;
  if (options.single) {
    auto single = rounded(options, loaded, exit);
    if (!single) return exit;
    loaded.gains = std::move(*single);
  } else if (!hold(options, loaded)) {
    return ExitCode::no;
  }
  const model::Stated stated = bind::state(loaded.stated, loaded.gains);
  std::optional<model::RunTexts> texts;
  if (design.dynamics) texts = model::run_texts(design, stated);
  exports::Content content = exports::content_of(loaded.gains, design, stated, texts,
                                                 read_text(options.gains), view_of(design).units);
  content.single = options.single;
  const std::string name = name_of(options, loaded.gains);
  std::string text = text_of_target(options, name, content);
  const Telling telling;
  if (text.empty()) {
    content.notes.clear();
    const auto matrices = exports::matrices_of(loaded.gains, content.notes);
    if (matrices.empty() && options.target != "json")
      throw InputError({options.gains},
                       "no gain is a matrix, so there is nothing to write as " + options.target +
                           "; c, matlab and python have the maps of the observers");
    if (options.target == "csv") {
      write_csv(options, matrices);
    } else {
      text = options.target == "json"    ? json_file(content, matrices)
             : options.target == "latex" ? exports::latex_file(content, matrices)
                                         : exports::mat_file(matrices);
    }
  }
  for (const std::string& note : content.notes) say("note: " + note + "\n");
  if (text.empty()) return ExitCode::yes;
  if (options.output.empty() || options.output == "-") {
    fmt::print("{}", text);
  } else {
    write_atomically(options.output, text);
    say("wrote " + options.output + "\n");
  }
  return ExitCode::yes;
}

}  // namespace

Command export_command() {
  auto options = std::make_shared<ExportOptions>();
  return {"export",
          "Write the gains of a gain file as code or data",
          {Option("gains", options->gains, "gain file (JSON)").required(),
           Option("--to", options->target, "c, matlab, python, json, csv, mat or latex")
               .required()
               .checked(target_error)
               .suggests(kTargets),
           Option("-o,--output", options->output,
                  "write it here (default: standard output); its name is that of the code"),
           Option("--float", options->single,
                  "round the gains to single precision and show every inequality again there")},
          "C, MATLAB and Python have the maps of the observers too.\n"
          "Exit code: 0 written, 1 the inequalities do not hold at the gains, with --float at the "
          "rounded ones,\n"
          "2 wrong input, 3 with --float they are not shown; but for 0 nothing is written.\n"
          "Examples:\n"
          "  gainsmith export gains.json --to c -o observer.h\n"
          "  gainsmith export gains.json --to c --float -o observer.h\n"
          "  gainsmith export gains.json --to mat -o gains.mat",
          [options] { return export_gains(*options); }};
}

}  // namespace gainsmith::app
