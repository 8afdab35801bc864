"""Multipliers for a no on the boundary: Y_k = c_k z_k z_k* at an eigenvalue l of a matrix.

Feasibility may hang on an eigenvalue on the wrong side, as with an unstable A and P > 0,
He(P*A) < 0. Then every multiplier is singular. With A w = l w and m the conjugate of l,

    w*(-He(P A))w + (l + m) w*P w = 0      for every P,

so that w w* and (l + m) w w* are multipliers of both inequalities if l + m >= 0. The eigenvector
is a polynomial in l with rational coefficients. So are the weights c_k, in l and m. All equations
are checked in the ring Q[l, m]/(p(l), p(m)), where p(l) = 0: with fractions only. What remains are
signs at the root, which is isolated by a disk.
"""

from fractions import Fraction
from itertools import product

from arithmetic import Ball, Undecided, affine_terms, ball, is_exact, sign
from language import Family
from matrices import Matrix, column, exactly, identity, null_space
from statement import NOT_EVALUATED

LARGEST = 8         # rows of a matrix whose eigenvalues are tried
STRICT = ("<", ">")
L, M = (1, 0), (0, 1)       # the exponents of l and m
WEIGHTS = [[{(0, 0): Fraction(1)}],
           [{(0, 0): Fraction(1)}, {L: Fraction(1), M: Fraction(1)}],
           [{(0, 0): Fraction(1)}, {(1, 1): Fraction(1)}],
           [{(0, 0): Fraction(1)}, {L: Fraction(1), M: Fraction(1)}, {(1, 1): Fraction(1)}]]

# Polynomials in l and m: {(power of l, power of m): coefficient}.

def plus(a, b):
    result = dict(a)
    for e, c in b.items(): result[e] = result.get(e, Fraction(0)) + c
    return {e: c for e, c in result.items() if c != 0}

def times(a, b, p):
    """a*b reduced by p(l) = p(m) = 0; p = [p_0, ..., p_(n-1), 1]."""
    result = {}
    for (i, j), x in a.items():
        for (k, q), y in b.items():
            result[i + k, j + q] = result.get((i + k, j + q), Fraction(0)) + x * y
    n = len(p) - 1
    for side in (0, 1):
        for power in range(2 * n, n - 1, -1):
            for e in [e for e in result if e[side] == power]:
                c = result.pop(e)
                for t in range(n):
                    to = (power - n + t, e[1]) if side == 0 else (e[0], power - n + t)
                    result[to] = result.get(to, Fraction(0)) - c * p[t]
    return {e: c for e, c in result.items() if c != 0}

def conjugate(a): return {(j, i): c for (i, j), c in a.items()}

def eigenvector(a, start):
    """(p, w): the monic p of least degree with p(A) b = 0, and w(l) = (p(l) - p(A))/(l - A) b.

    (l - A) w(l) = p(l) b. So w(l) is an eigenvector at each root l of p. It is not 0, since its
    coefficients are combinations of b, A b, ..., of which the leading one is b.
    """
    powers = [start]
    while True:
        joined = Matrix([list(row) for row in zip(*[[x for r in v.elements for x in r]
                                                    for v in powers])])
        kernel = null_space(joined)
        if kernel.cols: break
        powers.append(a * powers[-1])
    n = len(powers) - 1
    p = [kernel[i, 0] / kernel[n, 0] for i in range(n + 1)]
    w = [{} for _ in range(a.rows)]
    for k in range(n):              # the coefficient of l^k is sum_(j > k) p_j A^(j-k-1) b
        for j in range(k + 1, n + 1):
            for i in range(a.rows):
                c = p[j] * powers[j - k - 1][i, 0]
                if c != 0: w[i] = plus(w[i], {(k, 0): c})
    return p, w

# Roots.

