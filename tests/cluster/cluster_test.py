"""Campaigns, scans and folders of problems through Snakemake, on the cores of this machine and through Slurm: the bytes of
one command, whatever dies on the way.

    cluster_test.py TREE GAINSMITH [Local|Slurm]
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
import one_machine  # beside this file

PROGRAM = os.environ.get("GAINSMITH_TEST_PROGRAM") or os.path.abspath(sys.argv.pop(2))
PROGRAM = os.path.abspath(PROGRAM)
TREE = os.path.abspath(sys.argv.pop(1))
CLUSTER = os.path.join(TREE, "scripts/cluster")
PROBLEM = os.path.join(TREE, "problems/ferrante-seuret-2021/t2-0.70.yaml")
GRID = "--over T2=0.5:0.8:12 --over delta=0.01:0.05:5"

WORK = """gainsmith: {program}
campaigns:
  t2: {{gains: gains.json, options: "--runs {runs}", shards: {shards}}}
scans:
  lengths: {{problem: {problem}, options: "{grid}", shards: 3}}
folders:
  classics: {{problems: {tree}/problems/classics, options: "--runs 10", shards: 2}}
"""


def processes(folder, shard):
    """The processes of gainsmith that work on this shard for this folder."""
    found = []
    for name in os.listdir("/proc"):
        try:
            with open(f"/proc/{name}/cmdline", "rb") as file:
                words = file.read().decode(errors="replace").split("\0")
            if words[0] == PROGRAM and shard in words and os.readlink(f"/proc/{name}/cwd") == folder:
                found.append(int(name))
        except OSError:
            pass
    return found


class Workflow(unittest.TestCase):
    profile = "local"
    env = os.environ

    def setUp(self):
        if not shutil.which("snakemake"):
            self.skipTest("snakemake is not installed")
        self.folder = os.path.realpath(tempfile.mkdtemp(prefix="gainsmith-cluster-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.gainsmith("synth", PROBLEM, "-o", "gains.json")

    def gainsmith(self, *words):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def say(self, runs, shards=4):
        with open(os.path.join(self.folder, "work.yaml"), "w", encoding="utf-8") as file:
            file.write(WORK.format(program=PROGRAM, runs=runs, shards=shards, problem=PROBLEM, grid=GRID, tree=TREE))

    def begin(self, *targets):
        words = ["snakemake", "-s", os.path.join(CLUSTER, "Snakefile"), "--profile", os.path.join(CLUSTER, self.profile), "--configfile",
                 "work.yaml", "--latency-wait", "5", *targets]
        return subprocess.Popen(words, cwd=self.folder, env=self.env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def end(self, running):
        out = running.communicate(timeout=300)[0]
        self.assertEqual(running.returncode, 0, out)
        return out

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def expect_campaign(self, runs):
        whole = self.gainsmith("verify", "gains.json", "--runs", runs, "--json")
        self.assertEqual(self.read("results/campaigns/t2/campaign.json"), whole)

    def wait_for(self, shard):
        while not (found := processes(self.folder, shard)):
            time.sleep(0.05)
        return found[0]

    def all_kinds_of_work(self):
        self.say("20000")
        self.end(self.begin())
        self.expect_campaign("20000")
        self.gainsmith("scan", PROBLEM, *GRID.split(), "-o", "table.csv")
        self.assertEqual(self.read("results/scans/lengths/table.csv"), self.read("table.csv"))
        summary = self.read("results/summary.txt")
        for part in ("campaigns/t2\ncampaign    held in 20000 runs", "scans/lengths\n", "ok          hinf-norm "):
            self.assertIn(part, summary)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "results/folders/classics/report.html")))

    def one_shard_again(self):
        """Of a campaign that is there a part is lost: that part alone is made again."""
        self.say("20000")
        target = "results/campaigns/t2/campaign.json"
        self.end(self.begin(target))
        os.remove(os.path.join(self.folder, "results/campaigns/t2/parts/4/3.json"))
        os.remove(os.path.join(self.folder, target))
        out = self.end(self.begin(target))
        self.assertEqual(out.count("rule campaign_part:"), 1, out)
        self.expect_campaign("20000")

    def a_shard_dies(self):
        self.say("400000", 2)
        running = self.begin("results/campaigns/t2/campaign.json")
        os.kill(self.wait_for("2/2"), signal.SIGKILL)
        out = self.end(running)
        self.assertEqual(out.count("Finished job"), 3, out)
        self.expect_campaign("400000")


class Local(Workflow):
    def test_all_kinds_of_work(self):
        self.all_kinds_of_work()

    def test_one_shard_again(self):
        self.one_shard_again()

    def test_a_shard_dies(self):
        self.a_shard_dies()

    def test_what_is_asked_for_may_change_after_a_stop(self):
        self.say("2000000", 3)
        target = "results/campaigns/t2/campaign.json"
        running = self.begin(target)
        self.wait_for("2/3")
        time.sleep(0.5)
        running.send_signal(signal.SIGINT)
        os.kill(self.wait_for("2/3"), signal.SIGKILL)
        running.communicate(timeout=300)
        for runs, shards in (("30000", 3), ("30000", 2)):
            self.say(runs, shards)
            self.end(self.begin(target))
            self.expect_campaign(runs)

    def test_a_problem_that_is_edited_is_made_again(self):
        os.mkdir(os.path.join(self.folder, "few"))
        problem = os.path.join(self.folder, "few/hinf-norm.yaml")
        shutil.copy(os.path.join(TREE, "problems/classics/hinf-norm.yaml"), problem)
        with open(os.path.join(self.folder, "work.yaml"), "w", encoding="utf-8") as file:
            file.write(f"gainsmith: {PROGRAM}\nfolders:\n  few: {{problems: few}}\n")
        self.end(self.begin())
        page = self.read("results/folders/few/report.html")
        with open(problem, "a", encoding="utf-8") as file:
            file.write("# edited\n")
        self.end(self.begin())
        self.assertNotEqual(self.read("results/folders/few/report.html"), page)

    def test_mistakes_are_named(self):
        for text, message in (("campaign: {t2: {gains: gains.json}}", "unknown key 'campaign'; expected campaigns, scans"),
                              ("campaigns: {t2: {gain: gains.json}}", "unknown key 'gain' of campaigns: t2; expected gains"),
                              ("campaigns: {t2: {options: --runs 9}}", "campaigns: t2: expected gains: FILE"),
                              ("campaigns: {t2: {gains: gains.json, shards: 0}}", "expected a number of shards, not '0'"),
                              ("threads: 1", "nothing is asked for")):
            with open(os.path.join(self.folder, "work.yaml"), "w", encoding="utf-8") as file:
                file.write(text + "\n")
            running = self.begin()
            out = running.communicate(timeout=300)[0]
            self.assertNotEqual(running.returncode, 0)
            self.assertIn(message, out)


class Slurm(Workflow):
    profile = "slurm"

    @classmethod
    def setUpClass(cls):
        if not shutil.which("snakemake"):
            raise unittest.SkipTest("snakemake is not installed")
        cls.own = tempfile.mkdtemp(prefix="gainsmith-slurm-")
        cls.addClassCleanup(shutil.rmtree, cls.own, ignore_errors=True)
        cls.slurm = one_machine.Slurm(cls.own)
        if cls.slurm.why:
            raise unittest.SkipTest(cls.slurm.why)
        cls.addClassCleanup(cls.slurm.stop)
        cls.env = cls.slurm.env

    def test_all_kinds_of_work(self):
        self.all_kinds_of_work()

    def test_a_shard_dies_and_a_job_is_cancelled(self):
        """As Slurm ends one that is out of time: the work that was kept counts, and another job goes on."""
        self.say("400000", 2)
        running = self.begin("results/campaigns/t2/campaign.json")
        process = self.wait_for("1/2")
        with open(f"/proc/{process}/environ", "rb") as file:
            job = [word for word in file.read().decode().split("\0") if word.startswith("SLURM_JOB_ID=")][0].split("=")[1]
        subprocess.run(["scancel", job], env=self.env, check=True)
        os.kill(self.wait_for("2/2"), signal.SIGKILL)
        self.end(running)
        self.expect_campaign("400000")


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=2).result
    if result.wasSuccessful() and len(result.skipped) >= max(1, result.testsRun):
        sys.exit(77)
    sys.exit(not result.wasSuccessful())
