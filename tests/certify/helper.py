"""Where the checker and the files are, and values that are computed without the checker."""

import copy
import os
import random
import sys
from decimal import Decimal, getcontext
from fractions import Fraction

HERE = os.path.dirname(os.path.abspath(__file__))
CERTIFY = os.environ.get("CERTIFY", os.path.join(HERE, "..", "..", "scripts", "certify"))
FILES = os.path.join(HERE, "files")
sys.path.insert(0, CERTIFY)
getcontext().prec = 60

from statement import Numeral, read_gain_file        # noqa: E402

def path(name): return os.path.join(FILES, name + ".json")

def gain(name): return copy.deepcopy(read_gain_file(path(name)))

def with_text(source, *replacements):
    """A gain file whose problem's text is changed; its sha256 is not looked at again."""
    found = gain(source)
    for old, new in replacements:
        assert old in found["statement"]["problem_text"], old
        found["statement"]["problem_text"] = \
            found["statement"]["problem_text"].replace(old, new)
    return found

def problem(text, unknowns, gains=None):
    """A gain file that was never written: a problem with its method, and values of unknowns."""
    def numerals(x):
        return [numerals(y) for y in x] if isinstance(x, list) else Numeral(x)
    return {"verdict": "yes", "statement": {"problem_text": text, "method_text": ""},
            "unknowns": {k: numerals(v) for k, v in unknowns.items()},
            "gains": {k: numerals(v) for k, v in (gains or {}).items()}}

def one_claim(forall, that, unknowns=None, declared="{x: scalar}", data=""):
    text = "problem: p\nmethod:\n  unknowns: %s\n  require:\n    c: {%sthat: \"%s\"}\n%s" % (
        declared, "forall: \"%s\", " % forall if forall else "", that, data)
    return problem(text, unknowns or {"x": "0"})

def to_decimal(x): return Decimal(x.numerator) / Decimal(x.denominator)

def sine(x):
    term = total = x
    n = 1
    while abs(term) > Decimal(10) ** -58:
        term = -term * x * x / ((n + 1) * (n + 2))
        total, n = total + term, n + 2
    return total

TRUE_VALUES = {
    "exp": lambda x: x.exp(), "log": lambda x: x.ln(), "sqrt": lambda x: x.sqrt(), "sin": sine,
    "cos": lambda x: 1 - 2 * sine(x / 2) ** 2,
}

def determinant(rows):
    """By fractions, without the checker."""
    rows, result = [list(r) for r in rows], Fraction(1)
    for k in range(len(rows)):
        p = next((i for i in range(k, len(rows)) if rows[i][k] != 0), None)
        if p is None: return Fraction(0)
        if p != k: rows[k], rows[p], result = rows[p], rows[k], -result
        result *= rows[k][k]
        for i in range(k + 1, len(rows)):
            f = rows[i][k] / rows[k][k]
            rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
    return result

def is_definite(rows):
    """Sylvester: all leading minors are positive."""
    return all(determinant([r[:k] for r in rows[:k]]) > 0 for k in range(1, len(rows) + 1))

def product(a, b): return [[sum(x * y for x, y in zip(r, c)) for c in zip(*b)] for r in a]

def plus(a, b, factor=1): return [[x + factor * y for x, y in zip(r, q)] for r, q in zip(a, b)]

def transposed(a): return [list(r) for r in zip(*a)]

def identity(n): return [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]

def exponential(a, t):
    """expm(a t) by its series, to far below 1e-40 for small arguments."""
    term = total = identity(len(a))
    for k in range(1, 45):
        term = [[Fraction(round(x * t / k * 10 ** 60), 10 ** 60) for x in r]
                for r in product(term, a)]
        total = plus(total, term)
    return total

def fractions(value):
    rows = value if isinstance(value, list) else [[value]]
    return [[Fraction(x) for x in (r if isinstance(r, list) else [r])] for r in rows]

RANDOM = random.Random(1)
