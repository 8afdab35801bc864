// A semidefinite program, gains from the text of a problem, and the gain file that they make.
#include <gainsmith/gainsmith.h>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace gs = gainsmith::api;

namespace {

/// The least t with [t, 1; 1, t] >= 0: that is 1.
double least_t() {
  gs::Sdp program;
  program.blocks = {{2}};
  program.costs = {1};
  program.entries = {{0, 0, 0, 1, -1}, {1, 0, 0, 0, 1}, {1, 0, 1, 1, 1}};
  const gs::SdpSolution solution = gs::solve(program);
  return solution.status == gs::SdpStatus::optimal ? solution.x[0] : -1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::printf("least t = %.6f\n", least_t());
  std::ifstream file(argv[1]);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  try {
    const gs::Gains found = gs::synthesize(text, argv[1]);
    if (found.verdict != gs::Verdict::yes) return 1;
    const gs::Gains read = gs::read_gains(found.text, "gains.json");
    for (const auto& [name, gain] : read.gains)
      for (int row = 0; row < gain.rows; ++row)
        for (int column = 0; column < gain.columns; ++column)
          std::printf("%s(%d, %d) = %.3f\n", name.c_str(), row + 1, column + 1, gain(row, column));
    for (const gs::Margin& margin : read.margins)
      std::printf("%s holds: %s\n", margin.name.c_str(), margin.holds ? "yes" : "no");
  } catch (const gs::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
