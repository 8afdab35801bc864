#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/number.h"
#include "gainsmith/commands.h"
#include "gainsmith/output.h"
#include "gainsmith/terminal.h"
#include "io/json/json_text.h"
#include "sdp/files/sdpa_file.h"
#include "sdp/files/solution_file.h"
#include "sdp/solver.h"

namespace gainsmith::app {

namespace {

struct SolveOptions {
  std::string file;
  std::string output;
  std::string format = "json";
  bool json = false;
  bool quiet = false;
  sdp::Options solver;
};

ExitCode exit_of_solution(sdp::Status status) {
  switch (status) {
    case sdp::Status::optimal:
      return ExitCode::yes;
    case sdp::Status::primal_infeasible:
    case sdp::Status::dual_infeasible:
      return ExitCode::no;
    case sdp::Status::undecided:
      break;
  }
  return ExitCode::undecided;
}

void print_iteration(const sdp::Progress& line) {
  if (line.iteration == 0)
    say(fmt::format("{:>4} {:>18} {:>18} {:>9} {:>9} {:>9} {:>6} {:>6}  {}\n", "iter", "primal",
                    "dual", "gap", "p.infeas", "d.infeas", "p.step", "d.step", "arithmetic"));
  say(fmt::format("{:>4} {:>18.10e} {:>18.10e} {:>9.2e} {:>9.2e} {:>9.2e} {:>6.3f} {:>6.3f}  {}\n",
                  line.iteration, line.primal_objective, line.dual_objective, line.relative_gap,
                  line.primal_infeasibility, line.dual_infeasibility, line.step_primal,
                  line.step_dual, line.precision));
}

io::Json certificate_json(const sdp::Certificate& certificate) {
  return {{"checked", certificate.checked},
          {"value", certificate.value},
          {"residual", certificate.residual},
          {"min_eigenvalue", certificate.min_eigenvalue},
          {"excluded_radius", io::finite_or_null(certificate.excluded_radius)}};
}

std::string json_text(const sdp::Solution& solution) {
  io::Json document = {{"status", to_string(solution.status)},
                       {"cause", to_string(solution.cause)},
                       {"message", solution.message},
                       {"primal_objective", solution.primal_objective},
                       {"dual_objective", solution.dual_objective},
                       {"relative_gap", solution.relative_gap},
                       {"primal_infeasibility", solution.dimacs[2]},
                       {"dual_infeasibility", solution.dimacs[0]},
                       {"dimacs_errors", solution.dimacs},
                       {"iterations", solution.iterations},
                       {"precision", solution.precision},
                       {"precision_reason", solution.precision_reason}};
  if (solution.certificate.checked)
    document["certificate"] = certificate_json(solution.certificate);
  document["seconds"] = solution.seconds;
  return io::to_text(document);
}

/// A block matrix as a list of blocks: a list of rows, or of diagonal elements.
io::Json matrix_json(const sdp::Problem& problem, const sdp::BlockMatrix& matrix) {
  io::Json blocks = io::Json::array();
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const std::vector<double>& values = matrix.values[b];
    if (problem.blocks[b].diagonal) {
      blocks.push_back(values);
      continue;
    }
    const auto n = static_cast<std::ptrdiff_t>(problem.blocks[b].size);
    io::Json rows = io::Json::array();
    for (auto row = values.begin(); row != values.end(); row += n)
      rows.push_back(std::vector<double>(row, row + n));
    blocks.push_back(std::move(rows));
  }
  return blocks;
}

/// The point itself: of an infeasible problem the certificate.
std::string solution_text(const sdp::Problem& problem, const sdp::Solution& solution,
                          const std::string& format) {
  if (format == "csdp") return sdp::csdp_solution(problem, solution);
  if (format == "sdpa") return sdp::sdpa_solution(problem, solution);
  return io::to_text({{"status", to_string(solution.status)},
                      {"x", solution.x},
                      {"X", matrix_json(problem, solution.X)},
                      {"Y", matrix_json(problem, solution.Y)}});
}

std::string summary(const sdp::Solution& solution) {
  std::string text = fmt::format("status            {} ({})\n", to_string(solution.status),
                                 to_string(solution.cause));
  if (!solution.message.empty()) text += fmt::format("                  {}\n", solution.message);
  if (solution.certificate.checked) {
    const bool primal = solution.status == sdp::Status::primal_infeasible;
    const sdp::Certificate& certificate = solution.certificate;
    text += fmt::format(
        "certificate       checked on the raw data: {} = {}, {} = {}, smallest eigenvalue of {} "
        "{}\n",
        primal ? "F_0.Y" : "-c'x", brief(certificate.value), primal ? "sum |F_i.Y|" : "defect",
        brief(certificate.residual, 3), primal ? "Y" : "sum x_i F_i",
        brief(certificate.min_eigenvalue, 3));
    const char* side = primal ? "primal" : "dual";
    const double radius = certificate.excluded_radius;
    text += std::isfinite(radius)
                ? fmt::format("                  every {} solution has {} above {}\n", side,
                              primal ? "an |x_i|" : "a trace", brief(radius, 3))
                : fmt::format("                  no {} solution of any size\n", side);
  } else {
    text += fmt::format(
        "primal objective  {:.15e}\ndual objective    {:.15e}\nrelative gap      {:.2e}\n",
        solution.primal_objective, solution.dual_objective, solution.relative_gap);
    text += fmt::format("DIMACS errors     {:.2e}\n", fmt::join(solution.dimacs, " "));
  }
  text += fmt::format("iterations        {} ({}{}{})\n", solution.iterations, solution.precision,
                      solution.precision_reason.empty() ? "" : ": ", solution.precision_reason);
  return text + fmt::format("seconds           {:.3f}\n", solution.seconds);
}

/// What is wrong with a value of --precision; empty when nothing is.
std::string precision_error(const std::string& text) {
  constexpr int kMostDigits = 100;
  int digits = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), digits);
  const bool number = end.ec == std::errc() && end.ptr == text.data() + text.size() &&
                      digits >= 1 && digits <= kMostDigits;
  if (number || text == "auto" || text == "double" || text == "quad") return {};
  return "expected auto, double, quad or a number of digits from 1 to 100, not '" + text + "'";
}

