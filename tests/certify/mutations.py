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
     "return result.widened(ball(left).size() + 1)", "return result"),
    ("exp leaves a remainder without exp(delta)", "arithmetic.py",
     "left *= upper(value * function(\"exp\", ball(upper(d))))", "left *= upper(value) / 4"),
    ("terms above the order are dropped", "arithmetic.py",
     "rest += (ball(a).size() * ball(b).size() >> BITS) + 1", "rest += 0"),
    ("remainders are not multiplied", "arithmetic.py",
     "rest += ((polynomial * other.rest + self.rest * other.size()) >> BITS) + 1", "rest += 1"),
    ("a product of unknowns is not refused", "arithmetic.py",
     "raise Unsupported(\"the text is not affine in the unknowns\")", "pass"),
    ("sin loses the radius of its argument", "arithmetic.py",
     "return s.widened(x.r), c.widened(x.r)", "return s, c"),
    ("a wrong factor of Machin's formula", "arithmetic.py",
     "4 * odd_series(ball(Fraction(1, 239))", "3 * odd_series(ball(Fraction(1, 239))"),
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
     "margins = [sum(max(", "margins = [0 * sum(max("),
    ("a pivot 0 is positive", "matrices.py",
     "if pivot <= 0: return False", "if pivot < 0: return False"),
    ("elimination without fractions adds", "matrices.py",
     "- factor * rows[j][k]) // last", "+ factor * rows[j][k]) // last"),
    ("the remainder of Bernstein coefficients is left out", "matrices.py",
     "for b in balls.values()) + x.rest", "for b in balls.values())"),
    ("the radii of Bernstein coefficients are not scaled", "matrices.py",
     "radius, parts = radius * d, {}", "radius, parts = radius, {}"),
    ("the last Bernstein coefficients are left out", "matrices.py",
     "for e in product(*[range(n + 1) for n in degrees]))",
     "for e in product(*[range(max(n, 1)) for n in degrees]))"),
    ("Bernstein weights of a wrong sign", "matrices.py", "* (-1) ** (j - k)", ""),
    ("norms from below are the norms", "matrices.py",
     "return ball((low + high) / 2).widened(ball((high - low) / 2).size() + 1)",
     "return ball(low)"),
    ("any objective is taken", "yes.py", "found = Comparison(parse(text), \"<=\",",
     "found = Comparison(parse(text), \">=\","),
    ("lambda_max of a second matrix that is not definite", "statement.py",
     "if len(values) > 1 and not is_positive(one):", "if False:"),
    ("a strict inequality is not strict", "yes.py",
     "strict, found = comparison.sign in (\"<\", \">\"), classify(a)",
     "strict, found = False, classify(a)"),
    ("a requirement is left out", "yes.py",
     "for label, comparison in statement.comparisons():",
     "for label, comparison in list(statement.comparisons())[:-1]:"),
    ("a requirement that cannot be evaluated is skipped", "yes.py",
     "for domain in [None] if isinstance", "for domain in [] if isinstance"),
    ("the balls around both unknowns have no radius", "yes.py",
     "Ball(0, ball(x).size())", "Ball(0, 0)"),
    ("what is open around both unknowns counts as proved there", "yes.py",
     "if claim and claim.result == \"proved\":", "if claim:"),
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
     "\"symmetric\": lambda i, j: a[j, i]", "\"symmetric\": lambda i, j: a[i, j]"),
    ("an unknown that is not diagonal", "statement.py", "a[i, j] if i == j else 0}", "a[i, j]}"),
    ("only the first element of a column is compared", "statement.py",
     "return diagonal(flat(difference))", "return diagonal(flat(difference)[:1])"),
    ("a matrix that is not symmetric", "statement.py",
     "raise Unsupported(\"a matrix that is not symmetric\")", "pass"),
    ("the second comparison of a chain is left out", "statement.py",
     "for k in range(0, len(tree[1]) - 2, 2)]", "for k in range(0, 1, 2)]"),
    ("abs is bounded on one side", "statement.py", "values += [-values[0]]", "pass"),
    ("the sha256 is not compared", "statement.py",
     "expect_sha256(statement[\"sha256\"], parts", "expect_sha256(hashlib.sha256(\"\\0\".join("
     "parts).encode()).hexdigest(), parts"),
    ("the sha256 of the results is not compared", "statement.py",
     "if \"proof\" in gain: check_results(gain)", "pass"),
    ("an empty sha256 of the results is right", "statement.py",
     "expect(found == stated, what)", "expect(found == stated or stated is None, what)"),
    ("the sha256 is of gains without their functions", "statement.py",
     "in gain[\"gain_functions\"].items():", "in {}.items():"),
    ("the sha256 is of results without bases", "statement.py",
     "for key in (\"unknowns\", \"parameters\", \"bases\", \"searched\", \"optimum\"):",
     "for key in (\"unknowns\", \"parameters\", \"searched\", \"optimum\"):"),
    ("the sha256 is of results without the optimum", "statement.py",
     "for key in (\"unknowns\", \"parameters\", \"bases\", \"searched\", \"optimum\"):",
     "for key in (\"unknowns\", \"parameters\", \"bases\", \"searched\"):"),
    ("the sha256 is of results without the certificate of a search", "statement.py",
     "for key, part in ((\"\", gain), (\"search.\", gain[\"search\"])):",
     "for key, part in ((\"\", gain),):"),
    ("the sha256 is of the first row of each matrix", "statement.py",
     "for row in listed(x) for y in listed(row)]",
     "for row in listed(x)[:1] for y in listed(row)]"),
    ("a Chebyshev polynomial without its first term", "language.py",
     "before, b = u, Fraction(1)", "before, b = 0, Fraction(1)"),
    ("the derivative by another element", "language.py",
     "found.map(lambda x: slope(x, 1))", "found.map(lambda x: slope(x, 0))"),
    ("a piece with a constant matrix proves the others", "yes.py",
     "if found.result != \"proved\" or piece == whole: return found", "return found"),
    ("entries of forall that depend on an interval or a vertex", "statement.py",
     "hidden[name] = later", "pass"),
    ("a variable of forall that occurs twice", "statement.py", "if name in hidden or any(",
     "if False and any("),
    ("max of a column, element by element", "statement.py",
     "elif len(values) == 1:", "elif False:"),
    ("the logarithm of a wide ball", "arithmetic.py", "if z.size() > ONE >> 1:", "if False:"),
    ("a point of an empty interval", "no.py", "outward(interval)       # not empty", "pass"),
    ("the sign of r", "no.py", "if p == q: traces[i] = traces.get(i, Ball(0)) + g",
     "if p == q: traces[i] = traces.get(i, Ball(0)) - g"),
    ("the sign of the costs", "no.py", "ball(costs.get(i, 0)) * (1 / scale) - traces",
     "ball(-costs.get(i, 0)) * (1 / scale) - traces"),
    ("derivatives of terms with unknowns are 0", "arithmetic.py", "level = 3", "level = 5"),
    ("a matrix of a file in another folder", "statement.py", "if f[\"file\"] == name]",
     "if f[\"file\"]][:1]"),
    ("a no of vertex gains", "statement.py", "if isinstance(self.unknown_value, Symbols):",
     "if False:"),
    ("r' inv(H) r <= 10^9", "no.py", "+ [Fraction(1)])", "+ [Fraction(10 ** 9)])"),
    ("the constant part may have any sign", "no.py",
     "if v.m <= v.r: return \"the constant part has no sign\"", "v = Ball(abs(v.m), v.r)"),
    ("no strict inequality is needed", "no.py",
     "elif not any(block.sign in STRICT for block in used):", "elif False:"),
    ("the residual is taken as 0", "no.py",
     "lower.append([r for _, r in scaled]", "lower.append([Ball(0) for _, r in scaled]"),
    ("a bound without sqrt(s) |G_0|", "no.py",
     "(first - function(\"sqrt\", s * inner(constant, constant))) * scale", "first * scale"),
    ("a bound plus sqrt(s) |G_0|", "no.py",
     "(first - function(\"sqrt\"", "(first + function(\"sqrt\""),
    ("a bound with s for sqrt(s)", "no.py", "function(\"sqrt\", s * inner(constant, constant))",
     "s * function(\"sqrt\", inner(constant, constant))"),
    ("a bound without the scale of the multipliers", "no.py",
     "inner(constant, constant))) * scale", "inner(constant, constant)))"),
    ("costs that are not scaled as the multipliers", "no.py",
     "ball(costs.get(i, 0)) * (1 / scale)", "ball(costs.get(i, 0))"),
    ("s is the pivot", "no.py", "return upper(1 - pivot)", "return upper(pivot)"),
    ("s is 0", "no.py", "return upper(1 - pivot)", "return Fraction(0)"),
    ("a pivot that is not positive", "no.py", "if pivot.m <= pivot.r: return None", "pass"),
    ("any bound near 0 is enough", "no.py", "if low < stated - abs(stated) / NEAR:",
     "if low < stated - 10 ** 6:"),
    ("the stated bound is named as proved", "no.py", "return Claim(\"objective >= %s\" % digits",
     "return Claim(name"),
    ("an unknown that has only costs", "no.py", "if not set(residual) <= set(rows):", "if False:"),
    ("multipliers of inequalities of any sign", "no.py",
     "if block.sign == \"==\": add_equation", "if block.sign in (\"==\", \"<=\"): add_equation"),
    ("multipliers of strict inequalities of any sign", "no.py",
     "if block.sign == \"==\": add_equation", "if block.sign in (\"==\", \"<\"): add_equation"),
    ("the half of an equation's multiplier", "no.py", "m = 2 * given", "m = given"),
    ("the sign of an equation's multiplier", "no.py", "+ ball(c) * (m / scale)",
     "- ball(c) * (m / scale)"),
    ("the constant of an equation is not in G_0", "no.py",
     "rows.setdefault(i, {})[k, a, b] = ball(c) * Fraction(2 ** 40)",
     "rows.setdefault(i, {})[k, a, b] = ball(c) * Fraction(2 ** 40 if i else 0)"),
    ("a point outside of its interval", "no.py", "if is_outside(interval, value):", "if False:"),
    ("a point near the one of the label", "no.py", "upper(x) / 10 ** 15", "upper(x) / 10 ** 5"),
    ("weights of any sign", "algebraic.py",
     'if size < 0: return "a multiplier that is negative"', "pass"),
    ("a weight that is 0 counts as strict", "algebraic.py",
     "if size > 0 and block.sign", "if block.sign"),
    ("a vector that is 0 counts as strict", "algebraic.py",
     "sign(value_at(z.transposed() * z, re, im)) > 0", "True"),
    ("every inequality is an equation", "algebraic.py",
     'size = block.sign != "==" and', "size = 0 and"),
    ("no equation of the algebraic multipliers", "algebraic.py",
     "if any(x != 0 for total in sums.values() for row in total.elements for x in row):",
     "if False:"),
    ("m is not the conjugate of l", "algebraic.py",
     "(x * c + c.transposed() * x)", "(x * c + x * c)"),
    ("the algebraic multipliers need nothing strict", "algebraic.py",
     'return None if strict else "no strict inequality has a multiplier"', "return None"),
    ("the constant part of any sign", "algebraic.py",
     "return None if sign(value_at(constant, re, im)) < 0 else", "return None if True else"),
    ("a disk without a root", "algebraic.py",
     'if not has_one(h): raise Undecided("the root of a polynomial")', "pass"),
    ("all roots are on the unit circle", "algebraic.py",
     "circle = inverted and", "circle = True or"),
    ("all roots near the axis are on it", "algebraic.py",
     "mirrored = all(c == 0 for c in p[-2::-2])", "mirrored = True"),
    ("the algebraic multipliers are not in the hash", "statement.py",
     'add("", {term.get("block"): term.get("vector", [])})', "pass"),
]

