// Scans and folders of problems in parts, and stopped and resumed: the bytes of one in one piece.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

namespace fs = std::filesystem;

class ScanShards : public testing::Test {
 protected:
  Outcome scan(std::vector<std::string> more) const {
    more.insert(more.begin(), {"scan", problem("ferrante-seuret-2021/t2-0.70.yaml"), "--over",
                               "T2=0.6:0.9:7", "--over", "delta=0.01:0.05:3", "--show", "norm(L)"});
    return gainsmith(more);
  }
  std::vector<std::string> parts(int count) const {
    std::vector<std::string> files;
    for (int k = 1; k <= count; ++k) {
      files.push_back(folder_.path("scan" + std::to_string(k) + ".json"));
      EXPECT_EQ(
          scan({"--shard", std::to_string(k) + "/" + std::to_string(count), "-o", files.back()})
              .exit,
          0);
    }
    return files;
  }

  Folder folder_;
};

TEST_F(ScanShards, AreTheScan) {
  const std::string csv = folder_.path("a.csv"), merged = folder_.path("b.csv");
  const std::string picture = folder_.path("a.svg"), drawn = folder_.path("b.svg");
  const Outcome whole = scan({"-o", csv, "--plot", picture});
  EXPECT_EQ(whole.exit, 0);
  const std::vector<std::string> files = parts(4);
  const Outcome out =
      gainsmith({"merge", files[2], files[0], files[3], files[1], "-o", merged, "--plot", drawn});
  EXPECT_EQ(out.exit, 0) << out.err;
  EXPECT_EQ(out.out, whole.out);
  EXPECT_EQ(text_of(merged), text_of(csv));
  EXPECT_EQ(text_of(drawn), text_of(picture));
  EXPECT_EQ(gainsmith({"merge", files[0], files[1], files[2], files[3], "--json"}).out,
            scan({"--json"}).out);
}

TEST_F(ScanShards, ThatDoNotFitAreRefusedByName) {
  const std::vector<std::string> files = parts(3);
  const auto refused = [&](std::vector<std::string> given, const std::string& message) {
    given.insert(given.begin(), "merge");
    const Outcome outcome = gainsmith(given);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, message)) << outcome.err;
  };
  refused({files[0], files[2]},
          "7 of 21 points are in no part; make what is missing with --shard 2/3");
  refused({files[0], files[1], files[1]}, files[1] + ": this part is given twice");
  const std::string other = folder_.path("other.json");
  scan({"--shard", "2/3", "-o", other, "--set", "eta=1e-3"});
  refused({files[0], other, files[2]}, other + ": this part is of another scan than " + files[0] +
                                           ": another text of the problem");
  refused({files[0], files[1], folder_.file("cut.json", text_of(files[2]).substr(0, 500))},
          "cut.json:");
}

TEST_F(ScanShards, AScanGoesOn) {
  const std::string kept = folder_.path("kept");
  const std::string whole = scan({"--json"}).out;
  for (const char* time : {"0.02", "0.05", "0.05"}) {
    const Outcome part = scan({"--resume", kept, "--time", time, "--threads", "1"});
    EXPECT_TRUE(part.exit == 3 ? has(part.err, "the same command goes on from there")
                               : part.exit == 0)
        << part.exit << part.err;
  }
  EXPECT_EQ(scan({"--resume", kept, "--json"}).out, whole);
  EXPECT_EQ(scan({"--resume", kept, "--json"}).out, whole);
  const Outcome other = scan({"--resume", kept, "--set", "eta=1e-3"});
  EXPECT_EQ(other.exit, 2);
  EXPECT_TRUE(has(other.err, "keeps other work: problem_sha256")) << other.err;
}

TEST_F(ScanShards, ASearchGoesOn) {
  const std::string kept = folder_.path("kept");
  const auto optimize = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"optimize", problem("ferrante-seuret-2021/t2-0.70.yaml"), "--over",
                               "delta=1e-3:1", "--largest", "T2=0.5:1.1", "--evaluations", "40"});
    return gainsmith(more);
  };
  const std::string out = folder_.path("whole.json"), resumed = folder_.path("resumed.json");
  EXPECT_EQ(optimize({"-o", out}).exit, 0);
  const auto known = [&] {
    std::size_t values = 0;
    for (const char* turn : {"0", "1"})
      if (const std::string file = kept + "/kept-" + turn + ".json"; fs::exists(file))
        values = std::max(values, nlohmann::json::parse(text_of(file))["done"].size());
    return values;
  };
  // The first that comes to a value, however fast the machine is.
  for (double seconds = 0.1; known() == 0 && seconds < 100; seconds *= 2) {
    const Outcome part =
        optimize({"--resume", kept, "--time", std::to_string(seconds), "--threads", "1"});
    EXPECT_TRUE(part.exit == 0 || has(part.err, "the same command goes on from there")) << part.err;
  }
  const std::size_t before = known();
  EXPECT_GT(before, 0U);
  EXPECT_EQ(optimize({"--resume", kept, "-o", resumed}).exit, 0);
  EXPECT_GE(known(), before);
  EXPECT_EQ(without_timings(text_of(resumed)), without_timings(text_of(out)));
  const Outcome other = optimize({"--resume", kept, "--tolerance", "1e-3"});
  EXPECT_EQ(other.exit, 2);
  EXPECT_TRUE(has(other.err, "keeps other work: --tolerance")) << other.err;
}

