// Campaigns in parts, and campaigns that are stopped and go on: the bytes of one in one piece, or a
// clear refusal.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

namespace fs = std::filesystem;

/// The gains of t2-0.70, and campaigns of them.
class Shards : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(gainsmith({"synth", problem("ferrante-seuret-2021/t2-0.70.yaml"), "-o", gains_}).exit,
              0);
  }

  Outcome verify(const std::string& runs, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"verify", gains_, "--runs", runs});
    return gainsmith(more);
  }

  /// The files of the parts, made on one thread and on two in turn.
  std::vector<std::string> parts(const std::string& runs, int count,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> files;
    for (int k = 1; k <= count; ++k) {
      const std::string of = std::to_string(count), index = std::to_string(k);
      files.push_back(folder_.path("part" + index + "of" + of + ".json"));
      std::vector<std::string> words = {"--shard",    index + "/" + of, "-o",
                                        files.back(), "--threads",      std::to_string(1 + k % 2)};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome made = verify(runs, words);
      EXPECT_EQ(made.exit, 0) << made.err;
      EXPECT_TRUE(has(made.err, "part " + index + "/" + of)) << made.err;
    }
    return files;
  }

  static Outcome merge(std::vector<std::string> files, const std::vector<std::string>& more = {}) {
    files.insert(files.begin(), "merge");
    files.insert(files.end(), more.begin(), more.end());
    return gainsmith(files);
  }

  Folder folder_;
  const std::string gains_ = folder_.path("gains.json");
};

TEST_F(Shards, AreTheCampaignInAnyOrder) {
  const Outcome whole = verify("20000", {"--json"});
  std::mt19937 random(1);
  for (const int count : {1, 3, 8}) {
    std::vector<std::string> files = parts("20000", count);
    std::shuffle(files.begin(), files.end(), random);
    const std::string out = folder_.path("campaign.json");
    const Outcome merged = merge(files, {"-o", out});
    EXPECT_EQ(merged.exit, 0) << merged.err;
    EXPECT_EQ(text_of(out), whole.out) << count;
    EXPECT_EQ(merged.out, verify("20000").out);
    EXPECT_EQ(merge(files, {"--json"}).out, whole.out);
  }
}

TEST_F(Shards, MayBeAHundred) {
  const std::string whole = verify("20000", {"--json"}).out;
  std::vector<std::string> files = parts("20000", 100);
  std::shuffle(files.begin(), files.end(), std::mt19937(2));
  EXPECT_EQ(merge(files, {"--json"}).out, whole);
}

TEST_F(Shards, AreTheFilesOfAFolder) {
  const std::vector<std::string> files = parts("3000", 3);
  const std::string folder = folder_.path("parts");
  fs::create_directory(folder);
  EXPECT_TRUE(has(merge({folder}).err, folder + ": this folder has no parts"));
  for (const std::string& file : files)
    fs::rename(file, fs::path(folder) / fs::path(file).filename());
  EXPECT_EQ(merge({folder}, {"--json"}).out, verify("3000", {"--json"}).out);
}

TEST_F(Shards, HaveFiguresOverAllRuns) {
  const auto compared = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"verify", problem("own-systems/trusted-covariance.yaml"),
                               "--compare", "--runs", "700"});
    return gainsmith(more);
  };
  const Outcome whole = compared({"--json"});
  std::vector<std::string> files;
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    files.push_back(folder_.path(std::string("figures") + shard[0] + ".json"));
    EXPECT_EQ(compared({"--shard", shard, "-o", files.back()}).exit, 0);
  }
  EXPECT_EQ(merge(files, {"--json"}).out, whole.out);
  EXPECT_EQ(merge(files).out, compared({}).out);
  const std::string kept = folder_.path("kept");
  for (const char* time : {"0.1", "0.2", "0.3"}) compared({"--resume", kept, "--time", time});
  EXPECT_EQ(compared({"--resume", kept, "--json"}).out, whole.out);
  // Without figures it is another report.
  const std::string other = folder_.path("other.json");
  gainsmith({"verify", problem("own-systems/trusted-covariance.yaml"), "--runs", "700", "--shard",
             "2/3", "-o", other});
  const Outcome mixed = merge({files[0], files[1], other});
  EXPECT_EQ(mixed.exit, 2);
  EXPECT_TRUE(has(mixed.err, other + ": this part is of another campaign than " + files[0] +
                                 ": compare none, not yes"))
      << mixed.err;
}