def caught(file, old, new):
    """Whether the tests fail with the fault."""
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "certify")
        shutil.copytree(SOURCE, copy, ignore=shutil.ignore_patterns("__pycache__"))
        name = os.path.join(copy, file)
        with open(name, encoding="utf-8") as stream: text = stream.read()
        with open(name, "w", encoding="utf-8") as stream: stream.write(text.replace(old, new, 1))
        environment = dict(os.environ, CERTIFY=copy, CERTIFY_DIGITS="12")
        try:
            done = subprocess.run([sys.executable, os.path.join(HERE, "run")], env=environment,
                                  capture_output=True, text=True, timeout=120)
        except subprocess.TimeoutExpired:
            return True
        return done.returncode != 0

def main():
    """All faults, or so many of them as CERTIFY_FAULTS says; the texts of all must be there."""
    missed = 0
    step = -(-len(FAULTS) // int(os.environ.get("CERTIFY_FAULTS", len(FAULTS))))
    planted = FAULTS[::step]
    for what, file, old, new in FAULTS:
        with open(os.path.join(SOURCE, file), encoding="utf-8") as stream:
            there = old in stream.read()
        if there and (what, file, old, new) not in planted: continue
        found = caught(file, old, new) if there else None
        if not found:
            missed += 1
            print("%s: %s (%s)" % ("not there" if found is None else "NOT CAUGHT", what, file))
            sys.stdout.flush()
    print("%d faults planted, %d not caught" % (len(planted), missed))
    return 1 if missed else 0

if __name__ == "__main__":
    sys.exit(main())
