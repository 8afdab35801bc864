"""A no at an eigenvalue: multipliers that are right, and such as are not."""

import unittest
from fractions import Fraction

import helper
from algebraic import root_near
from arithmetic import Undecided, is_exact, middle, upper
from helper import gain, problem
from no import prove_no
from statement import Damaged

LYAPUNOV = ("problem: p\nmethod:\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n  require:\n"
            "    positive: P %s 0\n    decrease: \"%s\"\ndata: {A: %s}\n")
CONTINUOUS, DISCRETE = "He(P*A) %s 0", "A'*P*A - P %s 0"

def certificate(p, near, vectors, weights):
    def texts(x): return [texts(y) for y in x] if isinstance(x, list) else str(x)
    return {"algebraic": {
        "of": "A", "polynomial": texts(p), "near": [helper.Numeral(str(x)) for x in near],
        "terms": [{"block": k, "vector": texts(z), "weight": texts(weights[k])}
                  for k, z in vectors.items()]}}

def answer(text, given): return prove_no(problem(text, {}), given).result

class Roots(unittest.TestCase):
    def test_roots_with_what_is_exact(self):
        for p, near, re, im, square in (
                ([-2, 0, 1], (1.4, 0), None, 0, 2), ([3, 0, 1], (0, -1.7), 0, None, 3),
                ([1, Fraction(-6, 5), 1], (0.6, 0.8), None, None, 1),
                ([Fraction(-1, 3), 1], (0.3, 0), Fraction(1, 3), 0, Fraction(1, 9))):
            found = root_near([Fraction(x) for x in p], *map(Fraction, near))
            for value, exact in zip(found, (re, im, square)):
                if exact is None: continue
                self.assertLess(upper(value - exact), Fraction(1, 10 ** 50))
            self.assertEqual(is_exact(found[0]), re is not None)
            self.assertEqual(is_exact(found[2]), square == 1 or len(p) == 2)
        # The root near 1.0000001 of a polynomial that is not its own mirror image.
        found = root_near([Fraction(-10000001, 10 ** 7), Fraction(-1, 10 ** 9), Fraction(1)],
                          Fraction(1), Fraction(0))
        self.assertFalse(is_exact(found[2]))
        self.assertGreater(middle(found[2]), 1)

    def test_what_is_no_simple_root(self):
        for p, near in (([1, 2, 1], (-1, 0)), ([2, 0, 0, 1, 0, 0, 1], (50, 50))):
            with self.assertRaises(Undecided):
                root_near([Fraction(x) for x in p], *map(Fraction, near))