TEST_F(Shards, MayBeMoreThanRuns) {
  EXPECT_EQ(merge(parts("5", 8), {"--json"}).out, verify("5", {"--json"}).out);
}

TEST_F(Shards, ThatDoNotFitAreRefusedByName) {
  std::vector<std::string> files = parts("3000", 3);
  const std::string first = files[0], second = files[1], third = files[2];
  const auto refused = [&](const std::vector<std::string>& given, const std::string& part) {
    const Outcome outcome = merge(given, {"-o", folder_.path("campaign.json")});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, part)) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_.path("campaign.json")));
  };
  refused({first, third},
          "runs 1000 to 1999 are in no part; make what is missing with --shard 2/3");
  refused({first, second, second, third}, second + ": this part is given twice");
  const std::string other = folder_.path("other.json");
  verify("3000", {"--seed", "5", "--shard", "2/3", "-o", other});
  refused({first, other, third},
          other + ": this part is of another campaign than " + first + ": seed 5, not 1");
  verify("3001", {"--shard", "2/3", "-o", other});
  refused({first, other, third}, "runs 3001, not 3000");
  const std::string quarter = folder_.path("quarter.json");
  verify("3000", {"--shard", "2/4", "-o", quarter});
  refused({first, quarter, third},
          quarter + ": runs 750 to 999 of this part, 2/4, are in " + first);
  folder_.file("part2of3.json", text_of(second).substr(0, 900));
  refused(files, second + ":");
  folder_.file("part2of3.json", with(text_of(third), "\"violations\": 0", "\"violations\": 1"));
  refused(files, second + ": this file is damaged");
  refused(
      {first, gains_},
      gains_ + ": expected a part that --shard of 'gainsmith verify' or 'gainsmith scan' writes");
}

TEST_F(Shards, OfOtherGainsAreRefused) {
  const std::vector<std::string> files = parts("300", 2);
  const std::string other = folder_.path("other.json");
  ASSERT_EQ(gainsmith({"synth", problem("ferrante-seuret-2021/t2-0.70.yaml"), "--set", "T2=0.69",
                       "-o", other})
                .exit,
            0);
  const std::string part = folder_.path("part.json");
  ASSERT_EQ(gainsmith({"verify", other, "--runs", "300", "--shard", "2/2", "-o", part}).exit, 0);
  const Outcome outcome = merge({files[0], part});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(has(outcome.err,
                  part + ": this part is of another campaign than " + files[0] + ": other gains, "))
      << outcome.err;
}

int ended(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// So many runs are kept.
std::uint64_t kept_runs(const std::string& folder) {
  std::uint64_t most = 0;
  for (const char* name : {"kept-0.json", "kept-1.json"})
    if (fs::exists(fs::path(folder) / name))
      most = std::max(most, nlohmann::json::parse(text_of(
                                (fs::path(folder) / name).string()))["done"]["tally"]["runs"]
                                .get<std::uint64_t>());
  return most;
}

TEST_F(Shards, ACampaignThatIsKilledGoesOn) {
  const std::string runs = "400000", kept = folder_.path("kept");
  const Outcome whole = verify(runs, {"--json"});
  std::mt19937 random(7);
  std::uint64_t before = 0;
  for (int k = 0; k < 10; ++k) {
    const pid_t child = start({"verify", gains_, "--runs", runs, "--resume", kept, "--threads",
                               std::to_string(1 + k % 2)},
                              folder_.path("out"), folder_.path("out"));
    const double after = 0.05 + static_cast<double>(random() % 400) / 1000;
    wait_for(child, [&] { return seconds_of(child) >= after; });
    ::kill(child, SIGKILL);
    const int exit = ended(child);
    EXPECT_TRUE(exit == -SIGKILL || exit == 0) << exit << text_of(folder_.path("out"));
    const std::uint64_t now = fs::exists(kept) ? kept_runs(kept) : 0;
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_GT(before, 0U);
  EXPECT_EQ(verify(runs, {"--resume", kept, "--json"}).out, whole.out);
  // All is done: it is told again at once.
  EXPECT_EQ(kept_runs(kept), 400000U);
  EXPECT_EQ(verify(runs, {"--resume", kept, "--json"}).out, whole.out);
}

/// Of row III, whose runs are violated often: stopped before and after its end.
TEST_F(Shards, ACampaignUntilViolatedGoesOn) {
  const std::string row = folder_.path("row.json"), kept = folder_.path("kept");
  const std::string file = problem("ferrante-seuret-2021/row-3.yaml");
  ASSERT_EQ(gainsmith({"synth", file, "-o", row}).exit, 1);  // its inequalities do not hold
  const auto until = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"verify", row, "--runs", "1e9", "--until", "violated"});
    return gainsmith(more);
  };
  const Outcome whole = until({"--json"});
  EXPECT_EQ(whole.exit, 1);
  const auto report = nlohmann::json::parse(whole.out);
  EXPECT_EQ(report["violations"], 1);
  EXPECT_EQ(report["worst_run"], report["runs"].get<int>() - 1);
  EXPECT_TRUE(
      has(whole.out, "ended by the first run that violates a claim, of at most 1000000000"));
  EXPECT_EQ(until({"--threads", "1", "--json"}).out, whole.out);
  EXPECT_EQ(until({"--resume", kept, "--json"}).out, whole.out);
  EXPECT_EQ(until({"--resume", kept, "--json"}).out, whole.out);
  EXPECT_TRUE(has(gainsmith({"verify", row, "--runs", "1e9", "--resume", kept}).err,
                  "keeps other work: until"));
  EXPECT_EQ(until({"--shard", "1/2", "-o", folder_.path("part.json")}).exit, 2);
}

