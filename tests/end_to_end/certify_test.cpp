// The second program, called by the first.
#include <gtest/gtest.h>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

std::string lyapunov(const std::string& A) {
  return "problem: p\nmethod:\n  data: {A: 2 x 2}\n  unknowns: {P: symmetric 2}\n"
         "  require: {decreases: He(P*A) < 0, positive: P > I}\ndata: {A: " +
         A + "}\nno campaign: static\n";
}

TEST(Certify, SaysYesNoAndUndecidedByItsExitCode) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  ASSERT_EQ(
      gainsmith({"synth", folder.file("p.yaml", lyapunov("[[-1, 2], [0, -3]]")), "-o", gains}).exit,
      0);
  const Outcome proved = gainsmith({"certify", gains, "--claims"});
  EXPECT_EQ(proved.exit, 0) << proved.out << proved.err;
  EXPECT_TRUE(has(proved.out, "proved")) << proved.out;
  EXPECT_TRUE(has(proved.out, "decreases")) << proved.out;

  // Its multipliers and unknowns are those that were written, as long as the file says so.
  const std::string first = "\"P\": [\n      [";
  std::string negative = with(text_of(gains), first, first + "-");
  const Outcome changed = gainsmith({"certify", folder.file("f.json", negative)});
  EXPECT_EQ(changed.exit, 2) << changed.out;
  EXPECT_TRUE(has(changed.out, "edited")) << changed.out;
  const Outcome checked = gainsmith({"check", folder.path("f.json")});
  EXPECT_TRUE(has(checked.out, "proof.sha256")) << checked.out;
  negative = folder.file("f.json", with(negative, "\"proof\"", "\"no proof\""));
  const Outcome refuted = gainsmith({"certify", negative, "--claims"});
  EXPECT_EQ(refuted.exit, 1) << refuted.out << refuted.err;
  EXPECT_TRUE(has(refuted.out, "refuted")) << refuted.out;
  const Outcome edited =
      gainsmith({"certify", folder.file("e.json", with(text_of(gains), "-3", "3"))});
  EXPECT_EQ(edited.exit, 2) << edited.out << edited.err;

  const Outcome no =
      gainsmith({"synth", folder.file("n.yaml", lyapunov("[[1, 2], [1, -3]]")), "-o", gains});
  EXPECT_EQ(no.exit, 1);
  EXPECT_TRUE(has(no.out, "multipliers at the eigenvalue 1.44949 of A, exact in fractions"))
      << no.out;
  const Outcome excluded = gainsmith({"certify", gains});
  EXPECT_EQ(excluded.exit, 0);
  EXPECT_TRUE(has(excluded.out, "an eigenvalue of A, exactly")) << excluded.out;
  EXPECT_EQ(gainsmith({"check", gains}).exit, 1);

  const std::string problem = folder.file("q.yaml", lyapunov("[[-1, 0], [1, -3]]"));
  const Outcome synth = gainsmith({"synth", problem, "-o", gains, "--certify"});
  EXPECT_EQ(synth.exit, 0) << synth.err;
  EXPECT_TRUE(has(synth.out, "proved ")) << synth.out;
  EXPECT_EQ(gainsmith({"synth", problem, "--certify"}).exit, 2);
  const Outcome run = gainsmith({"run", problem, "-o", folder.path("out"), "--certify"});
  EXPECT_EQ(run.exit, 0) << run.out << run.err;
  EXPECT_TRUE(has(run.out, "proved ")) << run.out;

  const Outcome wrong = gainsmith({"certify", folder.file("p.json", "[1, 2]")});
  EXPECT_EQ(wrong.exit, 2) << wrong.out << wrong.err;
}

}  // namespace
}  // namespace gainsmith::tests
