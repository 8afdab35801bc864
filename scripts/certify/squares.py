"""Inequalities for all x, as sums of squares. The file gives polynomials z and Gram matrices Q >= 0
with  v'M(x)v = sum of g(x) z'Qz + sum of h(x) t(x, v),  where g >= 0 and h = 0 by `where`. Both sides
are expanded, coefficient by coefficient, in fractions."""
import re
from fractions import Fraction
from operator import add
from arithmetic import Taylor, Unsupported, is_exact
from language import Scope, parse
from matrices import POSITIVE, SEMIDEFINITE, Matrix, classify, column, flat, number
from statement import Comparison, chain_parts, expect, inequality, listed
ORDER = 400         # of polynomials: beyond it a Taylor model has a rest, and is refused
def squares_of(gain, label):
    """The records of one comparison in the order of the finite choices of its forall, those of the
    elements of a column together."""
    groups = {}
    for record in gain.get("sums_of_squares", []):
        name = record["name"]
        if re.fullmatch(re.escape(label) + r"( at .*)?(\(\d+\))?", name, re.S):
            groups.setdefault(re.sub(r"\(\d+\)$", "", name), []).append(record)
    return list(groups.values())
def polynomials_of(comparison, domain):
    """(M, (polynomials >= 0, polynomials = 0), the polynomial 0) of one comparison."""
    count = len(domain.intervals)
    zero = Taylor({}, 0, (count, ORDER))
    x = [zero.like({tuple(int(i == j) for j in range(count)): Fraction(1)}) for i in range(count)]
    scope, sets = scope_of(domain, x), ([], [])
    for text in listed(comparison.entry.get("where", [])):
        for left, relation, right in chain_parts(parse(text)):
            found = inequality(Comparison(left, relation, right, [], {}), scope)
            found = flat(found.transposed()) if relation == "==" else \
                [found[i, i] for i in range(found.rows)]
            sets[relation == "=="].extend(p for p in (terms_of(f, zero) for f in found) if p)
    for i, t in zip(domain.intervals, x):
        if i.low is not None: sets[0].append(terms_of((t - i.low) * (i.high - t), zero))
    return inequality(comparison, scope), sets, zero
def prove_squares(comparison, domain, records):
    """None, or why the identities do not show the comparison."""
    m, sets, zero = polynomials_of(comparison, domain)
    parts = [Matrix([[m[i, i]]]) for i in range(m.rows)] if len(records) > 1 else [m]
    if len(parts) != len(records): return "another number of identities"
    strict = comparison.sign in ("<", ">")
    return next(filter(None, (fault_of(a, r, sets, zero, strict)
                              for a, r in zip(parts, records))), None)
def scope_of(domain, x):
    names = {}
    for i, t in zip(domain.intervals, x):
        names[i.name] = number(t) if i.index is None else column(
            (flat(names[i.name]) if i.index else []) + [t])
    return Scope(domain.scope, names)
def terms_of(f, zero):
    """{exponents: fraction} of a polynomial; Unsupported for anything else."""
    f = f if isinstance(f, Taylor) else zero.lift(f)
    if f.rest or not all(map(is_exact, f.terms.values())):
        raise Unsupported("what is no polynomial with fractions")
    return {e: c for e, c in f.terms.items() if c}
def fault_of(m, record, sets, zero, strict):
    left, origin = {}, zero.origin()        # {(row, column, exponents): coefficient}
    def put(i, j, e, c):
        key = (min(i, j), max(i, j), e)
        left[key] = left.get(key, 0) + c
    for i in range(m.rows):
        for j in range(m.cols):
            for e, c in terms_of(m[i, j], zero).items(): put(i, j, e, c)
    constants = set()
    for square in record["squares"]:
        times = factor(square["times"], sets[0], origin)
        basis = [[summand(s) for s in z] for z in square["basis"]]
        rows = [[Fraction(c) for c in row] for row in square["gram"]]
        expect([len(row) for row in rows] == list(range(1, len(basis) + 1)), "a lower triangle")
        gram = Matrix([[rows[max(a, b)][min(a, b)] for b in range(len(rows))]
                       for a in range(len(rows))])
        found = classify(gram)
        if found not in (POSITIVE, SEMIDEFINITE): return "a Gram matrix that is not semidefinite"
        if found == POSITIVE and int(square["times"]) == 0:
            constants |= {z[0][1] for z in basis if len(z) == 1 and z[0][2] == origin}
        for a, first in enumerate(basis):
            for b, second in enumerate(basis):
                for c, i, e in first:
                    for d, j, f in second:
                        weight, both = gram[a, b] * c * d, tuple(map(add, e, f))
                        for g, t in times.items() if weight else ():
                            put(i, j, tuple(map(add, both, g)), -weight * t)
    for free in record.get("free", []):
        c, i, e = summand(free)
        expect(int(free["times"]) > 0, "times: an equation under where")
        for g, t in factor(free["times"], sets[1], origin).items():
            put(i, int(free["column"]), tuple(map(add, e, g)), -c * t)
    if any(left.values()): return "an identity that does not hold"
    if strict and constants < set(range(m.rows)): return "squares that may all be 0"
    return None
def factor(times, polynomials, origin):
    k = int(times)
    expect(0 <= k <= len(polynomials), "times: a polynomial under where")
    return polynomials[k - 1] if k else {origin: Fraction(1)}
def summand(s): return Fraction(s["c"]), int(s["row"]), tuple(int(e) for e in s["exponents"])
