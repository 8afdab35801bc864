"""What multipliers show: that inequalities have no common solution, or a bound of an objective.

Let B_k(x) = B_k0 + sum_i x_i B_ki > 0 (or >= 0) be inequalities of the text, some of them at
points of their intervals, and Y_k >= 0 with sum_k <B_ki, Y_k> = c_i for each i >= 1. Then

    c_0 + c'x = v + sum_k <B_k(x), Y_k> >= v = c_0 - sum_k <B_k0, Y_k>      at each solution x.

So v is a lower bound of the objective c_0 + c'x. With c = 0 there is no solution if v > 0, or if
v = 0 and a strict inequality has a Y_k that is not 0.

The matrices Y_k of the file are rounded and satisfy no equation. Two rules find others: `near`
shows that there are some near those of the file; algebraic.py checks those that are exact.
"""
import math
from collections import namedtuple
from fractions import Fraction
from itertools import product
from algebraic import STRICT, prove_algebraic
from arithmetic import (Ball, Undecided, Unsupported, affine_terms, ball, function, is_exact,
                        middle, sum_of_balls, upper)
from language import decimal, matrix, parse
from matrices import filled, least, pivots_of
from moments import prove_no_squares
from statement import NOT_EVALUATED, Statement, Symbols, expect, inequality, matrix_of_json, refuse
from yes import Claim, is_outside, outward, reason, scope_at, ten_digits
# One inequality at one point: its matrix as {i: {(row, column): coefficient of x_i}}, x_0 = 1, its
# shape, and the rows of its multiplier.
Block = namedtuple("Block", "sign terms shape multiplier")
# (smallest pivot kept, smallest multiplier kept), relative to the largest
CHOICES = [(1e-13, 0), (1e-9, 0), (1e-13, 1e-14), (1e-13, 1e-9), (1e-9, 1e-9), (1e-6, 0),
           (1e-6, 1e-6)]
NEAR = 10 ** 6      # an objective is proved above its stated bound, but for this part of it
FAR = "the multipliers of the file are too far from exact ones, or dependent"
BOUNDED = "the bound is one within bounds of the gains that the text does not state"
def prove_no(gain, certificate, name="no solution"):
    """The claim that the inequalities of the file have no solution."""
    try:
        statement = Statement(gain, Symbols())
        if certificate.get("about") == "sums of squares":
            return prove_no_squares(statement, certificate.get("moments"), name)
        if given := certificate.get("algebraic"):
            why = prove_algebraic(given, lambda label: blocks_of(statement, {label: None})[0])
            how = "an eigenvalue of %(of)s, exactly" if "of" in given else "exact multipliers"
            return Claim(name, "open", why) if why else Claim(name, "proved", how % given)
        blocks = blocks_of(statement, certificate.get("multipliers"))
        if moved := equal_effects(blocks):
            blocks = blocks_of(Statement(gain, Symbols(moved)), certificate["multipliers"])
        for tiny, small in CHOICES:
            try: why = prove_inside(blocks, Fraction(tiny), Fraction(small))
            except Undecided as error: why = str(error)
            if why is None: return Claim(name, "proved", "multipliers near those of the file")
        return Claim(name, "open", why)
    except NOT_EVALUATED as error: return Claim(name, "open", reason(error))
def prove_inside(blocks, tiny, small):
    """None if multipliers with c = 0 and v > 0 (or v = 0, strictly) are shown to exist, else why
    not. The constant parts are the coefficients of x_0 = 1 > 0, with v as its multiplier: another
    block, of one row, with G = v and r_0 = 0."""
    _, rows, residual, used = near(blocks, {}, tiny, small, relaxed_rows(blocks))
    v = residual.pop(0)
    if 0 in rows:
        if v.m <= v.r: return "the constant part has no sign"
        rows[0]["x0"], residual[0] = v, Ball(0)
    elif not any(block.sign in STRICT for block in used):
        return "no strict inequality has a multiplier"
    return FAR if correction(rows, residual) is None else None
