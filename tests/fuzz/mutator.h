// Mutants of a file, the same ones for the same number.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>

namespace gainsmith::fuzz {

/// A few random edits: bits flipped, bytes replaced by signs of the languages, pieces deleted, doubled, moved or cut off,
/// the end of another file, lengths and numbers replaced by those at the ends of their ranges.
class Mutator {
 public:
  explicit Mutator(std::uint64_t number) : random_(number) {}

  std::string operator()(std::string bytes, const std::string& other);

 private:
  /// From 0 to count - 1.
  std::size_t pick(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
  void edit(std::string& bytes, const std::string& other);
  /// A length field of 1, 2, 4 or 8 bytes at `at`, which is aligned.
  void set_length(std::string& bytes, std::size_t at);
  /// The digits from `at` on.
  void set_number(std::string& bytes, std::size_t at);

  std::mt19937_64 random_;
};

}  // namespace gainsmith::fuzz
