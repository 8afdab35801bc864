"""Matrices whose elements are numbers of any kind; elimination; what is positive definite."""
from fractions import Fraction
from functools import cache
from itertools import product
from math import comb, lcm
from arithmetic import (Ball, Undecided, Unsupported, ball, function, inverse, is_exact, is_zero,
                        level, middle, sign, sum_of_balls, typical, upper)
LONGEST_FRACTION = 3000     # bits; longer inverses become balls

class Matrix:
    """rows x cols elements. `flexible`: a multiple of I, whose size the context gives."""
    def __init__(self, elements, rows=None, cols=None, flexible=False):
        self.elements, self.flexible = elements, flexible
        self.rows = len(elements) if rows is None else rows
        self.cols = len((elements or [[]])[0]) if cols is None else cols
        if any(len(r) != self.cols for r in elements): raise Unsupported("rows of unequal length")
    def __getitem__(self, place): return self.elements[place[0]][place[1]]
    def shape(self): return (self.rows, self.cols)
    def is_number(self): return self.shape() == (1, 1)
    def number(self):
        if self.is_number(): return self.elements[0][0]
        raise Unsupported("a number is expected, not %d x %d" % self.shape())
    def whole(self):
        x = self.number()
        if not is_exact(x) or x.denominator != 1 or abs(x) > 10 ** 6:
            raise Unsupported("a whole number is expected")
        return int(x)
    def is_zero(self):      # the number 0, which takes any size
        return self.is_number() and is_zero(self.elements[0][0])
    def spread(self, i, j):     # element (i, j), where a number stands for all elements
        if self.flexible: raise Unsupported("elements of I, whose size is not known")
        return self.elements[0][0] if self.is_number() else self.elements[i][j]
    def map(self, f):
        return Matrix([[f(x) for x in row] for row in self.elements], *self.shape(), self.flexible)
    def transposed(self):
        return Matrix([[row[j] for row in self.elements] for j in range(self.cols)],
                      self.cols, self.rows, self.flexible)
    def part(self, rows, cols):
        return filled(len(rows), len(cols), lambda i, j: self.elements[rows[i]][cols[j]])
    def __neg__(self): return self.map(lambda x: -x)
    def __sub__(self, other): return self + (-other)
    def __add__(self, other):
        a, b = (other, self) if self.flexible and not other.flexible else (self, other)
        if b.is_zero(): return a
        if a.is_zero() and not b.flexible: return b
        if b.flexible and not a.flexible: b = b.sized(*a.shape())
        if a.is_number(): a, b = b, a
        if a.shape() != b.shape() and not (b.is_number() and 1 in a.shape()):
            raise Unsupported("a sum of %d x %d and %d x %d" % (a.shape() + b.shape()))
        return Matrix([[x + b.spread(i, j) for j, x in enumerate(row)]
                       for i, row in enumerate(a.elements)], *a.shape(), a.flexible and b.flexible)
    def sized(self, rows, cols):
        """This matrix at a place of a given size: I and 0 take it, others must have it."""
        if self.is_zero(): return zeros(rows, cols)
        if self.flexible and rows == cols: return identity(rows, self.number())
        if not self.flexible and self.shape() == (rows, cols): return self
        raise Unsupported("%d x %d at a place of %d x %d" % (self.shape() + (rows, cols)))
    def __mul__(self, other):
        for a, b in ((self, other), (other, self)):
            if a.is_number() and (a.flexible or not b.flexible or b.is_number()):
                scaled = b.map(lambda y, x=a.number(): x * y)
                scaled.flexible = b.flexible or (a.flexible and b.is_number())
                return scaled
        if self.cols != other.rows:
            raise Unsupported("a product of %d x %d and %d x %d" % (self.shape() + other.shape()))
        columns = other.transposed().elements
        return Matrix([[dot(r, c) for c in columns] for r in self.elements], self.rows, other.cols)
