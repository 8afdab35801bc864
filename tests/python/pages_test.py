"""docs/coming-from.md: the number in bold of each problem is that of gainsmith, and of NumPy alone.

    pages_test.py TREE GAINSMITH

tests/docs runs the commands of the page.
"""
import os
import re
import unittest

from support import TREE, main, with_numpy

with_numpy()
import numpy as np  # noqa: E402

import gainsmith as gs  # noqa: E402

with open(os.path.join(TREE, "docs/coming-from.md"), encoding="utf-8") as file:
    SECTIONS = file.read().split("\n## ")[1:]


def section(number):
    return next(text for text in SECTIONS if text.startswith(f"{number}. "))


def problem_of(number):
    return re.search(r"```yaml\n(.*?)```", section(number), re.S)[1]


def printed_by(number):
    """The variables of the Python of gainsmith in a section, once it ran."""
    code = next(
        block
        for block in re.findall(r"```python\n(.*?)```", section(number), re.S)
        if "import gainsmith" in block
    )
    names = {"print": lambda *_: None}
    exec(code, names)  # pylint: disable=exec-used
    return names


def riccati(A, B, Q, R):
    """X of A'X + XA - X B inv(R) B'X + Q = 0, from the stable eigenvectors of the Hamiltonian."""
    n = len(A)
    values, vectors = np.linalg.eig(np.block([[A, -B @ np.linalg.inv(R) @ B.T], [-Q, -A.T]]))
    stable = vectors[:, values.real < 0]
    return (stable[n:] @ np.linalg.inv(stable[:n])).real


def symmetric(p):
    return np.array([[p[0], p[1]], [p[1], p[2]]])


def rate(P, vertices):
    """The largest alpha with A'P + PA + 2 alpha P <= 0 at all vertices."""
    root = np.linalg.inv(np.linalg.cholesky(P))
    return min(-np.linalg.eigvalsh(root @ (P @ A + A.T @ P) @ root.T).max() / 2 for A in vertices)


