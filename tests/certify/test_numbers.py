"""Numbers: identities that fractions decide, and enclosures of values with 50 digits."""

import random
import unittest
from fractions import Fraction

import helper
from arithmetic import (ONE, PI, Affine, Ball, Dual, Taylor, Undecided, Unsupported, ball,
                        function, inverse, sign)
from matrices import (classify, is_positive, is_positive_on_box, spectral_norm, witness,
                      Matrix, invert, join_blocks, null_space, POSITIVE, SEMIDEFINITE, NEGATIVE)

R = random.Random(7)

def fraction(size=4): return Fraction(R.randint(-10 ** size, 10 ** size), R.randint(1, 10 ** size))

def holds(b, x):
    """Whether the ball b holds the fraction x."""
    return abs(Fraction(b.m, ONE) - x) <= Fraction(b.r, ONE)

def member(b):
    """A random fraction of the ball, often an end."""
    return Fraction(b.m, ONE) + Fraction(b.r, ONE) * R.choice([1, -1, 0, Fraction(1, 3)])

def wide(): return Ball(R.randint(-3 * ONE, 3 * ONE), R.randint(0, ONE >> R.choice([1, 3, 200])))

def value(model, t):
    """The polynomial of a Taylor model with fractions at t."""
    total = Fraction(0)
    for e, c in model.terms.items():
        part = c if isinstance(c, Fraction) else Fraction(c.m, ONE)
        for power, x in zip(e, t): part *= x ** power
        total += part
    return total

def error(model):
    """What the value of a Taylor model may differ from its polynomial."""
    radii = sum(c.r for c in model.terms.values() if isinstance(c, Ball))
    return Fraction(model.rest + radii, ONE)

def model(terms=4, variables=1, order=5, rest=0):
    found = {}
    for _ in range(terms):
        e = tuple(R.randint(0, 2) for _ in range(variables))
        if sum(e) <= order: found[e] = fraction(2)
    return Taylor(found or {(0,) * variables: Fraction(1)}, rest, (variables, order))

