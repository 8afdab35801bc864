"""The matrix language of methods and problems: text -> tree -> matrix.

The elements of a matrix are numbers of any kind of arithmetic.py. So the same text gives exact
values, enclosures for all values of a variable, derivatives, or functions of the unknowns.
The language is that of docs/language.md. A name or function that is not here raises Unsupported.
"""

import re
from fractions import Fraction

from arithmetic import (BITS, PI, Affine, Ball, Dual, Taylor, Undecided, Unsupported, ball,
                        ball_exp, function, inverse, is_exact, middle, sign, typical, upper)
from definite import spectral_norm
from matrices import (Matrix, column, diagonal, exactly, flat, identity, invert, join_blocks,
                      null_space, number, row_echelon, zeros)

# Tokens and trees. A tree is a tuple: its kind, then its parts. In 2./v the point belongs to the
# operator, not to the number.

TOKEN = re.compile(r"""\s*(?:
    (?P<number>\d+(?=\.[*/^])|(?:\d+(?:\.(?!\.)\d*)?|\.\d+)(?:[eE][+-]?\d+)?)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<sign>\.\.|\.\^|\.\*|\./|<=|>=|==|!=|[-+*/^'()\[\],;:<>{}]))""", re.X)
COMPARISONS = ("<", ">", "<=", ">=", "==", "!=")
LONGEST = 100_000

def tokens_of(text):
    if len(text) > LONGEST: raise Unsupported("a formula of more than %d characters" % LONGEST)
    tokens, at, text = [], 0, text.strip()
    while at < len(text):
        found = TOKEN.match(text, at)
        if not found: raise Unsupported("the text %r" % text[at:at + 20])
        tokens.append((found.lastgroup, found.group(found.lastgroup)))
        at = found.end()
    return tokens

class Parser:
    """Recursive descent; each method reads one level of the table of operators."""

    def __init__(self, text): self.text, self.tokens, self.at = text, tokens_of(text), 0

    def next_is(self, *signs, ahead=0):
        at = self.at + ahead
        return at < len(self.tokens) and self.tokens[at][0] != "number" and \
            self.tokens[at][1] in signs

    def take(self):
        self.at += 1
        return self.tokens[self.at - 1][1]

    def taken(self, *signs):
        """The next sign if it is one of these; it is consumed."""
        return self.take() if self.next_is(*signs) else None

    def expect(self, sign_):
        if not self.taken(sign_): raise Unsupported("%r is missing in %r" % (sign_, self.text[:60]))

    def whole(self):
        tree = self.condition()
        if self.at < len(self.tokens):
            raise Unsupported("%r in %r" % (self.tokens[self.at][1], self.text[:60]))
        return tree

    def chain(self, signs, read):
        tree = read()
        while self.next_is(*signs): tree = (self.take(), tree, read())
        return tree

    def condition(self): return self.chain(("or",), self.conjunction)
    def conjunction(self): return self.chain(("and",), self.negation)
    def negation(self): return ("not", self.negation()) if self.taken("not") else self.comparison()
    def sum(self): return self.chain(("+", "-"), self.term)

    def comparison(self):
        parts = [self.sum()]
        while self.next_is(*COMPARISONS): parts += [self.take(), self.sum()]
        return ("compare", parts) if len(parts) > 1 else parts[0]

    def term(self):
        if self.taken("-"): return ("minus", self.term())
        if self.taken("+"): return self.term()
        return self.chain(("*", "/", ".*", "./"), lambda: self.signed(self.factor))

    def signed(self, read): return ("minus", read()) if self.taken("-") else read()

    def factor(self):
        """A value with what follows it, from left to right: A^2' is (A^2)'."""
        tree = self.value()
        while True:
            if self.taken("'"): tree = ("'", tree)
            elif self.next_is("^", ".^"): tree = (self.take(), tree, self.signed(self.value))
            elif self.taken("("): tree = ("call", tree, self.arguments())
            else: return tree

    def arguments(self):
        found = []
        if self.taken(")"):
            return found
        while True:
            found.append(self.argument())
            if not self.taken(","):
                self.expect(")")
                return found

    def argument(self):
        if self.taken(":"): return ("all",)
        if self.next_is("in", ahead=1):
            name = self.take()
            self.take()
            low = self.sum()
            self.expect("..")
            return ("range", name, low, self.sum())
        tree = self.condition()
        return ("span", tree, self.sum()) if self.taken(":") else tree

    def value(self):
        if self.at >= len(self.tokens): raise Unsupported("the end of %r" % self.text[:60])
        kind, text = self.tokens[self.at]
        if kind in ("number", "name"):
            self.at += 1
            return (kind, decimal(text) if kind == "number" else text)
        if self.taken("("):
            tree = self.condition()
            self.expect(")")
            return tree
        self.expect("[")
        rows = [[]]
        while True:
            if self.next_is("*") and self.next_is(",", ";", "]", ahead=1):
                self.take()
                rows[-1].append(("mirror",))
            else: rows[-1].append(self.condition())
            separator = self.taken(",", ";")
            if separator == ";": rows.append([])
            elif not separator:
                self.expect("]")
                return ("block", rows)