def dot(a, b):
    pairs = [(x, y) for x, y in zip(a, b) if not is_zero(x) and not is_zero(y)]
    if pairs and all(isinstance(z, Ball) for xy in pairs for z in xy): return sum_of_balls(pairs)
    return sum((x * y for x, y in pairs), Fraction(0))
def form(v, a, w): return dot(v, [dot(row, w) for row in a.elements])      # v'aw
def filled(rows, cols, element):
    return Matrix([[element(i, j) for j in range(cols)] for i in range(rows)], rows, cols)
def number(x): return Matrix([[x]])
def column(values): return filled(len(values), 1, lambda i, j: values[i])
def zeros(rows, cols): return filled(rows, cols, lambda i, j: Fraction(0))
def identity(n, x=Fraction(1)): return diagonal([x] * n)
def diagonal(values):
    n = len(values)
    return filled(n, n, lambda i, j: values[i] if i == j else Fraction(0))
def flat(a): return [x for row in a.elements for x in row]
def exactly(a): return all(is_exact(x) for x in flat(a))        # all elements are fractions
def stacked(items):
    if len({x.cols for x in items}) > 1: raise Unsupported("different widths of stacked matrices")
    rows = [row for x in items for row in x.elements]
    return Matrix(rows, len(rows), items[0].cols)
def beside(items): return stacked([x.transposed() for x in items]).transposed()
def join_blocks(blocks):
    """[a, b; c, d]. None stands for `*`, the transpose of the mirrored block. Zeros and multiples
    of I take their size from their block row and block column; a size that nothing gives is 1."""
    count, known, equal = len(blocks), {}, []       # block column j has the name count + j
    if any(len(row) != len(blocks[0]) for row in blocks):
        return stacked([join_blocks([row]) for row in blocks])     # each row has its own columns
    if any(x is None for row in blocks for x in row):
        def mirrored(i, j):
            if count == len(blocks[0]) and blocks[j][i]: return blocks[j][i].transposed()
            raise Unsupported("a * without a mirrored block")
        blocks = [[x or mirrored(i, j) for j, x in enumerate(row)] for i, row in enumerate(blocks)]
        equal = [(k, count + k) for k in range(count)]
    for i, row in enumerate(blocks):
        for j, x in enumerate(row):
            if x.is_zero(): continue
            if x.flexible: equal.append((i, count + j))
            else: known = {i: x.rows, count + j: x.cols, **known}
    for _ in range(count + len(blocks[0])):
        for a, b in equal:
            size = known.get(a, known.get(b))
            if size is not None: known = {a: size, b: size, **known}
    return stacked([beside([x.sized(known.get(i, 1), known.get(count + j, 1))
                            for j, x in enumerate(row)]) for i, row in enumerate(blocks)])
# Elimination.
def reduced(a, cols):
    """(pivot columns, rows) of the Gauss-Jordan elimination in the first columns of a; the pivot is
    the largest of its column. A column without a pivot is all zeros below, as fractions."""
    rows, pivots = [list(row) for row in a.elements], []
    for j in range(cols):
        i = len(pivots)
        if all(is_zero(row[j]) for row in rows[i:]): continue
        p = max(range(i, a.rows), key=lambda k: typical(rows[k][j]))
        rows[i], rows[p] = rows[p], rows[i]
        factor = inverse(rows[i][j])
        rows[i] = [x * factor for x in rows[i]]
        for k in range(a.rows):
            f = rows[k][j]
            if k != i and not is_zero(f): rows[k] = [x - f * y for x, y in zip(rows[k], rows[i])]
        pivots.append(j)
    return pivots, rows
def invert(a):
    if a.flexible: return a.map(inverse)
    if a.rows != a.cols: raise Unsupported("the inverse of a matrix that is not square")
    pivots, rows = reduced(beside([a, identity(a.rows)]), a.cols)
    if len(pivots) < a.rows: raise Undecided("the inverse of a singular matrix")
    result = Matrix([row[a.cols:] for row in rows], a.rows, a.rows)
    bits = max((x.denominator.bit_length() for x in flat(result) if is_exact(x)), default=0)
    return result.map(ball) if bits > LONGEST_FRACTION else result
