"""The module with NumPy: arrays in problems, and results that are arrays.

    numpy_test.py TREE GAINSMITH
"""
import os
import tempfile
import time
import unittest

from support import main, problem, spring, with_numpy

with_numpy()
import numpy as np  # noqa: E402

import gainsmith as gs  # noqa: E402

A = np.array([[0, 1], [-2, -0.5]])
C = np.array([[1, 0]])


def stable(matrix):
    return np.linalg.eigvals(matrix).real.max()


class Arrays(unittest.TestCase):
    def test_a_problem_has_arrays_of_any_kind(self):
        gain = gs.synth(spring()).gains["L"]
        for a in (
            A,
            A.tolist(),
            np.asfortranarray(A),
            np.matrix(A),
            list(A),
            np.array(A, dtype=object),
            np.ma.masked_array(A),
            A.astype(np.longdouble),
        ):
            np.testing.assert_array_equal(gs.synth(spring(data={"A": a, "C": C})).gains["L"], gain)
        self.assertEqual(gain.shape, (2, 1))
        self.assertLess(stable(A - gain @ C), -3 + 1e-6)

    def test_figures_of_linear_systems(self):
        loop = {
            "problem": "loop",
            "method": {"let": {"L": "5*tf(1, [1, 3, 2, 0])"}},
            "figures": {"loop": {"bode": "L"}, "modes": {"poles": "feedback(L)"}},
        }
        figures = gs.plot(loop)
        (found,) = figures["loop"].systems
        s = 1j * found.frequency
        np.testing.assert_allclose(found.response[1, 1], 5 / (s * (s + 1) * (s + 2)), rtol=1e-12)
        self.assertAlmostEqual(found.margins["gain"]["value"], 1.2, 12)
        self.assertTrue(figures["loop"].svg.startswith("<svg "))
        self.assertIn("gain margin 1.2", repr(figures["loop"]))
        self.assertEqual(list(gs.plot(loop, figures="modes")), ["modes"])
        self.assertEqual(len(figures["modes"].systems[0].poles), 3)
        gain = gs.synth(spring(figures={"error": {"poles": "ss(A - L*C, L, C, 0)"}}))
        poles = gain.plot()["error"].systems[0].poles
        self.assertLess(max(pole.real for pole in poles), -3 + 1e-6)

    def test_scans_and_draws_of_figures(self):
        figures = gs.plot(
            {
                "problem": "loop",
                "method": {},
                "data": {"k": 5, "d": 3, "G": "tf(1, [1, d, 2, 0])"},
                "uncertain": {"d": {"box": [2, 4]}},
                "figures": {
                    "margins": {"margins": "k*G", "scan": {"k": [1, 7]}},
                    "locus": {"poles": "feedback(k*G)", "scan": {"k": [1, 7]}},
                    "band": {"bode": "k*plant.G"},
                },
            }
        )
        name, values = figures["margins"].scan
        self.assertEqual(name, "k")
        np.testing.assert_allclose(figures["margins"].systems[0].gain_margin, 6 / values, rtol=1e-9)
        for poles in figures["locus"].systems[0].locus:
            self.assertAlmostEqual(sum(poles).real, -3, 9)
        # And at both ends of the box.
        self.assertEqual(len(figures["band"].draws[0].stable), 102)
        size, phase = figures["band"].bands
        self.assertTrue((size["low"] < size["high"]).all())
        self.assertEqual(size["x"].shape, phase["low"].shape)

    def test_designs_side_by_side(self):
        other = gs.synth(spring(parameters={"alpha": 4}))
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, "both.html")
            table = gs.compare({"calm": gs.synth(spring()), "quick": other}, page)
            with open(page, encoding="utf-8") as file:
                self.assertIn("calm, quick", file.read())
        self.assertEqual(table["alpha"], {"calm": "3", "quick": "4"})

    def test_a_sparse_matrix(self):
        class Sparse:  # as those of SciPy
            def toarray(self):
                return A

        design = gs.synth(spring(data={"A": Sparse(), "C": C}))
        np.testing.assert_array_equal(design.gains["L"], gs.synth(spring()).gains["L"])

    def test_numbers_of_numpy(self):
        for alpha in (np.float64(3), np.int32(3), np.array(3), np.array(3.0), np.float32(3)):
            self.assertEqual(gs.synth(spring(parameters={"alpha": alpha}))["alpha"], 3)
        self.assertEqual(gs.synth(spring(parameters={"alpha": 0.1 + 0.2}))["alpha"], 0.1 + 0.2)
        single = gs.synth(spring(parameters={"alpha": np.float32(0.1)}))
        self.assertEqual(single["alpha"], float(np.float32(0.1)))

    def test_a_column_and_a_row_may_be_flat(self):
        flat = gs.synth({"problem": "p", "method": "lqr", "data": {"A": A, "B": np.array([0, 1])}})
        column = gs.synth(
            {"problem": "p", "method": "lqr", "data": {"A": A, "B": np.array([[0], [1]])}}
        )
        np.testing.assert_array_equal(flat.gains["K"], column.gains["K"])

    def test_an_array_of_three_dimensions_is_a_family(self):
        vertices = np.array([[[-1, 0.5], [0, -2]], [[-1, 0], [0.5, -2]]])
        design = gs.synth(
            {"problem": "p", "method": "quadratic-stability", "data": {"A": vertices}}
        )
        self.assertEqual(design.verdict, "yes")
        P = design.unknowns["P"]
        for vertex in vertices:
            self.assertGreater(np.linalg.eigvalsh(-(P @ vertex + vertex.T @ P)).min(), 0)

    def test_what_is_not_finite_has_its_place(self):
        wrong = A.copy()
        wrong[1, 0] = np.nan
        for value, key in (
            (wrong, "data.A(2, 1)"),
            (np.array([A, wrong]), "data.A(2, 2, 1)"),
            (np.array([0, np.inf]), "data.A(2)"),
            (np.float64("nan"), "data.A"),
        ):
            with self.assertRaises(gs.InputError) as caught:
                gs.synth(spring(data={"A": value, "C": C}))
            self.assertEqual(caught.exception.key, key)
            self.assertIn("a number must be finite", caught.exception.message)

    def test_what_is_no_matrix(self):
        for value, message in (
            (np.zeros((2, 0)), r"empty \(2 x 0\)"),
            (np.zeros(0), r"empty \(0\)"),
            (A + 1j, "complex"),
            (np.array(["2020"], dtype="datetime64"), "a date is neither"),
            (np.ma.masked_equal(A, 1), "masked"),
        ):
            with self.assertRaisesRegex(gs.InputError, message) as caught:
                gs.synth(spring(data={"A": value, "C": C}))
            self.assertRegex(caught.exception.key, r"^data\.A")

    def test_set_takes_arrays(self):
        changed = gs.synth(spring(), set={"A": np.array([[0, 1], [-1, -1]])})
        same = gs.synth(spring(data={"A": np.array([[0, 1], [-1, -1]]), "C": C}))
        np.testing.assert_array_equal(changed.gains["L"], same.gains["L"])

    def test_a_large_problem(self):
        n = 300
        a = np.random.default_rng(1).normal(size=(n, n))
        began = time.monotonic()
        method = {"data": {"A": "n x n"}, "report": {"B": "A(1:2, :)"}}
        design = gs.synth({"problem": "large", "method": method, "data": {"A": a}})
        np.testing.assert_array_equal(design.report["B"], a[:2])
        self.assertLess(time.monotonic() - began, 60)