class ComingFrom(unittest.TestCase):
    def both_give(self, number, ours, theirs, tolerance=1e-6):
        (shown,) = re.findall(r"\*\*([\d.]+)\*\*", section(number))
        digits = 10.0 ** -len(shown.partition(".")[2])
        for value in (ours, theirs):
            self.assertAlmostEqual(
                value, float(shown), delta=0.51 * digits + tolerance, msg=section(number)[:40]
            )

    def test_eight_problems(self):
        self.assertEqual(
            [text[:2] for text in SECTIONS if text[0].isdigit()], [f"{i}." for i in range(1, 9)]
        )

    def test_lyapunov(self):
        A = np.array([[0, 1], [-2, -3]])
        P = np.linalg.solve(
            np.kron(np.eye(2), A.T) + np.kron(A.T, np.eye(2)), -np.eye(2).ravel()
        ).reshape(2, 2)
        self.both_give(1, gs.synth(problem_of(1)).objective, np.trace(P))

    def test_polytope(self):
        vertices = [np.array([[-1, -1], [1, -1]]), np.array([[-1, -4], [0.25, -1]])]
        best, width = np.array([0.0, 0.0]), 2.0  # P = [1, b; b, b^2 + exp(c)], up to a factor
        for _ in range(40):
            grid = [
                best + width * np.array([x, y])
                for x in np.linspace(-1, 1, 9)
                for y in np.linspace(-1, 1, 9)
            ]
            best = max(
                grid, key=lambda p: rate(symmetric([1, p[0], p[0] ** 2 + np.exp(p[1])]), vertices)
            )
            width *= 0.7
        largest = rate(symmetric([1, best[0], best[0] ** 2 + np.exp(best[1])]), vertices)
        found = gs.bisect(problem_of(2), largest={"alpha": (0, 1)})
        self.both_give(2, found.search["value"], largest, 1e-4)
        self.assertEqual(found.search["beyond"], 0.25)

    def test_hinf_norm(self):
        s = 1j * np.linspace(0.9, 1.1, 200001)
        self.both_give(
            3, gs.synth(problem_of(3)).objective, np.abs(1 / (s**2 + 0.2 * s + 1)).max()
        )

    def test_h2_state_feedback(self):
        A, B = np.array([[0, 1], [0, 0]]), np.array([[0], [1]])
        X = riccati(A, B, np.eye(2), np.eye(1))
        design = gs.synth(problem_of(4))
        self.both_give(4, design.objective, np.trace(X))
        np.testing.assert_allclose(design["K"], -B.T @ X, atol=1e-3)

    def test_lqr(self):
        names = printed_by(5)
        X = riccati(names["A"], names["B"], names["Q"], np.array([[names["R"]]]))
        self.both_give(5, names["design"].objective, np.trace(X), 2e-5)
        np.testing.assert_allclose(names["design"]["K"], -names["B"].T @ X / names["R"], rtol=1e-4)

    def test_kalman(self):
        names = printed_by(6)
        A, G, C = (np.array(names["data"][name]) for name in "AGC")
        P = riccati(A.T, C.T, G @ G.T, np.eye(1))
        self.both_give(6, names["design"].objective, np.trace(P))
        np.testing.assert_allclose(names["design"]["L"], P @ C.T, atol=1e-3)

    def test_dwell_time(self):
        """NumPy checks the P of gainsmith, and just below the multipliers that exclude all P."""
        found = gs.bisect(problem_of(7), smallest={"T": (1, 5)}, tolerance=1e-5)
        A = [np.array([[0, 1], [-10, -1]]), np.array([[0, 1], [-0.1, -0.5]])]
        P = [found["P_1"], found["P_2"]]
        for i in range(2):
            E = self.exponential(A[i] * found["T"])
            for matrix in (P[i], -(P[i] @ A[i] + A[i].T @ P[i]), P[i] - E.T @ P[1 - i] @ E):
                self.assertGreater(np.linalg.eigvalsh(matrix).min(), 0)
        below = found.search["beyond"]
        Y = {
            name: np.array(value)
            for name, value in found.search["certificate"]["multipliers"].items()
        }
        E = [self.exponential(a * below) for a in A]
        basis = [np.array(b) for b in ([[1, 0], [0, 0]], [[0, 1], [1, 0]], [[0, 0], [0, 1]])]
        for i, j in ((0, 1), (1, 0)):

            def inner(name, matrix):
                return np.sum(Y[name] * matrix)

            for b in basis:  # the sum of all inequalities, each with its multiplier, has no P_i
                total = (
                    inner(f"positive at i = {i + 1}", b)
                    - inner(f"flow at i = {i + 1}", b @ A[i] + A[i].T @ b)
                    + inner(f"switch at i = {i + 1}, j = {j + 1}", b)
                    - inner(f"switch at i = {j + 1}, j = {i + 1}", E[j].T @ b @ E[j])
                )
                self.assertAlmostEqual(
                    total, 0, delta=1e-6 * max(abs(value).max() for value in Y.values())
                )
        for value in Y.values():
            self.assertGreater(np.linalg.eigvalsh(value).min(), 0)
        self.both_give(7, found.search["value"], below, 1e-5)

    @staticmethod
    def exponential(matrix):
        values, vectors = np.linalg.eig(matrix)
        return (vectors @ np.diag(np.exp(values)) @ np.linalg.inv(vectors)).real

    def test_pentagon(self):
        """Of a graph whose edges are all alike: -n least/(largest - least), of the eigenvalues."""
        adjacent = np.roll(np.eye(5), 1, axis=0) + np.roll(np.eye(5), -1, axis=0)
        values = np.linalg.eigvalsh(adjacent)
        solution = printed_by(8)["solution"]
        self.both_give(8, solution.dual_objective, -5 * values[0] / (values[-1] - values[0]))


if __name__ == "__main__":
    main()
