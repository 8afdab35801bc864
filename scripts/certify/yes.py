"""The proof of a yes: every comparison of every requirement, at the decimals of the file."""

import re
from collections import namedtuple
from fractions import Fraction
from itertools import product

from arithmetic import (ONE, Affine, Taylor, Undecided, Unsupported, ball, is_exact, middle, sign,
                        upper)
from definite import (NEGATIVE, POSITIVE, UNKNOWN, classify, is_positive, is_positive_on_box,
                      witness)
from language import Scope, matrix, parse
from matrices import Matrix, column, exactly, flat, number
from statement import (NOT_EVALUATED, Statement, inequality, matrix_of_json, section,
                       values_of_file)

# result: proved, refuted or open. `how` says by what it was proved, or why it is open.
Claim = namedtuple("Claim", "name result how pieces point vector")
ORDERS = {1: 9, 2: 5}       # of Taylor models, by the number of variables; else 3
SMALLEST_PIECE = Fraction(1, 10 ** 12)      # of the interval

def claim(name, result, how, pieces=0, point=None, vector=None):
    return Claim(name, result, how, pieces, point or {}, vector or [])

def prove_requirements(statement):
    """A claim for each comparison of each requirement, and each finite choice of its forall."""
    for label, comparison in statement.comparisons():
        if isinstance(comparison, Exception):
            yield claim(label, "open", reason(comparison))
            continue
        for domain in comparison.domains:
            name = label + label_of(domain.choices)
            try:
                yield prove(name, comparison, domain, "solution_within" in statement.gain)
            except NOT_EVALUATED as error:
                yield claim(name, "open", reason(error))

def reason(error):
    if isinstance(error, Undecided): return "not decided: %s" % error
    if isinstance(error, Unsupported): return "not known to certify: %s" % error
    return "not evaluated: %s %s" % (type(error).__name__, error)

def label_of(choices):
    texts = ["%s = %s" % (name, short(value.elements[0][0])) if value.is_number()
             else "%s = element %d" % (name, k) for name, k, value in choices]
    return " at " + ", ".join(texts) if texts else ""

def short(x): return "%.6g" % float(middle(x)) if upper(x) < 10 ** 300 else "a large number"

def prove(name, comparison, domain, near=False):
    if domain.hulls: check_affine(comparison, domain)
    if comparison.sign == "==": return prove_equation(name, comparison, domain, near)
    if domain.intervals: return prove_for_all(name, comparison, domain)
    return judge(name, comparison, inequality(comparison, domain.scope), {})

def judge(name, comparison, a, point):
    """One symmetric matrix: a > 0 or a >= 0."""
    strict = comparison.sign in ("<", ">")
    found = classify(a)
    if found == POSITIVE or found not in (UNKNOWN, NEGATIVE) and not strict:
        return claim(name, "proved", "fractions" if exactly(a) else "balls")
    vector = witness(a, strict)
    if vector: return claim(name, "refuted", "a vector", 0, point, vector)
    return claim(name, "open", "the matrix is not shown to be definite")

def prove_equation(name, comparison, domain, near):
    """Both sides are the same fractions; over intervals, the same polynomials of fractions. With
    `solution_within` (near) the file does not say that its decimals satisfy the equations."""
    scope = domain.scope
    if domain.intervals: scope, _ = on_piece(domain, [outward(x) for x in domain.intervals])
    difference = matrix(comparison.left, scope) - matrix(comparison.right, scope)
    terms = [c for x in flat(difference)
             for c in ([x] if not isinstance(x, Taylor) else [*x.terms.values(),
                                                              Fraction(x.rest)])]
    if all(is_exact(c) and c == 0 for c in terms): return claim(name, "proved", "fractions")
    if not domain.intervals and exactly(difference) and not near:
        return claim(name, "refuted", "an equation that does not hold exactly")
    return claim(name, "open", "an equation that does not hold exactly")

def check_affine(comparison, domain):
    """Over conv{...} the vertices are enough where the matrix is affine in the variable. A value
    of the variable with Affine elements raises Unsupported where it is not."""
    if domain.intervals or len(domain.hulls) > 1:
        raise Unsupported("a polytope beside another polytope or an interval")
    for name, values in domain.hulls:
        shape = values[0]
        symbols = [[Affine({1 + i * shape.cols + j: Fraction(1)}) for j in range(shape.cols)]
                   for i in range(shape.rows)]
        inequality(comparison, Scope(domain.scope, {name: Matrix(symbols)}))

# Intervals.

def outward(interval):
    """The ends as fractions; an end that is a ball is moved outward."""
    low = interval.low if is_exact(interval.low) else \
        middle(interval.low) - upper(interval.low - middle(interval.low))
    high = interval.high if is_exact(interval.high) else \
        middle(interval.high) + upper(interval.high - middle(interval.high))
    if low > high: raise Unsupported("an interval whose low end is above its high end")
    return low, high

