"""The module without NumPy: problems, errors with their places, results, interrupts.

    module_test.py TREE GAINSMITH
"""
import copy
import decimal
import fractions
import html
import inspect
import json
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
from unittest import mock

from support import MODULE, PROGRAM, TREE, main, problem, spring

sys.modules["numpy"] = None  # importing it fails, as where it is not installed
import gainsmith as gs  # noqa: E402


class Problems(unittest.TestCase):
    def test_a_dict_a_text_and_a_file_are_the_same_problem(self):
        of_dict = gs.synth(spring())
        text = (
            "problem: spring\nmethod: observer\nparameters: {alpha: 3}\n"
            "data: {A: [[0, 1], [-2, -0.5]], C: [[1, 0]]}\n"
        )
        self.assertEqual(gs.synth(text).gains, of_dict.gains)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "größe.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            self.assertEqual(gs.synth(path).gains, of_dict.gains)

    def test_without_numpy_matrices_are_lists_of_rows(self):
        gain = gs.synth(spring()).gains["L"]
        # (s + 3)^2 is the fastest way to decay like exp(-3 t): A - L C has the trace -6.
        self.assertEqual((len(gain), len(gain[0])), (2, 1))
        self.assertAlmostEqual(gain[0][0] + 0.5, 6, places=2)

    def test_set_replaces_values(self):
        changed = gs.synth(spring(), set={"alpha": 2, "A": [[0, 1], [-1, -1]], "C": "[1, 0]"})
        same = gs.synth(
            spring(data={"A": [[0, 1], [-1, -1]], "C": [[1, 0]]}, parameters={"alpha": 2})
        )
        self.assertEqual(changed.gains, same.gains)
        self.assertEqual(changed.file["statement"]["set"]["alpha"], "2")

    def test_decimals_stay_as_written(self):
        design = gs.synth(
            spring(
                parameters={"alpha": fractions.Fraction(7, 2)},
                data={"A": [[0, 1], [decimal.Decimal("-2.10"), 0]], "C": [[1, 0]]},
            )
        )
        self.assertIn("-2.10", design.file["statement"]["problem_text"])
        self.assertEqual(design["alpha"], 3.5)

    def test_names_beyond_ascii(self):
        name = 'Größe 😀 "quoted" \\'
        self.assertEqual(gs.synth(spring(problem=name)).file["problem"], name)

    def test_paths_of_a_dict_begin_in_the_working_folder(self):
        here = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            self.addCleanup(os.chdir, here)
            with open("A.csv", "w", encoding="utf-8") as file:
                file.write("0, 1\n-2, -0.5\n")
            design = gs.synth(spring(data={"A": {"csv": "A.csv"}, "C": [[1, 0]]}))
            os.chdir(here)
            self.assertEqual(design.gains, gs.synth(spring()).gains)
            self.assertEqual(design.verify(runs=20).verdict, "held")

    def test_a_log_is_beside_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "log.csv"), "w", encoding="utf-8") as file:
                file.write("t,y\n0,1\n0.5,3\n1,2\n")
            path = os.path.join(folder, "filter.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(
                    "problem: filter\nmethod:\n  like: kalman\n  noise: none\n  signals: none\n"
                    "  claims: none\n"
                    "  plant: {state: none, flow: none, log: log.csv, output: {y: y}}\n"
                    "data: {A: [[0, 1], [0, -2]], C: [[1, 0]]}\ncampaign: {initial: {xh: 0}}\n"
                )
            design = gs.synth(path)
            run = design.simulate()
            self.assertEqual((run["y"][0], run["y"][-1], run.t[-1]), (1, 3, 1))  # held
            design.save(os.path.join(folder, "gains.json"))
            self.assertEqual(gs.load(os.path.join(folder, "gains.json")).simulate()["y"], run["y"])

    def test_a_large_matrix(self):
        n = 200
        method = {"data": {"A": "n x n"}, "report": {"t": "trace(A)"}}
        rows = [[(i * 7 + j) / 8 for j in range(n)] for i in range(n)]
        design = gs.synth({"problem": "large", "method": method, "data": {"A": rows}})
        self.assertEqual(design.report["t"], [[sum(rows[i][i] for i in range(n))]])
        with self.assertRaisesRegex(gs.InputError, "too large"):
            gs.synth(spring(), set={"A": rows})


