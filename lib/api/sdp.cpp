// Semidefinite programs by the solver of the room sdp: its structures copied to those of the
// library.
#include <string>
#include <utility>

#include "api/call.h"
#include "sdp/solver.h"

namespace gainsmith::api {

namespace {

sdp::Problem problem_of(const Sdp& program) {
  sdp::Problem problem;
  for (const Sdp::Block& block : program.blocks)
    problem.blocks.push_back({block.size, block.diagonal});
  problem.c = program.costs;
  problem.f.resize(program.costs.size() + 1);
  for (const Sdp::Entry& entry : program.entries) {
    if (entry.matrix < 0 || entry.matrix > problem.m())
      throw Error("an entry of the matrix " + std::to_string(entry.matrix) + ": there are 0 to " +
                      std::to_string(problem.m()),
                  "", 0, 0);
    problem.f[static_cast<std::size_t>(entry.matrix)].push_back(
        {entry.block, entry.row, entry.column, entry.value});
  }
  return problem;
}

std::vector<Matrix> blocks_of(const Sdp& program, const sdp::BlockMatrix& matrix) {
  std::vector<Matrix> blocks;
  for (std::size_t b = 0; b < matrix.values.size(); ++b) {
    const Sdp::Block& block = program.blocks[b];
    blocks.push_back({block.size, block.diagonal ? 1 : block.size, matrix.values[b]});
  }
  return blocks;
}

SdpStatus status_of(sdp::Status status) {
  switch (status) {
    case sdp::Status::optimal:
      return SdpStatus::optimal;
    case sdp::Status::primal_infeasible:
      return SdpStatus::primal_infeasible;
    case sdp::Status::dual_infeasible:
      return SdpStatus::dual_infeasible;
    case sdp::Status::undecided:
      break;
  }
  return SdpStatus::undecided;
}

}  // namespace

SdpSolution solve(const Sdp& program, const SdpOptions& options) {
  sdp::Options wanted;
  wanted.tolerance = options.tolerance;
  wanted.precision = options.precision;
  wanted.threads = options.threads;
  sdp::Solution found = call([&] { return sdp::solve(problem_of(program), wanted); });
  SdpSolution solution;
  solution.status = status_of(found.status);
  solution.message = std::move(found.message);
  solution.X = blocks_of(program, found.X);
  solution.Y = blocks_of(program, found.Y);
  solution.x = std::move(found.x);
  solution.primal_objective = found.primal_objective;
  solution.dual_objective = found.dual_objective;
  solution.relative_gap = found.relative_gap;
  solution.dimacs_errors = found.dimacs;
  solution.iterations = found.iterations;
  solution.precision = std::move(found.precision);
  return solution;
}

}  // namespace gainsmith::api
