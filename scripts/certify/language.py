"""The matrix language of docs/language.md: text -> tree -> matrix.

The elements of a matrix are numbers of any kind of arithmetic.py. So the same text gives exact
values, enclosures for all values of a variable, derivatives, or functions of the unknowns.
A name or function that is not here raises Unsupported.
"""
import operator, re
from collections import namedtuple
from fractions import Fraction
from functools import cache, partial, reduce
from itertools import islice
from arithmetic import (BITS, PI, Affine, Dual, Taylor, Undecided, Unsupported, ball, function,
                        inverse, is_exact, is_zero, middle, sign, upper)
from matrices import (Matrix, beside, column, diagonal, exactly, filled, flat, identity, invert,
                      join_blocks, null_space, number, pivots_of, reduced, spectral_norm, stacked,
                      zeros)
# Trees: a tuple of a kind and its parts. In 2./v the point belongs to the operator.
TOKEN = re.compile(r"""\s*(?:
    (?P<number>\d+(?=\.[*/^])|(?:\d+(?:\.(?!\.)\d*)?|\.\d+)(?:[eE][+-]?\d+)?)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<sign>\.\.|\.\^|\.\*|\./|<=|>=|==|!=|[-+*/^'()\[\],;:<>{}])
  | (?P<other>\S))""", re.X)
DECIMAL = re.compile(r"-?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")
RELATIONS = {"<": operator.lt, ">": operator.gt, "<=": operator.le, ">=": operator.ge,
             "==": operator.eq, "!=": operator.ne}
LEVELS = {"or": 1, "and": 2, **dict.fromkeys(RELATIONS, 4), "+": 5, "-": 5,
          **dict.fromkeys(("*", "/", ".*", "./"), 6)}      # not: 3, a sign: 6, beside * and /: 7
LONGEST = 100_000       # characters of a formula

class Parser:
    """Recursive descent by the levels of operators."""
    def __init__(self, text):
        if len(text) > LONGEST: raise Unsupported("a formula of more than %d characters" % LONGEST)
        self.text, self.at = text, 0
        self.tokens = [(m.lastgroup, m.group(m.lastgroup)) for m in TOKEN.finditer(text)]
        self.tokens += [("end", ""), ("end", "")]
    def next_is(self, *texts, ahead=0): return self.tokens[self.at + ahead][1] in texts
    def take(self):
        self.at += 1
        return self.tokens[self.at - 1][1]
    def taken(self, *texts): return self.take() if self.next_is(*texts) else None
    def expect(self, text):
        if not self.taken(text): raise Unsupported("%r is missing in %r" % (text, self.text[:60]))
    def whole(self, read):
        tree = read(self)
        if self.tokens[self.at][0] == "end": return tree
        raise Unsupported("%r in %r" % (self.tokens[self.at][1], self.text[:60]))
    def expression(self, level=1):
        """Operators of this level and above, from left to right."""
        if self.taken("not"): tree = ("not", self.expression(3))
        elif self.taken("-"): tree = ("minus", self.expression(max(level, 6)))
        elif self.taken("+"): tree = self.expression(max(level, 6))
        else: tree = self.factor()
        chain = None        # of comparisons
        while self.next_is(*LEVELS) and LEVELS[self.tokens[self.at][1]] >= level:
            sign_ = self.take()
            right = self.expression(LEVELS[sign_] + 1)
            if sign_ not in RELATIONS: tree = (sign_, tree, right)
            elif tree is chain: tree[1].extend([sign_, right])
            else: tree = chain = ("compare", [tree, sign_, right])
        return tree
    def factor(self):
        """A value with what follows it, from left to right: A^2' is (A^2)'."""
        tree = self.value()
        while True:
            if self.taken("'"): tree = ("'", tree)
            elif self.next_is("^", ".^"):
                power, negative = self.take(), self.taken("-")
                tree = (power, tree, ("minus", self.value()) if negative else self.value())
            elif self.taken("("):
                tree = ("call", tree, [] if self.next_is(")") else self.listed(self.argument, ","))
                self.expect(")")
            else: return tree
    def listed(self, read, separator):
        found = [read()]
        while self.taken(separator): found.append(read())
        return found
    def argument(self):
        if self.taken(":"): return ("all",)
        if self.next_is("in", ahead=1):
            name, _, low = self.take(), self.take(), self.expression(5)
            self.expect("..")
            return ("range", name, low, self.expression(5))
        tree = self.expression()
        return ("span", tree, self.expression(5)) if self.taken(":") else tree
    def value(self):
        kind = self.tokens[self.at][0]
        if kind == "number": return (kind, decimal(self.take()))
        if kind == "name": return (kind, self.take())
        if self.taken("("):
            tree = self.expression()
            self.expect(")")
            return tree
        self.expect("[")
        rows = self.listed(lambda: self.listed(self.entry, ","), ";")
        self.expect("]")
        return ("block", rows)
    def entry(self):
        """An entry of a matrix; None for a * that stands alone."""
        alone = self.next_is("*") and self.next_is(",", ";", "]", ahead=1)
        if alone: self.take()
        return None if alone else self.expression()