def on_piece(domain, piece):
    """(scope with Taylor models of the variables on the piece, a number 0 of their space). An
    interval of one point has the value of this point."""
    wide = [k for k, (low, high) in enumerate(piece) if high > low]
    zero = Taylor({}, 0, (len(wide), ORDERS.get(len(wide), 3)))
    values = [low for low, _ in piece]
    for k in wide:
        low, high = piece[k]
        exponent = tuple(int(j == k) for j in wide)
        values[k] = Taylor({zero.origin(): (low + high) / 2, exponent: (high - low) / 2}, 0,
                           zero.space)
    return scope_at(domain, values), zero

def scope_at(domain, values):
    """The scope with these values of the intervals' variables."""
    names = {}
    for interval, x in zip(domain.intervals, values):
        names.setdefault(interval.name, []).append(x)
    scalar = {i.name for i in domain.intervals if i.index is None}
    return Scope(domain.scope, {n: number(v[0]) if n in scalar else column(v)
                                for n, v in names.items()})

def prove_for_all(name, comparison, domain):
    """The box is halved until each piece is proved. Where the middle of a piece may fail, the
    matrix there is judged."""
    whole = [outward(x) for x in domain.intervals]
    lengths = [(high - low) or 1 for low, high in whole]
    todo, pieces = [whole], 0
    text = ", ".join("%s in [%s, %s]" % (title(i), short(a), short(b))
                     for i, (a, b) in zip(domain.intervals, whole))
    while todo:
        piece = todo.pop()
        pieces += 1
        scope, zero = on_piece(domain, piece)
        why, a = "a margin that is too small", None
        try:
            a = inequality(comparison, scope)
            a = a.map(lambda x: x if isinstance(x, Taylor) else zero.lift(x))
            constant = all(not any(e) for x in flat(a) for e in x.terms) and \
                not any(x.rest for x in flat(a))
            if constant: return judge(name, comparison, a.map(lambda x: x.constant()), {})
            if is_positive_on_box(a): continue
            suspicious = not is_positive(a.map(lambda x: x.constant()))
        except Undecided as error:
            suspicious, why = True, str(error)
        if suspicious or pieces == 1:
            found = refutation(name, comparison, domain, piece, pieces == 1)
            if found: return found
        k = longest_side(piece, lengths, a)
        low, high = piece[k]
        if high - low <= SMALLEST_PIECE * lengths[k]:
            at = ", ".join("%s = %s" % (title(i), short(x[0]))
                           for i, x in zip(domain.intervals, piece))
            return claim(name, "open", "%s at %s" % (why, at), pieces)
        half = (low + high) / 2
        todo += [piece[:k] + [(half, high)] + piece[k + 1:],
                 piece[:k] + [(low, half)] + piece[k + 1:]]
    return claim(name, "proved", "all " + text, pieces)

def longest_side(piece, lengths, a):
    """The side to halve: that of the variable whose powers from 2 on are largest in a, since
    Bernstein coefficients are exact for the others; without such, the relatively longest side."""
    sides = [(high - low) / length for (low, high), length in zip(piece, lengths)]
    wide = [k for k, side in enumerate(sides) if side > 0]
    scores = dict.fromkeys(wide, Fraction(0))
    if a is not None and len(wide) > 1:
        scale = [upper(a[i, i]) + Fraction(1, ONE) for i in range(a.rows)]
        for i in range(a.rows):
            for j in range(i + 1):
                for e, c in a[i, j].terms.items():
                    for k, power in zip(wide, e):
                        if power > 1: scores[k] += upper(c) ** 2 / (scale[i] * scale[j])
    shortest = max(sides) / 1000
    return max(wide, key=lambda k: (scores[k] if sides[k] > shortest else 0, sides[k]))

def title(interval):
    return interval.name if interval.index is None else "%s_%d" % (interval.name,
                                                                   interval.index + 1)

def refutation(name, comparison, domain, piece, corners):
    """The claim refuted at the middle (or a corner) of a piece, or None."""
    points = [[(low + high) / 2 for low, high in piece]]
    points += [list(p) for p in product(*piece)] if corners and len(piece) <= 3 else []
    for point in points:
        try:
            inside = all(sign(x - i.low) >= 0 and sign(i.high - x) >= 0
                         for x, i in zip(point, domain.intervals))
            if not inside: continue
            at = {title(i): x for i, x in zip(domain.intervals, point)}
            found = judge(name, comparison, inequality(comparison, scope_at(domain, point)), at)
            if found.result == "refuted": return found
        except Undecided:
            pass
    return None

# Gains.

Gain = namedtuple("Gain", "name ulps how")      # ulps: None where the formula has no value here

def gain_names(statement):
    """[(name in the file, text of its formula, scope, argument or None)] of all gains."""
    for head, text in section(statement.method, "gains").items():
        name, calls = head.split("(")[0].strip(), re.findall(r"\(([^()]*)\)", head)
        arguments = [c.strip() for c in calls if " in " not in c]
        members = [((), statement.scope)]
        for indices in [c for c in calls if " in " in c]:
            members = statement.index_keys(indices.split(","))
        for key, scope in members:
            yield ("_".join(map(str, (name,) + key)), text, scope,
                   arguments[0] if arguments else None)

