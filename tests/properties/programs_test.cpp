// Semidefinite programs with a planted optimum or certificate.
#include <gtest/gtest.h>

#include "properties/programs.h"
#include "sdp/files/sdpa_file.h"

namespace gainsmith::tests::properties {
namespace {

TEST(ProgramsTest, AreNeverWrong) {
  constexpr std::uint64_t kSeed = 0xC1C1C1;
  constexpr std::uint64_t kPrograms = 2000;
  int undecided = 0;
  for (std::uint64_t index = 0; index < kPrograms; ++index) {
    const Program known = make_program(kSeed, index);
    const Answer answer = judge(known);
    EXPECT_NE(answer.outcome, Outcome::wrong)
        << "program " << index << ": " << answer.message << ", planted " << known.optimum << "\n"
        << sdp::write_sdpa(known.problem);
    undecided += answer.outcome == Outcome::undecided;
  }
  RecordProperty("undecided", undecided);
  EXPECT_LE(undecided, static_cast<int>(kPrograms / 50));
}

}  // namespace
}  // namespace gainsmith::tests::properties