def decimal(text):
    """The fraction that a decimal is."""
    if len(text) < 2000 and DECIMAL.fullmatch(text): return Fraction(text)
    raise Unsupported("the number %s" % text[:40])
@cache
def parse(text): return Parser(text).whole(Parser.expression)
def parse_range(text): return Parser(text).whole(Parser.argument)
# Names.
class Scope:
    """Names with their values; an inner scope hides names of the outer one."""
    def __init__(self, outer=None, names=()): self.outer, self.names = outer, dict(names)
    def find(self, name):
        """The value of a name, or None."""
        if name not in self.names: return self.outer and self.outer.find(name)
        value = self.names[name]
        return value.get() if isinstance(value, Later) else value
    def is_local(self, name):       # of a variable or an argument, not a datum or a definition
        return self.outer is not None and (name in self.names or self.outer.is_local(name))
class Later:
    """A value that is computed when it is first used, once."""
    def __init__(self, compute): self.get = cache(compute)
# A definition with arguments, or an unknown that is a function.
Function = namedtuple("Function", "apply")
def defined(names, text, scope):
    """The function of these arguments that the text is."""
    def apply(*values):
        if len(values) < len(names): raise Unsupported("the number of arguments")
        return matrix(parse(text), Scope(scope, zip(names, values)))
    return Function(apply)
class Family(dict): """Members by their indices, a tuple of whole numbers."""
# Evaluation.
CONSTANTS = {"I": Matrix([[Fraction(1)]], flexible=True), "pi": number(PI)}
def evaluate(tree, scope):      # the matrix (or Function, Family) that a tree means
    kind, *parts = tree
    if kind == "number": return number(parts[0])
    if kind == "call": return call(*parts, scope)
    if kind == "block": return join_blocks([[t and matrix(t, scope) for t in r] for r in parts[0]])
    if kind in OPERATORS: return OPERATORS[kind](*[matrix(x, scope) for x in parts])
    if kind != "name": raise Unsupported("a condition where a value is expected")
    value = scope.find(parts[0])
    if value is None and parts[0] not in CONSTANTS: raise Unsupported("the name " + parts[0])
    return CONSTANTS[parts[0]] if value is None else value
def matrix(tree, scope):
    value = evaluate(tree, scope)
    if not isinstance(value, Matrix): raise Unsupported("a function where a value is expected")
    return value
def elementwise(operation):
    """The operation on equal shapes, or on a number and a matrix."""
    def apply(a, b):
        if not (a.is_number() or b.is_number()) and a.shape() != b.shape():
            raise Unsupported("different shapes")
        rows, cols = (b if a.is_number() else a).shape()
        return filled(rows, cols, lambda i, j: operation(a.spread(i, j), b.spread(i, j)))
    return apply
