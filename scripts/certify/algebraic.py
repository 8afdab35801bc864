"""Multipliers for a no on the boundary: Y_k = c_k z_k z_k* at an eigenvalue l of a matrix.

Feasibility may hang on an eigenvalue on the wrong side, as with an unstable A and P > 0,
He(P*A) < 0. Then every multiplier is singular. With A w = l w and m the conjugate of l,

    w*(-He(P A))w + (l + m) w*P w = 0      for every P,

so that w w* and (l + m) w w* are multipliers of both inequalities if l + m >= 0. The eigenvector
is a polynomial in l with rational coefficients: w = W e, e = (1, l, ..., l^(n-1))', where
p(l) = 0 and n is the degree of p. So w*B w = e* (W'B W) e. In the ring Q[l, m]/(p(l), p(m)) a
matrix X stands for e*X e, and for 0 only if X = 0. With the companion matrix C, l e = C e:
times l is X C, and times m is C'X. All equations are checked in this ring, so with fractions only.
What remains are signs at the root, which is isolated by a disk.
"""
from fractions import Fraction
from functools import reduce
from itertools import product
from math import prod
from operator import add, mul
from arithmetic import Ball, Undecided, ball, is_exact, sign
from language import Family, observability
from matrices import Matrix, beside, column, exactly, filled, flat, identity, null_space, zeros
from statement import NOT_EVALUATED

LARGEST = 8         # rows of a matrix whose eigenvalues are tried
STRICT = ("<", ">")
# The weights c_k are combinations of some of 1, l + m, l m: sums of l^i m^j by their (i, j).
POWERS = {"1": [(0, 0)], "l + m": [(1, 0), (0, 1)], "l m": [(1, 1)]}
WEIGHTS = [["1"], ["1", "l + m"], ["1", "l m"], ["1", "l + m", "l m"]]
# The vectors z_k are w, or have two halves s l^i m^j w by their (s, i, j): w, and +-l w or +-m w.
W = (1, 0, 0)
HALVES = [p for h in ((1, 1, 0), (-1, 1, 0), (1, 0, 1), (-1, 0, 1)) for p in ((W, h), (h, W))]

def eigenvector(a, start):
    """(p, W): the monic p of least degree with p(A) b = 0, and w = W e = (p(l) - p(A))/(l - A) b.
    (l - A) w(l) = p(l) b, so w(l) is an eigenvector at each root l of p. It is not 0, since the
    columns of W, the coefficients sum_(j > k) p_j A^(j-k-1) b of l^k, are independent."""
    powers = [start]
    while not (kernel := null_space(beside(powers))).cols: powers.append(a * powers[-1])
    n = len(powers) - 1
    p = [kernel[i, 0] / kernel[n, 0] for i in range(n + 1)]
    return p, beside([sum((powers[j - k - 1].map(lambda x: p[j] * x) for j in range(k + 1, n + 1)),
                          zeros(a.rows, 1)) for k in range(n)])
def companion(p):
    """C with l e = C e for e = (1, l, ..., l^(n-1))'."""
    n = len(p) - 1
    return filled(n, n, lambda i, j: Fraction(int(j == i + 1)) if i < n - 1 else -p[j])

# Roots.
def roots(p):
    """Disks (re, im) of balls, each with exactly one root of p. Multiple roots have none. Rouche:
    the disk of radius h <= 1 has one root if |p| + M h^2/2 < |p'| h at its centre, where M >= |p''|
    on the disk. If the centre is real, the root is real, since the disk is its mirror image."""
    d1 = [k * c for k, c in enumerate(p)][1:]
    d2 = [k * c for k, c in enumerate(d1)][1:]
    h = Fraction(1, 2 ** 200)
    for guess in float_roots([float(c) for c in p]):
        re, im = Fraction(guess.real), Fraction(guess.imag)
        im = Fraction(0) if abs(im) < 1e-9 * (1 + abs(re)) else im
        for _ in range(8):          # Newton, rounded
            f, g = complex_value(p, re, im), complex_value(d1, re, im)
            size = g[0] ** 2 + g[1] ** 2 or 1
            re -= (f[0] * g[0] + f[1] * g[1]) / size
            im -= (f[1] * g[0] - f[0] * g[1]) / size
            re, im = (Fraction(round(x * 2 ** 250), 2 ** 250) for x in (re, im))
        f, g = complex_value(p, re, im), complex_value(d1, re, im)
        bound = sum(abs(c) * (abs(re) + abs(im) + 1) ** k for k, c in enumerate(d2))
        if abs(f[0]) + abs(f[1]) + bound * h * h / 2 < max(abs(g[0]), abs(g[1])) * h:
            wide = ball(h).size()
            yield ball(re).widened(wide), ball(im).widened(wide if im else 0)
def complex_value(p, re, im):
    a, b = re * 0, re * 0
    for c in reversed(p): a, b = a * re - b * im + c, a * im + b * re
    return a, b
