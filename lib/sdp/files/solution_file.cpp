#include "sdp/files/solution_file.h"

#include <cstddef>

#include "base/number.h"
#include "base/words.h"

namespace gainsmith::sdp {
namespace {

/// One line an element of the upper triangles that is not 0, indices from 1.
void append_entries(const Problem& problem, const BlockMatrix& matrix, int number,
                    std::string& text) {
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const auto n = static_cast<std::size_t>(problem.blocks[b].size);
    const auto line = [&](std::size_t i, std::size_t j, double value) {
      if (value == 0) return;
      text += std::to_string(number) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(i + 1) +
              ' ' + std::to_string(j + 1) + ' ' + decimal17(value) + '\n';
    };
    for (std::size_t j = 0; j < n; ++j) {
      if (problem.blocks[b].diagonal) {
        line(j, j, matrix.values[b][j]);
        continue;
      }
      for (std::size_t i = 0; i <= j; ++i) line(i, j, matrix.values[b][i + n * j]);
    }
  }
}

/// {a,b,c}
std::string braced(const double* first, std::size_t count, std::size_t stride) {
  std::string text = "{";
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    text += decimal17(first[i * stride]);
  }
  return text + "}";
}

/// All blocks of a matrix, full rows, in SDPA's braces.
std::string braced(const Problem& problem, const BlockMatrix& matrix) {
  std::string text = "{\n";
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const auto n = static_cast<std::size_t>(problem.blocks[b].size);
    const double* values = matrix.values[b].data();
    if (problem.blocks[b].diagonal) {
      text += braced(values, n, 1) + "\n";
      continue;
    }
    for (std::size_t i = 0; i < n; ++i)
      text += (i == 0 ? "{ " : "  ") + braced(values + i, n, n) + (i + 1 == n ? " }\n" : ",\n");
  }
  return text + "}\n";
}

/// The word that SDPA has for a status.
std::string phase(Status status) {
  return word_of<Status::undecided>(status, {"pdOPT", "pINF_dFEAS", "pFEAS_dINF", "noINFO"});
}

}  // namespace

std::string csdp_solution(const Problem& problem, const Solution& solution) {
  std::string text;
  for (std::size_t i = 0; i < solution.x.size(); ++i)
    text += (i > 0 ? " " : "") + decimal17(solution.x[i]);
  text += '\n';
  append_entries(problem, solution.X, 1, text);
  append_entries(problem, solution.Y, 2, text);
  return text;
}

std::string sdpa_solution(const Problem& problem, const Solution& solution) {
  return "phase.value  = " + phase(solution.status) +
         "\nobjValPrimal = " + decimal17(solution.primal_objective) +
         "\nobjValDual   = " + decimal17(solution.dual_objective) + "\nxVec = \n" +
         braced(solution.x.data(), solution.x.size(), 1) + "\nxMat = \n" +
         braced(problem, solution.X) + "yMat = \n" + braced(problem, solution.Y);
}

}  // namespace gainsmith::sdp