DECIMAL = re.compile(r"-?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,4})?")

def decimal(text):
    """The fraction that a decimal is."""
    if len(text) > 2000 or not DECIMAL.fullmatch(text):
        raise Unsupported("the number %s" % text[:40])
    mantissa, _, exponent = text.lower().partition("e")
    if abs(int(exponent or 0)) > 1000: raise Unsupported("the exponent of %s" % text[:40])
    return Fraction(mantissa) * Fraction(10) ** int(exponent or 0)

TREES = {}

def parse(text):
    if text not in TREES: TREES[text] = Parser(text).whole()
    return TREES[text]

# Names.

class Scope:
    """Names with their values; an inner scope hides names of the outer one."""

    def __init__(self, outer=None, names=None): self.outer, self.names = outer, dict(names or {})

    def find(self, name):
        scope = self
        while scope is not None:
            if name in scope.names:
                value = scope.names[name]
                return value.get() if isinstance(value, Later) else value
            scope = scope.outer
        return None

    def is_local(self, name):
        """Whether a variable or argument has this name, not a datum or a definition."""
        scope = self
        while scope.outer is not None:
            if name in scope.names: return True
            scope = scope.outer
        return False

class Later:
    """A value that is computed when it is first used, once."""

    def __init__(self, compute): self.compute, self.busy, self.done = compute, False, False

    def get(self):
        if not self.done:
            if self.busy: raise Unsupported("a definition that uses itself")
            self.busy = True
            try:
                self.value, self.done = self.compute(), True
            finally:
                self.busy = False
        return self.value

class Function:
    """A definition with arguments, or an unknown that is a function."""

    def __init__(self, apply, derivative=None): self.apply, self.derivative = apply, derivative

class Family(dict):
    """Members by their indices, a tuple of whole numbers."""

# Evaluation.

def evaluate(tree, scope):
    """The matrix (or Function, Family) that a tree means."""
    kind = tree[0]
    if kind == "number": return number(tree[1])
    if kind == "name": return value_of_name(tree[1], scope)
    if kind == "call": return call(tree[1], tree[2], scope)
    if kind == "block":
        return join_blocks([[None if x == ("mirror",) else evaluate(x, scope) for x in row]
                            for row in tree[1]])
    if kind in OPERATORS: return OPERATORS[kind](*[matrix(part, scope) for part in tree[1:]])
    raise Unsupported("a condition where a value is expected")

def matrix(tree, scope):
    value = evaluate(tree, scope)
    if not isinstance(value, Matrix): raise Unsupported("a function where a value is expected")
    return value

def value_of_name(name, scope):
    value = scope.find(name)
    if value is not None: return value
    if name == "I": return Matrix([[Fraction(1)]], flexible=True)
    if name == "pi": return number(PI)
    raise Unsupported("the name " + name)

