"""Matrices whose elements are numbers of any kind, and elimination."""

from fractions import Fraction

from arithmetic import Ball, Unsupported, ball, inverse, is_exact, sum_of_balls, typical

LONGEST_FRACTION = 3000     # bits; longer inverses become balls

class Matrix:
    """rows x cols elements. `flexible`: a multiple of I, whose size the context gives."""

    def __init__(self, elements, rows=None, cols=None, flexible=False):
        self.elements, self.flexible = elements, flexible
        self.rows = len(elements) if rows is None else rows
        self.cols = (len(elements[0]) if elements else 0) if cols is None else cols
        if self.rows != len(elements) or any(len(row) != self.cols for row in elements):
            raise Unsupported("rows of different lengths")

    def __getitem__(self, place): return self.elements[place[0]][place[1]]
    def shape(self): return (self.rows, self.cols)
    def is_number(self): return self.shape() == (1, 1)

    def number(self):
        if not self.is_number():
            raise Unsupported("a number is expected, not %d x %d" % self.shape())
        return self.elements[0][0]

    def whole(self):
        x = self.number()
        if not is_exact(x) or x.denominator != 1 or abs(x) > 10 ** 6:
            raise Unsupported("a whole number is expected")
        return int(x)

    def is_zero(self):
        """Whether this is the number 0, which takes any size."""
        return self.is_number() and is_exact(self.elements[0][0]) and self.elements[0][0] == 0

    def spread(self, i, j):
        """Element (i, j), where a number stands for all elements."""
        return self.elements[0][0] if self.is_number() else self.elements[i][j]

    def map(self, f):
        return Matrix([[f(x) for x in row] for row in self.elements], self.rows, self.cols,
                      self.flexible)

    def transposed(self):
        return Matrix([[self.elements[i][j] for i in range(self.rows)] for j in range(self.cols)],
                      self.cols, self.rows, self.flexible)

    def __neg__(self): return self.map(lambda x: -x)
    def __sub__(self, other): return self + (-other)

    def __add__(self, other):
        a, b = (other, self) if self.flexible and not other.flexible else (self, other)
        if a.is_zero() and not b.flexible or b.is_zero():
            return b if a.is_zero() and not b.is_zero() else a
        if b.flexible and not a.flexible:
            if a.rows != a.cols: raise Unsupported("I beside a matrix that is not square")
            b = identity(a.rows, b.number())
        if a.shape() != b.shape():
            a, b = (b, a) if a.is_number() else (a, b)
            if not (b.is_number() and 1 in a.shape()):
                raise Unsupported("a sum of %d x %d and %d x %d" % (a.shape() + b.shape()))
        return Matrix([[x + b.spread(i, j) for j, x in enumerate(row)]
                       for i, row in enumerate(a.elements)], a.rows, a.cols,
                      a.flexible and b.flexible)

    def __mul__(self, other):
        for a, b in ((self, other), (other, self)):
            if a.is_number() and (a.flexible or not b.flexible or b.is_number()):
                x = a.number()
                scaled = b.map(lambda y: x * y)
                scaled.flexible = b.flexible or (a.flexible and b.is_number())
                return scaled
        if self.cols != other.rows:
            raise Unsupported("a product of %d x %d and %d x %d" % (self.shape() + other.shape()))
        columns = other.transposed().elements
        return Matrix([[dot(row, c) for c in columns] for row in self.elements],
                      self.rows, other.cols)

def dot(a, b):
    pairs = [(x, y) for x, y in zip(a, b)
             if not (is_exact(x) and x == 0 or is_exact(y) and y == 0)]
    if pairs and all(isinstance(z, Ball) for pair in pairs for z in pair):
        return sum_of_balls(pairs)
    return sum((x * y for x, y in pairs), Fraction(0))

def number(x): return Matrix([[x]])
def column(values): return Matrix([[x] for x in values], len(values), 1)
def zeros(rows, cols): return Matrix([[Fraction(0)] * cols for _ in range(rows)], rows, cols)

def diagonal(values):
    n = len(values)
    return Matrix([[values[i] if i == j else Fraction(0) for j in range(n)] for i in range(n)],
                  n, n)

def identity(n, x=Fraction(1)): return diagonal([x] * n)
def flat(a): return [x for row in a.elements for x in row]

def exactly(a):
    """Whether all elements are fractions."""
    return all(is_exact(x) for x in flat(a))