def repeated(base, k, one):         # base^k
    if abs(k) > 10_000: raise Unsupported("an exponent above 10000")
    return reduce(operator.mul, [base] * abs(int(k)), one)
def power_of_number(x, k):
    whole = is_exact(k) and k.denominator == 1
    if whole: return repeated(x if k >= 0 else inverse(x), k, Fraction(1))
    return function("sqrt", x) if k == Fraction(1, 2) else function("exp", k * function("log", x))
def power(base, exponent):
    if base.is_number(): return base.map(lambda x: power_of_number(x, exponent.number()))
    k = exponent.whole()
    return repeated(base if k >= 0 else invert(base), k, identity(base.rows))
OPERATORS = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "minus": operator.neg, "^": power,
    "'": Matrix.transposed, "/": lambda a, b: a.map(lambda x, y=b.number(): x * inverse(y)),
    ".*": elementwise(operator.mul), "./": elementwise(lambda x, y: x * inverse(y)),
    ".^": elementwise(power_of_number)}
def call(head, arguments, scope):
    """f(...), a member of a family, an element or part of a matrix, or a built-in function."""
    if head[0] == "name" and scope.find(head[1]) is None: return builtin(head[1], arguments, scope)
    if head[0] == "call" and head[1] == ("name", "derivative"):
        unknown = evaluate(head[2][0], scope)
        if isinstance(unknown, Function) and len(arguments) == 1:
            found = at_duals(unknown.apply, number(matrix(arguments[0], scope).number()))
            return found.map(lambda x: slope(x, 1))
        raise Unsupported("the derivative of what is not an unknown function")
    value = evaluate(head, scope)
    if isinstance(value, Function): return value.apply(*[matrix(x, scope) for x in arguments])
    if isinstance(value, Matrix): return part_of(value, arguments, scope)
    last = with_end(scope, max(k[0] for k in value))
    key = tuple(matrix(x, last).whole() for x in arguments)
    if key in value: return value[key]
    raise Unsupported("the member %s of a family" % (key,))
def with_end(scope, last): return Scope(scope, {"end": number(Fraction(last))})
def part_of(value, arguments, scope):
    """M(i, j), v(i); an index is a number, lo:hi or : alone."""
    def places(tree, length):
        if tree == ("all",): return range(length)
        ends = [matrix(x, with_end(scope, length)).whole()
                for x in (tree[1:] if tree[0] == "span" else [tree])]
        if ends[0] >= 1 and ends[-1] <= length: return range(ends[0] - 1, ends[-1])
        raise Unsupported("an index beyond the size of a matrix")
    if len(arguments) == 1 and 1 in value.shape():
        arguments = arguments + [("all",)] if value.cols == 1 else [("all",)] + arguments
    if len(arguments) != 2: raise Unsupported("the number of indices")
    return value.part(places(arguments[0], value.rows), places(arguments[1], value.cols))
def relation(name): return elementwise(lambda x, y: RELATIONS[name](sign(x - y), 0))
both, either = elementwise(operator.and_), elementwise(operator.or_)
def truths(tree, scope):        # of a condition, element by element
    kind, *parts = tree
    if kind == "not": return truths(parts[0], scope).map(operator.not_)
    if kind in ("and", "or"):
        return (both if kind == "and" else either)(*[truths(x, scope) for x in parts])
    if kind != "compare": raise Unsupported("a value where a condition is expected")
    values, names = [matrix(x, scope) for x in parts[0][::2]], parts[0][1::2]
    return reduce(both, [relation(r)(a, b) for a, r, b in zip(values, names, values[1:])])
def holds(tree, scope): return all(flat(truths(tree, scope)))
def choose(condition, yes, no, scope):
    found = truths(condition, scope)
    if found.is_number(): return yes if found.number() else no
    return filled(*found.shape(), lambda i, j: (yes if found[i, j] else no).spread(i, j))