class RunShards : public testing::Test {
 protected:
  const std::vector<std::string> problems_ = {problem("classics/hinf-norm.yaml"),
                                              problem("ferrante-seuret-2021/t2-0.70.yaml"),
                                              problem("own-systems/dc-motor.yaml")};
  Outcome run(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"run", "--runs", "20", "-o", folder_.path(out)};
    words.insert(words.end(), problems_.begin(), problems_.end());
    words.insert(words.end(), more.begin(), more.end());
    return gainsmith(words);
  }
  fs::file_time_type time_of(const std::string& file) const {
    return fs::last_write_time(folder_.path(file));
  }

  Folder folder_;
};

TEST_F(RunShards, EachProblemIsInOne) {
  run("whole", {});
  EXPECT_EQ(run("parts", {"--shard", "1/2"}).exit, 0);
  EXPECT_FALSE(fs::exists(folder_.path("parts/t2-0.70")));
  const Outcome incomplete = gainsmith({"report", folder_.path("parts"), "--json"});
  EXPECT_EQ(incomplete.exit, 3);
  EXPECT_TRUE(has(incomplete.err, "1 of 3 problems have no result")) << incomplete.err;
  EXPECT_TRUE(has(incomplete.out, "no result: the part of --shard")) << incomplete.out;
  EXPECT_EQ(run("parts", {"--shard", "2/2"}).exit, 0);
  EXPECT_EQ(gainsmith({"report", folder_.path("parts"), "--json"}).exit, 0);
  for (const char* name : {"hinf-norm", "t2-0.70", "dc-motor"}) {
    const auto gains = [&](const char* folder) {
      return without_timings(text_of(folder_.path(folder) + "/" + name + "/gains.json"));
    };
    EXPECT_EQ(gains("parts"), gains("whole")) << name;
  }
  const Outcome empty = run("empty", {"--shard", "5/5"});
  EXPECT_EQ(empty.exit, 0);
  EXPECT_EQ(empty.err, "part 5/5 has no problem\n");
}

/// Two problems in one part because the third takes as long as both.
TEST_F(RunShards, TimesOfAnEarlierRunBalanceTheParts) {
  for (const auto& [name, seconds] :
       {std::pair("hinf-norm", 2.0), {"t2-0.70", 1.5}, {"dc-motor", 4.0}}) {
    fs::create_directories(folder_.path("earlier") + "/" + name);
    std::ofstream(folder_.path("earlier") + "/" + name + "/result.json")
        << nlohmann::json({{"timings", {{"total", seconds}}}});
  }
  const std::string times = folder_.path("earlier");
  EXPECT_EQ(run("first", {"--shard", "1/2", "--times", times}).exit, 0);
  EXPECT_TRUE(fs::exists(folder_.path("first/dc-motor")));
  EXPECT_FALSE(fs::exists(folder_.path("first/hinf-norm")));
  EXPECT_EQ(run("second", {"--shard", "2/2", "--times", times}).exit, 0);
  EXPECT_TRUE(fs::exists(folder_.path("second/hinf-norm")));
  EXPECT_TRUE(fs::exists(folder_.path("second/t2-0.70")));
  EXPECT_FALSE(fs::exists(folder_.path("second/dc-motor")));
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message,
                           const std::string& to = "third") {
    const Outcome outcome = run(to, words);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, message)) << outcome.err;
  };
  refused({"--times", times}, "expected --shard I/N too");
  refused({"--shard", "1/2", "--times", folder_.path("first/dc-motor")}, "no results of these");
  refused({"--shard", "1/2", "--times", times}, "another folder", "earlier");
  std::ofstream(times + "/t2-0.70/result.json") << "{";
  refused({"--shard", "1/2", "--times", times}, "t2-0.70/result.json:1:");
}

TEST_F(RunShards, WhatIsFinishedIsKept) {
  const Outcome first = run("out", {"--resume", "--json"});
  EXPECT_EQ(first.exit, 0) << first.err;
  const auto gains = time_of("out/t2-0.70/gains.json"), motor = time_of("out/dc-motor/gains.json");
  // One that was cut is made again, the others stay.
  const std::string cut = folder_.path("out/dc-motor/campaign.json");
  std::ofstream(cut, std::ios::binary) << text_of(cut).substr(0, 200);
  const Outcome again = run("out", {"--resume", "--json"});
  EXPECT_EQ(without_timings(again.out), without_timings(first.out));
  EXPECT_EQ(time_of("out/t2-0.70/gains.json"), gains);
  EXPECT_NE(time_of("out/dc-motor/gains.json"), motor);
  EXPECT_EQ(nlohmann::json::parse(text_of(cut))["verdict"], "held");
  // Other runs are another result.
  run("out", {"--resume", "--seed", "7"});
  EXPECT_EQ(nlohmann::json::parse(text_of(cut))["seed"], 7);
}

}  // namespace
}  // namespace gainsmith::tests