TEST_F(Shards, ACampaignThatIsInterruptedSaysHowToGoOn) {
  const std::string kept = folder_.path("kept"), part = folder_.path("part.json");
  const Outcome stopped =
      interrupted({"verify", gains_, "--runs", "1e9", "--resume", kept, "--json"});
  EXPECT_EQ(stopped.exit, 3);
  EXPECT_TRUE(has(stopped.err, kept + " keeps ")) << stopped.err;
  EXPECT_TRUE(has(stopped.err, " of 1000000000 runs; the same command goes on from there"))
      << stopped.err;
  const std::uint64_t runs = stopped.json()["runs"];
  EXPECT_GT(runs, 0U);
  EXPECT_EQ(kept_runs(kept), runs);
  const Outcome shard =
      interrupted({"verify", gains_, "--runs", "1e9", "--shard", "2/2", "-o", part});
  EXPECT_EQ(shard.exit, 3);
  EXPECT_TRUE(has(shard.err, " runs of part 2/2: it was not written")) << shard.err;
  EXPECT_FALSE(fs::exists(part));
}

TEST_F(Shards, APartGoesOnToo) {
  const std::string kept = folder_.path("kept"), part = folder_.path("part.json");
  const std::vector<std::string> words = {"--shard", "2/3", "-o", part, "--resume", kept};
  std::vector<std::string> briefly = words;
  briefly.insert(briefly.end(), {"--time", "0.4"});
  verify("300000", briefly);
  ASSERT_EQ(verify("300000", words).exit, 0);
  const std::string resumed = text_of(part);
  verify("300000", {"--shard", "2/3", "-o", part});
  EXPECT_EQ(resumed, text_of(part));
  const Outcome other = verify("300000", {"--shard", "3/3", "-o", part, "--resume", kept});
  EXPECT_EQ(other.exit, 2);
  EXPECT_TRUE(has(other.err, kept + ": this folder keeps other work: shard 2/3, not 3/3"))
      << other.err;
}

TEST_F(Shards, DamagedFilesOfAFolderDoNotCount) {
  const std::string kept = folder_.path("kept");
  const std::string whole = verify("20000", {"--resume", kept, "--json"}).out;
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    const std::string file =
        (fs::path(kept) / ("kept-" + std::to_string(k % 2) + ".json")).string();
    std::string text = text_of(file);
    if (k % 4 < 2)
      text.resize(random() % text.size());
    else
      text[random() % text.size()] ^= 1;
    std::ofstream(file, std::ios::binary) << text;
    const bool swapped = k % 5 == 4;
    if (swapped)
      fs::copy_file(fs::path(kept) / "kept-0.json", fs::path(kept) / "kept-1.json",
                    fs::copy_options::overwrite_existing);
    const Outcome again = verify("20000", {"--resume", kept, "--json"});
    EXPECT_EQ(again.exit, 0) << again.err;
    EXPECT_EQ(again.out, whole);
    EXPECT_TRUE(swapped || has(again.err, "it does not count")) << again.err;
  }
}