def roots(p):
    """Disks (re, im) of balls, each with exactly one root of p. Multiple roots have none."""
    d1 = [k * c for k, c in enumerate(p)][1:]
    d2 = [k * c for k, c in enumerate(d1)][1:]
    for guess in float_roots([float(c) for c in p]):
        re, im = Fraction(guess.real), Fraction(guess.imag)
        im = Fraction(0) if abs(im) < 1e-9 * (1 + abs(re)) else im
        for _ in range(8):          # Newton, rounded
            f, g = complex_value(p, re, im), complex_value(d1, re, im)
            size = g[0] ** 2 + g[1] ** 2
            if size == 0: break
            re -= (f[0] * g[0] + f[1] * g[1]) / size
            im -= (f[1] * g[0] - f[0] * g[1]) / size
            re, im = (Fraction(round(x * 2 ** 250), 2 ** 250) for x in (re, im))
        h = Fraction(1, 2 ** 200)
        if is_root_disk(p, d1, d2, re, im, h):
            wide = ball(h).size()
            yield Ball(ball(re).m, wide), Ball(ball(im).m, wide if im else 0)

def is_root_disk(p, d1, d2, re, im, h):
    """Rouche: |p| + M h^2/2 < |p'| h at the centre, M >= |p''| on the disk of radius h <= 1.

    If the centre is real, the disk is its own mirror image, so that its only root is real."""
    f, g = complex_value(p, re, im), complex_value(d1, re, im)
    reach = abs(re) + abs(im) + 1
    bound = sum(abs(c) * reach ** k for k, c in enumerate(d2))
    return abs(f[0]) + abs(f[1]) + bound * h * h / 2 < max(abs(g[0]), abs(g[1])) * h

def complex_value(p, re, im):
    a, b = re * 0, re * 0
    for c in reversed(p): a, b = a * re - b * im + c, a * im + b * re
    return a, b

def float_roots(p):
    """Roots in floating point (Durand and Kerner): only a guess."""
    n = len(p) - 1
    size = 1 + max((abs(c) for c in p[:-1]), default=0)
    z = [(0.4 + 0.9j) ** k * min(size, 1e3) ** (k / n) for k in range(1, n + 1)]
    for _ in range(300):
        for i in range(n):
            value, quotient = 0, 1
            for c in reversed(p): value = value * z[i] + c
            for j in range(n): quotient *= (z[i] - z[j]) if i != j else 1
            z[i] -= value / quotient if quotient else 0
    return [x for x in z if abs(x) < 1e300]

def value_at(a, re, im):
    """(real, imaginary) part of a polynomial in l and m at l = re + i im."""
    degree = max((max(e) for e in a), default=0)
    powers = [(ball(Fraction(1)), Ball(0))]
    for _ in range(degree):
        x, y = powers[-1]
        powers.append((x * re - y * im, x * im + y * re))
    real, imaginary = Ball(0), Ball(0)
    for (i, j), c in a.items():
        (x, y), (u, v) = powers[i], powers[j]       # l^i, and m^j = u - i v
        real, imaginary = real + (x * u + y * v) * c, imaginary + (y * u - x * v) * c
    return real, imaginary

# The search.

def prove_algebraic(statement, blocks):
    """A text that says by which eigenvalue there is no solution, or None."""
    blocks = [b for b in blocks if b.sign != "==" and all(
        is_exact(c) for row in b.matrix.elements for x in row for c in affine_terms(x).values())]
    matrices, scalars = rational_values(statement)
    for name, a in with_shifts(matrices, scalars):
        for start in starts(a, [m for _, m in matrices]):
            p, w = eigenvector(a, start)
            for form in forms(blocks, a.rows, w, p):
                for basis in WEIGHTS:
                    if certifies(blocks, form, basis, p):
                        return "an eigenvalue of %s, exactly" % name
    return None

def rational_values(statement):
    """([(name, matrix)], [(name, scalar)]) of the data and definitions that are fractions."""
    matrices, scalars = [], []
    for name in list(statement.scope.names):
        if name in statement.unknowns: continue
        try:
            value = statement.scope.find(name)
        except NOT_EVALUATED:
            continue
        for x in value.values() if isinstance(value, Family) else [value]:
            if isinstance(x, Matrix) and not x.flexible and 0 not in x.shape() and exactly(x):
                if x.is_number() and name not in statement.method.get("data", {}): continue
                (scalars if x.is_number() else matrices).append((name, x))
    return matrices + [s for s in scalars if s[0] not in ("n", "m", "p")], scalars

