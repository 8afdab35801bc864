"""Plants faults in a copy of the checker, one at a time; the tests must notice each."""

import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.environ.get("CERTIFY", os.path.join(HERE, "..", "..", "scripts", "certify"))

# (what is wrong, file, text, faulty text); the text occurs at least once, the first is replaced
FAULTS = [
    ("products of balls lose their radius", "arithmetic.py",
     "return Ball((self.m * other.m) >> BITS, (spread >> BITS) + 2)",
     "return Ball((self.m * other.m) >> BITS, 2)"),
    ("sums of products lose their radius", "arithmetic.py",
     "return Ball(m >> BITS, (r >> BITS) + 2)", "return Ball(m >> BITS, 2)"),
    ("inverses lose their radius", "arithmetic.py",
     "return Ball(m if x.m > 0 else -m, high - m + 1)", "return Ball(m if x.m > 0 else -m, 1)"),
    ("the sign of a ball that touches 0", "arithmetic.py",
     "if abs(m) <= r:", "if abs(m) < r:"),
    ("the remainder of a Taylor series is 0", "arithmetic.py",
     "result.rest + ball(left).size() + 1", "result.rest"),
    ("exp leaves a remainder without exp(delta)", "arithmetic.py",
     "left = upper(ball(left) * ball_exp(ball(delta))) if name == \"exp\" else left",
     "left = left / 4"),
    ("terms above the order are dropped", "arithmetic.py",
     "rest += (ball(a).size() * ball(b).size() >> BITS) + 1", "rest += 0"),
    ("remainders are not multiplied", "arithmetic.py",
     "rest += ((polynomial * other.rest + self.rest * other.size()) >> BITS) + 1", "rest += 1"),
    ("a product of unknowns is not refused", "arithmetic.py",
     "raise Unsupported(\"the text is not affine in the unknowns\")", "pass"),
    ("sin loses the radius of its argument", "arithmetic.py",
     "return Ball(s.m, s.r + x.r), Ball(c.m, c.r + x.r)",
     "return Ball(s.m, s.r), Ball(c.m, c.r)"),
    ("a wrong factor of Machin's formula", "arithmetic.py",
     "4 * atan_of_inverse(239)", "3 * atan_of_inverse(239)"),
    ("expm stops its series after three terms", "language.py",
     "while bound > Fraction(1, 2 ** (BITS - 20)):", "while j < 3:"),
    ("expm is squared once too little", "language.py",
     "for _ in range(halvings):", "for _ in range(halvings - 1):"),
    ("expm of affine arguments has no remainder", "language.py",
     "Taylor(x, rest if coupled[i][j] else 0, model.space)", "Taylor(x, 0, model.space)"),
    ("powers are applied from right to left", "language.py",
     "tree = (self.take(), tree, self.signed(self.value))",
     "tree = (self.take(), tree, self.signed(self.factor))"),
    ("a jacobian within a jacobian", "language.py", "if OPEN_JACOBIANS:", "if False:"),
    ("a singular matrix is definite", "definite.py",
     "result = SEMIDEFINITE", "result = POSITIVE"),
    ("an element beside a pivot 0", "definite.py",
     "if pivot < 0 or pivot == 0 and any(rows[i][k] != 0 for i in range(k + 1, a.rows)):",
     "if pivot < 0:"),
    ("the shift by the radii is left out", "definite.py",
     "rows[i][i] = Ball(rows[i][i].m - sum(", "rows[i][i] = Ball(rows[i][i].m - 0*sum("),
    ("a pivot 0 is positive", "definite.py",
     "if rows[k][k].m <= rows[k][k].r:", "if rows[k][k].m < rows[k][k].r:"),
    ("the remainder of Bernstein coefficients is left out", "definite.py",
     "return Ball(total.m, total.r + x.rest)", "return Ball(total.m, total.r)"),
    ("semidefinite Bernstein coefficients are enough", "definite.py",
     "if classify(a.map(lambda x: bernstein_coefficient(x, factor))) != POSITIVE:",
     "if classify(a.map(lambda x: bernstein_coefficient(x, factor))) in (NEGATIVE, UNKNOWN):"),
    ("Bernstein weights of a wrong sign", "definite.py", "* (-1) ** (j - k)", ""),
    ("norms from below are the norms", "definite.py",
     "Ball(m.m, m.r + ball((high - low) / 2).size())", "Ball(m.m, m.r)"),
    ("a strict inequality is not strict", "yes.py",
     "strict = comparison.sign in (\"<\", \">\")", "strict = False"),
    ("a requirement is left out", "yes.py",
     "for label, comparison in statement.comparisons():",
     "for label, comparison in list(statement.comparisons())[:-1]:"),
    ("a requirement that cannot be evaluated is skipped", "yes.py",
     "yield claim(name, \"open\", reason(error))", "pass"),
    ("a piece is left out", "yes.py",
     "todo += [piece[:k] + [(half, high)] + piece[k + 1:],\n                 ",
     "todo += ["),
    ("a polytope without a look at the variable", "yes.py", "if domain.hulls:", "if False:"),
    ("an equation holds nearly", "yes.py",
     "if all(is_exact(c) and c == 0 for c in terms):",
     "if all(is_exact(c) and abs(c) < 1e-9 for c in terms):"),
    ("terms of an equation beside the constant are not looked at", "yes.py",
     "for c in ([x] if not isinstance(x, Taylor) else [*x.terms.values(),",
     "for c in ([x] if not isinstance(x, Taylor) else [x.constant(),"),
    ("the sides of a comparison are swapped", "statement.py",
     "if comparison.sign in (\">\", \">=\"):", "if comparison.sign in (\"<\", \"<=\"):"),
    ("an unknown that is not symmetric", "statement.py",
     "if kind == \"symmetric\" and result.elements != result.transposed().elements:", "if False:"),
    ("only the first element of a column is compared", "statement.py",
     "return diagonal(flat(difference))", "return diagonal(flat(difference)[:1])"),
    ("a matrix that is not symmetric", "statement.py",
     "raise Unsupported(\"a matrix that is not symmetric\")", "pass"),
    ("the second comparison of a chain is left out", "statement.py",
     "for k in range(0, len(tree[1]) - 2, 2):", "for k in range(0, 1, 2):"),
    ("abs is bounded on one side", "statement.py", "values += [-values[0]]", "pass"),
    ("the sha256 is not compared", "statement.py",
     "expect(found == statement[\"sha256\"]", "expect(True"),
    ("the derivative of a Chebyshev polynomial", "statement.py",
     "return 2 * scale * (k * now)", "return 2 * scale * now"),
    ("the sign of r", "no.py", "r[i] = r[i] - f * r[k]", "r[i] = r[i] + f * r[k]"),
    ("r' inv(H) r <= 2", "no.py", "if value.m + value.r < ONE:", "if value.m < 10 ** 9 * ONE:"),
    ("the constant part may have any sign", "no.py", "v = -residual[0]", "v = residual[0]"),
    ("no strict inequality is needed", "no.py", "elif not strict:", "elif False:"),
    ("a factor may be 0", "no.py", "if any(any(row) for row in part):", "if part and part[0]:"),
    ("the residual is taken as 0", "no.py",
     "r = [residual[i] for i in unknowns]", "r = [Ball(0) for i in unknowns]"),
    ("weights of any sign", "algebraic.py",
     "if sign(value_at(weight, *root)[0]) < 0: return False", "pass"),
    ("no equation of the algebraic multipliers", "algebraic.py",
     "for i, x in t.items() if i for e in x})", "for i, x in t.items() if i for e in x})[:1]"),
    ("the algebraic multipliers need nothing strict", "algebraic.py",
     "strict = strict or blocks[k].sign in STRICT and is_nonzero(form[k], root)",
     "strict = True"),
]

def caught(file, old, new):
    """Whether the tests fail with the fault; None if the text is not there."""
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "certify")
        shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns("__pycache__"))
        name = os.path.join(copy, file)
        with open(name, encoding="utf-8") as stream: text = stream.read()
        if old not in text: return None
        with open(name, "w", encoding="utf-8") as stream: stream.write(text.replace(old, new, 1))
        environment = dict(os.environ, CERTIFY=copy, CERTIFY_DIGITS="12")
        try:
            done = subprocess.run([sys.executable, os.path.join(HERE, "run")], env=environment,
                                  capture_output=True, text=True, timeout=120)
        except subprocess.TimeoutExpired:
            return True
        return done.returncode != 0

def main():
    missed = 0
    for what, file, old, new in FAULTS:
        found = caught(file, old, new)
        if not found:
            missed += 1
            print("%s: %s (%s)" % ("not there" if found is None else "NOT CAUGHT", what, file))
            sys.stdout.flush()
    print("%d faults planted, %d not caught" % (len(FAULTS), missed))
    return 1 if missed else 0

if __name__ == "__main__":
    sys.exit(main())
