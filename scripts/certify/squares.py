"""Inequalities for all x, as sums of squares. The file gives polynomials z and Gram matrices Q >= 0
with  M = sum of g(x) z'Qz + sum of h(x) t(x),  where g >= 0 and h = 0 by `where`. Of a matrix M the
identity is that of row'M(x) row. Both sides are expanded, coefficient by coefficient, in fractions.
"""
import re
from collections import namedtuple
from fractions import Fraction
from arithmetic import Taylor, Unsupported, affine_terms, is_exact
from language import Scope, matrix, parse
from matrices import POSITIVE, SEMIDEFINITE, Matrix, classify, column, flat, number
from statement import Comparison, chain_parts, expect, inequality, listed
ORDER = 400         # of polynomials: beyond it a Taylor model has a rest, and is refused
# p = row'M(x) row, or M itself where it is a number, on the set g(x) >= 0, h(x) = 0.
Posed = namedtuple("Posed", "p nonnegative zero ring")

class Polynomials:
    """Polynomials with fractions in the variables of a domain, and in a column `row`."""
    def __init__(self, domain, rows=0):
        n = len(domain.intervals)
        self.nothing = Taylor({}, 0, (n + rows, ORDER))
        self.units = [tuple(int(i == j) for j in range(n + rows)) for i in range(n + rows)]
        x = [self.nothing.like({unit: Fraction(1)}) for unit in self.units]
        names = {}
        for i, t in zip(domain.intervals, x):
            if i.title != i.name: names[i.title] = number(t)
            names[i.name] = number(t) if i.index is None else column(
                (flat(names[i.name]) if i.index else []) + [t])
        self.count, self.variables, self.rows = n, x[:n], x[n:]
        self.scope, row = Scope(domain.scope, names), "row"
        while row in names: row += "_"
        self.records = Scope(None, {**names, row: column(x[n:])} if rows else names)
    def terms(self, f):
        """{exponents: fraction} of a value; Unsupported where it is no polynomial."""
        f = f if isinstance(f, Taylor) else self.nothing.lift(f)
        if f.rest or not all(map(is_exact, f.terms.values())):
            raise Unsupported("what is no polynomial with fractions")
        return {e: c for e, c in f.terms.items() if c}
    def read(self, text): return matrix(parse(text), self.records).number()
    def is_zero(self, f): return not any(self.terms(c) for c in affine_terms(f).values())
    def constants(self):        # the exponents of what is not 0 at x = 0
        return set(self.units[self.count:]) or {self.nothing.origin()}
def parts(comparison, domain, are_one=False):
    """One part, but of a diagonal matrix one for each element, if they are not one anyhow."""
    ring = Polynomials(domain)
    m = inequality(comparison, ring.scope)
    pairs = [(i, j) for i in range(m.rows) for j in range(m.rows)]
    if m.rows == 1 or not are_one and all(i == j or ring.is_zero(m[i, j]) for i, j in pairs):
        found = [m[i, i] for i in range(m.rows)]
    else:
        ring = Polynomials(domain, m.rows)
        m = inequality(comparison, ring.scope)
        found = [sum((ring.rows[i] * ring.rows[j] * m[i, j] for i, j in pairs), Fraction(0))]
    sets = [], []
    for text in listed(comparison.entry.get("where", [])):
        for left, relation, right in chain_parts(parse(text)):
            d = inequality(Comparison(left, relation, right, [], {}), ring.scope)
            values = flat(d.transposed()) if relation == "==" else [d[i, i] for i in range(d.rows)]
            sets[relation == "=="].extend(f for f in values if ring.terms(f))
    for i, t in zip(domain.intervals, ring.variables):
        if i.low is not None: sets[0].append((t - i.low) * (i.high - t))
    return [Posed(p, *sets, ring) for p in found]
def squares_of(gain, label):
    """The records of one comparison in the order of the finite choices of its forall, those of the
    elements of a column together."""
    groups = {}
    for record in gain.get("sums_of_squares", []):
        name = record["name"]
        if re.fullmatch(re.escape(label) + r"( at .*)?(\(\d+\))?", name, re.S):
            groups.setdefault(re.sub(r"\(\d+\)$", "", name), []).append(record)
    return list(groups.values())
def prove_squares(comparison, domain, records):
    """None, or why the identities do not show the comparison."""
    found = parts(comparison, domain, len(records) == 1)
    if len(found) != len(records): return "another number of identities"
    strict = comparison.sign in ("<", ">")
    return next(filter(None, (fault_of(p, r, strict) for p, r in zip(found, records))), None)
def fault_of(posed, record, strict):
    left, ring, constants = posed.p, posed.ring, set()
    for square in record["squares"]:
        k, z = int(square["times"]), [ring.read(text) for text in square["basis"]]
        rows = [[Fraction(c) for c in row] for row in square["gram"]]
        expect([len(row) for row in rows] == list(range(1, len(z) + 1)), "a lower triangle")
        gram = Matrix([[rows[max(a, b)][min(a, b)] for b in range(len(z))] for a in range(len(z))])
        found = classify(gram)
        if found not in (POSITIVE, SEMIDEFINITE): return "a Gram matrix that is not semidefinite"
        if found == POSITIVE and k == 0:
            constants.update(*(e for e in map(ring.terms, z) if len(e) == 1))
        for a, first in enumerate(z):
            inner = sum((gram[a, b] * second for b, second in enumerate(z)), Fraction(0))
            left = left - factor(k, posed.nonnegative) * (first * inner)
    for free in record.get("free", []):
        expect(int(free["times"]) > 0, "times: an equation under where")
        left = left - factor(int(free["times"]), posed.zero) * ring.read(free["polynomial"])
    if not ring.is_zero(left): return "an identity that does not hold"
    return "squares that may all be 0" if strict and not ring.constants() <= constants else None
def factor(k, polynomials):
    expect(0 <= k <= len(polynomials), "times: a polynomial under where")
    return polynomials[k - 1] if k else Fraction(1)
