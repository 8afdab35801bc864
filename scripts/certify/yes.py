"""The proof of a yes: every comparison of every requirement, at the decimals of the file."""
import math, re
from collections import namedtuple
from decimal import Context, Decimal
from fractions import Fraction
from functools import reduce
from itertools import product
from operator import add
from arithmetic import (Affine, Ball, Taylor, Undecided, Unsupported, ball, is_zero, middle, sign,
                        upper)
from language import Scope, decimal, matrix, parse
from matrices import (POSITIVE, SEMIDEFINITE, classify, column, exactly, filled, flat, is_positive,
                      is_positive_on_box, number, witness)
from squares import prove_squares, squares_of
from statement import (NOT_EVALUATED, Comparison, Statement, checked, inequality, matrix_of_json,
                       refuse, section, values_of_file)
# result: proved, refuted or open. `how` says by what it was proved, or why it is open.
Claim = namedtuple("Claim", "name result how pieces point vector", defaults=(0, {}, []))
Gain = namedtuple("Gain", "name ulps how")      # ulps: None where the formula has no value here
ORDERS = {1: 9}     # of Taylor models, by the number of variables; else 5
SMALLEST_PIECE = Fraction(1, 10 ** 12)      # of the interval
def ten_digits(x, rounding):
    return str(Context(10, rounding).divide(Decimal(x.numerator), Decimal(x.denominator)))
def cases(statement):
    """(name, comparison, domain) of each comparison and each finite choice of its forall."""
    for label, comparison in statement.comparisons():
        squares = squares_of(statement.gain, label)
        for k, domain in enumerate([None] if isinstance(comparison, Exception)
                                   else comparison.domains):
            if k < len(squares): comparison = comparison._replace(squares=squares[k])
            yield label + label_of(domain.choices if domain else ()), comparison, domain
def prove_requirements(statement, hull, at_both):
    """A claim for each case. Those over intervals are tried with the unknowns of `hull` first, with
    those of the file and of the printed gains in balls: their names join `at_both`."""
    near = "solution_within" in statement.gain
    for case, wide in zip(cases(statement), cases(hull or statement)):
        claim = prove(*wide, near, True) if hull and wide[2] and wide[2].intervals else None
        if claim and claim.result == "proved": at_both.add(claim.name)
        else: claim = prove(*case, near)
        yield claim._replace(result="open") if near and claim.result == "refuted" else claim
def reason(error):
    kinds = {Undecided: "not decided: ", Unsupported: "not known to certify: "}
    known = "not evaluated: %s " % type(error).__name__
    return kinds.get(type(error), known) + str(error)
def label_of(choices):
    texts = ["%s = %s" % (name, short(value.number())) if value.is_number()
             else "%s = element %d" % (name, k) for name, k, value in choices]
    return " at " + ", ".join(texts) if texts else ""
def short(x): return "%.6g" % float(middle(x)) if upper(x) < 10 ** 300 else "a large number"
def prove(name, comparison, domain, near, only_ordinary=False):
    try:
        if isinstance(comparison, Exception): raise comparison
        if domain.intervals and comparison.squares:
            fault = prove_squares(comparison, domain, comparison.squares)
            return Claim(name, "open" if fault else "proved", fault or "squares")
        if any(i.low is None for i in domain.intervals): refuse("an inequality without squares")
        if domain.hulls: check_affine(comparison, domain)
        if comparison.sign == "==": return prove_equation(name, comparison, domain, near)
        if domain.intervals: return prove_for_all(name, comparison, domain, only_ordinary)
        return judge(name, comparison, inequality(comparison, domain.scope))
    except NOT_EVALUATED as error: return Claim(name, "open", reason(error))
def judge(name, comparison, a, point={}):
    """One symmetric matrix: a > 0 or a >= 0."""
    strict, found = comparison.sign in ("<", ">"), classify(a)
    if found == POSITIVE or found == SEMIDEFINITE and not strict:
        return Claim(name, "proved", "fractions" if exactly(a) else "balls")
    vector = witness(a, strict)
    if vector: return Claim(name, "refuted", "a vector", 0, point, vector)
    return Claim(name, "open", "the matrix is not shown to be definite")