class Errors(unittest.TestCase):
    def error(self, *arguments, **options):
        with self.assertRaises(gs.InputError) as caught:
            gs.synth(*arguments, **options)
        return caught.exception

    def test_a_file_has_line_and_column(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wrong.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(
                    "problem: wrong\nmethod: observer\ndata: {A: [[0, 1], [0, q]], C: [[1, 0]]}\n"
                )
            error = self.error(path)
            self.assertEqual((error.file, error.line, error.column, error.key), (path, 3, 24, None))
            self.assertEqual(str(error), f"{path}:3:24: {error.message}")
            self.assertTrue(error.message.startswith("unknown name 'q'"))

    def test_a_text_has_line_and_column(self):
        error = self.error("problem: a\nmethod: observr\n")
        self.assertEqual((error.file, error.line, error.column), ("<text>", 2, 9))
        self.assertIn("did you mean 'observer'", error.message)

    def test_a_dict_has_the_key(self):
        error = self.error(spring(data={"A": [[0, 1], [0, "1 + q"]], "C": [[1, 0]]}))
        self.assertEqual((error.key, error.column, error.line), ("data.A(2, 2)", 5, None))
        method = {
            "data": {"A": "n x n"},
            "unknowns": {"P": "symmetric n"},
            "require": {"positive": "P > I", "decay": "He(P*A) + qq < 0"},
        }
        error = self.error({"problem": "p", "method": method, "data": {"A": [[-1]]}})
        self.assertEqual((error.key, error.column), ("method.require.decay", 11))
        self.assertEqual(self.error(spring(parmeters={})).key, "parmeters")
        self.assertEqual(self.error(spring(data={"A": [], "C": [[1, 0]]})).key, "data.A")

    def test_numbers_that_are_not_finite(self):
        error = self.error(spring(data={"A": [[0, 1], [float("nan"), 0]], "C": [[1, 0]]}))
        self.assertEqual(
            (error.key, error.message), ("data.A(2, 1)", "nan: a number must be finite")
        )
        self.assertEqual(self.error(spring(), set={"alpha": float("inf")}).key, "set.alpha")

    def test_what_is_no_value(self):
        self.assertEqual(self.error(spring(data={"A": object()})).key, "data.A")
        self.assertEqual(self.error(spring(parameters={3: 1})).key, "parameters")
        loop = spring()
        loop["data"] = loop
        self.assertIn("contains itself", self.error(loop).message)
        with self.assertRaisesRegex(TypeError, "a path, a text or a dict"):
            gs.synth(3)

    def test_unknown_names_of_set(self):
        error = self.error(spring(), set={"alfa": 3})
        self.assertEqual(error.key, "set.alfa")
        self.assertIn("'alfa'", error.message)

    def test_a_missing_file(self):
        error = self.error("nowhere.yaml")
        self.assertEqual(error.file, "nowhere.yaml")
        with self.assertRaises(FileNotFoundError):
            gs.load("nowhere.json")

    def test_unknown_options_have_the_nearest_one(self):
        with self.assertRaisesRegex(
            TypeError, r"synth\(\) has no option 'efort'; did you mean 'effort'\?"
        ):
            gs.synth(spring(), efort="full")
        with self.assertRaisesRegex(
            TypeError, r"verify\(\) has no option 'rums'; did you mean 'runs'\?"
        ):
            gs.synth(spring()).verify(rums=3)

    def test_wrong_values_of_options(self):
        with self.assertRaisesRegex(gs.InputError, "--runs"):
            gs.verify(spring(), runs="many")
        with self.assertRaisesRegex(TypeError, "set is a dict"):
            gs.synth(spring(), set="alpha=3")
        with self.assertRaisesRegex(TypeError, "over is a dict"):
            gs.scan(spring(), "alpha=1:3")
        with self.assertRaisesRegex(gs.InputError, "known: c, matlab"):
            gs.export(gs.synth(spring()), to="fortran")

    def test_a_file_that_is_no_gain_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "gains.json")
            with open(path, "w", encoding="utf-8") as file:
                file.write("[]")
            with self.assertRaisesRegex(gs.InputError, "no gain file"):
                gs.load(path)