# The matrix exponential.
def matrix_exponential(a):
    """expm(a) by parts that commute, or by scaling, Taylor series and squaring."""
    if any(isinstance(x, (Affine, Dual)) for x in flat(a)):
        raise Unsupported("expm of unknowns, or its derivative")
    model = next((x for x in flat(a) if isinstance(x, Taylor)), None)
    parts = affine_parts(a, model) if model else None
    if parts: return reduce(operator.mul, parts)
    halvings, norm = 0 if model else 8, row_sum(a)
    while norm > Fraction(2 ** halvings, 4): halvings += 1
    if halvings > 60: raise Undecided("expm of a large matrix")
    total = exponential_series(a.map(lambda x: x if is_zero(x) else
                                     (ball(x) if is_exact(x) else x) * Fraction(1, 2 ** halvings)))
    for _ in range(halvings): total = total * total
    return total
def row_sum(a): return max(sum(upper(x) for x in row) for row in a.elements)
def affine_parts(a, model):
    """The exponentials of M_0 and of all M_e t^e, where a = M_0 + sum M_e t^e, if all M are exact
    and commute; else None. So the error of the one does not grow with the norm of the other."""
    elements = a.map(lambda x: x if isinstance(x, Taylor) else model.lift(x))
    exponents = sorted({e for x in flat(elements) for e in x.terms})
    parts = [elements.map(lambda x, e=e: x.terms.get(e, Fraction(0))) for e in exponents]
    if any(x.rest for x in flat(elements)) or any(sum(e) > 1 for e in exponents) or \
            not all(map(exactly, parts)) or \
            any((m * n).elements != (n * m).elements for m in parts for n in parts): return None
    return [exponential_series(m, lambda x, j, e=e: model.like({tuple(j * k for k in e): ball(x)}),
                               model.space[1]) if any(e) else matrix_exponential(m)
            for m, e in zip(parts, exponents)]
def exponential_series(a, embed=lambda x, j: x, last=None):
    """The series of expm(a), up to the term a^j/j! with j = last or where it is tiny; the elements
    x of this term are replaced by embed(x, j), such as x t^j for expm(a t). With n, the largest sum
    of a row of |a|, the rest is at most n^(j+1)/(j+1)! exp(n). It does not touch an element (i, k)
    if no power of a does: if there is no path from i to k."""
    total, term, j = identity(a.rows), identity(a.rows), 0
    norm, bound = row_sum(a), Fraction(1)
    while j != last and bound > Fraction(1, 2 ** (BITS - 20)):
        j += 1
        bound = bound * norm / j
        term = (term * a).map(lambda x: x * Fraction(1, j))
        total = total + term.map(lambda x: x if is_zero(x) else embed(x, j))
    error = (ball(bound * norm / (j + 1)) * function("exp", ball(norm))).size() + 1
    paths = a.map(lambda x: not is_zero(x)).elements
    for k, row in enumerate(paths):
        for i in range(a.rows):
            if paths[i][k]: paths[i] = [x or y for x, y in zip(paths[i], paths[k])]
    return filled(a.rows, a.rows, lambda i, k: total[i, k] if not paths[i][k] else
                  (ball(total[i, k]) if is_exact(total[i, k]) else total[i, k]).widened(error))
# Functions.
def determinant(a):         # by rows, with one minor of the last rows for each set of columns
    @cache
    def minor(columns):
        row = a.elements[a.rows - len(columns)] if columns else []
        return sum(((-1) ** j * row[k] * minor(columns[:j] + columns[j + 1:])
                    for j, k in enumerate(columns) if not is_zero(row[k])), Fraction(not columns))
    return minor(tuple(range(a.rows)))
def observability(a, c):
    return stacked([c * repeated(a, k, identity(a.rows)) for k in range(max(a.rows, 1))])
