"""What multipliers show: that inequalities have no common solution, or a bound of an objective.

Let B_k(x) = B_k0 + sum_i x_i B_ki > 0 (or >= 0) be inequalities of the text, some of them at
points of their intervals, and Y_k >= 0. If sum_k <B_ki, Y_k> = 0 for each i >= 1, then
sum_k <B_k(x), Y_k> = sum_k <B_k0, Y_k> for all x. At a solution the left side is >= 0, and > 0 if
a strict inequality has a Y_k that is not 0. So there is no solution if the right side is < 0, or
if it is 0 and a strict inequality has such a Y_k.

The matrices Y_k of the file are rounded and satisfy no equation. Two rules find others:
prove_inside shows that there are some near those of the file; algebraic.py builds some.
With sum_k <B_ki, Y_k> = c_i instead, c_0 + c'x >= c_0 - sum_k <B_k0, Y_k> at each solution.
"""

import math
from collections import namedtuple
from fractions import Fraction
from itertools import product

from algebraic import prove_algebraic
from arithmetic import (Ball, Undecided, Unsupported, affine_terms, ball, function, is_exact,
                        middle, sign, sum_of_balls, upper)
from language import decimal, matrix, parse
from matrices import Matrix, is_positive
from statement import (NOT_EVALUATED, Statement, Symbols, expect, inequality, matrix_of_json,
                       refuse)
from yes import Claim, outward, reason, scope_at

# One inequality at one point: its matrix as {i: {(row, column): coefficient of x_i}}, x_0 = 1, its
# shape, and the rows of its multiplier, or of a factor of it.
Block = namedtuple("Block", "sign terms shape multiplier factor")

# (smallest pivot kept, smallest multiplier kept), relative to the largest
CHOICES = [(1e-13, 0), (1e-9, 0), (1e-13, 1e-14), (1e-13, 1e-9), (1e-9, 1e-9), (1e-6, 0),
           (1e-6, 1e-6)]
LIMITS = [Fraction(1, 10 ** k) for k in (28, 24, 20, 16, 12, 8)]    # of prove_optimum

def prove_no(gain, certificate, name="no solution"):
    """The claim that the inequalities of the file have no solution."""
    try:
        statement = Statement(gain, Symbols())
        blocks = blocks_of(statement, certificate)
        for tiny, small in CHOICES:
            try:
                why = prove_inside(blocks, Fraction(tiny), Fraction(small))
            except Undecided as error:
                why = str(error)
            if why is None: return Claim(name, "proved", "multipliers near those of the file")
        found = prove_algebraic(statement, blocks)
        return Claim(name, "proved", found) if found else Claim(name, "open", why)
    except NOT_EVALUATED as error:
        return Claim(name, "open", reason(error))

# The blocks of a certificate.
def blocks_of(statement, certificate):
    """The inequalities that have multipliers, at their points."""
    comparisons = dict(statement.comparisons())
    if "blocks" in certificate:
        return [block_of_record(comparisons, entry) for entry in certificate["blocks"]]
    expect(isinstance(certificate.get("multipliers"), dict), "certificate.multipliers: an object")
    return [block_of_label(comparisons, label, matrix_of_json(rows, "multipliers").elements)
            for label, rows in certificate["multipliers"].items()]
def block_of_label(comparisons, label, multiplier):
    """The block of a label such as `flow at i = 1, tau = 0.768359`, whose values have 6 digits. A
    value near an end of its interval is that end. Any point of the interval would serve."""
    names = [n for n in comparisons if label == n or label.startswith(n + " at ")]
    name = max(names, key=len, default="")
    at = dict(part.partition(" = ")[::2] for part in label[len(name) + 4:].split(", ") if part)
    return block_at(comparisons.get(name), label, {key: decimal(x) for key, x in at.items()},
                    multiplier, None)
def block_of_record(comparisons, entry):
    """The block of {requirement, comparison, at: {variable: text}, factor: rows of texts}."""
    name = entry["requirement"]
    if name not in comparisons: name = "%s.%s" % (name, entry["comparison"])
    factor = [[decimal(str(x)) for x in row] for row in entry["factor"]]
    at = {key: matrix(parse(str(text)), comparisons[name].domains[0].scope).number()
          for key, text in entry.get("at", {}).items()}
    return block_at(comparisons[name], name, at, None, factor)
def block_at(comparison, label, at, multiplier, factor):
    if isinstance(comparison, Exception): raise comparison
    for domain in comparison.domains if comparison else ():
        if all(is_near(value, at.get(name)) for name, _, value in domain.choices):
            scope = scope_at(domain, [place(i, at.get(i.title)) for i in domain.intervals])
            if comparison.sign == "==":
                found = matrix(comparison.left, scope) - matrix(comparison.right, scope)
            else: found = inequality(comparison, scope)
            terms = {}
            for a, b in product(range(found.rows), range(found.cols)):
                for i, c in affine_terms(found[a, b]).items(): terms.setdefault(i, {})[a, b] = c
            return Block(comparison.sign, terms, found.shape(), multiplier, factor)
    raise Unsupported("the block " + label)
