#include "gainsmith/problem_shares.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "io/json/json_reader.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

/// The time that an earlier run of a problem took, if its folder says so.
std::optional<double> seconds_of(const fs::path& folder) {
  const fs::path file = folder / "result.json";
  std::error_code none;
  if (!fs::exists(file, none)) return std::nullopt;
  const io::Json document = io::parse_json(read_text(file), file.string());
  return io::JsonReader(document, file.string()).at("timings").at("total").number();
}

std::vector<double> seconds_of(const std::vector<ProblemFile>& all, const fs::path& times) {
  std::vector<std::optional<double>> known;
  double sum = 0;
  std::size_t count = 0;
  for (const ProblemFile& problem : all) {
    known.push_back(seconds_of(times / problem.name));
    if (!known.back()) continue;
    sum += *known.back();
    ++count;
  }
  if (count == 0)
    throw InputError({times.string()}, "no results of these problems; 'gainsmith run' makes them");
  std::vector<double> seconds;
  for (const auto& one : known) seconds.push_back(one.value_or(sum / static_cast<double>(count)));
  return seconds;
}

}  // namespace

std::vector<std::vector<std::size_t>> balanced_shares(const std::vector<double>& seconds,
                                                      std::size_t shares) {
  std::vector<std::size_t> longest_first(seconds.size());
  std::iota(longest_first.begin(), longest_first.end(), std::size_t{0});
  std::stable_sort(longest_first.begin(), longest_first.end(),
                   [&](std::size_t a, std::size_t b) { return seconds[a] > seconds[b]; });
  std::vector<std::vector<std::size_t>> made(shares);
  std::vector<double> sums(shares, 0.0);
  for (const std::size_t k : longest_first) {
    const auto least = std::min_element(sums.begin(), sums.end());
    *least += seconds[k];
    made[static_cast<std::size_t>(least - sums.begin())].push_back(k);
  }
  for (auto& share : made) std::sort(share.begin(), share.end());
  return made;
}

std::vector<ProblemFile> problems_of_shard(const std::vector<ProblemFile>& all, const Shard& shard,
                                           const fs::path& times) {
  std::vector<ProblemFile> own;
  if (times.empty()) {
    for (std::size_t k = shard.index - 1; k < all.size(); k += shard.of) own.push_back(all[k]);
    return own;
  }
  const auto shares = balanced_shares(seconds_of(all, times), shard.of);
  for (const std::size_t k : shares[shard.index - 1]) own.push_back(all[k]);
  return own;
}

}  // namespace gainsmith::app