class Results(unittest.TestCase):
    def test_a_design_is_as_its_matrices_say(self):
        design = gs.synth({"problem": "p", "method": "lqr", "data": {"A": A, "B": [[0], [1]]}})
        K = design["K"]
        self.assertEqual(K.shape, (1, 2))
        X = np.linalg.solve(
            np.kron(np.eye(2), (A + [[0], [1]] @ K).T) + np.kron((A + [[0], [1]] @ K).T, np.eye(2)),
            -(np.eye(2) + K.T @ K).ravel(),
        ).reshape(2, 2)
        self.assertAlmostEqual(np.trace(X), design.objective, places=5)  # the cost over all starts

    def test_a_run_has_arrays(self):
        run = gs.synth(spring()).simulate(run=2)
        self.assertEqual(run.t.shape, (run.rows,))
        self.assertEqual(run["e"].shape, (run.rows, 2))
        np.testing.assert_allclose(run["e"], run["x"] - run["xh"], atol=1e-12)
        self.assertTrue((np.diff(run.t) >= 0).all())
        exact = A - gs.synth(spring()).gains["L"] @ C
        values, vectors = np.linalg.eig(exact)
        at_end = (
            vectors @ np.diag(np.exp(values * run.t[-1])) @ np.linalg.inv(vectors) @ run["e"][0]
        ).real
        np.testing.assert_allclose(run["e"][-1], at_end, atol=1e-8)

    def test_a_scan_over_evenly_spaced_values(self):
        scan = gs.scan(spring(), {"alpha": np.linspace(1, 3, 5)}, show=["norm(L)"])
        np.testing.assert_allclose(scan["alpha"], np.linspace(1, 3, 5), rtol=1e-12)
        self.assertTrue((np.diff(scan["objective"]) > 0).all())
        logarithmic = gs.scan(spring(), {"alpha": np.geomspace(0.5, 5, 3)})
        np.testing.assert_allclose(logarithmic["alpha"], np.geomspace(0.5, 5, 3), rtol=1e-9)
        with self.assertRaisesRegex(gs.InputError, "evenly spaced"):
            gs.scan(spring(), {"alpha": np.array([1, 2, 5])})

    def test_a_scan_over_two_scalars(self):
        scan = gs.scan(spring(), {"alpha": (1, 2, 2), "shrink": 0.5})
        self.assertEqual(scan["alpha"].tolist(), [1, 2])
        self.assertEqual(scan["shrink"].tolist(), [0.5, 0.5])

    def test_edited_gains_may_be_arrays(self):
        design = gs.synth(spring())
        file = dict(design.file, gains={"L": design.gains["L"] * 1.001})
        self.assertEqual(gs.check(file).edited, ["L"])

    def test_a_hybrid_run(self):
        run = gs.synth(problem("ferrante-seuret-2021/t2-0.70")).simulate()
        jumps = np.diff(run.j) == 1
        self.assertEqual(jumps.sum(), run.j[-1])
        np.testing.assert_array_equal(run.t[1:][jumps], run.t[:-1][jumps])


if __name__ == "__main__":
    main()
