// verdict_generator [--seed S] [--count N] [--from I] [--family F] [--threads N] [--folder DIR]
//
// N problems with known answers, from case I on; the counts of right, undecided and wrong ones by
// family, and each problem that was not answered as a file in DIR. F is a family, "edges" for
// those with thin, far or singular sets of solutions, "ordinary" for the others, "all" for both.
// The last line is "W wrong, U undecided, R right of N". Exit code 1: one is wrong, or an easy one
// undecided. The long run:
//
//   cmake --build --preset release --target verdict_generator
//   build/release/tests/properties/verdict_generator --count 20000 --threads 2 --folder left-over
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>

#include "base/parallel.h"
#include "properties/judge.h"

namespace {

using namespace gainsmith;
using namespace gainsmith::tests::properties;

struct Count {
  int right = 0, undecided = 0, wrong = 0, easy_undecided = 0;
  double seconds = 0, slowest = 0;
};

struct Request {
  std::uint64_t seed = 1;
  std::uint64_t from = 0;
  std::size_t count = 1000;
  std::string family = "all";
  std::string folder;
  unsigned threads = 1;
};

void add(const Case& known, const Answer& answer, Count& count) {
  count.right += answer.outcome == Outcome::right;
  count.wrong += answer.outcome == Outcome::wrong;
  count.undecided += answer.outcome == Outcome::undecided;
  count.easy_undecided += answer.outcome == Outcome::undecided && known.easy;
  count.seconds += answer.seconds;
  count.slowest = std::max(count.slowest, answer.seconds);
}

void keep(const Request& request, std::uint64_t index, const Case& known, const Answer& answer) {
  if (answer.outcome == Outcome::right) return;
  const std::string name =
      fmt::format("{}-{}-{}-{}.yaml", answer.outcome == Outcome::wrong ? "wrong" : "undecided",
                  known.family, request.seed, index);
  if (!request.folder.empty())
    std::ofstream(std::filesystem::path(request.folder) / name) << record(known, answer);
  fmt::print("{}: {}{}\n", name, known.easy ? "EASY, " : "", answer.message);
  std::fflush(stdout);
}

std::map<std::string, Count> run(const Request& request) {
  std::map<std::string, Count> counts;
  std::mutex mutex;
  parallel_for(request.count, request.threads, [&](std::size_t k) {
    const std::uint64_t index = request.from + k;
    const Case known =
        make_case(request.seed, index, request.family == "ordinary" ? "" : request.family);
    const Answer answer = judge(known);
    const std::scoped_lock lock(mutex);
    add(known, answer, counts[known.family]);
    keep(request, index, known, answer);
  });
  return counts;
}

void print(const std::string& name, const Count& count) {
  fmt::print("{:20} {:7} {:9} {:6} {:15} {:9.3f} {:9.2f}\n", name, count.right, count.undecided,
             count.wrong, count.easy_undecided,
             count.seconds / std::max(1, count.right + count.undecided + count.wrong),
             count.slowest);
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Problems with known answers");
  app.add_option("--seed", request.seed);
  app.add_option("--count", request.count);
  app.add_option("--from", request.from);
  app.add_option("--family", request.family);
  app.add_option("--threads", request.threads);
  app.add_option("--folder", request.folder);
  CLI11_PARSE(app, argc, argv);
  if (!request.folder.empty()) std::filesystem::create_directories(request.folder);
  const auto counts = run(request);
  fmt::print("{:20} {:>7} {:>9} {:>6} {:>15} {:>9} {:>9}\n", "family", "right", "undecided",
             "wrong", "easy undecided", "seconds", "slowest");
  Count whole;
  for (const auto& [name, count] : counts) {
    print(name, count);
    whole.right += count.right;
    whole.undecided += count.undecided;
    whole.wrong += count.wrong;
    whole.easy_undecided += count.easy_undecided;
    whole.seconds += count.seconds;
    whole.slowest = std::max(whole.slowest, count.slowest);
  }
  print("all", whole);
  fmt::print("{} wrong, {} undecided, {} right of {}\n", whole.wrong, whole.undecided, whole.right,
             whole.wrong + whole.undecided + whole.right);
  return whole.wrong > 0 || whole.easy_undecided > 0 ? 1 : 0;
}
