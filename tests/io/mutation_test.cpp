// Whatever a file holds, it is read or refused with InputError; nothing else happens.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "io/method_yaml.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

/// A few random edits: bytes flipped, replaced by signs of YAML or of the language, pieces deleted,
/// doubled or moved.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text) {
    for (std::size_t edits = 1 + pick(4); edits > 0 && !text.empty(); --edits) {
      const std::size_t at = pick(text.size());
      const std::size_t length = 1 + pick(12);
      switch (pick(6)) {
        case 0:
          text[at] = static_cast<char>(text[at] ^ static_cast<char>(1U << pick(8)));
          break;
        case 1:
          text[at] = kSigns[pick(kSigns.size())];
          break;
        case 2:
          text.erase(at, length);
          break;
        case 3:
          text.insert(at, text.substr(at, length));
          break;
        case 4:
          text.insert(at, text.substr(pick(text.size()), 3 * length));
          break;
        default:
          text.insert(at, 1, kSigns[pick(kSigns.size())]);
      }
    }
    return text;
  }

 private:
  std::size_t pick(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  static constexpr std::string_view kSigns = "[]{}()\"'*&!|>:;,#-?~%@\n\t 0e.^/+<I";
  std::mt19937 random_;
};

/// Whether the text was read; the test fails on any exception but InputError.
template <class Read>
bool reads(const std::string& text, Read read) {
  try {
    read(text);
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.message().empty()) << text;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "threw " << error.what() << " for\n" << text;
  }
  return false;
}

constexpr unsigned kMutations = 2000;

TEST(Mutations, OfAProblemAreReadOrRefused) {
  unsigned read = 0;
  for (unsigned seed = 0; seed < kMutations; ++seed)
    read += reads(Mutator(seed)(kProblem),
                  [](const std::string& text) { bind::bind(read_problem(text)); });
  EXPECT_GT(read, 0U) << "every mutation was refused: the test does not reach far";
  EXPECT_LT(read, kMutations);
}

TEST(Mutations, OfAMethodAreReadOrRefused) {
  unsigned read = 0;
  for (unsigned seed = 0; seed < kMutations; ++seed)
    read += reads(Mutator(seed)(kMethod), [](const std::string& text) {
      const MethodLibrary own{[&](const std::string&) { return text; }, {"own"}};
      bind::bind(
          parse_problem("problem: a\nmethod: own\ndata: {A: [[1, 2], [3, 4]]}\n", "p.yaml", own));
    });
  EXPECT_GT(read, 0U);
  EXPECT_LT(read, kMutations);
}

}  // namespace
}  // namespace gainsmith::io