def elementwise(operation):
    """The operation on equal shapes, or on a number and a matrix."""
    def apply(a, b):
        shape = b if a.is_number() else a
        if not (a.is_number() or b.is_number()) and a.shape() != b.shape():
            raise Unsupported("different shapes")
        return Matrix([[operation(a.spread(i, j), b.spread(i, j)) for j in range(shape.cols)]
                       for i in range(shape.rows)], shape.rows, shape.cols)
    return apply

def power_of_number(x, k):
    if is_exact(k) and k.denominator == 1:
        if abs(k) > 10_000: raise Unsupported("an exponent above 10000")
        base, result = x if k >= 0 else inverse(x), Fraction(1)
        for _ in range(abs(int(k))): result = result * base
        return result
    if k == Fraction(1, 2): return function("sqrt", x)
    return function("exp", k * function("log", x))

def power(base, exponent):
    k = exponent.number()
    if base.is_number():
        return Matrix([[power_of_number(base.number(), k)]], flexible=base.flexible)
    n = exponent.whole()
    if base.rows != base.cols or abs(n) > 10_000: raise Unsupported("this power of a matrix")
    factor, result = base if n >= 0 else invert(base), identity(base.rows)
    for _ in range(abs(n)): result = result * factor
    return result

OPERATORS = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a.map(lambda x: x * inverse(b.number())),
    "minus": lambda a: -a,
    "'": lambda a: a.transposed(),
    "^": power,
    ".*": elementwise(lambda x, y: x * y),
    "./": elementwise(lambda x, y: x * inverse(y)),
    ".^": elementwise(power_of_number),
}

def call(head, arguments, scope):
    """f(...), a member of a family, an element or part of a matrix, or a built-in function."""
    if head[0] == "name" and scope.find(head[1]) is None: return builtin(head[1], arguments, scope)
    if head[0] == "call" and head[1] == ("name", "derivative"):
        unknown = evaluate(head[2][0], scope)
        if not isinstance(unknown, Function) or unknown.derivative is None:
            raise Unsupported("the derivative of what is not an unknown function")
        return unknown.derivative(matrix(arguments[0], scope))
    value = evaluate(head, scope)
    if isinstance(value, Function): return value.apply(*[matrix(x, scope) for x in arguments])
    if isinstance(value, Family):
        last = Scope(scope, {"end": number(Fraction(max(k[0] for k in value)))})
        key = tuple(matrix(x, last).whole() for x in arguments)
        if key not in value: raise Unsupported("the member %s of a family" % (key,))
        return value[key]
    return part_of(value, arguments, scope)

def part_of(value, arguments, scope):
    """M(i, j), v(i); an index is a number, lo:hi or : alone."""
    def places(tree, length):
        if tree == ("all",): return list(range(length))
        inner = Scope(scope, {"end": number(Fraction(length))})
        ends = [matrix(x, inner).whole() for x in (tree[1:] if tree[0] == "span" else [tree])]
        found = list(range(ends[0] - 1, ends[-1]))
        if any(not 0 <= k < length for k in found):
            raise Unsupported("an index beyond the size of a matrix")
        return found

    if len(arguments) == 1 and 1 in value.shape():
        arguments = arguments + [("all",)] if value.cols == 1 else [("all",)] + arguments
    if len(arguments) != 2: raise Unsupported("the number of indices")
    rows, cols = places(arguments[0], value.rows), places(arguments[1], value.cols)
    return Matrix([[value[i, j] for j in cols] for i in rows], len(rows), len(cols))

# Conditions.

def order(x, y):
    """The sign of x - y."""
    return (x > y) - (x < y) if is_exact(x) and is_exact(y) else sign(x - y)

def relation(sign_, x, y):
    s = order(x, y)
    return {"<": s < 0, ">": s > 0, "<=": s <= 0, ">=": s >= 0, "==": s == 0, "!=": s != 0}[sign_]