def printed_parts(gain, name):
    """The decimals of a gain: [its matrix], or its coefficients if it is a polynomial. A gain
    that is given by its formula has none."""
    if name in gain["gains"]: return [matrix_of_json(gain["gains"][name], name)]
    function = gain.get("gain_functions", {}).get(name, {})
    return [matrix_of_json(c, name) for c in function.get("coefficients", [])]

def compare_gains(statement):
    """|formula - printed| in units of the last place of the largest element of each gain. The
    polynomials of degree d are compared at the d + 1 points 0, ..., d."""
    for name, text, scope, argument in gain_names(statement):
        try:
            parts, worst = printed_parts(statement.gain, name), Fraction(0)
            for t in range(len(parts)):
                value = matrix(parse(text), Scope(scope, {argument: number(Fraction(t))}))
                decimals = parts[0]
                for k, part in enumerate(parts[1:]):
                    decimals = decimals + part.map(lambda x: x * Fraction(t) ** (k + 1))
                worst = max(worst, distance(value, decimals))
                if not argument: statement.scope.names.setdefault(name, value)
            if parts: yield Gain(name, worst, "")
        except NOT_EVALUATED as error:
            yield Gain(name, None, reason(error))

def distance(value, decimals):
    """The largest difference of two matrices in units of the last place of the second."""
    if decimals.shape() != value.shape() and decimals.cols == 1: decimals = decimals.transposed()
    if 0 in value.shape(): return Fraction(0)
    if value.flexible: raise Unsupported("a gain without a size")
    if decimals.shape() != value.shape(): return Fraction(10 ** 9)
    largest = max([abs(x) for x in flat(decimals)] + [Fraction(1, 10 ** 300)])
    return max(upper(ball(x)) for x in flat(value - decimals)) / unit_in_last_place(largest)

def unit_in_last_place(x):
    """2^(e - 52) with 2^e <= x < 2^(e + 1)."""
    e = x.numerator.bit_length() - x.denominator.bit_length()
    e = e if Fraction(2) ** e <= x else e - 1
    return Fraction(2) ** (e - 52)

def replaced_unknowns(statement):
    """{Y: (P, K, left)} of the gains K = inv(P)*Y (left) and K = Y*inv(P)."""
    found = {}
    for name, text, scope, _ in gain_names(statement):
        try:
            tree = parse(text)
        except NOT_EVALUATED:
            continue
        if tree[0] != "*" or name not in statement.gain["gains"]: continue
        for a, b, left in ((tree[1], tree[2], True), (tree[2], tree[1], False)):
            if a[:2] == ("call", ("name", "inv")):
                p, y = member(a[2][0], scope), member(b, scope)
                known = statement.gain["unknowns"]
                if p in known and y in known and p != y and y not in found:
                    found[y] = (p, name, left)
    return found

def member(tree, scope):
    """The name in the file of an unknown, or of a member P(i) of a family."""
    if tree[0] == "name": return tree[1]
    if tree[0] == "call" and tree[1][0] == "name":
        try:
            return "_".join([tree[1][1]] + [str(matrix(x, scope).whole()) for x in tree[2]])
        except NOT_EVALUATED:
            return ""
    return ""

def values_with_gains(gain, found):
    """unknown_value of the file, but Y = P*K (or K*P) with K as it is printed."""
    of_file = values_of_file(gain)

    def value(name, rows, cols, kind):
        if name not in found: return of_file(name, rows, cols, kind)
        p_name, k_name, left = found[name]
        size = rows if left else cols
        p = matrix_of_json(gain["unknowns"][p_name], p_name)
        k = matrix_of_json(gain["gains"][k_name], k_name)
        if k.shape() != (rows, cols) and k.cols == 1: k = k.transposed()
        if p.shape() != (size, size) or k.shape() != (rows, cols) or kind != "full":
            raise Unsupported("the printed gain " + k_name)
        return p * k if left else k * p
    return value

def prove_yes(gain, claims=None):
    """(claims, gains, the gains at whose printed values all claims are proved again). The claims
    are appended to the given list, which so holds what was found when the time ran out."""
    statement, claims = Statement(gain, values_of_file(gain)), [] if claims is None else claims
    claims.extend(prove_requirements(statement))
    try:
        gains, found = list(compare_gains(statement)), replaced_unknowns(statement)
    except NOT_EVALUATED as error:
        gains, found = [Gain("all gains", None, reason(error))], {}
    at_gains = []
    if found and claims and all(c.result == "proved" for c in claims):
        again = Statement(gain, values_with_gains(gain, found))
        if all(c.result == "proved" for c in prove_requirements(again)):
            at_gains = sorted({k for _, k, _ in found.values()})
    return claims, gains, at_gains