def prove_equation(name, comparison, domain, near):
    """Both sides are the same fractions; over intervals, the same polynomials of fractions. With
    `solution_within` (near) the file does not say that its decimals satisfy the equations."""
    scope = domain.scope
    if domain.intervals: scope, _ = on_piece(domain, [outward(x) for x in domain.intervals])
    difference = inequality(comparison, scope)
    terms = [c for x in flat(difference)
             for c in ([*x.terms.values(), x.rest] if isinstance(x, Taylor) else [x])]
    if all(is_zero(c) for c in terms): return Claim(name, "proved", "fractions")
    decided = not domain.intervals and exactly(difference) and not near
    return Claim(name, "refuted" if decided else "open", "an equation that does not hold exactly")
def check_affine(comparison, domain):
    """Over conv{...} the vertices are enough where the matrix is affine in the variable. A value of
    the variable with Affine elements raises Unsupported where it is not."""
    if domain.intervals or len(domain.hulls) > 1:
        raise Unsupported("a polytope beside another polytope or an interval")
    (name, values), = domain.hulls
    rows, cols = values[0].shape()
    if any(x.shape() != (rows, cols) for x in values): refuse("elements of several shapes")
    symbols = filled(rows, cols, lambda i, j: Affine({1 + i * cols + j: Fraction(1)}))
    inequality(comparison, Scope(domain.scope, {name: symbols}))
# Intervals.
def outward(span):
    """The ends as fractions; an end that is a ball is moved outward."""
    low, high = [middle(x) + s * upper(x - middle(x)) for s, x in ((-1, span.low), (1, span.high))]
    if low > high or sign(span.high - span.low) < 0: refuse("an interval that is empty")
    return low, high
def is_outside(interval, x): return sign(x - interval.low) < 0 or sign(interval.high - x) < 0
def on_piece(domain, piece):
    """(scope with Taylor models of the variables on the piece, a number 0 of their space). An
    interval of one point has the value of this point."""
    wide = [k for k, (low, high) in enumerate(piece) if high > low]
    zero = Taylor({}, 0, (len(wide), ORDERS.get(len(wide), 5)))
    values = [zero.like({zero.origin(): (low + high) / 2, tuple(int(j == k) for j in wide):
                         (high - low) / 2}) if k in wide else low
              for k, (low, high) in enumerate(piece)]
    return scope_at(domain, values), zero
def scope_at(domain, values):
    """The scope with these values of the intervals' variables."""
    names = {}
    for i, x in zip(domain.intervals, values):
        before = [] if not i.index else flat(names[i.name])
        names[i.name] = number(x) if i.index is None else column(before + [x])
    return Scope(domain.scope, names)
def prove_for_all(name, comparison, domain, only_ordinary):
    """The box is halved until each piece is proved. Where the middle of a piece may fail, the
    matrix there is judged, or (only_ordinary) nothing is proved."""
    whole = [outward(x) for x in domain.intervals]
    lengths = [(high - low) or 1 for low, high in whole]
    titles, todo, pieces = [i.title for i in domain.intervals], [whole], 0
    while todo:
        piece = todo.pop()
        pieces += 1
        scope, zero = on_piece(domain, piece)
        why, a = "a margin that is too small", None
        try:
            a = inequality(comparison, scope)
            a = a.map(lambda x: x if isinstance(x, Taylor) else zero.lift(x))
            if all(x.is_constant() for x in flat(a)):
                found = judge(name, comparison, a.map(lambda x: x.constant()))
                if found.result != "proved" or piece == whole: return found
                continue
            if is_positive_on_box(a): continue
            suspicious = not is_positive(a.map(lambda x: x.constant()))
        except Undecided as error: suspicious, why = True, str(error)
        if a and suspicious and only_ordinary: return Claim(name, "open", why)
        if (suspicious or pieces == 1) and not only_ordinary:
            found = refutation(name, comparison, domain, piece, pieces == 1)
            if found: return found
        k = longest_side(piece, lengths, a)
        low, high = piece[k]
        if high - low <= SMALLEST_PIECE * lengths[k]:
            at = ", ".join("%s = %s" % (t, short(x)) for t, (x, _) in zip(titles, piece))
            return Claim(name, "open", "%s at %s" % (why, at), pieces)
        half = (low + high) / 2
        todo += [piece[:k] + [part] + piece[k + 1:] for part in ((half, high), (low, half))]
    texts = ["%s in [%s, %s]" % (t, short(x), short(y)) for t, (x, y) in zip(titles, whole)]
    return Claim(name, "proved", "all " + ", ".join(texts), pieces)