def holds(tree, scope):
    """Whether a condition holds for all elements."""
    if tree[0] == "and": return holds(tree[1], scope) and holds(tree[2], scope)
    if tree[0] == "or": return holds(tree[1], scope) or holds(tree[2], scope)
    if tree[0] == "not": return not holds(tree[1], scope)
    if tree[0] != "compare": raise Unsupported("a value where a condition is expected")
    values = [matrix(x, scope) for x in tree[1][::2]]
    return all(all(flat(elementwise(lambda x, y, s=s: relation(s, x, y))(a, b)))
               for a, s, b in zip(values, tree[1][1::2], values[1:]))

def choose(condition, yes, no, scope):
    """where(condition, yes, no), element by element."""
    if condition[0] == "compare" and len(condition[1]) == 3:
        left, sign_, right = condition[1]
        truths = elementwise(lambda x, y: relation(sign_, x, y))(matrix(left, scope),
                                                                 matrix(right, scope))
        if not truths.is_number():
            return Matrix([[(yes if truths[i, j] else no).spread(i, j)
                            for j in range(truths.cols)] for i in range(truths.rows)])
        return yes if truths.number() else no
    return yes if holds(condition, scope) else no

# Functions.

def matrix_exponential(a):
    """expm(a) by scaling, Taylor series and squaring, or for affine arguments by parts.

    After scaling the norm is at most q <= 1/4. The terms beyond the j-th are less than twice its
    bound q^j/j!. Row sums bound the norm.
    """
    if all(is_exact(x) and x == 0 for x in flat(a)): return identity(a.rows)
    if any(isinstance(x, (Affine, Dual)) for x in flat(a)):
        raise Unsupported("expm of unknowns, or its derivative")
    models = [x for x in flat(a) if isinstance(x, Taylor)]
    if models:
        parts = affine_parts(a, models[0])
        if parts: return exponential_of_affine(parts, models[0])
    norm = max(sum(upper(x) for x in row) for row in a.elements)
    halvings = 0 if models else 8
    norm = norm / 2 ** halvings
    while norm > Fraction(1, 4):
        norm, halvings = norm / 2, halvings + 1
        if halvings > 60: raise Undecided("expm of a large matrix")
    scaled = a.map(lambda x: (ball(x) if is_exact(x) and x != 0 else x) *
                   Fraction(1, 2 ** halvings))
    total = term = identity(a.rows)
    bound, j = Fraction(1), 0
    while bound > Fraction(1, 2 ** (BITS - 20)):
        j += 1
        bound = bound * norm / j
        term = (term * scaled).map(lambda x: x * Fraction(1, j))
        total = total + term
    error, coupled = ball(2 * bound).size() + 1, coupling(a)
    total = Matrix([[widened(x, error, models) if coupled[i][j] else x for j, x in enumerate(row)]
                    for i, row in enumerate(total.elements)])
    for _ in range(halvings): total = total * total
    return total

def coupling(a):
    """Where a power a^k, k >= 1, can differ from 0: the paths in the graph of its elements."""
    paths = [[not (is_exact(x) and x == 0) for x in row] for row in a.elements]
    for k in range(a.rows):
        for i in range(a.rows):
            if paths[i][k]: paths[i] = [x or y for x, y in zip(paths[i], paths[k])]
    return paths

def widened(x, error, models):
    """x with an additional error of `error`/2^320."""
    if models:
        x = models[0].lift(x) if not isinstance(x, Taylor) else x
        return Taylor(x.terms, x.rest + error, x.space)
    return Ball(ball(x).m, ball(x).r + error)

def affine_parts(a, model):
    """[(exponent, M_e)] of a = M_0 + sum M_e t^e if all M are exact and commute, else None."""
    elements = a.map(lambda x: x if isinstance(x, Taylor) else model.lift(x))
    exponents = sorted({e for x in flat(elements) for e in x.terms})
    parts = [(e, elements.map(lambda x, e=e: x.terms.get(e, Fraction(0)))) for e in exponents]
    if any(x.rest for x in flat(elements)) or any(sum(e) > 1 for e in exponents) or \
            not all(is_exact(x) for _, m in parts for x in flat(m)):
        return None
    commute = all((m * n).elements == (n * m).elements for _, m in parts for _, n in parts)
    return parts if commute else None