def solved(system, q):
    """X of S vec X + vec Q = 0, where vec writes the columns one below the other."""
    x = invert(system) * column([-y for y in flat(q.transposed())])
    return filled(q.rows, q.rows, lambda i, j: x[j * q.rows + i, 0])
def gramian(f, hc, j, hd, lengths, backward=False):
    """Sum over flows and the jumps between them of the outputs' squares, x'W x, by the state at the
    start (or at the end). expm([-F', H'H; 0, F] t) = [.., expm(-F't) W; 0, expm(F t)]."""
    n, total, moved = f.rows, zeros(f.rows, f.rows), identity(f.rows)
    generator = join_blocks([[-f.transposed(), squared(hc)], [zeros(n, n), f]])
    both = cache(lambda t: matrix_exponential(generator.map(lambda x: x * t)))
    for k, t in enumerate(flat(lengths)):
        if k: total, moved = total + squared(hd * moved), j * moved
        seen, flow = [both(t).part(rows, range(n, 2 * n)) for rows in (range(n), range(n, 2 * n))]
        total, moved = total + moved.transposed() * flow.transposed() * seen * moved, flow * moved
    back = invert(moved) if backward else identity(n)
    return back.transposed() * total * back
def squared(a): return a.transposed() * a
def orthonormal(subspace, a, *tolerance):
    """The basis of docs/language.md of the range or kernel of a matrix whose rank is checked: the
    pivoted Cholesky factor of the projector."""
    checked_rank(a, *tolerance)
    basis, columns, e = subspace(a), [], function("exp", ball(1))
    size = basis.rows
    if basis.cols in (0, size): return identity(size).part(range(size), range(basis.cols))
    w = basis * invert(squared(basis)) * basis.transposed()
    for _ in range(basis.cols):
        r = [w[i, i] for i in range(size)]
        largest = max(middle(x) + upper(x - middle(x)) for x in r)
        p = next(i for i in range(size) if sign(e * r[i] - largest) >= 0)
        b = [w[i, p] * inverse(function("sqrt", r[p])) for i in range(size)]
        columns.append(column(b))
        w = filled(size, size, lambda i, j: Fraction(0) if p in (i, j) else w[i, j] - b[i] * b[j])
    return beside(columns)
def checked_rank(a, tolerance=number(Fraction(1, 10 ** 12))):
    """The rank of a matrix of fractions, if all singular values but those that are 0 are above the
    tolerance times the largest one. By inertia: the positive pivots of a'a - s I count the
    eigenvalues of a'a above s; here s = (tolerance)^2 trace(a'a), and trace >= largest."""
    if not exactly(a): raise Unsupported("the rank of numbers that are not rational")
    rank, s = len(reduced(a, a.cols)[0]), tolerance.number() ** 2 * sum(x * x for x in flat(a))
    pivots = list(pivots_of((squared(a) - identity(a.cols, s)).elements)) if rank else []
    if 0 in pivots or sum(p > 0 for p in pivots) != rank:
        raise Undecided("a rank that depends on the tolerance")
    return rank
