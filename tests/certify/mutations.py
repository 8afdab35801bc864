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
     "return sum_of_balls([(self, other)])", "return Ball((self.m * other.m) >> BITS, 2)"),
    ("sums of products lose their radius", "arithmetic.py",
     "return Ball(m >> BITS, (r >> BITS) + 2)", "return Ball(m >> BITS, 2)"),
    ("inverses lose their radius", "arithmetic.py",
     "return Ball(m if x.m > 0 else -m, high - m + 1)", "return Ball(m if x.m > 0 else -m, 1)"),
    ("the sign of a ball that touches 0", "arithmetic.py",
     "if abs(x.m) <= x.r: raise Undecided(\"a sign\")",
     "if abs(x.m) < x.r: raise Undecided(\"a sign\")"),
    ("the remainder of a Taylor series is 0", "arithmetic.py",
     "return result.widened(ball(left * upper(largest)).size() + 1)", "return result"),
    ("exp leaves a remainder without exp(delta)", "arithmetic.py",
     "largest = value * function(\"exp\", ball(delta))", "largest = value * Fraction(1, 4)"),
    ("terms above the order are dropped", "arithmetic.py",
     "rest += (ball(a).size() * ball(b).size() >> BITS) + 1", "rest += 0"),
    ("remainders are not multiplied", "arithmetic.py",
     "rest += ((polynomial * other.rest + self.rest * other.size()) >> BITS) + 1", "rest += 1"),
    ("a product of unknowns is not refused", "arithmetic.py",
     "raise Unsupported(\"the text is not affine in the unknowns\")", "pass"),
    ("sin loses the radius of its argument", "arithmetic.py",
     "return s.widened(x.r), c.widened(x.r)", "return s, c"),
    ("a wrong factor of Machin's formula", "arithmetic.py",
     "4 * atan_of_inverse(239)", "3 * atan_of_inverse(239)"),
    ("expm stops its series after three terms", "language.py",
     "while j != last and bound > Fraction(1, 2 ** (BITS - 20)):", "while j < 3:"),
    ("expm is squared once too little", "language.py",
     "for _ in range(halvings):", "for _ in range(halvings - 1):"),
    ("expm of affine arguments has no remainder", "language.py",
     "return filled(a.rows, a.rows, lambda i, k: total[i, k] if not paths[i][k] else",
     "return filled(a.rows, a.rows, lambda i, k: total[i, k] if last or not paths[i][k] else"),
    ("powers are applied from right to left", "language.py",
     "else self.value())", "else self.factor())"),
    ("a jacobian within a jacobian", "language.py", "if OPEN_JACOBIANS:", "if False:"),
    ("a singular matrix is definite", "matrices.py",
     "result = SEMIDEFINITE", "result = POSITIVE"),
    ("an element beside a pivot 0", "matrices.py",
     "if pivot < 0 or pivot == 0 and any(row[k] != 0 for row in rows[k + 1:]):", "if pivot < 0:"),
    ("the shift by the radii is left out", "matrices.py",
     "rows[i][i].m -= sum(", "rows[i][i].m -= 0*sum("),
    ("a pivot 0 is positive", "matrices.py",
     "all(pivot.m > pivot.r for pivot", "all(pivot.m >= pivot.r for pivot"),
    ("the remainder of Bernstein coefficients is left out", "matrices.py",
     "else ball(total).widened(x.rest)", "else ball(total)"),
    ("semidefinite Bernstein coefficients are enough", "matrices.py",
     "if classify(a.map(coefficient)) != POSITIVE:",
     "if classify(a.map(coefficient)) in (NEGATIVE, UNKNOWN):"),
    ("Bernstein weights of a wrong sign", "matrices.py", "* (-1) ** (j - k)", ""),
    ("norms from below are the norms", "matrices.py",
     "return ball((low + high) / 2).widened(ball((high - low) / 2).size() + 1)",
     "return ball(low)"),
    ("a strict inequality is not strict", "yes.py",
     "strict, found = comparison.sign in (\"<\", \">\"), classify(a)",
     "strict, found = False, classify(a)"),
    ("a requirement is left out", "yes.py",
     "for label, comparison in statement.comparisons():",
     "for label, comparison in list(statement.comparisons())[:-1]:"),
    ("a requirement that cannot be evaluated is skipped", "yes.py",
     "yield Claim(name, \"open\", reason(error))", "pass"),
    ("a piece is left out", "yes.py",
     "for part in ((half, high), (low, half))]", "for part in ((low, half),)]"),
    ("a polytope without a look at the variable", "yes.py", "if domain.hulls:", "if False:"),
    ("an equation holds nearly", "yes.py",
     "if all(is_zero(c) for c in terms):", "if all(upper(c) < 1e-9 for c in terms):"),
    ("terms of an equation beside the constant are not looked at", "yes.py",
     "for c in ([*x.terms.values(), x.rest] if", "for c in ([x.constant(), x.rest] if"),
    ("the sides of a comparison are swapped", "statement.py",
     "if comparison.sign in (\">\", \">=\"):", "if comparison.sign in (\"<\", \"<=\"):"),
    ("an unknown that is not symmetric", "statement.py",
     "if kind == \"symmetric\" and a.elements != a.transposed().elements:", "if False:"),
    ("only the first element of a column is compared", "statement.py",
     "return diagonal(flat(difference))", "return diagonal(flat(difference)[:1])"),
    ("a matrix that is not symmetric", "statement.py",
     "raise Unsupported(\"a matrix that is not symmetric\")", "pass"),
    ("the second comparison of a chain is left out", "statement.py",
     "for k in range(0, len(tree[1]) - 2, 2)]", "for k in range(0, 1, 2)]"),
    ("abs is bounded on one side", "statement.py", "values += [-values[0]]", "pass"),
    ("the sha256 is not compared", "statement.py",
     "expect(found == statement[\"sha256\"]", "expect(True"),
    ("the derivative of a Chebyshev polynomial", "language.py",
     "2 * (slope * b + u * d) - before[1]", "2 * (u * d) - before[1]"),
    ("a piece with a constant matrix proves the others", "yes.py",
     "if found.result != \"proved\" or piece == whole: return found", "return found"),
    ("entries of forall that depend on an interval or a vertex", "statement.py",
     "hidden[name] = later", "pass"),
    ("a variable of forall that occurs twice", "statement.py", "if name in hidden or any(",
     "if False and any("),
    ("max of a column, element by element", "statement.py", "elif len(values) == 1:", "elif False:"),
    ("the logarithm of a wide ball", "arithmetic.py", "if z.size() > ONE >> 1:", "if False:"),
    ("a point of an empty interval", "no.py", "outward(interval)       # not empty", "pass"),
    ("the sign of r", "no.py", "if p == q: residual[i] = residual.get(i, Ball(0)) + g",
     "if p == q: residual[i] = residual.get(i, Ball(0)) - g"),
    ("derivatives of terms with unknowns are 0", "arithmetic.py", "level = 3", "level = 5"),
    ("a matrix of a file in another folder", "statement.py", "if f[\"file\"] == name]",
     "if f[\"file\"]][:1]"),
    ("a no of vertex gains", "statement.py", "if isinstance(self.unknown_value, Symbols):",
     "if False:"),
    ("r' inv(H) r <= 10^9", "no.py", "+ [Fraction(1)])", "+ [Fraction(10 ** 9)])"),
    ("the constant part may have any sign", "no.py", "v = -residual[0]", "v = residual[0]"),
    ("no strict inequality is needed", "no.py", "elif not strict:", "elif False:"),
    ("a factor may be 0", "no.py", "if any(any(row) for row in part):", "if part and part[0]:"),
    ("the residual is taken as 0", "no.py",
     "bordered.append([residual[i] for i in unknowns]", "bordered.append([Ball(0) for i in unknowns]"),
    ("weights of any sign", "algebraic.py",
     "if any(sign(c) < 0 for c in used.values()): return False", "pass"),
    ("no equation of the algebraic multipliers", "algebraic.py",
     "unknowns = sorted({i for t in terms for i in t if i})",
     "unknowns = sorted({i for t in terms for i in t if i})[:1]"),
    ("the algebraic multipliers need nothing strict", "algebraic.py",
     "return any(blocks[k].sign in STRICT for k in used)", "return True"),
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
