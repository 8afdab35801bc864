"""The language: the examples of docs/language.md, and what is refused."""

import unittest
from fractions import Fraction

import helper
from arithmetic import ONE, Ball, Taylor, Undecided, Unsupported
from language import Function, Scope, holds, matrix, parse
from matrices import column, number

EXAMPLES = """
[1, 2]' | [1; 2]
[1, 1; 0, 1]^-2 | [1, -2; 0, 1]
[2, 3].^2 | [4, 9]
[1, 2; 3, 4](2, 1) | 3
-2^2 | -4
2^3^2 | 64
[1, 2]*[3; 4] | 11
[1, 2]/4 | [0.25, 0.5]
2./[1, 4] | [2, 0.5]
[1; 2] - 3 | [-2; -1]
where(1 < 2, 3, 4) | 3
where(not 1 < 2, 3, 4) | 4
where(1 < 2 and 2 < 1, 3, 4) | 4
where(1 < 2 or 2 < 1, 3, 4) | 3
where([1, 5] > [2, 2], [2, 3], 0) | [0, 3]
where([-1, 6] < 0 or [-1, 6] > 10, 1, [-1, 6]) | [1, 6]
where([-1, 6] > 0 and [-1, 6] < 10, 1, [-1, 6]) | [-1, 1]
where(0 < [-1, 6] < 5, 1, 2) | [2, 2]
where(not [-1, 6] > 0, 1, 2) | [1, 2]
det([2, 1, 0, 3; 1, 3, 1, 0; 0, 1, 4, 1; 5, 0, 1, 2]) | -142
He([0, 2; 0, 1]) | [0, 2; 2, 2]
inv([2, 1; 0, 1]) | [0.5, -0.5; 0, 1]
pinv([3; 4]) | [0.12, 0.16]
expm(log(2)*[0, 1; 1, 0]) | [1.25, 0.75; 0.75, 1.25]
exp([0, log(2)]) | [1, 2]
log([1, exp(2)]) | [0, 2]
sqrt([4, 9]) | [2, 3]
sin([0, pi/6]) | [0, 0.5]
cos([0, pi/3]) | [1, 0.5]
tan([0, pi/4]) | [0, 1]
sinh([0, log(2)]) | [0, 0.75]
tanh([0, log(2)]) | [0, 0.6]
abs([-1, 2]) | [1, 2]
sign([-2, 0, 3]) | [-1, 0, 1]
floor([1.5, -0.5]) | [1, -1]
ceil([1.5, -0.5]) | [2, 0]
mod([5.5, -1], 3) | [2.5, 2]
min([1, 4], 2) | [1, 2]
max([1, 4], 2) | [2, 4]
max([3; 7; 5]) | 7
trace([1, 2; 3, 4]) | 5
det([1, 2; 3, 4]) | -2
sum(k in 1..3, k^2*[1, 2]) | [14, 28]
sum([1, 2; 3, 4]) | 10
norm([3, 4]) | 5
norm([0, 3; -4, 0]) | 4
eye(2) | [1, 0; 0, 1]
ones(1, 2) | [1, 1]
diag([1, 2]) | [1, 0; 0, 2]
blkdiag(1, [2, 3]) | [1, 0, 0; 0, 2, 3]
horzcat(k in 1..3, [k; k^2]) | [1, 2, 3; 1, 4, 9]
vertcat(k in 1..2, [k, k^2]) | [1, 1; 2, 4]
kron([1, 2], [3; 4]) | [3, 6; 4, 8]
skew([1; 2; 3]) | [0, -3, 2; 3, 0, -1; -2, 1, 0]
orth([3, 0; 4, 0]) | [0.6; 0.8]
abs(null([4, 3])) | [0.6; 0.8]
units([0, 8; 2, 0], [1, 0]) | [1, 0; 0, 0.5]
rank([1, 2; 2, 4]) | 1
obsv([0, 1; 0, 0], [1, 0]) | [1, 0; 0, 1]
ctrb([0, 1; 0, 0], [0; 1]) | [0, 1; 1, 0]
c2d([0, 1; 0, 0], [0; 1], 2) | [1, 2, 2; 0, 1, 2]
lyap([-1, 1; 0, -1], eye(2)) | [0.75, 0.25; 0.25, 0.5]
dlyap([0.5, 0; 0, 0], eye(2)) | [4/3, 0; 0, 1]
chebyshev(2, 3, 0, 4) | -0.5
gramian(0, 1, 2, 3, [1, 1]) | 14
backward_gramian(0, 1, 2, 3, [1, 1]) | 3.5
[1, 2, 3](end) | 3
[1, 2; 3, 4](:, end) | [2; 4]
[4, 5, 6](2:end) | [5, 6]
[zeros(1, 3); eye(2), [5; 6]] | [0, 0, 0; 1, 0, 5; 0, 1, 6]
[1, [2, 3]; *, 4*I] | [1, 2, 3; 2, 4, 0; 3, 0, 4]
2*I + [1, 2; 3, 4] | [3, 2; 3, 6]
"""

def element_holds(x, y):
    if isinstance(x, Ball) or isinstance(y, Ball):
        d = x - y
        return abs(d.m) <= d.r and d.r < ONE >> 200
    return x == y