def null_space(a):
    """A matrix whose columns are a basis of {x: a x = 0}; fractions. Each has one 1 and, beside it,
    zeros at the other columns of a without a pivot."""
    pivots, rows = reduced(a, a.cols)
    free = [j for j in range(a.cols) if j not in pivots]
    basis = [[Fraction(int(i == j)) for j in free] for i in range(a.cols)]
    for i, p in enumerate(pivots): basis[p] = [-rows[i][j] for j in free]
    return Matrix(basis, a.cols, len(free))
def pivots_of(rows):
    """The pivots of the L D L' elimination of a symmetric matrix, whose rows are changed. A pivot
    is left out of the elimination if it is 0. The caller must stop before a pivot that may be 0
    with other elements in its column."""
    for k, row in enumerate(rows):
        yield row[k]
        if is_zero(row[k]): continue
        factor = inverse(row[k])
        for i in range(k + 1, len(rows)):
            if not is_zero(rows[i][k]):
                f = rows[i][k] * factor
                for j in range(k + 1, i + 1): rows[i][j] = rows[i][j] - f * rows[j][k]
# Definite matrices.
POSITIVE, SEMIDEFINITE, UNKNOWN, NEGATIVE = "positive", "semidefinite", "unknown", "negative"
def classify(a):
    """What is proved of the symmetric matrix a: POSITIVE (definite), SEMIDEFINITE and singular,
    NEGATIVE (v'av < 0 for some v), or UNKNOWN. Fractions decide always: a pivot 0 needs a zero
    column, else v'av < 0 for some v."""
    if not exactly(a): return POSITIVE if is_positive(a) else UNKNOWN
    rows, result = [list(row) for row in a.elements], POSITIVE
    for k, pivot in enumerate(pivots_of(rows)):
        if pivot < 0 or pivot == 0 and any(row[k] != 0 for row in rows[k + 1:]): return NEGATIVE
        if pivot == 0: result = SEMIDEFINITE
    return result
def is_positive(a): return is_definite(least(a))
def least(a):
    """The lower triangle of a matrix of whole numbers that is at most each symmetric matrix in the
    matrix of balls m_ij +- r_ij, times 2^320: m - diag(sums of the rows of r)."""
    b, places = a.map(ball), range(a.rows)
    margins = [sum(max(b[i, j].r, b[j, i].r) for j in places) for i in places]
    return [[b[i, j].m - (margins[i] if i == j else 0) for j in range(i + 1)] for i in places]
def is_definite(rows):
    """Whether the matrix of whole numbers with this lower triangle, which is changed, is positive
    definite: elimination without fractions gives the leading minors."""
    last = 1
    for k, row in enumerate(rows):
        pivot = row[k]
        if pivot <= 0: return False
        for other in rows[k + 1:]:
            factor = other[k]
            for j in range(k + 1, len(other)):
                other[j] = (other[j] * pivot - factor * rows[j][k]) // last
        last = pivot
    return True
def witness(a, strict):
    """A vector v of fractions with v'av < 0 (if strict: <= 0 and v not 0), or None. If a + t I has
    its first pivot d <= 0 at k, let v = (x, 1, 0) solve its first k rows: v'(a + t I)v = d. A tiny
    t > 0 is for a pivot 0 beside other elements."""
    middles, found = a.map(middle), None
    size = max(upper(x) for x in flat(a))
    for t in [Fraction(0)] + [size / 10 ** k for k in (10, 20, 40, 80, 160, 320)]:
        shifted = middles + identity(a.rows, t)
        pivots = pivots_of([list(row) for row in shifted.elements])
        k = next((k for k, pivot in enumerate(pivots) if pivot <= 0), None)
        if k is None and t == 0: return None
        if k is None: continue
        v = flat(null_space(shifted.part(range(k), range(k + 1))).map(rounded))
        v += [Fraction(0)] * (a.rows - k - 1)
        try: s = sign(form(v, a, v))
        except Undecided: continue
        if s < 0: return v
        if s == 0 and strict: found = v
    return found