ExitCode solve(SolveOptions options) {
  prepare_outputs(options.file, {options.output});
  const sdp::Problem problem = sdp::read_sdpa(read_text(options.file), options.file);
  if (!options.quiet && !options.json && is_terminal()) options.solver.progress = print_iteration;
  const sdp::Solution solution = sdp::solve(problem, options.solver);
  const Telling telling;
  const bool to_stdout = options.output == "-";
  if (!options.output.empty()) {
    const std::string text = solution_text(problem, solution, options.format);
    if (to_stdout) {
      fmt::print("{}", text);
    } else {
      write_atomically(options.output, text);
    }
  }
  print_report(options.json ? json_text(solution) : summary(solution), to_stdout);
  return exit_of_solution(solution.status);
}

}  // namespace

Command solve_command() {
  auto options = std::make_shared<SolveOptions>();
  sdp::Options& solver = options->solver;
  return {
      "solve",
      "Solve a semidefinite program in SDPA sparse format",
      {Option("file", options->file, "SDPA sparse file (.dat-s); - for standard input").required(),
       Option("--json", options->json, "print the result as JSON"),
       Option("-q,--quiet", options->quiet, "no progress table"),
       Option("-o,--output", options->output, "write x, X and Y here; - for standard output"),
       Option("--format", options->format, "layout of that file: json, csdp or sdpa")
           .one_of({"json", "csdp", "sdpa"}),
       Option("--precision", solver.precision,
              "auto (double, then more digits where double stalls), double, quad or digits")
           .checked(precision_error),
       Option("--tolerance", solver.tolerance, "relative gap and DIMACS errors for 'optimal'")
           .within(1e-30, 1e-2),
       Option("--iterations", solver.iteration_limit, "most iterations").within(1, 100000),
       Option("--threads", solver.threads, "threads; results do not depend on it").within(1, 1024)},
      "Exit code: 0 optimal, 1 infeasible by a checked certificate, 2 wrong input, 3 undecided.\n"
      "Examples:\n"
      "  gainsmith solve control1.dat-s --json\n"
      "  gainsmith solve hinf2.dat-s --precision quad -o hinf2.sol --format csdp\n"
      "  gainsmith synth problem.yaml --sdpa problem.dat-s && gainsmith solve problem.dat-s",
      [options] { return solve(*options); }};
}

}  // namespace gainsmith::app
