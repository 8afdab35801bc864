"""The page of results, as a person gets it: `report`, `run --report`, and in a browser where there is one.

    report_test.py TREE GAINSMITH

GAINSMITH_TEST_PROGRAM in the environment names another program, as for the other end-to-end tests.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

BUILT = sys.argv.pop(2)
PROGRAM = os.environ.get("GAINSMITH_TEST_PROGRAM") or BUILT
TREE = sys.argv.pop(1)
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")

# Texts with everything that is markup in a page.
ODD = """problem: "<script>alert(1)</script> & ü"
method:
  summary: "a <b>bold</b> & 'quoted' \\"summary\\""
  source: "<script>alert(2)</script>"
  data: {A: {shape: n x n, help: "<i>plant</i> & \\"ü\\""}, C: p x n}
  parameters: {alpha: {default: 1, help: "</math><script>alert(3)</script>"}}
  unknowns: {P: symmetric n, Y: n x p}
  require:
    "<img src=x onerror=alert(4)>": P > I
    decay: He(P*A - Y*C) + 2*alpha*P < 0
    small: norm(Y) <= 100
  gains: {L: inv(P)*Y}
  report: {poles: eig(A - L*C)}
  plant: {state: {x: n}, output: {y: C*x}, flow: {x: A*x}}
  observer: {state: {xh: n}, flow: {xh: A*xh + L*(y - C*xh)}}
  signals: {e: x - xh}
  claims: {lyapunov: {nonincreasing: e'*P*e}, error: {shrinks: norm(e), to: 0.5}}
data: {A: [[0, 1], [-4, 0]], C: [1, 0]}
campaign: {runs: 20, horizon: 5, initial: {x: {box: [-1, 1]}, xh: 0}}
expect: {values: {alpha: {value: 1, absolute: 0}}}
"""

IMPOSSIBLE = """problem: impossible
method:
  data: {A: n x n}
  unknowns: {P: symmetric n}
  require: {positive: P > I, decay: He(P*A) < 0}
data: {A: [[1, 0], [0, -1]]}
expect: {verdict: "no"}
"""


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def elements(page, name):
    """The elements of a page, which must be well-formed."""
    return [one for one in ElementTree.fromstring(page).iter() if one.tag.split("}")[-1] == name]


def text_of(page):
    return " ".join("".join(ElementTree.fromstring(page).itertext()).split())


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.at = lambda _, *names: os.path.join(cls.folder, *names)
        files = [write(os.path.join(cls.folder, name), text) for name, text in
                 [("a&b 'c'.yaml", ODD), ("impossible.yaml", IMPOSSIBLE), ("wrong.yaml", "problem: x\nmetod: <b>\n")]]
        cls.out = os.path.join(cls.folder, "out")
        cls.outcome = run("run", *files, "-o", cls.out, "--report")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_run_writes_the_page_that_report_writes(self):
        self.assertEqual(self.outcome.returncode, 2, self.outcome.stdout + self.outcome.stderr)
        page = read(self.at("out", "report.html"))
        again = run("report", self.out)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(again.stdout, page)
        rows = [" ".join(row.itertext()) for row in elements(page, "tr")]
        for name, words in [("a&b 'c'", ["ok", "yes", "held in 20 runs"]), ("impossible", ["ok", "no"]),
                            ("wrong", ["ERROR", "wrong.yaml:2:1"])]:
            row = next(row for row in rows if name in row)
            for word in words:
                self.assertIn(word, row)
        self.assertEqual(len([one for one in elements(page, "details") if one.get("class") == "problem"]), 3)

    def test_texts_are_no_markup_and_nothing_is_loaded(self):
        page = read(self.at("out", "report.html"))
        for name in ["script", "img", "b", "i", "link"]:
            self.assertEqual(elements(page, name), [], name)
        for one in ElementTree.fromstring(page).iter():
            self.assertIsNone(one.get("src"))
            self.assertTrue(one.get("href", "#").startswith("#"))
        self.assertIn("<script>alert(1)</script> & ü", text_of(page))

    def test_one_problem_shows_everything(self):
        page = run("report", self.at("out", "a&b 'c'")).stdout
        titles = [one.text for one in elements(page, "h3")]
        self.assertEqual(titles, ["Verdict", "Gains", "Margins", "Campaign", "Problem", "Provenance"])
        self.assertEqual(len(elements(page, "svg")), 1)
        text = text_of(page)
        for words in ["is a proof for the decimals", "All is as the problem expects", "poles", "He(P", "≺0", "never increases",
                      "With 95 % confidence", "--seed 1", "Seed 1, horizon 5", "nearest to a violation"]:
            self.assertIn(words, text)
        with open(self.at("out", "a&b 'c'", "gains.json"), encoding="utf-8") as file:
            self.assertIn(json.load(file)["statement"]["sha256"], text)
        self.assertEqual(page, run("report", self.at("out", "a&b 'c'") + "/").stdout)

    def test_a_no_shows_what_conflicts(self):
        text = text_of(run("report", self.at("out", "impossible")).stdout)
        self.assertIn("Inequalities in conflict", text)
        self.assertIn("They show that no solution", text)
        self.assertNotIn("is a proof for the decimals", text)

    def test_a_gain_file_alone_has_the_picture_of_its_first_run(self):
        gains = self.at("alone.json")
        self.assertEqual(run("synth", self.at("a&b 'c'.yaml"), "-o", gains).returncode, 0)
        page = self.at("made", "alone.html")
        self.assertEqual(run("report", gains, "-o", page).returncode, 0)
        self.assertEqual(len(elements(read(page), "svg")), 1)
        self.assertIn("gainsmith verify alone.json makes one", text_of(read(page)))

    def test_an_edited_gain_file_is_told(self):
        edited = self.at("edited")
        shutil.copytree(self.at("out", "a&b 'c'"), edited)
        self.assertNotIn("is not the one that was run", run("report", edited).stdout)
        gains = read(os.path.join(edited, "gains.json"))
        write(os.path.join(edited, "gains.json"), re.sub(r'("L": \[\n\s*\[)', r"\g<1>1", gains, count=1))
        self.assertIn("is not the one that was run", run("report", edited).stdout)

    def test_json_is_the_table(self):
        lines = json.loads(run("report", self.out, "--json").stdout)
        self.assertEqual([line["name"] for line in lines], ["a&b 'c'", "impossible", "wrong"])
        self.assertEqual(lines[0]["campaign"], "held")
        self.assertEqual(lines[1]["verdict"], "no")
        self.assertIn("metod", lines[2]["error"])

    def test_bad_input_is_refused_with_its_place(self):
        def error(*arguments):
            outcome = run("report", *arguments)
            self.assertEqual(outcome.returncode, 2, outcome.stdout[:200])
            return outcome.stderr

        os.makedirs(self.at("empty"), exist_ok=True)
        self.assertIn("no results here", error(self.at("empty")))
        self.assertIn("missing.json", error(self.at("missing.json")))
        self.assertIn("did you mean 'impossible'?", error(self.at("out", "imposible")))
        self.assertIn("known: a&b 'c', impossible, wrong", error(self.at("out", "by-name")))
        self.assertIn("no gain file", error(self.at("impossible.yaml")))
        for name, change, words in [
                ("gains.json", lambda text: text[:len(text) // 2], r"gains\.json:\d+:\d+"),
                ("gains.json", lambda text: text.replace('"0.', '"99.', 1), "gainsmith 99"),
                ("campaign.json", lambda text: text[:-20], r"campaign\.json:\d+:\d+"),
                ("result.json", lambda text: text.replace('"exit"', '"exot"'), r"result\.json:\d+:\d+"),
                ("worst-run.svg", lambda text: text[:-20], "no whole picture"),
                ("worst-run.svg", lambda text: text.replace("</svg>", "<script>alert(1)</script></svg>"), "script"),
                ("worst-run.svg", lambda text: text.replace("<rect ", '<rect onload="alert(1)" ', 1), "script"),
        ]:
            with self.subTest(name=name, words=words):
                broken = self.at("broken")
                shutil.copytree(self.at("out", "a&b 'c'"), broken)
                path = os.path.join(broken, name)
                write(path, change(read(path)))
                page = self.at("broken.html")
                self.assertRegex(error(broken, "-o", page), words)
                self.assertFalse(os.path.exists(page))
                shutil.rmtree(broken)
        self.assertIn("cannot write", error(self.out, "-o", "/dev/null/page.html").lower().replace("cannot make", "cannot write"))

    def test_wrong_input_leaves_no_older_results(self):
        folder = self.at("again")
        os.makedirs(self.at("sources"), exist_ok=True)
        problem = write(self.at("sources", "p.yaml"), IMPOSSIBLE)
        self.assertEqual(run("run", problem, "-o", folder).returncode, 0)
        write(problem, IMPOSSIBLE.replace("require", "requires"))
        self.assertEqual(run("run", problem, "-o", folder).returncode, 2)
        self.assertEqual(os.listdir(os.path.join(folder, "p")), ["result.json"])
        self.assertIn("requires", text_of(run("report", folder).stdout))

    def test_gains_without_a_campaign_that_could_be_made_are_shown(self):
        problem = write(self.at("nostart.yaml"), ODD.replace(", initial: {x: {box: [-1, 1]}, xh: 0}", ""))
        folder = self.at("nostart")
        self.assertEqual(run("run", problem, "-o", folder, "--report").returncode, 2)
        self.assertEqual(sorted(os.listdir(os.path.join(folder, "nostart"))), ["gains.json", "result.json"])
        text = text_of(read(os.path.join(folder, "report.html")))
        self.assertIn("nostart.yaml:", text)
        self.assertIn("is a proof for the decimals", text)
        self.assertEqual(read(os.path.join(folder, "report.html")), run("report", folder).stdout)

    def test_data_beside_the_problem_are_found(self):
        for name in ("recorded.yaml", "recorded.csv"):
            shutil.copy(os.path.join(TREE, "problems", "own-systems", name), self.folder)
        folder = self.at("measured")
        self.assertEqual(run("run", self.at("recorded.yaml"), "-o", folder).returncode, 0)
        self.assertIn("measured,", text_of(run("report", folder).stdout))
        os.remove(self.at("recorded.csv"))
        text = text_of(run("report", folder).stdout)
        self.assertIn("Its mathematics is not shown", text)
        self.assertIn("recorded.csv", text)


@unittest.skipUnless(CHROMIUM, "chromium is not installed")
class InABrowser(unittest.TestCase):
    def browse(self, folder, *arguments):
        return subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--hide-scrollbars",
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={folder}/profile", *arguments],
            capture_output=True, text=True, check=True, timeout=120, cwd=folder)

    def test_a_page_is_shown_and_printed_without_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            problem = write(os.path.join(folder, "odd.yaml"), ODD)
            self.assertEqual(run("run", problem, "-o", folder, "--report").returncode, 0)
            page = "file://" + os.path.join(folder, "report.html")
            shown = self.browse(folder, "--screenshot=page.png", "--window-size=1000,2000", page)
            self.assertNotIn("CONSOLE", shown.stderr)
            self.assertGreater(os.path.getsize(os.path.join(folder, "page.png")), 20000)
            self.browse(folder, "--print-to-pdf=page.pdf", page)
            with open(os.path.join(folder, "page.pdf"), "rb") as file:
                self.assertTrue(file.read().startswith(b"%PDF"))
            dom = self.browse(folder, "--dump-dom", page).stdout
            self.assertIn("<math", dom)
            self.assertNotIn("<script>alert", dom)


if __name__ == "__main__":
    unittest.main()