TEST_F(Shards, AFolderOfOtherWorkIsRefused) {
  const std::string kept = folder_.path("kept");
  verify("100", {"--resume", kept});
  const auto refused = [&](const Outcome& outcome, const std::string& part) {
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(has(outcome.err, part)) << outcome.err;
  };
  refused(verify("200", {"--resume", kept}), "runs 100, not 200; choose another folder");
  refused(verify("100", {"--resume", kept, "--seed", "4"}), "seed 1, not 4");
  refused(verify("100", {"--resume", kept, "--confidence", "0.9"}), "confidence ");
  const std::string folder = fs::path(gains_).parent_path().string();
  refused(verify("100", {"--resume", folder}), folder + ": this folder holds other files");
  refused(verify("100", {"--resume", gains_}), gains_ + ": cannot make this folder");
}

TEST_F(Shards, OneProgramWorksInAFolder) {
  const std::string kept = folder_.path("kept");
  const pid_t child = start({"verify", gains_, "--runs", "1e9", "--resume", kept},
                            folder_.path("out"), folder_.path("out"));
  wait_for(child, [&] { return fs::exists(fs::path(kept) / "kept-0.json"); });
  const Outcome second = verify("1e9", {"--resume", kept});
  EXPECT_EQ(second.exit, 2);
  EXPECT_TRUE(has(second.err, kept + ": another gainsmith works in this folder (process " +
                                  std::to_string(child) + ")"))
      << second.err;
  ::kill(child, SIGKILL);
  EXPECT_EQ(ended(child), -SIGKILL);
  // A dead process holds no lock.
  EXPECT_EQ(verify("1e9", {"--resume", kept, "--time", "0.5"}).exit, 3);
}

/// A small disk of its own, where this process may mount one.
class SmallDisk {
 public:
  SmallDisk(const std::string& path, const char* options) : path_(path) {
    fs::create_directories(path);
    mounted_ = ::mount("tmpfs", path.c_str(), "tmpfs", 0, options) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount2(path_.c_str(), MNT_DETACH);
  }
  bool is_there() const { return mounted_; }
  bool make_read_only() const {
    return ::mount("tmpfs", path_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  }

 private:
  std::string path_;
  bool mounted_ = false;
};

TEST_F(Shards, AFullOrReadOnlyDiskIsSaid) {
  const std::string path = folder_.path("disk"), kept = path + "/kept";
  const SmallDisk disk(path, "size=64k");
  if (!disk.is_there()) GTEST_SKIP() << "this process may not mount a disk";
  const auto some = [&] {
    return interrupted({"verify", gains_, "--runs", "1e9", "--resume", kept}, 0.6);
  };
  some();
  const std::uint64_t before = kept_runs(kept);
  EXPECT_GT(before, 0U);
  const std::string fill = path + "/fill";
  std::ofstream(fill) << std::string(1 << 20, 'x');
  const Outcome full = some();
  EXPECT_EQ(full.exit, 2);
  EXPECT_TRUE(has(full.err,
                  "No space left on device; what was kept before is whole, and the same "
                  "command goes on from it"))
      << full.err;
  fs::remove(fill);
  EXPECT_EQ(kept_runs(kept), before);
  EXPECT_EQ(some().exit, 3);
  EXPECT_GT(kept_runs(kept), before);
  ASSERT_TRUE(disk.make_read_only());
  const Outcome closed = some();
  EXPECT_EQ(closed.exit, 2);
  EXPECT_TRUE(has(closed.err, kept + ": cannot write here: Read-only file system")) << closed.err;
}

TEST_F(Shards, OptionsThatDoNotFitAreRefused) {
  for (const char* shard : {"0/3", "4/3", "3", "1/0", "a/b", "1/2/3", "-1/3"})
    EXPECT_EQ(verify("10", {"--shard", shard, "-o", folder_.path("part.json")}).exit, 2) << shard;
  EXPECT_TRUE(has(verify("10", {"--shard", "1/2"}).err, "--shard needs -o FILE"));
  EXPECT_EQ(verify("10", {"--shard", "1/2", "--worst"}).exit, 2);
  EXPECT_EQ(verify("10", {"--resume", folder_.path("kept"), "--worst"}).exit, 2);
}

}  // namespace
}  // namespace gainsmith::tests