def is_near(value, given):
    if not value.is_number() or given is None: raise Unsupported("the value of an element of a set")
    x = middle(value.number())
    return abs(x - middle(given)) <= (1 + abs(x)) / 10 ** 5
def place(interval, value):
    """The point of the interval that a value of 6 digits means; it is shown to be inside."""
    outward(interval)       # not empty
    value = interval.low if value is None else value
    for end in (interval.low, interval.high):
        if upper(end - value) <= upper(end) * 6 / 10 ** 6: return end
    if sign(value - interval.low) < 0 or sign(interval.high - value) < 0:
        raise Unsupported("a point outside of its interval")
    return value

# Multipliers near those of the file.
def prove_inside(blocks, tiny, small):
    """None if exact multipliers are shown to exist near those of the file, else why not. Let L_k be
    any matrices, such as factors of the multipliers of the file, G_ki = L_k' B_ki L_k, r_i = sum_k
    trace G_ki, and H_ij = sum_k <G_ki, G_kj>. With u = inv(H) r and S_k = sum_j u_j G_kj, the
    multipliers Y_k = L_k (I - S_k) L_k' satisfy all equations sum_k <B_ki, Y_k> = r_i - (H u)_i =
    0. If r' inv(H) r = sum_k |S_k|^2 < 1, then I - S_k > 0. So Y_k >= 0, and Y_k is not 0 if L_k is
    not 0. Both H > 0 and this hold if [H, r; r', 1] > 0. The constant parts are the coefficients of
    x_0 = 1 > 0, with v = -sum_k trace G_k0 > 0 as its multiplier: another block, of one row, with G
    = v. Equations E(x) = 0 have multipliers of any sign: their coefficients enter H with the weight
    2^40, and r as they are."""
    scale = scale_of(blocks)
    if scale == 0: return "all multipliers are 0"
    factors = factors_of(blocks, scale, tiny, small, relaxed_rows(blocks))
    rows, residual = gathered(blocks, scale, factors)
    strict = any(blocks[k].sign in ("<", ">") for k in factors)
    if 0 in rows:
        v = -residual[0]
        if v.m <= v.r: return "the constant part has no sign"
        rows[0]["x0"], residual[0] = v, Ball(0)
    elif not strict: return "no strict inequality has a multiplier"
    if first_above(rows, residual, [1]): return None
    return "the multipliers of the file are too far from exact ones, or dependent"

def scale_of(blocks):
    return max((abs(x) for b in blocks for row in b.multiplier or b.factor for x in row), default=0)
def gathered(blocks, scale, factors):
    """({i: G_ki, by (k, row, column)}, {i: r_i})."""
    rows, residual = {}, {}
    for k, block in enumerate(blocks):
        if block.sign == "==": add_equation(k, block, scale, rows, residual)
        elif k in factors: add_block(k, block, factors[k], rows, residual)
    return rows, residual
def first_above(rows, residual, limits):
    """The first of the limits with H > 0 and r' inv(H) r < limit, or None."""
    rows, residual = dict(rows), dict(residual)
    for i, row in rows.items():      # rows of size 1: this changes H and r together
        size = sum(upper(x) ** 2 for x in row.values())
        power = (size.numerator.bit_length() - size.denominator.bit_length()) // 2
        rows[i] = {key: x * Fraction(2) ** -power for key, x in row.items()}
        residual[i] = residual[i] * Fraction(2) ** -power
    h, places = {}, list(rows)
    for n, i in enumerate(places):
        for j in places[:n + 1]: h[i, j] = h[j, i] = inner(rows[i], rows[j])
    bordered = [[h[i, j] for j in rows] + [residual[i]] for i in rows]
    last = [residual[i] for i in rows]
    return next((x for x in limits if is_positive(Matrix(bordered + [last + [Fraction(x)]]))), None)

# The bound of an objective.
def prove_optimum(gain):
    """The claim that the objective is nowhere below objective_lower_bound, or hardly. With G_ki,
    r_i = c_i - sum_k trace G_ki and H as in prove_inside, and r' inv(H) r <= s <= 1, the
    multipliers L_k (I + S_k) L_k' >= 0 satisfy all equations. They bound the objective by r_0 -
    sum_k <S_k, G_k0> >= r_0 - sqrt(s) |G_0|. Bounds on gains that the text does not state have no
    multipliers here."""
    stated = decimal(str(gain["objective_lower_bound"]))
    name = "objective >= %.10g" % stated
    try:
        statement = Statement(gain, Symbols())
        text = statement.method.get("minimize") or refuse("the objective of another problem")
        costs = affine_terms(matrix(parse(text), statement.scope).number())
        comparisons = dict(statement.comparisons())
        blocks = [block_of_label(comparisons, label, matrix_of_json(rows, "optimum").elements)
                  for label, rows in gain["optimum"].items() if not label.startswith("bound ")]
        scale = scale_of(blocks)
        if scale == 0: raise Undecided("all multipliers are 0")
        factors = factors_of(blocks, scale, Fraction(0), 0, set())
        rows, residual = gathered(blocks, scale, factors)
        left = {i: ball(costs.get(i, 0)) * (1 / scale) - residual.get(i, Ball(0))
                for i in {0, *costs, *rows}}
        first, constant = left.pop(0), rows.pop(0, {})
        if not set(left) <= set(rows): raise Undecided("an unknown of the objective alone")
        s = first_above(rows, left, LIMITS)
        if s is None: raise Undecided("the multipliers of the file are too far from exact ones")
        shown = (first - function("sqrt", s * inner(constant, constant))) * scale
        low = middle(shown) - upper(shown - middle(shown))
        enough = low >= stated - abs(stated) / 10 ** 6
        return Claim(name, "proved" if enough else "open", "multipliers: at least %.12g" % low)
    except NOT_EVALUATED as error:
        return Claim(name, "open", reason(error))