def with_shifts(matrices, scalars):
    """(name, A) of the square matrices and their transposes; then (A - c I)/r for scalars c, r."""
    square = [(n, a) for n, a in matrices if a.rows == a.cols <= LARGEST]
    square += [(n + "'", a.transposed()) for n, a in square if a.rows > 1]
    yield from square
    for (n, a), (c, x), (r, y) in product(square, scalars, scalars):
        if c != r and y.number() != 0 and a.rows > 1:
            shifted = (a - identity(a.rows, x.number())).map(lambda z: z / y.number())
            yield "(%s - %s*I)/%s" % (n, c, r), shifted

def starts(a, others):
    """Vectors b: the unit vectors; and a basis of each kernel of [C; C A; ...], C a matrix."""
    n, seen = a.rows, set()
    for j in range(n): yield column([Fraction(int(i == j)) for i in range(n)])
    for c in [m for m in others if m.cols == n] + [m.transposed() for m in others if m.rows == n]:
        parts = [c]
        for _ in range(n - 1): parts.append(parts[-1] * a)
        kernel = null_space(Matrix([row for part in parts for row in part.elements]))
        for j in range(kernel.cols):
            vector = tuple(kernel[i, j] for i in range(n))
            if vector not in seen:
                seen.add(vector)
                yield column(list(vector))

def forms(blocks, n, w, p):
    """For each block a vector z: w, or [x w; y w] with x, y among 1, +-l, +-m; else None."""
    double = [[None]]
    if any(b.matrix.rows == 2 * n for b in blocks):
        one = {(0, 0): Fraction(1)}
        factors = [{e: Fraction(s)} for e in (L, M) for s in (1, -1)]
        double = [pair for f in factors for pair in ((one, f), (f, one))]
    for pair in double:
        result = []
        for block in blocks:
            if block.matrix.rows == n: result.append(w)
            elif block.matrix.rows == 2 * n and pair != [None]:
                result.append([times(x, y, p) for x in pair for y in w])
            else: result.append(None)
        yield result

def quadratic(block, z, p):
    """{i: z* B_i z} of a block, polynomials in l and m."""
    result = {}
    for a in range(block.matrix.rows):
        for b in range(block.matrix.rows):
            terms = affine_terms(block.matrix[a, b])
            if terms and z[a] and z[b]:
                both = times(conjugate(z[a]), z[b], p)
                for i, c in terms.items():
                    result[i] = plus(result.get(i, {}), {e: c * x for e, x in both.items()})
    return result

def certifies(blocks, form, basis, p):
    """Whether weights c_k in the span of `basis` make c_k z_k z_k* multipliers at a root of p."""
    used = [k for k, z in enumerate(form) if z is not None]
    places, terms = [], []              # one column for each weight of each block
    for k in used:
        parts = quadratic(blocks[k], form[k], p)
        for weight in basis:
            places.append((k, weight))
            terms.append({i: times(weight, x, p) for i, x in parts.items()})
    keys = sorted({(i, e) for t in terms for i, x in t.items() if i for e in x})
    if not places or not keys: return False
    system = Matrix([[t.get(i, {}).get(e, Fraction(0)) for t in terms] for i, e in keys])
    solutions = null_space(system)
    for j in range(solutions.cols):
        for s in (1, -1):
            weights, constant = {}, {}
            for q, (k, weight) in enumerate(places):
                factor = s * solutions[q, j]
                weights[k] = plus(weights.get(k, {}), {e: factor * c for e, c in weight.items()})
                constant = plus(constant, {e: factor * c for e, c in terms[q].get(0, {}).items()})
            if any(excludes(blocks, form, weights, constant, root) for root in roots(p)):
                return True
    return False

def excludes(blocks, form, weights, constant, root):
    """The signs: c_k >= 0; the constant part < 0, or exactly 0 with c_k > 0 and z_k not 0 for a
    strict inequality."""
    strict = False
    try:
        for k, weight in weights.items():
            if weight:
                if sign(value_at(weight, *root)[0]) < 0: return False
                strict = strict or blocks[k].sign in STRICT and is_nonzero(form[k], root)
        return sign(value_at(constant, *root)[0]) < 0 if constant else strict
    except Undecided:
        return False

def is_nonzero(z, root):
    parts = [x for entry in z if entry for x in value_at(entry, *root)]
    return any(abs(x.m) > x.r for x in parts)