class Balls(unittest.TestCase):
    def test_operations_hold_the_results_of_all_members(self):
        for _ in range(400):
            a, b = wide(), wide()
            x, y = member(a), member(b)
            self.assertTrue(holds(a + b, x + y))
            self.assertTrue(holds(a - b, x - y))
            self.assertTrue(holds(a * b, x * y))
            q = fraction()
            self.assertTrue(holds(ball(q), q))
            for found, true in ((a * q, x * q), (a + q, x + q), (q - a, q - x)):
                self.assertTrue(holds(ball(found), true))
            if abs(b.m) > b.r:
                self.assertTrue(holds(inverse(b), 1 / y))
                self.assertTrue(holds(q * inverse(b), q / y))

    def test_division_by_a_ball_around_zero_is_undecided(self):
        for b in (Ball(0, 1), Ball(5, 5), Ball(-3, 7)):
            self.assertRaises(Undecided, inverse, b)
        self.assertRaises(Undecided, inverse, Fraction(0))

    def test_functions_of_balls_that_are_too_wide_are_undecided(self):
        for name, x in (("log", Ball(ONE * 6 // 10, ONE * 6 // 10 - ONE // 10 ** 6)),
                        ("log", Ball(ONE, ONE)), ("exp", Ball(0, ONE)), ("sqrt", Ball(1, 2))):
            self.assertRaises(Undecided, function, name, x)

    def test_signs(self):
        self.assertEqual([sign(Ball(3, 2)), sign(Ball(-3, 2)), sign(Fraction(0))], [1, -1, 0])
        for b in (Ball(3, 3), Ball(-2, 3), Ball(0, 0)):
            self.assertRaises(Undecided, sign, b)

    def test_functions_hold_values_of_50_digits(self):
        for name, true in helper.TRUE_VALUES.items():
            for _ in range(25):
                x = fraction(3) / 100
                x = abs(x) + Fraction(1, 1000) if name in ("log", "sqrt") else x
                found, expected = ball(function(name, x)), true(helper.to_decimal(x))
                slack = Fraction(found.r, ONE) + abs(Fraction(expected)) / 10 ** 50 + \
                    Fraction(1, 10 ** 55)
                self.assertLessEqual(abs(Fraction(found.m, ONE) - Fraction(expected)), slack, name)
                self.assertLess(Fraction(found.r, ONE), (1 + abs(Fraction(expected))) / 10 ** 70)

    def test_functions_of_wide_balls_hold_the_values_at_their_ends(self):
        for name, true in helper.TRUE_VALUES.items():
            for _ in range(10):
                x = Ball(ONE + R.randint(0, ONE), R.randint(0, ONE >> 3))
                found = function(name, x)
                for s in (-1, 0, 1):
                    end = Fraction(x.m + s * x.r, ONE)
                    expected = Fraction(true(helper.to_decimal(end)))
                    self.assertLessEqual(abs(Fraction(found.m, ONE) - expected),
                                         Fraction(found.r, ONE) + Fraction(1, 10 ** 45), name)

    def test_pi(self):
        digits = Fraction("3.14159265358979323846264338327950288419716939937510582097494459")
        self.assertLess(abs(Fraction(PI.m, ONE) - digits), Fraction(1, 10 ** 60))
        self.assertLess(PI.r, ONE >> 280)

    def test_rational_values_stay_exact(self):
        self.assertEqual(function("sqrt", Fraction(4, 9)), Fraction(2, 3))
        self.assertEqual([function("exp", Fraction(0)), function("cos", Fraction(0))], [1, 1])
        self.assertIsInstance(function("sqrt", Fraction(2)), Ball)

class TaylorModels(unittest.TestCase):
    def test_products_hold_all_products(self):
        for _ in range(150):
            a, b = model(variables=2, order=3), model(variables=2, order=3)
            a.rest = R.choice([0, ONE >> 4])
            t = [Fraction(R.randint(-8, 8), 8) for _ in range(2)]
            for s in (-1, 0, 1):
                x, y = value(a, t) + s * Fraction(a.rest, ONE), value(b, t)
                for found, true in ((a * b, x * y), (a + b, x + y), (a - b, x - y),
                                    (a * Fraction(-3, 7), x * Fraction(-3, 7))):
                    self.assertLessEqual(abs(value(found, t) - true), error(found))

    def test_functions_hold_values_of_50_digits(self):
        for name, true in dict(helper.TRUE_VALUES, inv=lambda x: 1 / x).items():
            for order in (1, 2, 3, 5):
                for _ in range(6):
                    centre, width = 2 + fraction(2) / 100, Fraction(R.randint(1, 9), 10)
                    x = Taylor({(0,): centre, (1,): width}, 0, (1, order))
                    found = inverse(x) if name == "inv" else function(name, x)
                    for t in (Fraction(-1), Fraction(-1, 3), Fraction(1, 2), Fraction(1)):
                        expected = Fraction(true(helper.to_decimal(centre + width * t)))
                        self.assertLessEqual(abs(value(found, [t]) - expected),
                                             error(found) + Fraction(1, 10 ** 45), name)

    def test_the_rest_of_the_argument_enters(self):
        x = Taylor({(0,): Fraction(2)}, ONE >> 2, (1, 3))
        for name, true in helper.TRUE_VALUES.items():
            found = function(name, x)
            for end in (Fraction(7, 4), Fraction(9, 4)):
                expected = Fraction(true(helper.to_decimal(end)))
                self.assertLessEqual(abs(value(found, [0]) - expected),
                                     error(found) + Fraction(1, 10 ** 45), name)

    def test_quotients_by_zero_are_undecided(self):
        x = Taylor({(0,): Fraction(1), (1,): Fraction(1)}, 0, (1, 3))
        self.assertRaises(Undecided, inverse, x)
        self.assertRaises(Undecided, sign, x)

class DualsAndAffineForms(unittest.TestCase):
    def test_derivatives(self):
        x = Dual({0: Fraction(3), 1: Fraction(1)})
        y = Dual({0: Fraction(2), 2: Fraction(1)})
        f = x * x * y - 5 * x * inverse(y)
        self.assertEqual((f.terms[0], f.terms[1], f.terms[2]),
                         (Fraction(21, 2), Fraction(19, 2), Fraction(51, 4)))

    def test_a_product_of_unknowns_is_refused(self):
        x = Affine({1: Fraction(1)})
        self.assertEqual((x * 2 + 1).terms, {0: 1, 1: 2})
        for operation in (lambda: x * x, lambda: inverse(x), lambda: function("exp", x)):
            self.assertRaises(Unsupported, operation)

class Definite(unittest.TestCase):
    def random_symmetric(self, n):
        a = [[fraction(1) for _ in range(n)] for _ in range(n)]
        return [[a[i][j] + a[j][i] + (R.randint(0, 9) if i == j else 0) for j in range(n)]
                for i in range(n)]

    def test_fractions_agree_with_minors(self):
        seen = set()
        for _ in range(200):
            rows = self.random_symmetric(R.randint(1, 4))
            found = classify(Matrix(rows))
            seen.add(found)
            self.assertEqual(found == POSITIVE, helper.is_definite(rows))
        self.assertIn(NEGATIVE, seen)

    def test_singular_matrices(self):
        for rows, expected in (([[0]], SEMIDEFINITE), ([[1, 1], [1, 1]], SEMIDEFINITE),
                               ([[0, 1], [1, 0]], NEGATIVE), ([[0, 0], [0, 1]], SEMIDEFINITE),
                               ([[0, 1], [1, 9]], NEGATIVE), ([[1, 2], [2, 4]], SEMIDEFINITE),
                               ([[1, 2], [2, 3]], NEGATIVE), ([[-1]], NEGATIVE)):
            rows = [[Fraction(x) for x in row] for row in rows]
            self.assertEqual(classify(Matrix(rows)), expected)
            vector = witness(Matrix(rows), strict=True)
            self.assertEqual(len(vector), len(rows))
            self.assertTrue(any(vector))
            self.assertEqual(bool(witness(Matrix(rows), strict=False)), expected == NEGATIVE)

    def test_balls_need_room_for_their_radii(self):
        def matrix(diagonal, off, radius, off_radius):
            return Matrix([[Ball(diagonal * ONE, radius), Ball(off, off_radius)],
                           [Ball(off, off_radius), Ball(diagonal * ONE, radius)]])
        self.assertTrue(is_positive(matrix(1, 0, ONE >> 2, ONE >> 2)))
        self.assertFalse(is_positive(matrix(1, 0, ONE >> 1, (ONE >> 1) + 9)))
        self.assertFalse(is_positive(matrix(1, 0, 0, ONE + 9)))
        self.assertFalse(is_positive(Matrix([[Ball(ONE, 2 * ONE)]])))
        self.assertFalse(is_positive(Matrix([[Ball(0, 0)]])))

    def test_witness_is_negative(self):
        for _ in range(100):
            rows = self.random_symmetric(3)
            v = witness(Matrix(rows), strict=False)
            if v:
                value = sum(v[i] * rows[i][j] * v[j] for i in range(3) for j in range(3))
                self.assertLess(value, 0)
            else:
                self.assertNotEqual(classify(Matrix(rows)), NEGATIVE)

    def test_boxes(self):
        def scalar(*coefficients, rest=0):
            terms = {(k,): Fraction(c) for k, c in enumerate(coefficients)}
            return Matrix([[Taylor(terms, rest, (1, 9))]])
        self.assertTrue(is_positive_on_box(scalar(2, 1)))
        self.assertFalse(is_positive_on_box(scalar(1, 1)))
        self.assertFalse(is_positive_on_box(scalar(1, 0, 0, -2)))
        self.assertFalse(is_positive_on_box(scalar(0, 0, 1)))
        self.assertTrue(is_positive_on_box(scalar(1, rest=ONE >> 1)))
        self.assertFalse(is_positive_on_box(scalar(1, rest=ONE + 1)))
        self.assertFalse(is_positive_on_box(scalar(1, 0, -1)))

    def test_boxes_of_two_variables(self):
        t, s = (1, 0), (0, 1)
        for terms, expected in (({(0, 0): 3, t: 1, s: 1}, True), ({(0, 0): 1, t: 1, s: 1}, False),
                                ({(0, 0): 1, (1, 1): 2}, False)):
            terms = {e: Fraction(c) for e, c in terms.items()}
            self.assertEqual(is_positive_on_box(Matrix([[Taylor(terms, 0, (2, 5))]])), expected)

    def test_norm(self):
        for _ in range(20):
            a = Matrix([[fraction(1) for _ in range(3)] for _ in range(2)])
            g = a * a.transposed()
            trace, det = g[0, 0] + g[1, 1], g[0, 0] * g[1, 1] - g[0, 1] * g[1, 0]
            found = spectral_norm(a)
            low, high = ((Fraction(found.m + s * found.r, ONE)) ** 2 for s in (-1, 1))
            self.assertGreaterEqual(high, trace / 2)
            self.assertLessEqual(low * low - trace * low + det, 0)      # low <= norm^2 <= high
            self.assertGreaterEqual(high * high - trace * high + det, 0)
            self.assertLess(found.r, found.m / 10 ** 4)

class Matrices(unittest.TestCase):
    def test_inverse_and_kernel(self):
        for _ in range(30):
            a = Matrix([[fraction(1) for _ in range(3)] for _ in range(3)])
            self.assertEqual((a * invert(a)).elements, Matrix(helper.identity(3)).elements)
            wide_matrix = Matrix(a.elements[:2])
            kernel = null_space(wide_matrix)
            self.assertEqual(kernel.shape(), (3, 1))
            self.assertTrue(all(x == 0 for row in (wide_matrix * kernel).elements for x in row))

    def test_blocks(self):
        one = Matrix([[Fraction(1)]], flexible=True)
        a = Matrix([[Fraction(1), Fraction(2)]])
        found = join_blocks([[one, a], [None, one]])
        self.assertEqual(found.elements, [[1, 1, 2], [1, 1, 0], [2, 0, 1]])
        self.assertRaises(Unsupported, join_blocks, [[a, a], [a.transposed(), a]])

if __name__ == "__main__":
    unittest.main()