class Program(unittest.TestCase):
    def test_one_that_is_missing(self):
        with mock.patch.dict(os.environ, GAINSMITH="/nowhere/gainsmith"):
            with self.assertRaisesRegex(
                gs.ProgramError, "/nowhere/gainsmith: there is no such program"
            ):
                gs.synth(spring())
        with mock.patch.dict(os.environ, PATH=""):
            del os.environ["GAINSMITH"]
            with self.assertRaisesRegex(gs.ProgramError, "was not found"):
                gs.synth(spring())

    def test_path_and_prefix(self):
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "bin"))
            os.makedirs(os.path.join(folder, "lib/python3/dist-packages"))
            os.symlink(PROGRAM, os.path.join(folder, "bin/gainsmith"))
            os.symlink(
                os.path.join(MODULE, "gainsmith"),
                os.path.join(folder, "lib/python3/dist-packages/gainsmith"),
            )
            code = "import gainsmith._program as p; print(p.find())"

            def found(**environment):
                return subprocess.run(
                    [sys.executable, "-B", "-c", code],
                    env=environment,
                    capture_output=True,
                    text=True,
                    check=True,
                ).stdout.strip()

            expected = os.path.join(folder, "bin/gainsmith")
            self.assertEqual(
                found(PYTHONPATH=os.path.join(folder, "lib/python3/dist-packages"), PATH=""),
                expected,
            )
            self.assertEqual(found(PYTHONPATH=MODULE, PATH=os.path.join(folder, "bin")), expected)

    def test_one_that_fails_or_is_killed(self):
        with tempfile.TemporaryDirectory() as folder:
            fake = os.path.join(folder, "fake")
            for script, message, code in (
                ("echo broken >&2; exit 70", "exit code 70\nbroken", 70),
                ("kill -KILL $$", "ended by SIGKILL", -9),
                ("echo nothing", "no gain file", 0),
            ):
                with open(fake, "w", encoding="utf-8") as file:
                    file.write(f"#!/bin/sh\ncat > /dev/null\n{script}\n")
                os.chmod(fake, 0o755)
                with mock.patch.dict(os.environ, GAINSMITH=fake):
                    with self.assertRaisesRegex(gs.ProgramError, message) as caught:
                        gs.synth(spring())
                    self.assertEqual(caught.exception.code, code)

    def test_an_interrupt_ends_it(self):
        """Only Python gets the signal, as in a notebook; a program just started ends too."""
        code = textwrap.dedent(
            f"""
            import sys
            sys.path.insert(0, {MODULE!r})
            import gainsmith
            try:
                gainsmith.synth({spring()!r}).verify(runs=1e12)
            except KeyboardInterrupt:
                print("interrupted")
            """
        )
        started = subprocess.Popen(
            [sys.executable, "-B", "-c", code],
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        children = []
        until = time.monotonic() + 20
        while time.monotonic() < until and not any("verify" in command for command in children):
            time.sleep(0.05)
            children = self.commands_of_children(started.pid)
        self.assertTrue(any("verify" in command for command in children), children)
        child = self.children(started.pid)[0]
        os.kill(started.pid, signal.SIGINT)
        self.assertEqual(started.communicate(timeout=20)[0], "interrupted\n")
        self.assertFalse(os.path.exists(f"/proc/{child}"))

    @staticmethod
    def children(pid):
        with open(f"/proc/{pid}/task/{pid}/children", encoding="ascii") as file:
            return file.read().split()

    def commands_of_children(self, pid):
        found = []
        for child in self.children(pid):
            try:
                with open(f"/proc/{child}/cmdline", encoding="utf-8") as file:
                    found.append(file.read())
            except OSError:  # it ended
                pass
        return found


class Results(unittest.TestCase):
    def test_no_and_undecided_are_results(self):
        hidden = gs.synth(spring(data={"A": [[1, 0], [0, 1]], "C": [[1, 0]]}))
        self.assertEqual((hidden.verdict, hidden.status, hidden.gains), ("no", "infeasible", {}))
        self.assertIn("certificate", hidden.file)
        why = gs.explain(spring(data={"A": [[1, 0], [0, 1]], "C": [[1, 0]]}))
        self.assertEqual(why.verdict, "no")
        self.assertIn("decay", why.conflict["requirements"])
        self.assertEqual(gs.synth(problem("reset-observer/t2-3.3")).verdict, "undecided")

    def test_a_limit_of_time_without_a_result(self):
        with self.assertRaisesRegex(gs.ProgramError, "stopped after 0.001 s") as caught:
            gs.synth(problem("designs/arm-observer"), time=0.001)
        self.assertEqual(caught.exception.code, 3)

    def test_a_design(self):
        design = gs.synth(spring())
        self.assertEqual(design["L"], design.gains["L"])
        self.assertEqual(design.margin, min(each["reached"] for each in design.file["margins"]))
        self.assertEqual(set(design.margins), {"scale", "decay", "gain"})
        self.assertRegex(repr(design), r"problem     spring\nmethod      observer\nverdict     yes")
        with self.assertRaisesRegex(KeyError, "did you mean"):
            design["l"]
        for copied in (copy.deepcopy(design), pickle.loads(pickle.dumps(design))):
            self.assertEqual(copied.gains, design.gains)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "gains.json")
            design.save(path)
            loaded = gs.load(path)
            self.assertEqual((loaded.text, loaded.gains), (design.text, design.gains))
            self.assertEqual(gs.verify(path, runs=20).verdict, "held")

    def test_check_proves_edited_gains(self):
        design = gs.synth(spring())
        self.assertEqual(design.check().verdict, "yes")
        edited = json.loads(design.text)
        edited["gains"]["L"] = [[0], [0]]
        self.assertEqual(gs.check(edited).verdict, "no")
        valid = gs.check(spring())
        self.assertEqual((valid.verdict, valid.valid, valid.dimensions["n"]), ("yes", True, 2))

    def test_the_second_program_proves_it(self):
        try:
            proof = gs.synth(spring()).certify()
        except gs.InputError as error:
            self.assertIn("python3-yaml", error.message)
            self.skipTest(error.message)
        self.assertEqual(proof.verdict, "proved")
        self.assertTrue(all(claim["result"] == "proved" for claim in proof.claims))

    def test_campaigns(self):
        design = gs.synth(spring())
        held = design.verify(runs=40, seed=5)
        self.assertEqual((held.verdict, held.runs, held.seed, held.violations), ("held", 40, 5, 0))
        self.assertAlmostEqual(held.probability, 1 - 0.05 ** (1 / 40), places=12)
        self.assertEqual(set(held.claims), {"lyapunov", "error"})
        self.assertRegex(repr(held), r"^campaign    held in 40 runs")
        self.assertNotIn("gainsmith simulate", repr(held))
        worst = held.replay()
        self.assertAlmostEqual(
            worst["lyapunov"][-1], held.claims["lyapunov"]["worst"]["value"], delta=1e-6
        )
        with self.assertRaisesRegex(AttributeError, "did you mean 'runs'"):
            held.rnus

    def test_runs_by_probability_and_kept(self):
        design = gs.synth(spring())
        # 0.9^n <= 0.1 from n = 22 on.
        self.assertEqual(design.verify(probability=0.1, confidence=0.9).runs, 22)
        with tempfile.TemporaryDirectory() as folder:
            kept = os.path.join(folder, "kept")
            first = design.verify(runs=64, resume=kept)
            self.assertTrue(os.listdir(kept))
            self.assertEqual(design.verify(runs=64, resume=kept).claims, first.claims)

    def test_a_violated_claim(self):
        claim = {"small": {"below": "norm(x)", "bound": 0.5}}
        free = {
            "problem": "free",
            "method": {"plant": {"state": {"x": 1}, "flow": {"x": "-x"}}, "claims": claim},
            "campaign": {"horizon": 1, "initial": {"x": {"box": [-1, 1]}}},
        }
        violated = gs.verify(free, runs=50)
        self.assertEqual(violated.verdict, "violated")
        starts = [gs.simulate(free, run=run)["x"][0] for run in range(5)]
        self.assertEqual(
            gs.verify(free, runs=5).violations, sum(abs(start) > 0.5 for start in starts)
        )
        found = gs.worst(free, runs=50)
        self.assertEqual(found.verdict, "violated")
        again = gs.simulate(free, given=found.claims[0]["given"])
        self.assertAlmostEqual(abs(again["x"][0]), found.claims[0]["value"], places=6)

    def test_a_run_is_a_table(self):
        run = gs.synth(spring()).simulate(run=3, step=0.25)
        self.assertEqual(list(run)[:5], ["t", "j", "event", "x1", "x2"])
        self.assertEqual((run.t[0], run.t[-1], run.j[-1], run.ending), (0, 2, 0, "horizon"))
        self.assertTrue(all(len(column) == run.rows for column in run.values()))
        self.assertEqual(run["e"], [[a, b] for a, b in zip(run["e1"], run["e2"])])
        for e, x, estimate in zip(run["e1"], run["x1"], run["xh1"]):
            self.assertAlmostEqual(e, x - estimate, places=12)
        with self.assertRaisesRegex(KeyError, "there is no column 'z'"):
            run["z"]
        self.assertTrue(run._repr_html_().startswith("<svg"))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run.svg")
            run.plot(path, panels="e")
            self.assertTrue(os.path.getsize(path) > 1000)
        pickle.loads(pickle.dumps(run))

    def test_an_event_column_is_a_list_of_texts(self):
        run = gs.synth(problem("ferrante-seuret-2021/t2-0.70")).simulate()
        self.assertEqual({"", "timer"}, set(run["event"]))
        self.assertEqual(sum(event == "timer" for event in run["event"]), run.j[-1])

    def test_a_scan_is_a_table(self):
        scan = gs.scan(
            problem("ferrante-seuret-2021/t2-0.70"), {"T2": (0.5, 0.8, 3)}, show="norm(L)"
        )
        self.assertEqual(scan["T2"], [0.5, 0.65, 0.8])
        self.assertEqual((scan["verdict"], scan.verdict), (["yes", "yes", "no"], "yes"))
        one = gs.synth(problem("ferrante-seuret-2021/t2-0.70"), set={"T2": 0.65})
        self.assertAlmostEqual(scan["objective"][1], one.objective, delta=1e-6 * one.objective)
        self.assertNotEqual(scan["objective"][2], scan["objective"][2])  # nan
        self.assertAlmostEqual(
            scan["norm(L)"][1], sum(row[0] ** 2 for row in one.gains["L"]) ** 0.5, places=6
        )
        self.assertRegex(repr(scan), r"T2 +verdict +objective +norm\(L\)\n")
        self.assertIn("<th>norm(L)</th>", scan._repr_html_())
        self.assertEqual(
            gs.scan(problem("ferrante-seuret-2021/t2-0.70"), {"T2": (0.8, 0.9, 2)}).verdict, "no"
        )

    def test_bisect_finds_both_ends(self):
        found = gs.bisect(
            problem("ferrante-seuret-2021/t2-0.70"), largest={"T2": (0.5, 1.1)}, tolerance=0.05
        )
        self.assertLessEqual(found.search["beyond"] - found.search["value"], 0.05)
        self.assertEqual(found.searched["T2"], found.search["value"])
        answers = {sample["value"]: sample["answer"] for sample in found.samples}
        self.assertEqual(answers[found.search["beyond"]], "no")
        self.assertEqual(found.verify(runs=10).verdict, "held")
        self.assertIn("is infeasible by a checked certificate", repr(found))
        none = gs.bisect(
            problem("ferrante-seuret-2021/t2-0.70"), largest={"T2": (0.9, 1.1)}, tolerance=0.1
        )
        self.assertNotEqual(none.verdict, "yes")

    def test_optimize_moves_scalars(self):
        found = gs.optimize(
            problem("ferrante-seuret-2021/t2-0.70"), over={"delta": (1e-3, 1)}, evaluations=6
        )
        self.assertEqual(found.verdict, "yes")
        self.assertEqual(found.objective, found.search["value"])
        fixed = gs.synth(
            problem("ferrante-seuret-2021/t2-0.70"), set={"delta": found.searched["delta"]}
        )
        self.assertAlmostEqual(fixed.objective, found.objective, delta=1e-5 * found.objective)

    def test_a_gain_that_is_a_polynomial(self):
        method = {
            "data": {"T": "scalar"},
            "unknowns": {"K": {"shape": "scalar", "of": "s", "degree": 1}},
            "require": {"low": {"forall": "s in [0, T]", "that": "K(s) > 1 + s"}},
            "minimize": "K(0) + K(T)",
            "gains": {"F(s)": "2*K(s)"},
        }
        design = gs.synth({"problem": "line", "method": method, "data": {"T": 3}})
        gain = design.gain_functions["F"]
        self.assertEqual((gain.of, gain.kind), ("s", "polynomial"))
        self.assertAlmostEqual(gain(2)[0][0], 6, places=5)

    def test_a_report_is_a_page(self):
        design = gs.synth(spring(problem="spring & <mass>"))
        page = gs.report(design)
        self.assertTrue(page.lstrip().startswith("<!DOCTYPE html>"))
        self.assertIn("spring &amp; &lt;mass&gt;", page)
        frame = design._repr_html_()
        self.assertTrue(frame.startswith("<iframe srcdoc="))
        self.assertEqual(html.unescape(frame.split('"')[1]), page)
        self.assertIn("held in 30 runs", html.unescape(design.verify(runs=30)._repr_html_()))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.html")
            self.assertIn("spring &amp; &lt;mass&gt;", gs.report(design.file, path))
            self.assertTrue(os.path.getsize(path) > 1000)
            gains = os.path.join(folder, "gains.json")
            design.save(gains)
            self.assertEqual(gs.report(gains), page)
            self.assertIn("held in 9 runs", gs.report(gains, campaign=gs.verify(gains, runs=9)))

    def test_exports(self):
        design = gs.synth(spring(), set={"margin": 1e-7})
        self.assertEqual(json.loads(design.export("json"))["gains"], design.gains)
        with self.assertRaisesRegex(
            gs.InputError, "at single precision the inequalities do not hold"
        ):
            gs.synth(spring()).export("c", single=True)
        with tempfile.TemporaryDirectory() as folder:
            self.assertIsNone(design.export("c", os.path.join(folder, "observer.h"), single=True))
            with open(os.path.join(folder, "observer.h"), encoding="utf-8") as file:
                self.assertIn("float", file.read())

    def test_semidefinite_programs(self):
        # Minimise x1 + x2 with [x1, 1; 1, x2] >= 0: both are 1.
        text = "2\n1\n2\n1 1\n0 1 1 2 -1\n1 1 1 1 1\n2 1 2 2 1\n"
        solution = gs.solve(text)
        self.assertEqual(solution.status, "optimal")
        self.assertAlmostEqual(solution.primal_objective, 2, places=6)
        for i, row in enumerate([[1, 1], [1, 1]]):
            for j, value in enumerate(row):
                self.assertAlmostEqual(solution.X[0][i][j], value, places=6)
        self.assertEqual([round(value, 6) for value in solution.x], [1, 1])

    def test_the_semidefinite_program_of_a_problem(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "spring.dat-s")
            design = gs.synth(spring(), sdpa=path)
            with open(path, encoding="utf-8") as file:
                factor = float(re.search(r"\(c'x\)/([\d.e+-]+)", file.read())[1].rstrip("."))
            solution = gs.solve(path)
        optimum = solution.primal_objective / factor
        self.assertAlmostEqual(optimum, design.objective, delta=1e-4 * design.objective)

    def test_infeasible_programs(self):
        # x >= 1 and x <= 0.
        solution = gs.solve("1\n1\n-2\n0\n0 1 1 1 1\n1 1 1 1 1\n1 1 2 2 -1\n")
        self.assertEqual(solution.status, "primal-infeasible")
        # Minimise x with x >= 1, x >= -2: the block is diagonal.
        diagonal = gs.solve("1\n1\n-2\n1\n0 1 1 1 1\n0 1 2 2 -2\n1 1 1 1 1\n1 1 2 2 1\n")
        self.assertEqual([round(value, 6) for value in diagonal.X[0]], [0, 3])

    def test_every_function_is_explained(self):
        for name in gs.__all__:
            self.assertTrue(inspect.getdoc(getattr(gs, name)), name)
        for name in (
            "synth",
            "optimize",
            "bisect",
            "scan",
            "explain",
            "verify",
            "simulate",
            "check",
            "certify",
            "solve",
        ):
            command = subprocess.run(
                [PROGRAM, name, "--help"], capture_output=True, text=True, check=True
            ).stdout
            for option in inspect.signature(getattr(gs, name)).parameters.values():
                if option.kind == option.KEYWORD_ONLY:
                    self.assertIn(f"--{option.name} ", command, name)


if __name__ == "__main__":
    main()
