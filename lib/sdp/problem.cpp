#include "sdp/problem.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace gainsmith::sdp {
namespace {

void fail(std::size_t i, const std::string& what) {
  throw std::invalid_argument("sdp: F_" + std::to_string(i) + ": " + what);
}

void validate_entry(const Problem& problem, std::size_t i, const Entry& e) {
  if (e.block < 0 || e.block >= static_cast<int>(problem.blocks.size()))
    fail(i, "block " + std::to_string(e.block) + " does not exist");
  const Block& block = problem.blocks[static_cast<std::size_t>(e.block)];
  if (e.row < 0 || e.column >= block.size) fail(i, "an index is outside of its block");
  if (e.row > e.column) fail(i, "an entry is below the diagonal");
  if (block.diagonal && e.row != e.column) fail(i, "a diagonal block has an off-diagonal entry");
  if (!std::isfinite(e.value)) fail(i, "an entry is not finite");
  if (e.finer < 0 || e.finer > std::ssize(problem.finer)) fail(i, "an entry has no finer part");
}

}  // namespace

void validate(const Problem& problem) {
  if (problem.f.size() != problem.c.size() + 1)
    throw std::invalid_argument("sdp: " + std::to_string(problem.c.size()) + " costs need " +
                                std::to_string(problem.c.size() + 1) + " matrices, not " +
                                std::to_string(problem.f.size()));
  if (!problem.c_rest.empty() && problem.c_rest.size() != problem.c.size())
    throw std::invalid_argument("sdp: c_rest needs as many entries as c, or none");
  for (const double c : problem.c)
    if (!std::isfinite(c)) throw std::invalid_argument("sdp: a cost is not finite");
  for (const Block& block : problem.blocks)
    if (block.size < 1) throw std::invalid_argument("sdp: a block has no rows");
  for (std::size_t i = 0; i < problem.f.size(); ++i)
    for (const Entry& e : problem.f[i]) validate_entry(problem, i, e);
}

}  // namespace gainsmith::sdp
