"""Proofs that symmetric matrices are definite, and vectors that show that they are not."""

from fractions import Fraction
from itertools import product
from math import comb

from arithmetic import (ONE, Ball, Undecided, ball, function, inverse, is_exact, middle, sign,
                        upper)
from matrices import dot, exactly, flat, identity

POSITIVE, SEMIDEFINITE, UNKNOWN, NEGATIVE = "positive", "semidefinite", "unknown", "negative"

def classify(a):
    """What is proved of the symmetric matrix a: POSITIVE (definite), SEMIDEFINITE and singular,
    NEGATIVE (v'av < 0 for some v), or UNKNOWN. Fractions decide always."""
    if exactly(a): return classify_fractions(a)
    return POSITIVE if is_positive(a) else UNKNOWN

def classify_fractions(a):
    """L D L' elimination. A pivot 0 needs a zero column: else v'av < 0 for some v."""
    rows, result = [list(row) for row in a.elements], POSITIVE
    for k in range(a.rows):
        pivot = rows[k][k]
        if pivot < 0 or pivot == 0 and any(rows[i][k] != 0 for i in range(k + 1, a.rows)):
            return NEGATIVE
        if pivot == 0:
            result = SEMIDEFINITE
            continue
        for i in range(k + 1, a.rows):
            if rows[i][k] != 0:
                factor = rows[i][k] / pivot
                for j in range(k + 1, i + 1): rows[i][j] -= factor * rows[j][k]
    return result

def is_positive(a):
    """Whether every symmetric matrix in the matrix of balls a is proved positive definite.

    If the balls are m_ij +- r_ij, then a >= m - diag(sums of the rows of r). This matrix has one
    number at each place, so that the balls of its L D L' elimination stay small.
    """
    n = a.rows
    balls = [[ball(x) for x in row] for row in a.elements]
    rows = [[Ball(balls[i][j].m) for j in range(n)] for i in range(n)]
    for i in range(n):
        rows[i][i] = Ball(rows[i][i].m - sum(max(balls[i][j].r, balls[j][i].r) for j in range(n)))
    for k in range(n):
        if rows[k][k].m <= rows[k][k].r: return False
        factor = inverse(rows[k][k])
        for i in range(k + 1, n):
            if rows[i][k].m or rows[i][k].r:
                f = rows[i][k] * factor
                for j in range(k + 1, i + 1):
                    rows[i][j] = rows[i][j] - f * rows[j][k]
    return True

def witness(a, strict):
    """A vector v of fractions with v'av < 0 (if strict: <= 0 and v not 0), or None.

    The elimination of the middles proposes v; its value is then computed anew.
    """
    found = None
    for v in directions(a.map(middle)):
        try:
            s = sign(dot(v, [dot(row, v) for row in a.elements]))
        except Undecided:
            continue
        if s < 0: return v
        if s == 0 and strict and any(v): found = v
    return found

def directions(a):
    """Vectors v where L D L' elimination meets a pivot d <= 0: v solves L'v = e_k, so v'av = d;
    beside a pivot 0 with an element b in its column, a combination with v'av < 0."""
    n, rows = a.rows, [list(row) for row in a.elements]
    factors = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]     # rows of inv(L)
    for k in range(n):
        pivot = rows[k][k]
        if pivot <= 0:
            yield [rounded(x) for x in factors[k]]
            for i in range(k + 1, n):
                b, c = rows[i][k], rows[i][i]
                if b != 0:
                    step = -(abs(c) + 1) / b        # (step e_k + e_i)' a (...) = 2 step b + c
                    yield [rounded(step * x + y) for x, y in zip(factors[k], factors[i])]
            return
        for i in range(k + 1, n):
            f = rows[i][k] / pivot
            if f != 0:
                rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
                factors[i] = [x - f * y for x, y in zip(factors[i], factors[k])]

def rounded(x, bits=400):
    """x if it is short, else a fraction near it."""
    if x.denominator.bit_length() < bits: return x
    shift = bits + max(0, x.denominator.bit_length() - x.numerator.bit_length())
    return Fraction((x.numerator << shift) // x.denominator, 1 << shift)

# Matrices of Taylor models.

def bernstein_weights(degree):
    """w[i][j] with b_i = sum_j w[i][j] c_j: Bernstein coefficients of sum_j c_j t^j on [-1, 1].

    With t = 2s - 1, t^j = sum_k p_jk s^k and b_i = sum_k C(i, k)/C(K, k) (coefficient of s^k).
    """
    powers = [[comb(j, k) * 2 ** k * (-1) ** (j - k) for k in range(j + 1)]
              for j in range(degree + 1)]
    return [[sum(Fraction(comb(i, k), comb(degree, k)) * powers[j][k]
                 for k in range(min(i, j) + 1)) for j in range(degree + 1)]
            for i in range(degree + 1)]

WEIGHTS = {}

def is_positive_on_box(a):
    """Whether a matrix of Taylor models is proved positive definite for all t in [-1, 1]^k.

    The value at any t is a convex combination of the Bernstein coefficients, plus the rest. So it
    is enough that each coefficient is positive definite with the rest as additional radius.
    """
    exponents = {e for x in flat(a) for e in x.terms}
    degrees = [max(e) for e in zip(*exponents)]
    weights = [WEIGHTS.setdefault(d, bernstein_weights(d)) for d in degrees]
    for place in product(*[range(d + 1) for d in degrees]):
        factor = {}
        for e in exponents:
            factor[e] = Fraction(1)
            for w, i, j in zip(weights, place, e): factor[e] *= w[i][j]
        if classify(a.map(lambda x: bernstein_coefficient(x, factor))) != POSITIVE: return False
    return True

def bernstein_coefficient(x, factor):
    total = Fraction(0)
    for e, c in x.terms.items(): total = total + c * factor[e]
    if x.rest == 0: return total
    total = ball(total)
    return Ball(total.m, total.r + x.rest)

# Norms.

def spectral_norm(a):
    """A ball around the largest singular value of a matrix of fractions and balls.

    g = a'a is squared 40 times; a column of the result is near the first singular vector v. Then
    v'gv/v'v <= norm^2, and norm^2 <= h if h I - g is positive definite, for h a little larger.
    """
    if any(not is_exact(x) and not isinstance(x, Ball) for x in flat(a)):
        raise Undecided("a norm of a matrix that depends on a variable")
    g = a.transposed() * a
    v = leading_vector(g.map(middle))
    if v is None:
        return ball(Fraction(0)) if exactly(a) else Ball(0, sum(ball(x).size() for x in flat(a)))
    quotient = ball(dot(v, [dot(row, v) for row in g.elements])) * (1 / dot(v, v))
    low = Fraction(max(quotient.m - quotient.r, 0), ONE)
    for digits in (60, 40, 25, 15, 9, 5):
        high = upper(quotient) * (1 + Fraction(1, 10 ** digits))
        if classify(identity(g.rows, high) - g) == POSITIVE: break
    else: raise Undecided("a norm")
    m = ball((low + high) / 2)
    return function("sqrt", Ball(m.m, m.r + ball((high - low) / 2).size()))

def leading_vector(g):
    """A vector near the first eigenvector of g >= 0, in whole numbers of 200 bits."""
    for _ in range(40):
        largest = max(abs(x) for x in flat(g))
        if largest == 0: return None
        g = g.map(lambda x: Fraction(int(x / largest * 2 ** 200), 2 ** 200))
        g = g * g
    return max(g.elements, key=lambda row: sum(abs(x) for x in row))