def rounded(x):         # x if it is short, else a fraction near it
    if x.denominator.bit_length() < 400: return x
    shift = 400 + max(0, x.denominator.bit_length() - x.numerator.bit_length())
    return Fraction((x.numerator << shift) // x.denominator, 1 << shift)
@cache
def bernstein_weights(degree):
    """(w, d) with b_i = sum_j w[i][j] c_j / d: Bernstein coefficients of sum_j c_j t^j on [-1, 1].
    With t = 2s - 1, t^j = sum_k p_jk s^k and b_i = sum_k C(i, k)/C(K, k) (coefficient of s^k)."""
    def power(j, k): return comb(j, k) * 2 ** k * (-1) ** (j - k)
    places, d = range(degree + 1), lcm(*(comb(degree, k) for k in range(degree + 1)))
    return [[sum(comb(i, k) * d // comb(degree, k) * power(j, k) for k in range(min(i, j) + 1))
             for j in places] for i in places], d
def is_positive_on_box(a):
    """Whether a symmetric matrix of Taylor models is proved positive definite for all t in
    [-1, 1]^k. The value at any t is a convex combination of the Bernstein coefficients, plus the
    rest. So it is enough that each coefficient is positive definite with the rest as radius."""
    degrees, places = [max(e) for e in zip(*{e for x in flat(a) for e in x.terms})], range(a.rows)
    found = {(i, j): bernstein(a[i, j], degrees) for i in places for j in range(i + 1)}
    margins = [sum(found[max(i, j), min(i, j)][1] for j in places) for i in places]
    return all(is_definite([[found[i, j][0][e] - (margins[i] if i == j else 0)
                             for j in range(i + 1)] for i in places])
               for e in product(*[range(n + 1) for n in degrees]))
def bernstein(x, degrees):
    """({e: Bernstein coefficient}, radius) of a Taylor model, times a number that only the degrees
    determine: one variable after the other. Those of powers of t are in [-1, 1]: the radii add."""
    balls = {e: ball(c) for e, c in x.terms.items()}
    terms, radius = {x.origin(): 0}, sum(b.r for b in balls.values()) + x.rest
    terms.update((e, b.m) for e, b in balls.items())
    for k, degree in enumerate(degrees):
        w, d = bernstein_weights(degree)
        radius, parts = radius * d, {}
        for e, m in terms.items(): parts.setdefault(e[:k] + e[k + 1:], []).append((e[k], m))
        terms = {e[:k] + (i,) + e[k:]: sum([row[j] * m for j, m in column])
                 for e, column in parts.items() for i, row in enumerate(w)}
    return terms, radius
def spectral_norm(a):
    """A ball around the largest singular value of a matrix of fractions and balls. It is below h if
    and only if [h I, a; a', h I] > 0. The interval [low, high] is halved."""
    if 1 in a.shape(): return function("sqrt", sum((x * x for x in flat(a)), Fraction(0)))
    if any(level(x) > 1 for x in flat(a)): raise Undecided("a norm that depends on a variable")
    low, high = Fraction(0), sum(upper(x) for x in flat(a))
    while high - low > high / 10 ** 30:
        half = (low + high) / 2
        if classify(norm_block(a, number(half))) == POSITIVE: high = half
        elif witness(norm_block(a, number(half)), strict=True): low = half
        else: break
    return ball((low + high) / 2).widened(ball((high - low) / 2).size() + 1)
def norm_block(m, bound):
    """[g I, M; M', g I], which is >= 0 if and only if norm(M) <= g."""
    g = bound.number()
    return join_blocks([[identity(m.rows, g), m], [m.transposed(), identity(m.cols, g)]])