def exponential_of_affine(parts, model):
    """expm(M_0 + sum M_e t^e) = expm(M_0) times the series of expm(M_e t^e) up to the order K.

    A series leaves at most s^(K+1)/(K+1)! exp(s), where s is the largest row sum of |M_e|.
    """
    result, order = None, model.space[1]
    for e, m in parts:
        if not any(e): factor = matrix_exponential(m)
        else:
            norm = max(sum(map(abs, row)) for row in m.elements)
            terms = [[{} for _ in range(m.cols)] for _ in range(m.rows)]
            term, bound = identity(m.rows), Fraction(1)
            for k in range(order + 1):
                if k:
                    term = (term * m).map(lambda x: x * Fraction(1, k))
                    bound = bound * norm / k
                for i in range(m.rows):
                    for j in range(m.cols):
                        if term[i, j] != 0: terms[i][j][tuple(k * x for x in e)] = ball(term[i, j])
            rest = (ball(bound * norm / (order + 1)) * ball_exp(ball(norm))).size() + 1
            coupled = coupling(m)
            factor = Matrix([[Taylor(x, rest if coupled[i][j] else 0, model.space)
                              for j, x in enumerate(row)] for i, row in enumerate(terms)])
        result = factor if result is None else result * factor
    return result

def hyperbolic(name):
    def apply(x):
        plus, minus = function("exp", x), function("exp", -x)
        s, c = (plus - minus) * Fraction(1, 2), (plus + minus) * Fraction(1, 2)
        return {"sinh": s, "cosh": c}[name] if name != "tanh" else s * inverse(c)
    return apply

def determinant(a):
    rows, result = [list(row) for row in a.elements], Fraction(1)
    for k in range(a.rows):
        p = max(range(k, a.rows), key=lambda i: typical(rows[i][k]))
        if p != k: rows[k], rows[p], result = rows[p], rows[k], -result
        if is_exact(rows[k][k]) and rows[k][k] == 0: return Fraction(0)
        result = result * rows[k][k]
        for i in range(k + 1, a.rows):
            f = rows[i][k] * inverse(rows[k][k])
            rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
    return result

def observability(a, c):
    blocks = [c]
    for _ in range(a.rows - 1): blocks.append(blocks[-1] * a)
    return Matrix([row for b in blocks for row in b.elements], a.rows * c.rows, a.cols)

def lyapunov(a, q, discrete):
    """X of A X + X A' + Q = 0, or of A X A' - X + Q = 0: n^2 equations, X column by column."""
    n = a.rows
    system = [[Fraction(0)] * (n * n) for _ in range(n * n)]
    for j in range(n):
        for i in range(n):
            row = system[j * n + i]
            for k in range(n):
                if discrete:
                    for m in range(n):
                        row[m * n + k] = row[m * n + k] + a[i, k] * a[j, m]
                else:
                    row[j * n + k] = row[j * n + k] + a[i, k]
                    row[k * n + i] = row[k * n + i] + a[j, k]
            if discrete: row[j * n + i] = row[j * n + i] - 1
    right = column([-q[i, j] for j in range(n) for i in range(n)])
    x = invert(Matrix(system)) * right
    return Matrix([[x[j * n + i, 0] for j in range(n)] for i in range(n)])