def inner(a, b):
    a, b = (a, b) if len(a) <= len(b) else (b, a)
    return sum_of_balls([(x, b[key]) for key, x in a.items() if key in b])
def add_equation(k, block, scale, rows, residual):
    """E(x) = 0 with the multiplier M of [0, E; E', 0], of which 2 M_12 counts."""
    (height, width), given = block.shape, block.multiplier or []
    for i, entries in block.terms.items():
        for (a, b), c in entries.items():
            m = 2 * given[a][height + b] if len(given) == height + width else given[a][b]
            residual[i] = residual.get(i, Ball(0)) + ball(c) * (m / scale)
            rows.setdefault(i, {})[k, a, b] = ball(c) * Fraction(2 ** 40)
def add_block(k, block, factor, rows, residual):
    """G_ki = L' B_i L for all i."""
    columns = range(len(factor[0]))
    for i, entries in block.terms.items():
        moved = {}                  # B_i L, by rows
        for (a, b), c in entries.items():
            if any(factor[a]) and any(factor[b]):
                row = moved.get(a, [Ball(0)] * len(columns))
                moved[a] = [x + ball(c) * y for x, y in zip(row, factor[b])]
        for p, q in product(columns, columns) if moved else ():
            g = sum((row[q] * factor[a][p] for a, row in moved.items()), Ball(0))
            rows.setdefault(i, {})[k, p, q] = g
            if p == q: residual[i] = residual.get(i, Ball(0)) + g

def factors_of(blocks, scale, tiny, small, dead):
    """{k: L_k} with zero rows where an unknown only relaxes the inequalities (dead). An unknown
    whose coefficients in the remaining rows are diagonal and of one sign makes these rows hold. No
    multiplier can use them, so they become zero; this is repeated."""
    found = {}
    for k, block in enumerate(blocks):
        size = max(abs(x) for row in block.multiplier or block.factor for x in row)
        live = [a for a in range(block.shape[0]) if (k, a) not in dead]
        if block.sign == "==" or size == 0 or size < small * scale or not live: continue
        if block.factor: part = [block.factor[a] for a in live]
        else: part = cholesky([[block.multiplier[a][b] / scale for b in live] for a in live], tiny)
        rows = dict(zip(live, part))
        if any(any(row) for row in part):      # L_k is not 0
            found[k] = [rows.get(a, [Fraction(0)] * len(part[0])) for a in range(block.shape[0])]
    return found

def relaxed_rows(blocks):
    """The rows (block, row) that an unknown alone can make positive."""
    entries = {}
    for k, block in enumerate(blocks):
        for i, found in block.terms.items():
            entries.setdefault(i, []).extend((k, a, b, c) for (a, b), c in found.items())
    entries.pop(0, None)
    dead, before = set(), None
    while before != len(dead):
        before = len(dead)
        for found in entries.values():
            live = [e for e in found if (e[0], e[1]) not in dead and (e[0], e[2]) not in dead]
            if all(a == b and is_exact(c) and blocks[k].sign != "==" and (c > 0) == (live[0][3] > 0)
                   for k, a, b, c in live):
                dead |= {(k, a) for k, a, _, _ in live}
    return dead

def cholesky(y, tiny):
    """Rows of L with y near L L', in floating point; pivots below `tiny`, for a diagonal near 1,
    are dropped. Nothing is concluded from L: whatever it is, L L' >= 0."""
    places = range(len(y))
    scale = [math.sqrt(max(y[a][a], 0)) or 1.0 for a in places]
    rest = [[float(y[a][b]) / scale[a] / scale[b] for b in places] for a in places]
    columns = []
    for _ in places:
        p = max(places, key=lambda a: rest[a][a])
        if rest[p][p] <= tiny: break
        c = [rest[a][p] / math.sqrt(rest[p][p]) for a in places]
        columns.append(c)
        rest = [[rest[a][b] - c[a] * c[b] for b in places] for a in places]
    return [[Fraction(c[a] * scale[a]) for c in columns] for a in places]
