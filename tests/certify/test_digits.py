"""Single digits changed: never proved where fractions, computed here apart, say false.

CERTIFY_DIGITS is the number of changes (60; `run --full` makes 1000).
"""

import copy
import os
import random
import unittest
from fractions import Fraction

import helper
from helper import (exponential, fractions, gain, identity, is_definite, plus, product, transposed,
                    with_text)
from no import prove_no
from statement import Numeral
from yes import prove_yes

COUNT = int(os.environ.get("CERTIFY_DIGITS", "60"))
R = random.Random(3)

def places(value, path=()):
    if isinstance(value, (list, dict)):
        for k in (range(len(value)) if isinstance(value, list) else value):
            yield from places(value[k], path + (k,))
    elif any(c in "123456789" for c in value):
        yield path

def changed(found, part):
    """A copy with one digit of one number of a part changed; symmetric places are both changed."""
    found = copy.deepcopy(found)
    path = R.choice(list(places(found[part])))
    holder = found[part]
    for key in path[:-1]: holder = holder[key]
    old = holder[path[-1]]
    mantissa = old.split("e")[0]
    digits = [k for k, c in enumerate(mantissa) if c.isdigit()][:R.choice([1, 2, 3, 5, 17])]
    k = R.choice(digits)
    new = Numeral(old[:k] + str((int(old[k]) + R.randint(1, 9)) % 10) + old[k + 1:])
    holder[path[-1]] = new
    if len(path) == 3 and R.random() < 0.9:
        rows = found[part][path[0]]
        if len(rows) == len(rows[0]): rows[path[2]][path[1]] = new
    return found

def negative(a): return [[-x for x in r] for r in a]

def he(a): return plus(a, transposed(a))

def blocks(a, b, d): return [x + y for x, y in zip(a, b)] + [x + y for x, y in
                                                            zip(transposed(b), d)]

def symmetric(a): return a == transposed(a)

def number(text): return Fraction(text)

A_OBSERVER = fractions([["0.2", "-1.01"], ["1", "0"]])
C_OBSERVER = fractions([["0.5", "-1"]])
A_SAMPLED = fractions([["0", "1"], ["-4", "0.1"]])

def true_lyapunov(u):
    p, a = fractions(u["P"]), fractions([["0", "1"], ["-2", "-3"]])
    return symmetric(p) and is_definite(plus(p, identity(2), -1)) and \
        is_definite(negative(he(product(p, a))))

def true_observer(u):
    p, y, g = fractions(u["P"]), fractions(u["Y"]), number(u["g"])
    flow = plus(he(plus(product(p, A_OBSERVER), product(y, C_OBSERVER), -1)), p, Fraction(1, 2))
    return symmetric(p) and is_definite(plus(p, identity(2), -1)) and \
        is_definite(negative(flow)) and is_definite(blocks(p, y, [[g]]))

def true_equations(u):
    p = fractions(u["P"])
    decrease = negative(he(product(p, fractions([["0", "1"], ["-1", "-1"]]))))
    return symmetric(p) and is_definite(p) and p[0][1] == Fraction(1, 2) and p[1][1] == 1 and \
        p[0][0] + p[1][1] == 3 and all(decrease[i][i] >= 0 for i in (0, 1)) and \
        helper.determinant(decrease) >= 0

def true_sampled(u):
    """At 41 points: necessary."""
    p, y = fractions(u["P"]), fractions(u["Y"])
    if not (symmetric(p) and is_definite(plus(p, identity(2), -1))): return False
    closed = plus(p, product(y, fractions([["1", "0"]])), -1)
    return all(is_definite(blocks(p, transposed(product(closed, FLOWS[k])), p))
               for k in range(41))

FLOWS = [exponential(A_SAMPLED, Fraction(1, 10) + Fraction(k, 50)) for k in range(41)]
TRUE = {"lyapunov": true_lyapunov, "observer": true_observer, "equations": true_equations,
        "sampled": true_sampled}

class Digits(unittest.TestCase):
    def test_unknowns(self):
        outcomes = set()
        for k in range(COUNT):
            name = list(TRUE)[k % 4]
            found = changed(gain(name), "unknowns")
            proved = {c.result for c in prove_yes(found)[0]} == {"proved"}
            true = TRUE[name](found["unknowns"])
            outcomes.add((proved, true))
            self.assertFalse(proved and not true, (name, found["unknowns"]))
        self.assertLessEqual({(True, True), (False, False)}, outcomes)

    def test_gains(self):
        for k in range(COUNT // 3):
            name = ("observer", "sampled")[k % 2]
            found = changed(gain(name), "gains")
            _, gains, at_gains = prove_yes(found)
            p, (gain_name, k) = fractions(found["unknowns"]["P"]), next(iter(
                found["gains"].items()))
            y = product(p, fractions(k))
            true = TRUE[name](dict(found["unknowns"], Y=[[str(x) for x in r] for r in y]))
            self.assertFalse(gain_name in at_gains and not true, found["gains"])

    def test_certificates(self):
        """A feasible problem has no certificate, whatever the multipliers."""
        feasible = [with_text("sampled-no", ("k: 1.5", "k: %s" % k)) for k in ("12", "40")]
        feasible += [with_text("uncontrollable", ("B: [[0]", "B: [[1e-6]"))]
        infeasible = gain("sampled-no")
        proved = 0
        for k in range(COUNT // 4):
            found = copy.deepcopy(feasible[k % 3])
            found["certificate"] = changed(found["certificate"], "multipliers")
            self.assertEqual(prove_no(found, found["certificate"]).result, "open")
            if k % 3 == 0:
                changed_certificate = changed(infeasible["certificate"], "multipliers")
                proved += prove_no(infeasible, changed_certificate).result == "proved"
        self.assertGreater(proved, 0)

if __name__ == "__main__":
    unittest.main()