class Values(unittest.TestCase):
    def test_examples(self):
        for line in EXAMPLES.strip().split("\n"):
            text, expected = line.split(" | ")
            found, true = matrix(parse(text), Scope()), matrix(parse(expected), Scope())
            self.assertEqual(found.shape(), true.shape(), text)
            for x, y in zip(found.elements, true.elements):
                self.assertTrue(all(element_holds(a, b) for a, b in zip(x, y)) or "norm" in text,
                                text)

    def test_decimals_are_exact(self):
        self.assertEqual(matrix(parse("0.1 + 0.2"), Scope()).number(), Fraction(3, 10))
        self.assertEqual(matrix(parse("1e-4*.5"), Scope()).number(), Fraction(1, 20000))

    def test_refused(self):
        for text in ("[1, 2] + [1; 2]", "[1, 2]*[3, 4]", "x", "1 +", "[1, 2; 3, 4] + 1", "f(1)",
                     "care(1, 1, 1, 1)", "inv([1, 2])", "[1, 2](3)", "[1, 2](0)", "1e2000",
                     "zeros(0.5)", "(1", "[1; 2, 3]", "[1, 2", "[*, 2; *, 3]", "eye(2)(1)",
                     "[1, 1; 0, 1]^10001",
                     "lyap([-1, 2; 0, -3], I)", "[1, 2; 3, 4].*I", "I./[1, 2; 3, 4]", "trace(3*I)",
                     "where([1, 2; 3, 4] > I, 1, 0)", "where([1, 2] > 0, I, 0)", "kron(I, [1, 2])", "[1, 2]^2", "1.5^20000", "[1, 2; 3, 4]^0.5"):
            with self.assertRaises((Unsupported, ZeroDivisionError), msg=text):
                matrix(parse(text), Scope())
        self.assertRaises(Undecided, lambda: matrix(parse("1/0"), Scope()))
        self.assertRaises(Undecided, lambda: matrix(parse("inv([1, 2; 2, 4])"), Scope()))
        self.assertRaises(Undecided, lambda: matrix(parse("sqrt(-2)"), Scope()))
        for text in ("rank([1, 0; 0, 1e-5], 1e-4)", "orth([1, 0; 0, 1e-5], 1e-4)"):
            self.assertRaises(Undecided, matrix, parse(text), Scope())

    def test_conditions(self):
        for text, expected in (("1 < 2 < 3", True), ("1 < 2 < 2", False), ("1 <= 1", True),
                               ("1 != 2", True), ("2 == 3", False), ("[1, 2] > 0", True)):
            self.assertEqual(holds(parse(text), Scope()), expected, text)

    def test_matrix_exponential(self):
        a = [[Fraction(1, 5), Fraction(-101, 100)], [Fraction(1), Fraction(0)]]
        true = helper.exponential(a, Fraction(7, 10))
        found = matrix(parse("expm([0.2, -1.01; 1, 0]*0.7)"), Scope())
        for i in range(2):
            for j in range(2):
                d = found[i, j] - true[i][j]
                self.assertLessEqual(abs(Fraction(d.m, ONE)), Fraction(d.r, ONE) +
                                     Fraction(1, 10 ** 45))
                self.assertLess(d.r, ONE >> 200)

    def test_matrix_exponential_of_taylor_models(self):
        a = [[Fraction(1, 5), Fraction(-101, 100)], [Fraction(1), Fraction(0)]]
        for order in (2, 4):
            for text in ("expm([0.2, -1.01; 1, 0]*t)", "expm([0.2, -1.01; 1, 0]*(t + 0*t*t))",
                         "expm([0.2, -1.01; 1, 0]*t + 0*[0, 1; 0, 0]*t^2)"):
                t = Taylor({(0,): Fraction(1, 2), (1,): Fraction(1, 2)}, 0, (1, order))
                found = matrix(parse(text), Scope(Scope(), {"t": number(t)}))
                for s in (Fraction(-1), Fraction(0), Fraction(2, 3), Fraction(1)):
                    true = helper.exponential(a, (1 + s) / 2)
                    for i in range(2):
                        for j in range(2):
                            x = found[i, j]
                            polynomial = sum(Fraction(c.m if isinstance(c, Ball) else c * ONE) *
                                             s ** e[0] for e, c in x.terms.items()) / ONE
                            self.assertLessEqual(abs(polynomial - true[i][j]), Fraction(
                                x.rest + 10 ** 20, ONE))

class Jacobians(unittest.TestCase):
    def scope(self):
        functions = {"f": Function(lambda v: matrix(parse("[v(1)*v(2); v(1)^2]"),
                                                    Scope(Scope(), {"v": v})))}
        return Scope(Scope(None, functions), {"x": column([Fraction(2), Fraction(3)])})

    def test_value(self):
        found = matrix(parse("jacobian(f(x), x)"), self.scope())
        self.assertEqual(found.elements, [[3, 2], [4, 0]])
        found = matrix(parse("jacobian([x(1)*x(2); x(1)^2], x)"), self.scope())
        self.assertEqual(found.elements, [[3, 2], [4, 0]])

    def test_a_jacobian_within_a_jacobian_or_by_a_datum_is_refused(self):
        for text in ("jacobian(jacobian(f(x), x)*x, x)", "jacobian(f(x), y)"):
            self.assertRaises(Unsupported, matrix, parse(text), self.scope())
        outer = Scope(None, {"x": column([Fraction(2), Fraction(3)])})
        self.assertRaises(Unsupported, matrix, parse("jacobian(x, x)"), outer)

if __name__ == "__main__":
    unittest.main()