class Eigenvalues(unittest.TestCase):
    # A = [0 1; 2 1] has the eigenvalues 2 and -1: w = (1, l)'.
    A, P, Z = "[[0, 1], [2, 1]]", [-2, -1, 1], [[1, 0], [0, 1]]
    both = {"positive": Z, "decrease": Z}

    def given(self, near=2, weights=None, p=None, vectors=None):
        return certificate(p or self.P, (near, 0), vectors or self.both,
                           weights or {"positive": [0, 1, 0], "decrease": [1, 0, 0]})

    def test_lyapunov(self):
        text = LYAPUNOV % (">", CONTINUOUS % "<", self.A)
        self.assertEqual(answer(text, self.given()), "proved")
        for wrong in (self.given(-1),                                   # l + m < 0
                      self.given(2, {"positive": [0, 1, 0], "decrease": [2, 0, 0]}),
                      self.given(2, {"positive": [1, 0, 0], "decrease": [1, 0, 0]}),
                      self.given(2, {"positive": [0, -1, 0], "decrease": [-1, 0, 0]}),
                      self.given(2, {"positive": [0, 0, 0], "decrease": [0, 0, 0]}),
                      self.given(2, p=[-2, -1 + Fraction(1, 10 ** 9), 1]),
                      self.given(2, vectors=dict(self.both, decrease=[[1, 0], [0, 2]])),
                      self.given(2, vectors=dict.fromkeys(self.both, [[0, 0], [0, 0]])),
                      self.given(2, vectors={"positive": self.Z}),
                      self.given(40)):
            self.assertEqual(answer(text, wrong), "open", wrong)

    def test_what_is_feasible(self):
        for signs in ((">=", "<="), (">", ">"), ("<", "<")):
            text = LYAPUNOV % (signs[0], CONTINUOUS % signs[1], self.A)
            self.assertEqual(answer(text, self.given()), "open", signs)
        for a in ("[[0, 1], [-2, -1]]", "[[0, 1], [2, 1.0000001]]"):
            self.assertEqual(answer(LYAPUNOV % (">", CONTINUOUS % "<", a), self.given()), "open", a)

    def test_the_limit(self):
        # A = [0 1; -3 0] has +-i sqrt(3), so that l + m = 0.
        text = LYAPUNOV % (">", CONTINUOUS % "<", "[[0, 1], [-3, 0]]")
        given = certificate([3, 0, 1], (0, 1.7320508), self.both,
                            {"positive": [0, 1, 0], "decrease": [1, 0, 0]})
        self.assertEqual(answer(text, given), "proved")
        weak = LYAPUNOV % (">", CONTINUOUS % "<=", "[[0, 1], [-3, 0]]")
        self.assertEqual(answer(weak, given), "open")       # P has the weight l + m, which is 0
        # Their real part is -1e-70, in a disk of 2^-200.
        for diagonal, expected in (("-1e-70", "open"), ("1e-70", "open"), ("0", "proved")):
            x = Fraction(diagonal)
            near = LYAPUNOV % (">", CONTINUOUS % "<", "[[%s, 1], [-1, %s]]" % (diagonal, diagonal))
            z = [[1, 0], [-x, 1]]
            given = certificate([1 + x * x, -2 * x, 1], (0, 1), {"positive": z, "decrease": z},
                                {"positive": [0, 1, 0], "decrease": [1, 0, 0]})
            self.assertEqual(answer(near, given), expected, diagonal)
        # A turns by the angle of 3/5 + 4/5 i.
        turn = "[[0.6, 0.8], [-0.8, 0.6]]"
        w = [[Fraction(4, 5), 0], [Fraction(-3, 5), 1]]     # (A - l) w = 0
        given = certificate([1, Fraction(-6, 5), 1], (0.6, 0.8), {"positive": w, "decrease": w},
                            {"positive": [-1, 0, 1], "decrease": [1, 0, 0]})
        self.assertEqual(answer(LYAPUNOV % (">", DISCRETE % "<", turn), given), "proved")
        self.assertEqual(answer(LYAPUNOV % (">", DISCRETE % "<=", turn), given), "open")

    def test_constant_parts(self):
        # P > c I and He(P*A) < 0: the constant part is (l + m) c |w|^2.
        for c, expected in (("1", "proved"), ("-1", "open")):
            text = LYAPUNOV.replace("P %s 0", "P >= " + c + "*eye(2)%.0s") % \
                ("", CONTINUOUS % "<=", self.A)
            self.assertEqual(answer(text, self.given()), expected, c)

    def test_equations_take_multipliers_of_any_sign(self):
        text = LYAPUNOV % (">", CONTINUOUS % "==", self.A)
        for p, e, expected in ((1, -1, "proved"), (1, 1, "open"), (-1, 1, "open"), (0, 0, "open")):
            # Of [0, E; E', 0] >= 0 the vector (e z/2, z) takes e z*E z.
            z = [[Fraction(e * x, 2) for x in row] for row in self.Z] + self.Z
            given = self.given(2, {"positive": [0, p, 0], "decrease": [1, 0, 0]},
                               vectors={"positive": self.Z, "decrease": z})
            self.assertEqual(answer(text, given), expected, (p, e))

    def test_damage(self):
        text = LYAPUNOV % (">", CONTINUOUS % "<", self.A)
        for key, value in (("polynomial", ["1", "x", "1"]), ("polynomial", ["1"]), ("near", ["1"]),
                           ("polynomial", ["1", "1/0", "1"]), ("polynomial", ["1", "2"]),
                           ("terms", None), ("terms", [1]), ("terms", [{}])):
            given = self.given()
            given["algebraic"][key] = value
            with self.assertRaises(Damaged, msg=(key, value)): answer(text, given)
        for key, value in (("vector", [["1"]]), ("vector", None), ("vector", [1, 2]),
                           ("weight", ["1"]), ("weight", None), ("block", None)):
            given = self.given()
            given["algebraic"]["terms"][0][key] = value
            with self.assertRaises(Damaged, msg=(key, value)): answer(text, given)
        given["algebraic"]["terms"][0]["block"] = "another"
        self.assertEqual(answer(text, given), "open")

    def test_rational_multipliers(self):
        # trace(P) <= 1 and P >= I: I of the second, 1 of the first; two terms of one block.
        text = ("problem: p\nmethod:\n  unknowns: {P: symmetric 2}\n  require:\n"
                "    most: trace(P) <= %s\n    least: P >= eye(2)\n")
        given = certificate([0, 1], (0, 0), {"most": [["1"]]}, {"most": [1, 0, 0]})
        for vector in ([["1"], ["0"]], [["0"], ["1"]]):
            given["algebraic"]["terms"].append(
                {"block": "least", "vector": vector, "weight": ["1", "0", "0"]})
        for most, expected in (("1", "proved"), ("1.999", "proved"), ("2", "open"), ("3", "open")):
            self.assertEqual(answer(text % most, given), expected, most)

    def test_steps(self):
        # Row 1 of P must be 0, so row 1 of Q, so P(2, 2) + Q(1, 1) = 0, which is to be at least 1.
        text = ("problem: p\nmethod:\n  unknowns: {P: symmetric 2, Q: symmetric 2}\n  require:\n"
                "    first: P(1, 1) %s\n    second: \"P %s 0\"\n    third: Q >= 0\n"
                "    fourth: Q(1, 1) == P(1, 2)\n    fifth: \"Q(1, 2) %s 1\"\n")
        def given(last):
            def term(block, vector, step):
                return {"block": block, "vector": [[x] for x in vector.split()],
                        "weight": ["1", "0", "0"], "step": helper.Numeral(step)}
            found = certificate([0, 1], (0, 0), {}, {})
            found["algebraic"]["terms"] = [
                term("first", "1", 1), term("second", "1 0", 1), term("fourth", "1 0", 2),
                term("fourth", "0 1", 2), term("third", "1 0", last), term("fifth", "1", 4)]
            return found
        for first, second, fifth, last, expected in (
                ("<= 0", ">=", ">=", 3, "proved"), ("<= 0", ">=", ">", 3, "proved"),
                ("<= 0", ">", ">=", 3, "proved"), ("<= -1", ">=", "<=", 3, "proved"),
                ("<= 0", ">=", "<=", 3, "open"), ("<= 1e-90", ">=", ">=", 3, "open"),
                ("<= 0", ">=", ">=", 4, "open"), ("<= 0", ">=", ">=", 1, "open")):
            self.assertEqual(answer(text % (first, second, fifth), given(last)), expected,
                             (first, second, fifth, last))
        weightless = given(3)
        for term in weightless["algebraic"]["terms"][:2]: term["weight"] = ["0", "0", "0"]
        self.assertEqual(answer(text % ("<= 0", ">=", ">="), weightless), "open")

    def test_files(self):
        for name in ("lyapunov-no", "undetectable", "uncontrollable", "two-steps"):
            found = gain(name)
            self.assertIn("algebraic", found["certificate"])
            self.assertEqual(prove_no(found, found["certificate"]).result, "proved", name)

if __name__ == "__main__":
    unittest.main()
