"""That no unknowns make inequalities sums of squares of their degrees.

    v'M(x; u)v = sum of g(x) z'Qz + sum of h(x) t(x, v),   Q >= 0, t any,   z: all monomials

gives an equation for each monomial. Where it says that positive multiples of diagonal elements of the
Q add up to 0, these elements are 0 in every solution, and so are their rows; what adds up to less is a
contradiction. For the rows that are left, the file gives a number L for each equation, so that

    sum of L times the coefficients of each u and t is 0, and of each Q a matrix >= 0.

Then the same sum of the constants, which is that of the Q, cannot be below 0."""
from collections import namedtuple
from fractions import Fraction
from itertools import combinations_with_replacement, product
from operator import add
from arithmetic import Unsupported, affine_terms
from matrices import NEGATIVE, Matrix, classify, filled
from squares import polynomials_of, terms_of
from yes import Claim, cases
# Terms of an equation: ("u", k), ("t", ...), or ("q", gram, a, b) with a <= b.
Gram = namedtuple("Gram", "basis entries")
def prove_no_squares(statement, given, name):
    equations, grams = {}, []
    for at, (label, comparison, domain) in enumerate(cases(statement)):
        if isinstance(comparison, Exception): raise comparison
        m, sets, zero = polynomials_of(comparison, domain)
        pose(at, m, sets, zero, comparison, equations, grams)
    dead = plain_steps(equations, grams)
    if dead is None: return Claim(name, "proved", "a coefficient")
    values = {}
    for at, record in enumerate(given or []):
        for y in record:
            key = (at, int(y["row"]), int(y["column"]), tuple(map(int, y["exponents"])))
            values[key] = Fraction(y["value"])
    sums, matrices = {}, [filled(len(g.basis), len(g.basis), lambda i, j: Fraction(0)) for g in grams]
    total = Fraction(0)
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
    for g, matrix in enumerate(matrices):
        kept = [a for a in range(matrix.rows) if (g, a) not in dead]
        if classify(Matrix([[matrix[a, b] for b in kept] for a in kept], len(kept), len(kept))) \
                == NEGATIVE: return Claim(name, "open", "moments that are not those of squares")
    return Claim(name, "proved", "moments") if total < 0 else \
        Claim(name, "open", "moments that exclude nothing")
def monomials(count, degree):
    found = set()
    for chosen in combinations_with_replacement(range(count + 1), degree):
        found.add(tuple(chosen.count(i) for i in range(count)))
    return sorted(found, key=lambda e: (sum(e), e))
def degree_of(p): return max(map(sum, p), default=0)
def pose(at, m, sets, zero, comparison, equations, grams):
    count, rows = zero.space[0], m.rows
    parts = {}          # of u: polynomials by row, column
    for i in range(rows):
        for j in range(i, rows):
            for k, f in affine_terms(m[i, j]).items():
                parts.setdefault(k, {})[i, j] = terms_of(f, zero)
    degree = max([degree_of(p) for part in parts.values() for p in part.values()] + [0])
    asked = str(comparison.entry.get("degree", "+0"))
    degree = degree + int(asked) if asked.startswith("+") else max(degree, int(asked))
    degree = max([degree] + [degree_of(p) for s in sets for p in s])
    degree += degree % 2
    def put(i, j, e, term, c):
        terms = equations.setdefault((at, min(i, j), max(i, j), e), ({}, Fraction(0)))[0]
        terms[term] = terms.get(term, 0) + c
    for k, part in parts.items():
        for (i, j), p in part.items():
            for e, c in p.items():
                c = c * (1 if i == j else 2)
                if k: put(i, j, e, ("u", k), -c)
                else:
                    terms, constant = equations.setdefault((at, i, j, e), ({}, Fraction(0)))
                    equations[at, i, j, e] = terms, constant + c
    for g in [{zero.origin(): Fraction(1)}] + sets[0]:
        basis = [(r, e) for r in range(rows) for e in monomials(count, (degree - degree_of(g)) // 2)]
        for b, (j, f) in enumerate(basis):
            for a, (i, e) in enumerate(basis[:b + 1]):
                for h, c in g.items():
                    put(i, j, tuple(map(add, map(add, e, f), h)), ("q", len(grams), a, b),
                        c * (1 if a == b else 2))
        grams.append(Gram(basis, None))
    for k, h in enumerate(sets[1]):
        for i, j in product(range(rows), repeat=2):
            for e in monomials(count, degree - degree_of(h)) if i <= j else ():
                for f, c in h.items(): put(i, j, tuple(map(add, e, f)), ("t", at, k, i, j, e), c)
def plain_steps(equations, grams):
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
