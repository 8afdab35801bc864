"""That no unknowns make inequalities sums of squares of their degrees.

    row'M(x; u) row = sum of g(x) z'Qz + sum of h(x) t(x, row),   Q >= 0, t any,   z: all monomials

gives an equation for each monomial. Where it says that positive multiples of diagonal elements of
the Q add up to 0, these elements are 0 in every solution, and so are their rows; what adds up to
less is a contradiction. For the rows that are left, the file gives a number L for each equation, so
that

    sum of L times the coefficients of each u and t is 0, and of each Q a matrix >= 0.

Then the same sum of the constants, which is that of the Q, cannot be below 0. It cannot be 0 either
where that matrix is not 0 at a constant of a strict inequality: M - c I is a sum of squares for a
c > 0, which adds c times these elements; nor may that Q lose a constant.
"""
from collections import namedtuple
from fractions import Fraction
from itertools import combinations_with_replacement
from arithmetic import affine_terms
from matrices import NEGATIVE, Matrix, classify, filled
from squares import parts
from yes import Claim, cases
# Terms of an equation: ("u", k), ("t", ...), or ("q", gram, a, b) with a <= b. An equation has its
# terms and its constant, by (part, exponents).
class Equations(dict):
    def __init__(self):
        super().__init__()
        self.bases = []     # of the Gram matrices: lists of exponents
        self.positive = {}  # the main ones of strict inequalities: the constants that they need
    def put(self, key, term, c):
        terms = self.setdefault(key, ({}, Fraction(0)))[0]
        terms[term] = terms.get(term, 0) + c
    def add_constant(self, key, c):
        terms, constant = self.get(key, ({}, Fraction(0)))
        self[key] = terms, constant + c
def prove_no_squares(statement, given, name):
    equations, posed = Equations(), []
    for _, comparison, domain in cases(statement):
        if isinstance(comparison, Exception): raise comparison
        for part in parts(comparison, domain):
            if comparison.sign in ("<", ">"):
                equations.positive[len(equations.bases)] = part.ring.constants()
            pose(len(posed), part, comparison.entry, equations)
            posed.append(part)
    dead = plain_steps(equations)
    if dead is None or any(equations.bases[g][a] in equations.positive.get(g, ())
                           for g, a in dead): return Claim(name, "proved", "a coefficient")
    values = {(at, e): Fraction(y) for at, moments in enumerate(given or [])
              for text, y in moments.items() for e in part_terms(posed[at], text)}
    sums, total = {}, Fraction(0)
    matrices = [filled(len(b), len(b), lambda i, j: Fraction(0)) for b in equations.bases]
    for key, (terms, constant) in equations.items():
        y = values.get(key, 0)
        total += y * constant
        for term, c in terms.items() if y else ():
            if term[0] == "q":
                g, a, b = term[1:]
                half = y * c / (1 if a == b else 2)
                matrices[g].elements[a][b] += half
                if a != b: matrices[g].elements[b][a] += half
            else: sums[term] = sums.get(term, 0) + y * c
    if any(sums.values()): return Claim(name, "open", "moments that are not those of the unknowns")
    excludes = total < 0
    for g, matrix in enumerate(matrices):
        kept = [a for a in range(matrix.rows) if (g, a) not in dead]
        left = Matrix([[matrix[a, b] for b in kept] for a in kept], len(kept), len(kept))
        if classify(left) == NEGATIVE:
            return Claim(name, "open", "moments that are not those of squares")
        excludes |= total == 0 and any(equations.bases[g][a] in equations.positive.get(g, ())
                                       and matrix[a, a] for a in kept)
    return Claim(name, "proved", "moments") if excludes else \
        Claim(name, "open", "moments that exclude nothing")
def part_terms(part, text): return part.ring.terms(part.ring.read(text))
def plus(*exponents): return tuple(map(sum, zip(*exponents)))
def pose(at, part, entry, equations):
    ring, count = part.ring, part.ring.count
    rows = ring.units[count:] or [ring.nothing.origin()]
    def degree_of(p): return max((sum(e[:count]) for e in p), default=0)
    def monomials(degree):
        found = set()
        for chosen in combinations_with_replacement(range(count + 1), degree):
            found.add(plus(ring.nothing.origin(), *(ring.units[i] for i in chosen if i < count)))
        return sorted(found, key=lambda e: (sum(e), e))
    polynomials = {k: ring.terms(f) for k, f in affine_terms(part.p).items()}
    sets = [[ring.terms(f) for f in side] for side in (part.nonnegative, part.zero)]
    degree = max(map(degree_of, polynomials.values()), default=0)
    asked = str(entry.get("degree", "+0"))
    degree = degree + int(asked) if asked.startswith("+") else max(degree, int(asked))
    degree = max([degree] + [degree_of(p) for s in sets for p in s])
    degree += degree % 2
    for k, p in polynomials.items():
        for e, c in p.items():
            if k: equations.put((at, e), ("u", k), -c)
            else: equations.add_constant((at, e), c)
    for g in [{ring.nothing.origin(): Fraction(1)}] + sets[0]:
        basis = [plus(r, e) for r in rows for e in monomials((degree - degree_of(g)) // 2)]
        for b, f in enumerate(basis):
            for a, e in enumerate(basis[:b + 1]):
                for h, c in g.items():
                    equations.put((at, plus(e, f, h)), ("q", len(equations.bases), a, b),
                                  c * (1 if a == b else 2))
        equations.bases.append(basis)
    for k, h in enumerate(sets[1]):
        for e in {plus(r, s, e) for r in rows for s in rows
                  for e in monomials(degree - degree_of(h))}:
            for f, c in h.items(): equations.put((at, plus(e, f)), ("t", at, k, e), c)
def plain_steps(equations):
    """The rows (gram, a) that are 0 in every solution; None for a contradiction."""
    dead, fixed, goes_on = set(), {}, True
    while goes_on:
        goes_on = False
        for key, (terms, constant) in list(equations.items()):
            left = {}
            for term, c in terms.items():
                if term in fixed: constant -= c * fixed[term]
                elif c and (term[0] != "q" or not dead & {term[1:3], (term[1], term[3])}):
                    left[term] = c
            if not left:
                if constant: return None
                continue
            signs = {c > 0 for c in left.values()}
            diagonal = all(t[0] == "q" and t[2] == t[3] for t in left) and len(signs) == 1
            if len(left) == 1 and "q" not in {t[0] for t in left}:
                (term, c), = left.items()
                fixed[term], goes_on = constant / c, True
            elif diagonal and constant == 0:
                dead |= {t[1:3] for t in left}
                goes_on = True
            elif diagonal and (constant > 0) != signs.pop(): return None
    return dead