def gramian(f, hc, j, hd, lengths, backward=False):
    """Sum over flows and the jumps between them of the outputs' squares, x'W x, by the state at
    the start (or at the end). expm([-F', H'H; 0, F] t) = [.., expm(-F't) W; 0, expm(F t)]."""
    n, total, moved, before = f.rows, zeros(f.rows, f.rows), identity(f.rows), None
    generator = join_blocks([[-f.transposed(), hc.transposed() * hc], [zeros(n, n), f]])
    for k, t in enumerate(flat(lengths)):
        if k:
            seen = hd * moved
            total, moved = total + seen.transposed() * seen, j * moved
        if t is not before:
            both = matrix_exponential(generator.map(lambda x: x * t)).elements
            flow = Matrix([row[n:] for row in both[n:]], n, n)
            seen_in_flow = flow.transposed() * Matrix([row[n:] for row in both[:n]], n, n)
        total, moved, before = total + moved.transposed() * seen_in_flow * moved, flow * moved, t
    back = invert(moved) if backward else identity(n)
    return back.transposed() * total * back

def orthonormal(basis, size):
    """The basis of docs/language.md: pivoted Cholesky factor of the projector on the range."""
    if basis.cols in (0, size): return zeros(size, 0) if basis.cols == 0 else identity(size)
    w = basis * invert(basis.transposed() * basis) * basis.transposed()
    columns = []
    for _ in range(basis.cols):
        r = [w[i, i] for i in range(size)]
        largest = max(middle(x) + upper(x - middle(x)) for x in r)
        p = next(i for i in range(size) if sign(ball_exp(ball(Fraction(1))) * r[i] - largest) >= 0)
        b = [w[i, p] * inverse(function("sqrt", r[p])) for i in range(size)]
        columns.append(b)
        w = Matrix([[w[i, j] - b[i] * b[j] if p not in (i, j) else Fraction(0)
                     for j in range(size)] for i in range(size)])
    return Matrix(columns, basis.cols, size).transposed()

def checked_rank(a, tolerance=None):
    """The rank of a matrix of fractions, if all singular values but those that are 0 are above the
    tolerance times the largest one. By inertia: the positive pivots of a'a - s I count the
    eigenvalues of a'a above s; here s = (tolerance)^2 trace(a'a), and trace >= largest."""
    if not exactly(a): raise Unsupported("the rank of numbers that are not rational")
    rank, g = len(row_echelon(a)[0]), a.transposed() * a
    s = (tolerance.number() if tolerance else Fraction(1, 10 ** 12)) ** 2
    g = g - identity(a.cols, s * sum((g[i, i] for i in range(a.cols)), Fraction(0)))
    rows, above = [list(row) for row in g.elements], 0
    for k in range(a.cols if rank else 0):
        if rows[k][k] == 0: raise Undecided("a rank")
        above += rows[k][k] > 0
        for i in range(k + 1, a.cols):
            f = rows[i][k] / rows[k][k]
            rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
    if above != rank: raise Undecided("a rank that depends on the tolerance")
    return rank

def range_basis(a, *tolerance):
    checked_rank(a, *tolerance)
    pivots, _ = row_echelon(a)
    return orthonormal(Matrix([[a[i, j] for j in pivots] for i in range(a.rows)],
                              a.rows, len(pivots)), a.rows)

def kernel_basis(a, *tolerance):
    checked_rank(a, *tolerance)
    return orthonormal(null_space(a), a.cols)

