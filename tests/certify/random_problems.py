#!/usr/bin/env python3
"""Random problems whose answer is known: the program, and the checker after it, are never wrong.

    tests/certify/random_problems.py PROGRAM [--cases N] [--seed S]

Each problem has a threshold that is known exactly or to 40 digits, and a datum that is by 1e-8 of
it on the side of yes or no. `PROGRAM synth` answers, and the checker proves the gain file. Both may
leave a problem open. An answer that is wrong, or a wrong one that is proved, ends with exit code 1.
"""

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
from decimal import Decimal, getcontext
from fractions import Fraction

HERE = os.path.dirname(os.path.abspath(__file__))
CERTIFY = os.path.join(HERE, "..", "..", "scripts", "certify")
getcontext().prec = 60
NEAR = Decimal("1e-8")

def decimal(x): return "%s" % (Decimal(x.numerator) / Decimal(x.denominator)
                               if isinstance(x, Fraction) else x)
def text(rows): return "[" + ", ".join("[" + ", ".join(map(decimal, r)) + "]" for r in rows) + "]"

def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]

def similar(rng, diagonal):
    """T D inv(T) with whole numbers in T = L U of determinant 1, and inv(T)."""
    n = len(diagonal)
    def unit(lower):
        return [[Fraction(1 if i == j else rng.randint(-2, 2) if (i > j) == lower else 0)
                 for j in range(n)] for i in range(n)]
    def inverse(t, lower):
        result = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
        for i in range(n) if lower else reversed(range(n)):
            for k in range(n):
                if k != i and t[i][k]:
                    result[i] = [x - t[i][k] * y for x, y in zip(result[i], result[k])]
        return result
    low, up = unit(True), unit(False)
    t, inverted = product(low, up), product(inverse(up, False), inverse(low, True))
    return product(product(t, diagonal), inverted), t

def blocks(rng, n, largest, modulus):
    """A block-diagonal matrix whose eigenvalues' real parts, or moduli, are at most `largest`."""
    d, i = [[Fraction(0)] * n for _ in range(n)], 0
    while i < n:
        size = largest * Fraction(rng.randint(1, 9), 10) if modulus else \
            largest - Fraction(rng.randint(1, 20), 10)
        if i == 0: size = largest
        if i + 1 < n and rng.random() < 0.5:
            if modulus: c, s = rng.choice(((Fraction(3, 5), Fraction(4, 5)), (0, 1), (-1, 0)))
            else: c, s = 1, Fraction(rng.randint(1, 30), 10)
            re, im = (size * c, size * s) if modulus else (size, s)
            d[i][i] = d[i + 1][i + 1] = Fraction(re)
            d[i][i + 1], d[i + 1][i] = Fraction(im), -Fraction(im)
            i += 2
        else:
            d[i][i], i = size, i + 1
    return d

HEAD = "problem: random\nmethod:\n  data: {%s}\n  unknowns: {%s}\n  require: {%s}\ndata: {%s}\n"

def beyond(threshold, yes, larger_is_yes, size=1):
    """The threshold, by 1e-8 of its size on one side."""
    step = NEAR * max(abs(Decimal(size)), abs(threshold))
    return threshold + (step if yes == larger_is_yes else -step)

def of_fraction(x): return Decimal(x.numerator) / Decimal(x.denominator)

def decay(rng, yes):
    """He(P*A) + 2*alpha*P < 0 exactly for alpha below the least decay rate."""
    n, rate = rng.randint(1, 4), Fraction(rng.randint(-20, 20), 10)
    a, _ = similar(rng, blocks(rng, n, -rate, False))
    return HEAD % ("A: n x n, alpha: scalar", "P: symmetric n",
                   "positive: P > 0, decrease: He(P*A) + 2*alpha*P < 0",
                   "A: %s, alpha: %s" % (text(a), beyond(of_fraction(rate), yes, False)))

def contraction(rng, yes):
    """A'*P*A < rho^2*P exactly for rho above the spectral radius."""
    n, radius = rng.randint(1, 4), Fraction(rng.randint(1, 30), 10)
    a, _ = similar(rng, blocks(rng, n, radius, True))
    return HEAD % ("A: n x n, rho: scalar", "P: symmetric n",
                   "positive: P > 0, \"decrease\": \"A'*P*A - rho^2*P < 0\"",
                   "A: %s, rho: %s" % (text(a), beyond(of_fraction(radius), yes, True)))