def floor(x):
    if not is_exact(x): raise Undecided("floor of a number that is not rational")
    return Fraction(x.numerator // x.denominator)
def units(a, c):
    """Powers of two S: least squares of log2 of the elements of inv(S)*A*S (beside the diagonal)
    and C*S. Exponents that these leave open are 0, of the first state of each group that no output
    is connected with: in the elimination from the last state to the first it has no pivot."""
    n = a.rows
    if not (exactly(a) and exactly(c)): raise Unsupported("units of irrational numbers")
    logs = [(i, j, a[i, j]) for i in range(n) for j in range(n) if i != j and a[i, j] != 0]
    logs += [(None, j, row[j]) for row in c.elements for j in range(n) if row[j] != 0]
    normal = zeros(n, n + 1)            # columns: the states from the last to the first, log2
    for i, j, x in logs:
        value = function("log", abs(x)) * inverse(function("log", Fraction(2)))
        ends = [(j, 1)] + ([(i, -1)] if i is not None else [])
        for k, s in ends:
            normal.elements[k][n] -= s * value
            for m, t in ends: normal.elements[k][n - 1 - m] += s * t
    pivots, rows = reduced(normal, n)
    exponents = {n - 1 - p: row[n] for p, row in zip(pivots, rows)}
    return diagonal([Fraction(2) ** nearest(exponents.get(k, Fraction(0))) for k in range(n)])
def nearest(x):
    """The nearest whole number, upward from 0.4863 on. A ball around such a limit is undecided."""
    x = x + Fraction(137, 10000)
    k = floor(middle(x) + Fraction(1, 2))
    if upper(x - k) >= Fraction(1, 2): raise Undecided("a rounding")
    return k
def basis_functions(t, span=None):
    """b_k(t) for k = 0, 1, ...: powers b_k = t b_(k-1), or the Chebyshev polynomials on the span,
    b_k = 2 u b_(k-1) - b_(k-2) with u = (2 t - low - high)/(high - low)."""
    u = span and (t - span[0]) * (2 * inverse(span[1] - span[0])) - 1
    before, b = u, Fraction(1)
    while True:
        yield b
        before, b = b, 2 * (u * b) - before if span else t * b
def chebyshev(k, t, low, high):
    functions = basis_functions(t.number(), (low.number(), high.number()))
    return number(next(islice(functions, k.whole(), None)))
def extreme(name):
    """The largest or smallest, element by element, or of the elements of one argument."""
    best = elementwise(lambda x, y: x if RELATIONS[name](sign(x - y), 0) else y)
    return lambda *a: reduce(best, a if len(a) > 1 else [number(x) for x in flat(a[0])])
def kronecker(a, b):
    return Matrix([[x * y for x in row for y in other] for row in a.elements
                   for other in b.elements], a.rows * b.rows, a.cols * b.cols)
def discretized(a, b, t):
    n, m = a.rows, b.cols
    joined = stacked([beside([a, b]), zeros(m, n + m)])
    return matrix_exponential(t * joined).part(range(n), range(n + m))
def each(operation): return lambda a: a.map(operation)
def shaped(x): return lambda n, m=None: filled(n.whole(), (m or n).whole(), lambda i, j: x)
def diagonal_or_its_matrix(a):
    return diagonal(flat(a)) if 1 in a.shape() else column([a[i, i] for i in range(a.rows)])
def block_diagonal(items):
    return stacked([beside([x if i == j else zeros(x.rows, y.cols) for j, y in enumerate(items)])
                    for i, x in enumerate(items)])
LISTS = {"sum": lambda items: reduce(operator.add, items or [number(Fraction(0))]),
         "vertcat": stacked, "horzcat": beside, "blkdiag": block_diagonal}
BUILTINS = {
    "inv": invert, "expm": matrix_exponential, "floor": each(floor),
    **{name: each(lambda x, name=name: function(name, x))
       for name in ("exp", "sin", "cos", "sqrt", "log")},
    "min": extreme("<="), "max": extreme(">="), "diag": diagonal_or_its_matrix,
    "det": lambda a: number(determinant(a)), "norm": lambda a: number(spectral_norm(a)),
    "eye": lambda n: identity(n.whole()), "zeros": shaped(Fraction(0)), "ones": shaped(Fraction(1)),
    "pinv": lambda a: (invert(squared(a)) * a.transposed() if a.rows >= a.cols else
                       a.transposed() * invert(squared(a.transposed()))),
    "kron": kronecker, 
    "orth": partial(orthonormal, lambda a: a.part(range(a.rows), reduced(a, a.cols)[0])),
    "null": partial(orthonormal, null_space), "units": units,
    "rank": lambda *arguments: number(Fraction(checked_rank(*arguments))),
    "obsv": observability, "c2d": discretized, "gramian": gramian, "chebyshev": chebyshev,
    "backward_gramian": partial(gramian, backward=True),
    "lyap": lambda a, q: solved(kronecker(identity(a.rows), a) + kronecker(a, identity(a.rows)), q),
    "dlyap": lambda a, q: solved(kronecker(a, a) - identity(a.rows ** 2), q)}
# Functions that the language can define.
DEFINITIONS = {name: defined(arguments.split(), text, Scope()) for name, arguments, text in (
    ("He", "A", "A + A'"), ("ctrb", "A B", "obsv(A', B')'"), ("tan", "x", "sin(x)./cos(x)"),
    ("sinh", "x", "(exp(x) - exp(-x))/2"), ("cosh", "x", "(exp(x) + exp(-x))/2"),
    ("tanh", "x", "sinh(x)./cosh(x)"), ("log10", "x", "log(x)/log(10)"),
    ("abs", "x", "where(x >= 0, x, -x)"), ("sign", "x", "where(x > 0, 1, where(x < 0, -1, 0))"),
    ("ceil", "x", "-floor(-x)"), ("mod", "a b", "a - b.*floor(a./b)"),
    ("trace", "A", "sum(diag(A))"),
    ("skew", "v", "[0, -v(3), v(2); v(3), 0, -v(1); -v(2), v(1), 0]"))}
def builtin(name, arguments, scope):
    if name == "where":
        return choose(arguments[0], *[matrix(x, scope) for x in arguments[1:]], scope)
    if name == "jacobian": return jacobian(*arguments, scope)
    if name in LISTS:           # of arguments, or of sum(i in 1..N, M) and the like
        ranges = [x for x in arguments if x[0] == "range"]
        items = [matrix(x, s) for _, s in members(ranges, scope) for x in arguments[len(ranges):]]
        if name == "sum" and len(arguments) == 1: items = [number(x) for x in flat(items[0])]
        return LISTS[name](items)
    values = [matrix(x, scope) for x in arguments]
    if any(x.flexible for x in values): raise Unsupported(name + " of I, whose size is not known")
    if name in DEFINITIONS: return DEFINITIONS[name].apply(*values)
    if name not in BUILTINS: raise Unsupported("the function " + name)
    return BUILTINS[name](*values)
def members(ranges, scope):
    """[(indices, scope)] of several i in low..high."""
    found = [((), scope)]
    for _, name, low, high in ranges:
        found = [(key + (k,), Scope(s, {name: number(Fraction(k))})) for key, s in found
                 for k in range(matrix(low, s).whole(), matrix(high, s).whole() + 1)]
    return found
OPEN_JACOBIANS = []
def at_duals(apply, value):
    """apply(value), with derivatives by the elements of the value, one column below the other. A
    jacobian within a jacobian would mix the derivatives of both."""
    if OPEN_JACOBIANS: raise Unsupported("a jacobian within a jacobian")
    OPEN_JACOBIANS.append(value)
    try:
        return apply(filled(*value.shape(), lambda i, j: Dual({
            0: value[i, j], 1 + i + j * value.rows: Fraction(1)})))
    finally: OPEN_JACOBIANS.pop()
def slope(x, k): return x.terms.get(k, Fraction(0)) if isinstance(x, Dual) else Fraction(0)
def jacobian(expression, variable, scope):
    """The derivatives of the expression by an argument or a variable of forall. Definitions without
    arguments do not depend on such a variable. A jacobian by a datum is refused."""
    if variable[0] != "name" or not scope.is_local(variable[1]):
        raise Unsupported("a jacobian by what is not a variable or an argument")
    value = scope.find(variable[1])
    found = at_duals(lambda x: matrix(expression, Scope(scope, {variable[1]: x})), value)
    found, size = flat(found.transposed()), value.rows * value.cols
    return filled(len(found), size, lambda i, k: slope(found[i], k + 1))