def float_roots(p):         # in floating point (Durand and Kerner): only a guess
    n, size = len(p) - 1, 1 + max(map(abs, p[:-1]), default=0)
    z = [(0.4 + 0.9j) ** k * min(size, 1e3) ** (k / n) for k in range(1, n + 1)]
    for _ in range(300):
        for i, x in enumerate(z):
            slope = prod(x - y for j, y in enumerate(z) if j != i)
            z[i] -= reduce(lambda value, c: value * x + c, reversed(p)) / slope if slope else 0
    return [x for x in z if abs(x) < 1e300]
def value_at(x, re, im):
    """The real part of e*X e at l = re + i im, by Horner's rule in l and in its conjugate."""
    a, b = Ball(0), Ball(0)
    for row in reversed(x.elements):
        u, v = complex_value(row, re, im)
        a, b = a * re + b * im + u, b * re - a * im + v
    return a

# The search.
def prove_algebraic(statement, blocks):
    """A text that says by which eigenvalue there is no solution, or None."""
    blocks = [b for b in blocks if b.sign != "==" and
              all(is_exact(c) for entries in b.terms.values() for c in entries.values())]
    matrices, scalars = rational_values(statement)
    for name, a in with_shifts(matrices, scalars):
        for start in starts(a, [m for _, m in matrices]):
            p, w = eigenvector(a, start)
            c = companion(p)
            for forms in all_forms(blocks, w, c):
                if any(certifies(blocks, forms, basis, p, c) for basis in WEIGHTS):
                    return "an eigenvalue of %s, exactly" % name
    return None
def rational_values(statement):
    """([(name, matrix)], [(name, scalar)]) of the data and definitions that are fractions."""
    matrices, scalars = [], []
    for name in list(statement.scope.names):
        try:
            value = statement.scope.find(name) if name not in statement.unknowns else None
        except NOT_EVALUATED:
            continue
        for x in value.values() if isinstance(value, Family) else [value]:
            if isinstance(x, Matrix) and not x.flexible and 0 not in x.shape() and exactly(x):
                if not x.is_number(): matrices.append((name, x))
                elif name in statement.method.get("data", {}): scalars.append((name, x))
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
    n = a.rows
    seen = [m for m in others if m.cols == n] + [m.transposed() for m in others if m.rows == n]
    kernels = [identity(n)] + [null_space(observability(a, c)) for c in seen]
    vectors = [tuple(row) for kernel in kernels for row in kernel.transposed().elements]
    return [column(v) for v in dict.fromkeys(vectors)]
def times(x, c, powers):
    """The sum of l^i m^j X over these powers (i, j)."""
    return reduce(add, [reduce(mul, [c.transposed()] * j + [x] + [c] * i) for i, j in powers])
def all_forms(blocks, w, c):
    """For each block {i: X} with z*B_i z = e*X e, for all z; None for a block of another size."""
    n = w.rows
    for pair in HALVES if any(b.shape[0] == 2 * n for b in blocks) else [()]:
        halves = {n: [W], 2 * n: pair}
        yield [{i: quadratic(entries, w, c, halves[block.shape[0]])
                for i, entries in block.terms.items()} if block.shape[0] in halves else None
               for block in blocks]
def quadratic(entries, w, c, halves):       # X with z*B z = e*X e
    n, total = w.rows, zeros(w.cols, w.cols)
    for (p, (s, i, j)), (q, (t, k, l)) in product(enumerate(halves), repeat=2):
        b = filled(n, n, lambda x, y: entries.get((p * n + x, q * n + y), Fraction(0)) * s * t)
        total = total + times(w.transposed() * b * w, c, [(j + k, i + l)])
    return total
def certifies(blocks, forms, basis, p, c):
    """Whether weights c_k in the span of `basis` make c_k z_k z_k* multipliers at a root of p."""
    places = [(k, weight) for k, form in enumerate(forms) if form for weight in basis]
    terms = [{i: times(x, c, POWERS[weight]) for i, x in forms[k].items()} for k, weight in places]
    zero = zeros(len(p) - 1, len(p) - 1)
    unknowns = sorted({i for t in terms for i in t if i})
    if not unknowns: return False
    system = [[x for i in unknowns for x in flat(t.get(i, zero))] for t in terms]
    for solution in null_space(Matrix(system).transposed()).transposed().elements:
        for s in (1, -1):
            weights, constant = {}, zero
            for factor, (k, weight), t in zip(solution, places, terms):
                weights.setdefault(k, {})[weight] = s * factor
                constant = constant + t.get(0, zero).map(lambda x: s * factor * x)
            if any(excludes(blocks, weights, constant, *root) for root in roots(p)): return True
    return False
def excludes(blocks, weights, constant, re, im):
    """The signs: c_k >= 0; the constant part < 0, or 0 with c_k > 0 for a strict inequality."""
    at = {"1": ball(Fraction(1)), "l + m": 2 * re, "l m": re * re + im * im}
    used = {k: sum(at[n] * x for n, x in w.items()) for k, w in weights.items() if any(w.values())}
    try:
        if any(sign(c) < 0 for c in used.values()): return False
        if any(flat(constant)): return sign(value_at(constant, re, im)) < 0
        return any(blocks[k].sign in STRICT for k in used)
    except Undecided:
        return False