def prove_optimum(gain):
    """The claim that the objective is nowhere below its bound in the file, or hardly; it names the
    bound that is proved. With r' inv(H) r <= s (see `near`), v = r_0 - sum_k <S_k, G_k0> is at
    least r_0 - sqrt(s) |G_0|. Bounds on gains that the text does not state get no multipliers."""
    stated = decimal(str(gain["objective_lower_bound"]))
    name = "objective >= " + ten_digits(stated, "ROUND_FLOOR")
    try:
        statement = Statement(gain, Symbols())
        text = statement.method.get("minimize") or refuse("the objective of another problem")
        costs = affine_terms(matrix(parse(text), statement.scope).number())
        blocks = blocks_of(statement, {label: rows for label, rows in gain["optimum"].items()
                                       if not label.startswith("bound ")})
        scale, rows, residual, _ = near(blocks, costs, 0, 0, set())
        first, constant = residual.pop(0), rows.pop(0, {})
        if not set(residual) <= set(rows): raise Undecided("an unknown of the objective alone")
        s = correction(rows, residual)
        if s is None: raise Undecided(FAR if len(blocks) == len(gain["optimum"]) else BOUNDED)
        shown = (first - function("sqrt", s * inner(constant, constant))) * scale
        low = middle(shown) - upper(shown - middle(shown))
        shown = ten_digits(low, "ROUND_FLOOR")
        if low < stated - abs(stated) / NEAR: return Claim(name, "open", "shown: >= " + shown)
        return Claim("objective >= " + shown, "proved", "multipliers near those of the file")
    except NOT_EVALUATED as error: return Claim(name, "open", reason(error))
def blocks_of(statement, multipliers):
    """The inequalities that have multipliers. A label is such as `flow at i = 1, tau = 0.7`."""
    expect(isinstance(multipliers, dict), "multipliers: an object")
    comparisons, blocks = dict(statement.comparisons()), []
    for label, rows in multipliers.items():
        name, _, point = label.partition(" at ")
        values = [part.partition(" = ") for part in point.split(", ") if part]
        comparison, at = comparisons.get(name), {key: decimal(x) for key, _, x in values}
        if isinstance(comparison, Exception): raise comparison
        domain = comparison and next((d for d in comparison.domains if is_chosen(d, at)), None)
        if not domain: raise Unsupported("the block " + label)
        scope = scope_at(domain, [place(i, at.get(i.title)) for i in domain.intervals])
        found, terms = inequality(comparison, scope), {}
        for a, b in product(range(found.rows), range(found.cols)):
            for i, c in affine_terms(found[a, b]).items(): terms.setdefault(i, {})[a, b] = c
        blocks.append(Block(comparison.sign, terms, found.shape(),
                            rows and matrix_of_json(rows, "multipliers").elements))
    return blocks
def is_chosen(domain, at):
    """Whether these are the values of the variables that have a finite choice."""
    if any(not value.is_number() or name not in at for name, _, value in domain.choices):
        raise Unsupported("the value of an element of a set")
    return all(is_rounded(at[name], value.number()) for name, _, value in domain.choices)
def is_rounded(value, x): return upper(x - value) <= upper(x) / 10 ** 15 + Fraction(1, 10 ** 30)
def place(interval, value):
    """The point of the interval that decimals mean: an end, or a point that is shown to be inside.
    Any point of the interval would serve."""
    outward(interval)       # not empty
    for end in (interval.low, interval.high):
        if value is None or is_rounded(value, end): return end
    if is_outside(interval, value): raise Unsupported("a point outside of its interval")
    return value
def near(blocks, costs, tiny, small, dead):
    """(scale, {i: G_ki, by (k, row, column)}, {i: r_i}, the blocks with L_k) for multipliers of the
    scale 1. Let L_k be any matrices, such as factors of the multipliers of the file, G_ki = L_k'
    B_ki L_k, r_i = c_i - sum_k trace G_ki and H_ij = sum_k <G_ki, G_kj>, i, j >= 1. With u = inv(H)
    r and S_k = sum_j u_j G_kj, the multipliers Y_k = L_k (I + S_k) L_k' satisfy all equations:
    sum_k <B_ki, Y_k> = c_i - r_i + (H u)_i = c_i. If r' inv(H) r = sum_k |S_k|^2 < 1, then I + S_k
    > 0. So Y_k >= 0, and Y_k is not 0 if L_k is not 0. Equations E(x) = 0 have multipliers of any
    sign: their coefficients enter H with the weight 2^40, and r as they are."""
    scale = max((abs(x) for b in blocks for row in b.multiplier for x in row), default=0)
    if scale == 0: raise Undecided("all multipliers are 0")
    rows, traces, used = {}, {}, []
    for k, block in enumerate(blocks):
        if block.sign == "==": add_equation(k, block, scale, rows, traces)
        elif factor := factor_of(k, block, scale, tiny, small, dead):
            add_block(k, block, factor, rows, traces)
            used.append(block)
    residual = {i: ball(costs.get(i, 0)) * (1 / scale) - traces.get(i, Ball(0))
                for i in {0, *costs, *rows}}
    return scale, rows, residual, used
