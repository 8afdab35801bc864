// "Did you mean ...?": the nearest known spelling of a misspelt word.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gainsmith {

/// Damerau-Levenshtein distance (optimal string alignment): insertions, deletions, substitutions
/// and swaps of neighbours each cost 1. Case counts half (1 of 2), so the result is doubled.
int doubled_edit_distance(std::string_view a, std::string_view b);

/// Whether nothing but upper and lower case tells the words apart.
bool differs_in_case(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, if one is near enough to be a likely misspelling (at most a
/// third of its letters wrong, at least one allowed). Ties go to the candidate that comes first. A
/// word without a point is compared with what follows the last point of a candidate.
std::optional<std::string> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// The candidates that share the most words with `word`, one at least: 'sampled-data' and
/// 'sampled-data-hybrid'. A word has four letters or more; hyphens and underscores part words. A
/// word is shared that begins with one of a candidate: 'hinfsyn' with 'hinf'.
std::vector<std::string> relatives(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// "; did you mean 'x'?"; when nothing is near, "; did you mean one of these: a, b?" with the
/// relatives, or "; known: a, b, c" (at most twelve, then "...").
/// Empty when there are no candidates. `otherwise`: what is said instead of the list.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       const std::string& otherwise = {});

}  // namespace gainsmith