def longest_side(piece, lengths, a):
    """The side to halve: that of the variable whose powers from 2 on are largest in a, since
    Bernstein coefficients are exact for the others; without such, the relatively longest side."""
    sides = [(high - low) / length for (low, high), length in zip(piece, lengths)]
    wide = [k for k, side in enumerate(sides) if side > 0]
    scores = dict.fromkeys(wide, 0)
    for i, j in product(range(a.rows), repeat=2) if a and len(wide) > 1 else ():
        scale = (upper(a[i, i]) + SMALLEST_PIECE ** 8) * (upper(a[j, j]) + SMALLEST_PIECE ** 8)
        for e, c in a[i, j].terms.items():
            for k, power in zip(wide, e): scores[k] += upper(c) ** 2 / scale if power > 1 else 0
    return max(wide, key=lambda k: (scores[k] if sides[k] > max(sides) / 1000 else 0, sides[k]))
def refutation(name, comparison, domain, piece, corners):
    """The claim refuted at the middle (or a corner) of a piece, or None."""
    points = [[(low + high) / 2 for low, high in piece]]
    points += list(product(*piece)) if corners and len(piece) <= 3 else []
    for point in points:
        try:
            if any(map(is_outside, domain.intervals, point)): continue
            at = {i.title: x for i, x in zip(domain.intervals, point)}
            found = judge(name, comparison, inequality(comparison, scope_at(domain, point)), at)
            if found.result == "refuted": return found
        except Undecided: pass
    return None
# Gains.
def gains_of(statement):
    """(name in the file, text of its formula, scope, argument or None) of all gains."""
    for head, text in section(statement.method, "gains").items():
        name, calls = head.split("(")[0].strip(), re.findall(r"\(([^()]*)\)", head)
        arguments = [c.strip() for c in calls if " in " not in c]
        indices = [c.split(",") for c in calls if " in " in c]
        members = statement.members(indices[-1]) if indices else [((), statement.scope)]
        for key, scope in members:
            yield "_".join(map(str, (name, *key))), text, scope, arguments[0] if arguments else None
def compare_gains(statement):
    """|formula - printed| in units of the last place of the largest element of each gain. A gain
    that is a polynomial with d + 1 coefficients is compared at the points 0, ..., d and 30 more, as
    its formula may have a higher degree. One that is given by its formula has no decimals."""
    for name, text, scope, argument in gains_of(statement):
        try:
            entry = statement.gain.get("gain_functions", {}).get(name, {})
            parts = entry.get("coefficients", [])
            if name in statement.gain["gains"]: parts = [statement.gain["gains"][name]]
            same = entry.get("formula", text).split() == text.split()
            parts = [matrix_of_json(x, name) for x in parts]
            worst = Fraction(0 if same else 10 ** 9)
            for t in map(Fraction, range(len(parts) + 30 * bool(argument and parts))):
                value = matrix(parse(text), Scope(scope, {argument: number(t)}))
                decimals = reduce(add, [part * number(t ** k) for k, part in enumerate(parts)])
                worst = max(worst, distance(value, decimals))
                if not argument: statement.scope.names.setdefault(name, value)
            if parts or not same: yield Gain(name, worst, "")
        except NOT_EVALUATED as error: yield Gain(name, None, reason(error))