def correction(rows, residual):
    """An upper bound s < 1 of r' inv(H) r, or None. If [H, r; r', 1] > 0, then H > 0, and the last
    pivot is 1 - r' inv(H) r. Powers of two make the rows of G_ki of size 1, and change r_i too."""
    scaled = []
    for i, row in rows.items():
        size = sum(upper(x) ** 2 for x in row.values())
        factor = Fraction(2) ** ((size.denominator.bit_length() - size.numerator.bit_length()) // 2)
        scaled.append(({key: x * factor for key, x in row.items()}, residual[i] * factor))
    lower = [[inner(a, b) for b, _ in scaled[:n + 1]] for n, (a, _) in enumerate(scaled)]
    lower.append([r for _, r in scaled] + [Fraction(1)])
    whole = filled(len(lower), len(lower), lambda i, j: lower[max(i, j)][min(i, j)])
    for pivot in pivots_of([[Ball(x) for x in row] for row in least(whole)]):
        if pivot.m <= pivot.r: return None
    return upper(1 - pivot)
def inner(a, b):
    a, b = (a, b) if len(a) <= len(b) else (b, a)
    return sum_of_balls([(x, b[key]) for key, x in a.items() if key in b])
def add_equation(k, block, scale, rows, traces):
    """E(x) = 0 with the multiplier M of [0, E; E', 0], of which 2 M_12 counts."""
    (height, width), given = block.shape, block.multiplier
    for i, entries in block.terms.items():
        for (a, b), c in entries.items():
            m = 2 * given[a][height + b] if len(given) == height + width else given[a][b]
            traces[i] = traces.get(i, Ball(0)) + ball(c) * (m / scale)
            rows.setdefault(i, {})[k, a, b] = ball(c) * Fraction(2 ** 40)
def add_block(k, block, factor, rows, traces):
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
            if p == q: traces[i] = traces.get(i, Ball(0)) + g
def factor_of(k, block, scale, tiny, small, dead):
    """L_k, with rows 0 where an unknown relaxes the inequalities (dead); None if it would be 0."""
    live = [a for a in range(block.shape[0]) if (k, a) not in dead]
    if max(abs(x) for row in block.multiplier for x in row) < small * scale: return None
    part = cholesky([[block.multiplier[a][b] / scale for b in live] for a in live], tiny)
    rows = dict(zip(live, part))
    return [rows.get(a, [Fraction(0)] * len(part[0])) for a in range(block.shape[0])] \
        if any(map(any, part)) else None
def relaxed_rows(blocks):
    """The rows (block, row) that no multiplier can use. An unknown whose coefficients in all other
    rows are diagonal and of one sign makes its rows hold; this is repeated."""
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
                   for k, a, b, c in live): dead |= {(k, a) for k, a, _, _ in live}
    return dead
def equal_effects(blocks):
    """{i: {j: f}} for scalars with B_kj = -f B_ki, about. With x_i + f x_j in the place of x_i, x_j
    has no coefficients left, if they cancel in the text: so no equation depends on another."""
    dead, entries, first, moved = relaxed_rows(blocks), {}, {}, {}
    for k, block in enumerate(blocks):
        for i, found in block.terms.items():
            entries.setdefault(i, []).extend(((k, a, b), float(middle(c))) for (a, b), c in
                                             sorted(found.items()) if not {(k, a), (k, b)} & dead)
    for i, found in entries.items():
        if i == 0 or not found or found[0][1] == 0: continue
        key = tuple((place, float("%.10g" % (x / found[0][1]))) for place, x in found)
        j, size = first.setdefault(key, (i, found[0][1]))
        factor = -Fraction(found[0][1] / size).limit_denominator(1000)
        if j != i: moved.setdefault(j, {})[i] = factor
    return moved
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
