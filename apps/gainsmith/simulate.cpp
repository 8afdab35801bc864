#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/file.h"
#include "base/number.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/terminal.h"
#include "io/csv.h"
#include "io/json_text.h"
#include "verify/replay.h"

namespace gainsmith::app {

namespace {

struct SimulateOptions {
  std::string gains;
  std::uint64_t run = 0;
  std::optional<std::uint64_t> seed;
  std::string output;
  bool json = false;
};

io::Json replay_json(const verify::Replay& replay) {
  io::Json rows = io::Json::array();
  for (Eigen::Index i = 0; i < replay.table.rows(); ++i) {
    io::Json row = io::Json::array();
    for (Eigen::Index j = 0; j < replay.table.cols(); ++j)
      row.push_back(io::finite_or_null(replay.table(i, j)));
    rows.push_back(std::move(row));
  }
  io::Json document = {{"termination", to_string(replay.arc.termination)}};
  if (!replay.arc.message.empty()) document["message"] = replay.arc.message;
  document["columns"] = replay.columns;
  document["rows"] = rows;
  return document;
}

ExitCode simulate(const SimulateOptions& options) {
  refuse_overwriting(options.gains, {options.output});
  const LoadedGains loaded = load_gains(options.gains);
  const std::uint64_t seed = options.seed.value_or(loaded.stated.design->campaign.seed);
  const verify::Replay replay = verify::replay(loaded.stated, loaded.gains, seed, options.run);
  const std::string text =
      options.json ? io::to_text(replay_json(replay)) : io::to_csv(replay.columns, replay.table);
  if (options.output.empty() || options.output == "-") {
    fmt::print("{}", text);
  } else {
    write_atomically(options.output, text);
  }
  say(fmt::format("run {} of seed {}: {} samples, {} jumps, ended by: {}\n", options.run, seed,
                  replay.arc.samples(), replay.arc.j.back(), to_string(replay.arc.termination)));
  if (!replay.arc.message.empty()) say("  " + replay.arc.message + "\n");
  for (const verify::ReplayedClaim& claim : replay.claims)
    say(fmt::format("  {:<12} {}: {} against {} at (t, j) = ({}, {})\n", claim.name,
                    to_string(claim.finding.judgement), brief(claim.finding.value),
                    brief(claim.finding.bound), brief(claim.finding.t), claim.finding.j));
  return ExitCode::yes;
}

}  // namespace

Command simulate_command() {
  auto options = std::make_shared<SimulateOptions>();
  return {
      "simulate",
      "Replay one run of a campaign as CSV",
      {Option("gains", options->gains, "gain file (JSON)").required(),
       Option("--run", options->run, "the run's number"),
       Option("--seed", options->seed, "seed of the campaign (default: the problem's)"),
       Option("-o,--output", options->output, "write the table here (default: standard output)"),
       Option("--json", options->json, "write JSON instead of CSV")},
      "Columns: t, j, the timer, the states, the signals, then the value of each claim.\n"
      "Example:\n"
      "  gainsmith simulate gains.json --run 17 -o run-17.csv",
      [options] { return simulate(*options); }};
}

}  // namespace gainsmith::app