def distance(value, decimals):
    """The largest difference of two matrices in units of the last place of the second."""
    if value.flexible: raise Unsupported("a gain without a size")
    if decimals.shape() != value.shape() and decimals.cols == 1: decimals = decimals.transposed()
    if 0 in value.shape(): return Fraction(0)
    if decimals.shape() != value.shape(): return Fraction(10 ** 9)
    largest = max([abs(x) for x in flat(decimals)] + [Fraction(1, 10 ** 300)])
    return max(upper(ball(x)) for x in flat(value - decimals)) / Fraction(math.ulp(float(largest)))
def replaced_unknowns(statement):
    """{Y: (P, K, left)} of the gains K = inv(P)*Y (left) and K = Y*inv(P)."""
    found, known = {}, statement.gain["unknowns"]
    for name, text, scope, _ in gains_of(statement):
        try:
            tree = parse(text)
            if tree[0] != "*" or name not in statement.gain["gains"]: continue
            for a, b, left in ((*tree[1:], True), (*tree[:0:-1], False)):
                if a[:2] == ("call", ("name", "inv")):
                    p, y = member(a[2][0], scope), member(b, scope)
                    if p in known and y in known and p != y: found.setdefault(y, (p, name, left))
        except NOT_EVALUATED: pass
    return found
def member(tree, scope):
    """The name in the file of an unknown, or of a member P(i) of a family."""
    if tree[0] == "name": return tree[1]
    if tree[0] != "call" or tree[1][0] != "name": return ""
    return "_".join([tree[1][1]] + [str(matrix(x, scope).whole()) for x in tree[2]])
def values_with_gains(gain, found, hull):
    """unknown_value of the file, but Y = P*K (or K*P) with K as it is printed; with `hull`, a ball
    with both."""
    def value(name, rows, cols, kind):
        stated = values_of_file(gain)(name, rows, cols, kind)
        if name not in found: return stated
        p_name, k_name, left = found[name]
        size = rows if left else cols
        p = checked(gain["unknowns"], p_name, size, size)
        k = checked(gain["gains"], k_name, rows, cols)
        if kind != "full": raise Unsupported("the printed gain " + k_name)
        product = p * k if left else k * p
        if not hull: return product
        return stated + (product - stated).map(lambda x: Ball(0, ball(x).size()))
    return value
def prove_objective(gain):
    """The claim that the objective at the unknowns is at most the one of the file, rounded."""
    stated = decimal(str(gain["objective"]))
    limit = stated + abs(stated) / 10 ** 12 + Fraction(1, 10 ** 30)
    name = "objective <= " + ten_digits(limit, "ROUND_CEILING")
    try:
        statement = Statement(gain, values_of_file(gain))
        text = statement.method.get("minimize") or refuse("the objective of another problem")
        found = Comparison(parse(text), "<=", ("number", limit), [])
        return judge(name, found, inequality(found, statement.scope))
    except NOT_EVALUATED as error: return Claim(name, "open", reason(error))
def prove_yes(gain, claims=None):
    """(claims, gains, the gains at whose printed values all claims are proved again). The claims
    are appended to the given list, which so holds what was found when the time ran out."""
    statement, claims = Statement(gain, values_of_file(gain)), [] if claims is None else claims
    try: gains, found = list(compare_gains(statement)), replaced_unknowns(statement)
    except NOT_EVALUATED as error: gains, found = [Gain("all gains", None, reason(error))], {}
    at_both, at_gains = set(), []
    hull = Statement(gain, values_with_gains(gain, found, True)) if found else None
    claims.extend(prove_requirements(statement, hull, at_both))
    if found and claims and all(c.result == "proved" for c in claims):
        exact = cases(Statement(gain, values_with_gains(gain, found, False)))
        again = (prove(*case, False) for case in exact if case[0] not in at_both)
        if all(c.result == "proved" for c in again):
            at_gains = sorted({k for _, k, _ in found.values()})
    return claims, gains, at_gains