def hidden(rng, yes):
    """An observer whose output does not see the mode l: for alpha < -l."""
    n, mode = rng.randint(2, 4), Fraction(rng.randint(-20, 20), 10)
    d = blocks(rng, n, mode, False)
    d[0] = [mode] + [Fraction(0)] * (n - 1)
    for row in d[1:]: row[0] = Fraction(0)
    d = [[d[i][j] if i and j or i == j else Fraction(0) for j in range(n)] for i in range(n)]
    if n > 2 and d[1][1] != d[2][2]: d[1][2] = d[2][1] = Fraction(0)
    a, t = similar(rng, d)
    c = [Fraction(0)] + [Fraction(rng.randint(1, 5)) for _ in range(n - 1)]
    inverted = product([c], inverse_of(t))
    return HEAD % ("A: n x n, C: p x n, alpha: scalar", "P: symmetric n, Y: n x p",
                   "positive: P > 0, decrease: He(P*A - Y*C) + 2*alpha*P < 0",
                   "A: %s, C: %s, alpha: %s" % (text(a), text(inverted),
                                                beyond(of_fraction(-mode), yes, False)))

def inverse_of(t):
    n = len(t)
    rows = [list(map(Fraction, t[i])) + [Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    for k in range(n):
        p = next(i for i in range(k, n) if rows[i][k])
        rows[k], rows[p] = rows[p], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k: rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k])]
    return [row[n:] for row in rows]

def root(rng, yes):
    """[x, a; a, x] > 0 and x <= c: for c > a, a = sqrt(k)."""
    a = Decimal(rng.randint(2, 90)).sqrt()
    return HEAD % ("k: scalar, c: scalar", "x: scalar",
                   "least: \"[x, sqrt(k); sqrt(k), x] > 0\", most: x <= c",
                   "k: %d, c: %s" % (round(a * a), beyond(a, yes, True)))

def sine(x):
    term, total, k = x, x, 1
    while abs(term) > Decimal("1e-55"):
        term *= -x * x / ((2 * k) * (2 * k + 1))
        total, k = total + term, k + 1
    return total

def interval(rng, yes):
    """x > sin(t) for all t in [0, T], T <= pi/2, and x <= c: for c > sin(T)."""
    end = Decimal(rng.randint(1, 15)) / 10
    return HEAD % ("T: scalar, c: scalar", "x: scalar",
                   "above: {forall: \"t in [0, T]\", that: x > sin(t)}, most: x <= c",
                   "T: %s, c: %s" % (end, beyond(sine(end), yes, True)))

FAMILIES = [decay, contraction, hidden, root, interval]

def answers(program, folder, problem):
    """(verdict of the program, that of the checker)."""
    name, gains = os.path.join(folder, "p.yaml"), os.path.join(folder, "g.json")
    with open(name, "w", encoding="utf-8") as stream: stream.write(problem)
    if os.path.exists(gains): os.remove(gains)
    done = subprocess.run([program, "synth", name, "-o", gains], capture_output=True, text=True)
    verdict = {0: "yes", 1: "no", 3: "undecided"}.get(done.returncode, done.stderr)
    if not os.path.exists(gains): return verdict, "no file"
    out = subprocess.run([sys.executable, CERTIFY, "--json", gains], capture_output=True, text=True)
    return verdict, json.loads(out.stdout)["verdict"]

def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    counts, wrong = {}, 0
    with tempfile.TemporaryDirectory() as folder:
        for case in range(asked.cases):
            rng = random.Random("%d %d" % (asked.seed, case))
            make, yes = FAMILIES[case % len(FAMILIES)], case // len(FAMILIES) % 2 == 0
            problem = make(rng, yes)
            verdict, proof = answers(asked.program, folder, problem)
            right = verdict == ("yes" if yes else "no")
            key = (make.__name__, "yes" if yes else "no", verdict, proof)
            counts[key] = counts.get(key, 0) + 1
            if not right and verdict != "undecided" or proof == "refuted" or \
                    proof == "not a gain file" or (proof == "proved" and not right):
                wrong += 1
                print("WRONG: case %d: %s, %s\n%s" % (case, verdict, proof, problem))
    for key, count in sorted(counts.items()): print("%4d  %s: %s, %s, %s" % ((count,) + key))
    print("%d problems, %d wrong" % (asked.cases, wrong))
    return 1 if wrong else 0

if __name__ == "__main__":
    sys.exit(main())