def invert(a):
    """The inverse by Gauss-Jordan elimination; the largest pivot of each column."""
    if a.flexible: return a.map(inverse)
    if a.rows != a.cols: raise Unsupported("the inverse of a matrix that is not square")
    n = a.rows
    rows = [list(a.elements[i]) + [Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: typical(rows[i][k]))
        rows[k], rows[p] = rows[p], rows[k]
        factor = inverse(rows[k][k])
        rows[k] = [x * factor for x in rows[k]]
        for i in range(n):
            f = rows[i][k]
            if i != k and not (is_exact(f) and f == 0):
                rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
    result = Matrix([row[n:] for row in rows], n, n)
    if exactly(result) and any(x.denominator.bit_length() > LONGEST_FRACTION
                               for x in flat(result)):
        return result.map(ball)
    return result

def row_echelon(a):
    """(pivot columns, reduced rows) of a matrix of fractions."""
    rows, pivots = [list(row) for row in a.elements], []
    for j in range(a.cols):
        i = len(pivots)
        p = next((k for k in range(i, a.rows) if rows[k][j] != 0), None)
        if p is None: continue
        rows[i], rows[p] = rows[p], rows[i]
        rows[i] = [x / rows[i][j] for x in rows[i]]
        for k in range(a.rows):
            if k != i and rows[k][j] != 0:
                rows[k] = [x - rows[k][j] * y for x, y in zip(rows[k], rows[i])]
        pivots.append(j)
    return pivots, rows

def null_space(a):
    """A matrix whose columns are a basis of {x: a x = 0}; fractions."""
    pivots, rows = row_echelon(a)
    free = [j for j in range(a.cols) if j not in pivots]
    basis = [[Fraction(int(i == j)) for j in free] for i in range(a.cols)]
    for i, p in enumerate(pivots): basis[p] = [-rows[i][j] for j in free]
    return Matrix(basis, a.cols, len(free))

def join_blocks(blocks):
    """[a, b; c, d]. None stands for `*`, the transpose of the mirrored block.

    Zeros and multiples of I take their size from their block row and block column.
    """
    count = len(blocks[0])
    if any(len(row) != count for row in blocks): return stack_rows(blocks)
    heights, widths = block_sizes(blocks)
    full = [[None] * count for _ in blocks]
    for i, row in enumerate(blocks):
        for j, x in enumerate(row):
            if x is not None: full[i][j] = sized(x, heights[i], widths[j])
    for i, row in enumerate(blocks):
        for j, x in enumerate(row):
            if x is None:
                if len(blocks) != count or full[j][i] is None:
                    raise Unsupported("a * without a mirrored block")
                full[i][j] = full[j][i].transposed()
    return Matrix([[x for part in row for x in part.elements[k]]
                   for row, height in zip(full, heights) for k in range(height)],
                  sum(heights), sum(widths))

def stack_rows(blocks):
    """Block rows with other numbers of entries: each is joined alone."""
    rows = [join_blocks([row]) for row in blocks]
    return Matrix([line for r in rows for line in r.elements])

def takes_size(x): return x.flexible or x.is_zero()

def sized(x, rows, cols):
    if not takes_size(x):
        if x.shape() != (rows, cols):
            raise Unsupported("a block of %d x %d at a place of %d x %d" %
                              (x.shape() + (rows, cols)))
        return x
    if x.is_zero(): return zeros(rows, cols)
    if rows != cols: raise Unsupported("I at a place that is not square")
    return identity(rows, x.number())

def block_sizes(blocks):
    """Heights of block rows and widths of block columns; sizes that nothing gives are 1."""
    mirrored = any(x is None for row in blocks for x in row)
    places = [(("row", i), ("col", j), x) for i, row in enumerate(blocks)
              for j, x in enumerate(row) if x is not None]
    known = {}
    for row, col, x in places:
        if not takes_size(x):
            known.setdefault(row, x.rows)
            known.setdefault(col, x.cols)
    equal = [(row, col) for row, col, x in places if x.flexible and not x.is_zero()]
    if mirrored: equal += [(("row", k), ("col", k)) for k in range(len(blocks))]
    for _ in range(len(blocks) + len(blocks[0])):
        for a, b in equal:
            if a in known or b in known:
                size = known.get(a, known.get(b))
                known.setdefault(a, size)
                known.setdefault(b, size)
    return ([known.get(("row", i), 1) for i in range(len(blocks))],
            [known.get(("col", j), 1) for j in range(len(blocks[0]))])
