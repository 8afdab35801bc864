#include "base/nearest.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <set>

namespace gainsmith {

namespace {

int substitution_cost(char a, char b) {
  if (a == b) return 0;
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return lower(a) == lower(b) ? 1 : 2;
}

/// The words of four letters or more of a name with hyphens or underscores.
std::set<std::string> words_of(std::string_view name) {
  // Shorter words, such as "of", are shared by chance.
  constexpr std::size_t kShortest = 4;
  std::set<std::string> words;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("-_ "), name.size());
    if (end >= kShortest) words.emplace(name.substr(0, end));
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return words;
}

}  // namespace

bool differs_in_case(std::string_view a, std::string_view b) {
  return a != b && std::equal(a.begin(), a.end(), b.begin(), b.end(),
                              [](char x, char y) { return substitution_cost(x, y) < 2; });
}

/// The table of the least costs of the beginnings, |a| + 1 by |b| + 1:
///   d(i,j) = min{ d(i-1,j) + 2, d(i,j-1) + 2, d(i-1,j-1) + s(a_i, b_j),
///                 d(i-2,j-2) + 2 if a_{i-1} a_i = b_j b_{j-1} }
int doubled_edit_distance(std::string_view a, std::string_view b) {
  const std::size_t rows = a.size() + 1;
  const std::size_t columns = b.size() + 1;
  std::vector<int> cost(rows * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> int& { return cost[i * columns + j]; };
  for (std::size_t i = 0; i < rows; ++i) at(i, 0) = 2 * static_cast<int>(i);
  for (std::size_t j = 0; j < columns; ++j) at(0, j) = 2 * static_cast<int>(j);
  for (std::size_t i = 1; i < rows; ++i) {
    for (std::size_t j = 1; j < columns; ++j) {
      int best = std::min({at(i - 1, j) + 2, at(i, j - 1) + 2,
                           at(i - 1, j - 1) + substitution_cost(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        best = std::min(best, at(i - 2, j - 2) + 2);
      at(i, j) = best;
    }
  }
  return at(rows - 1, columns - 1);
}

std::optional<std::string> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  const int allowed = 2 * std::max(1, static_cast<int>(word.size()) / 3);
  std::optional<std::string> best;
  int best_distance = allowed + 1;
  const bool is_full = word.find('.') != std::string_view::npos;
  for (const std::string& candidate : candidates) {
    // The own name of "observer.V".
    const std::size_t dot = is_full ? std::string::npos : candidate.rfind('.');
    const std::string_view own =
        std::string_view(candidate).substr(dot == std::string::npos ? 0 : dot + 1);
    const int distance = doubled_edit_distance(word, own);
    // Another letter is no misspelling of a letter.
    if (word.size() == 1 && own.size() == 1 && distance > 1) continue;
    if (differs_in_case(word, candidate)) return candidate;
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::vector<std::string> relatives(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  const auto words = words_of(word);
  std::vector<std::string> result;
  std::ptrdiff_t most = 1;
  for (const std::string& candidate : candidates) {
    std::ptrdiff_t shared = 0;
    for (const std::string& part : words_of(candidate))
      shared += std::count_if(words.begin(), words.end(),
                              [&](const std::string& one) { return one.starts_with(part); });
    if (shared < most) continue;
    if (shared > most) result.clear();
    most = shared;
    result.push_back(candidate);
  }
  return result;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       const std::string& otherwise) {
  if (candidates.empty()) return "";
  if (const auto near = nearest(word, candidates)) return "; did you mean '" + *near + "'?";
  constexpr std::size_t kMost = 12;
  const auto related = relatives(word, candidates);
  if (related.empty() && !otherwise.empty()) return otherwise;
  const auto& listed = related.empty() ? candidates : related;
  std::string text = related.empty() ? "; known: " : "; did you mean one of these: ";
  for (std::size_t i = 0; i < std::min(kMost, listed.size()); ++i)
    text += (i > 0 ? ", " : "") + listed[i];
  return text + (listed.size() > kMost ? ", ..." : related.empty() ? "" : "?");
}

}  // namespace gainsmith