def floor(x):
    if not is_exact(x): raise Undecided("floor of a number that is not rational")
    return Fraction(x.numerator // x.denominator)

def units(a, c):
    """Powers of two S: least squares of log2 of the elements of inv(S)*A*S (beside the diagonal)
    and C*S. States that no output is connected with are measured from their first one."""
    n, logs = a.rows, []
    if not (exactly(a) and exactly(c)): raise Unsupported("units of irrational numbers")
    for i in range(n):
        logs += [(i, j, a[i, j]) for j in range(n) if i != j and a[i, j] != 0]
    logs += [(None, j, c[i, j]) for i in range(c.rows) for j in range(n) if c[i, j] != 0]
    normal, right = [[Fraction(0)] * n for _ in range(n)], [Fraction(0)] * n
    group = list(range(n + 1))          # connected states; n stands for the outputs
    for i, j, x in logs:
        value = function("log", abs(x)) * inverse(function("log", Fraction(2)))
        ends = [(j, 1)] if i is None else [(j, 1), (i, -1)]
        for k, s in ends:
            right[k] = right[k] - s * value
            for m, t in ends: normal[k][m] += s * t
        old, new = group[n if i is None else i], group[j]
        group = [new if g == old else g for g in group]
    for k in range(n):
        if group[k] != group[n] and group.index(group[k]) == k: normal[k][k] += 1
    exponents = invert(Matrix(normal)) * column(right)
    return diagonal([Fraction(2) ** nearest(x) for x in flat(exponents)])

def nearest(x):
    """The nearest whole number. A ball around k + 1/2 is undecided; around k it is k."""
    k = (middle(x) + Fraction(1, 2)).__floor__()
    if upper(x - k) >= Fraction(1, 2): raise Undecided("a rounding")
    return k

def chebyshev(k, u):
    """T_k(u) by T_k = 2 u T_(k-1) - T_(k-2)."""
    before, now = u, Fraction(1)
    for _ in range(k): before, now = now, 2 * (u * now) - before
    return now

def choose_element(name):
    keep = (lambda s: s >= 0) if name == "max" else (lambda s: s <= 0)

    def pick(x, y): return x if keep(order(x, y)) else y

    def apply(*values):
        if len(values) == 1: values = [number(x) for x in flat(values[0])]
        result = values[0]
        for value in values[1:]: result = elementwise(pick)(result, value)
        return result
    return apply

def norm(a):
    if 1 in a.shape(): return function("sqrt", sum((x * x for x in flat(a)), Fraction(0)))
    return spectral_norm(a)

def pseudo_inverse(a):
    t = a.transposed()
    return invert(t * a) * t if a.rows >= a.cols else t * invert(a * t)

def skew(v):
    a, b, c = flat(v)
    zero = Fraction(0)
    return Matrix([[zero, -c, b], [c, zero, -a], [-b, a, zero]])

def kronecker(a, b):
    return Matrix([[x * y for x in row for y in other] for row in a.elements
                   for other in b.elements], a.rows * b.rows, a.cols * b.cols)

def discretized(a, b, t):
    n, m = a.rows, b.cols
    joined = Matrix([list(a.elements[i]) + list(b.elements[i]) for i in range(n)] +
                    [[Fraction(0)] * (n + m)] * m)
    return Matrix(matrix_exponential(t * joined).elements[:n], n, n + m)

def diagonal_or_its_matrix(a):
    if 1 in a.shape(): return diagonal(flat(a))
    return column([a[i, i] for i in range(a.rows)])

def ones(n, m=None):
    m = (m or n).whole()
    return Matrix([[Fraction(1)] * m for _ in range(n.whole())], n.whole(), m)

def each(operation): return lambda a: a.map(operation)

def stacked(items):
    if len({x.cols for x in items}) > 1: raise Unsupported("different widths in vertcat")
    return Matrix([row for x in items for row in x.elements], sum(x.rows for x in items),
                  items[0].cols)

def block_diagonal(items):
    cols, rows, before = sum(x.cols for x in items), [], 0
    for x in items:
        for row in x.elements:
            rows.append([Fraction(0)] * before + list(row) +
                        [Fraction(0)] * (cols - before - x.cols))
        before += x.cols
    return Matrix(rows, len(rows), cols)

LISTS = {
    "sum": lambda items: sum(items[1:], items[0]) if items else number(Fraction(0)),
    "vertcat": stacked,
    "horzcat": lambda items: stacked([x.transposed() for x in items]).transposed(),
    "blkdiag": block_diagonal,
}
BUILTINS = {
    "He": lambda a: a + a.transposed(),
    "inv": invert, "pinv": pseudo_inverse, "expm": matrix_exponential,
    "tan": each(lambda x: function("sin", x) * inverse(function("cos", x))),
    "log10": each(lambda x: function("log", x) * inverse(function("log", Fraction(10)))),
    "abs": each(lambda x: x if sign(x) >= 0 else -x),
    "sign": each(lambda x: Fraction(sign(x))),
    "floor": each(floor), "ceil": each(lambda x: -floor(-x)),
    "mod": elementwise(lambda x, y: x - y * floor(x * inverse(y))),
    "min": choose_element("min"), "max": choose_element("max"),
    "trace": lambda a: number(sum((a[i, i] for i in range(a.rows)), Fraction(0))),
    "det": lambda a: number(determinant(a)),
    "norm": lambda a: number(norm(a)),
    "eye": lambda n: identity(n.whole()),
    "zeros": lambda n, m=None: zeros(n.whole(), (m or n).whole()),
    "ones": ones, "diag": diagonal_or_its_matrix, "kron": kronecker, "skew": skew,
    "orth": range_basis, "null": kernel_basis, "units": units,
    "rank": lambda a, *tolerance: number(Fraction(checked_rank(a, *tolerance))),
    "obsv": observability,
    "ctrb": lambda a, b: observability(a.transposed(), b.transposed()).transposed(),
    "c2d": discretized,
    "gramian": gramian,
    "backward_gramian": lambda f, hc, j, hd, t: gramian(f, hc, j, hd, t, True),
    "lyap": lambda a, q: lyapunov(a, q, False),
    "dlyap": lambda a, q: lyapunov(a, q, True),
    "chebyshev": lambda k, s, low, high: number(chebyshev(
        k.whole(), (2 * s.number() - low.number() - high.number()) *
        inverse(high.number() - low.number()))),
}
BUILTINS.update({name: each(lambda x, name=name: function(name, x))
                 for name in ("exp", "sin", "cos", "sqrt", "log")})
BUILTINS.update({name: each(hyperbolic(name)) for name in ("sinh", "cosh", "tanh")})

def builtin(name, arguments, scope):
    if name == "where":
        return choose(arguments[0], matrix(arguments[1], scope), matrix(arguments[2], scope), scope)
    if name == "jacobian": return jacobian(arguments[0], arguments[1], scope)
    if name in LISTS:
        items = list_items(arguments, scope)
        if name == "sum" and len(arguments) == 1: return number(sum(flat(items[0]), Fraction(0)))
        return LISTS[name](items)
    if name not in BUILTINS: raise Unsupported("the function " + name)
    return BUILTINS[name](*[matrix(x, scope) for x in arguments])

def list_items(arguments, scope):
    """The values of sum(i in 1..N, M) and the like; or those of the arguments."""
    scopes = [scope]
    while arguments[0][0] == "range":
        _, name, low, high = arguments[0]
        scopes = [Scope(s, {name: number(Fraction(k))}) for s in scopes
                  for k in range(matrix(low, s).whole(), matrix(high, s).whole() + 1)]
        arguments = arguments[1:]
    return [matrix(x, s) for s in scopes for x in arguments]

OPEN_JACOBIANS = []

def jacobian(expression, variable, scope):
    """The derivatives of the expression by an argument or a variable of forall, by dual numbers.

    Definitions without arguments do not depend on such a variable. A jacobian within a jacobian
    would mix the derivatives of both and is refused, and so is one by a datum.
    """
    name = variable[1] if variable[0] == "name" else ""
    if not scope.is_local(name):
        raise Unsupported("a jacobian by what is not a variable or an argument")
    value = scope.find(name)
    if OPEN_JACOBIANS: raise Unsupported("a jacobian within a jacobian")
    seeds = Matrix([[Dual(value[i, j], {i + j * value.rows: Fraction(1)})
                     for j in range(value.cols)] for i in range(value.rows)])
    OPEN_JACOBIANS.append(name)
    try:
        result = matrix(expression, Scope(scope, {name: seeds}))
    finally:
        OPEN_JACOBIANS.pop()
    slopes = [x.slopes if isinstance(x, Dual) else {}
              for j in range(result.cols) for x in [result[i, j] for i in range(result.rows)]]
    size = value.rows * value.cols
    return Matrix([[s.get(k, Fraction(0)) for k in range(size)] for s in slopes], len(slopes), size)
