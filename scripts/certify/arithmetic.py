"""The numbers of the proofs. Nothing here is floating point.

    Fraction   a rational number, exact
    Ball       all reals x with |x - m/2^320| <= r/2^320, where m and r are whole numbers
    Taylor     all functions of t in [-1, 1]^k that differ from a polynomial by at most a remainder
    Affine     c_0 + c_1 x_1 + ... + c_m x_m in the unknowns x
    Dual       a value with its first derivatives

Every operation returns a set that contains all results of the operation on members of its
arguments. Two kinds may be mixed; the result has the later kind of the list. A question that a
set cannot answer, such as the sign of a ball around 0, raises Undecided.
"""
from fractions import Fraction
from math import factorial, isqrt
from operator import add
BITS = 320
ONE = 1 << BITS
class Undecided(Exception): """The enclosure is too wide to answer the question."""
class Unsupported(Exception): """The text asks for something that this checker does not know."""
def is_exact(x): return x.__class__ is Fraction or x.__class__ is int
def is_zero(x): return is_exact(x) and x == 0
def level(x): return 0 if is_exact(x) else x.level      # the place of its kind in the list above

class Number:
    """The operators of all kinds but fractions."""
    __slots__ = ()
    def __add__(self, other): return self.at_level(other, lambda a, b: a.plus(b))
    def __sub__(self, other): return self + (-other)
    def __rsub__(self, other): return (-self) + other
    def __mul__(self, other):
        if is_exact(other):
            return Fraction(0) if other == 0 else self if other == 1 else self.scaled(other)
        return self.at_level(other, lambda a, b: a.times(b))
    def at_level(self, other, operation):
        """The operation on both numbers in the later of their kinds."""
        if level(other) > self.level: return operation(other.lift(self), other)
        return operation(self, self.lift(other) if level(other) < self.level else other)
    __radd__, __rmul__ = __add__, __mul__
class Ball(Number):
    """The interval [m - r, m + r]/2^320."""
    __slots__, level = ("m", "r"), 1
    def __init__(self, m, r=0): self.m, self.r = m, r
    def lift(self, x): return ball(x)
    def size(self): return abs(self.m) + self.r         # at least |x| 2^320
    def plus(self, other): return Ball(self.m + other.m, self.r + other.r)
    def times(self, other): return sum_of_balls([(self, other)])
    def widened(self, error): return Ball(self.m, self.r + error)
    def __neg__(self): return Ball(-self.m, self.r)
    def scaled(self, q):
        n, d = q.numerator, q.denominator
        return Ball(self.m * n // d, self.r * abs(n) // d + 2)
def ball(x):
    """The ball of a fraction; a ball stays as it is."""
    if isinstance(x, Ball): return x
    if not is_exact(x): raise Unsupported("a number is expected, not a function")
    m, rest = divmod(x.numerator << BITS, x.denominator)
    return Ball(m, 1 if rest else 0)
def sum_of_balls(pairs):
    """The sum of products of balls, rounded once: both shifts round down, by less than 1 each."""
    m = sum(a.m * b.m for a, b in pairs)
    r = sum(abs(a.m) * b.r + a.r * (abs(b.m) + b.r) for a, b in pairs)
    return Ball(m >> BITS, (r >> BITS) + 2)
def upper(x):           # a fraction that is at least |x|, for fractions, balls and Taylor models
    return abs(x) if is_exact(x) else Fraction(x.size(), ONE)
def middle(x):          # the fraction in the middle of a fraction or a ball
    return Fraction(x) if is_exact(x) else Fraction(ball(x).m, ONE)
class Series(Number):
    """A polynomial, the sum of terms[e] x^e, up to an error of rest/2^320."""
    def __init__(self, terms, rest=0, space=None):
        self.terms, self.rest, self.space = terms, rest, space
    def like(self, terms, rest=0): return self.__class__(terms, rest, self.space)
    def origin(self): return 0          # the exponent of the constant term
    def lift(self, x): return self.like({self.origin(): x})
    def constant(self): return self.terms.get(self.origin(), Fraction(0))
    def is_constant(self): return not self.rest and all(e == self.origin() for e in self.terms)
    def variable(self):         # what remains without the constant term
        return self.like({e: c for e, c in self.terms.items() if e != self.origin()}, self.rest)
    def __neg__(self): return self.like({e: -c for e, c in self.terms.items()}, self.rest)
    def plus(self, other):
        terms = dict(self.terms)
        for e, c in other.terms.items(): terms[e] = terms[e] + c if e in terms else c
        return self.like(terms, self.rest + other.rest)
    def scaled(self, q):
        rest = self.rest * abs(q.numerator) // q.denominator + 1 if self.rest else 0
        return self.like({e: c * q for e, c in self.terms.items()}, rest)
    def times(self, other):
        """The product of polynomials of degree 1, without terms of degree 2."""
        a, b = self.constant(), other.constant()
        terms = {e: c * b for e, c in self.terms.items()}
        for e, c in other.terms.items():
            if e != 0: terms[e] = terms[e] + a * c if e in terms else a * c
        return self.like(terms)
class Taylor(Series):
    """A polynomial in t in [-1, 1]^k with fractions or balls as coefficients, and its rest. The
    exponents e are tuples. `space` is (k, order); products drop the terms above the order and add
    their size to the rest."""
    level = 2
    def origin(self): return (0,) * self.space[0]
    def widened(self, error): return self.like(self.terms, self.rest + error)
    def size(self):             # at least |f| 2^320 on the box
        return sum(ball(c).size() for c in self.terms.values()) + self.rest
    def times(self, other):
        exact = all(map(is_exact, [*self.terms.values(), *other.terms.values()]))
        left, right = [[(e, sum(e), c if exact else ball(c)) for e, c in x.terms.items()]
                       for x in (self, other)]
        terms, rest, order = {}, 0, self.space[1]
        for e, d, a in left:
            for f, g, b in right:
                if d + g > order: rest += (ball(a).size() * ball(b).size() >> BITS) + 1
                else: terms.setdefault(tuple(map(add, e, f)), []).append((a, b))
        if self.rest or other.rest:
            polynomial = self.size() - self.rest
            rest += ((polynomial * other.rest + self.rest * other.size()) >> BITS) + 1
        total = (lambda pairs: sum(a * b for a, b in pairs)) if exact else sum_of_balls
        return self.like({e: total(pairs) for e, pairs in terms.items()}, rest)
class Affine(Series):
    """terms[0] + sum of terms[i] x_i. A product of two unknowns raises Unsupported. So a matrix
    that was evaluated with Affine elements is known to be affine in the unknowns."""
    level = 3
    def times(self, other):
        if self.is_constant() or other.is_constant(): return super().times(other)
        raise Unsupported("the text is not affine in the unknowns")
class Dual(Series):
    """terms[0] is a value, terms[k] its derivative by the k-th element of one variable."""
    level = 4
def affine_terms(x):
    """{i: c_i} of x = c_0 + sum c_i x_i, without exact zeros."""
    terms = x.terms if isinstance(x, Affine) else {0: x}
    return {i: c for i, c in terms.items() if not is_zero(c)}
def sign(x):
    """1, 0 or -1 if all members of x have this sign."""
    if is_exact(x): return (x > 0) - (x < 0)
    if isinstance(x, Affine) and not x.is_constant(): raise Unsupported("the sign of an unknown")
    if isinstance(x, (Affine, Dual)): return sign(x.constant())
    if isinstance(x, Taylor): x = ball(x.constant()).widened(x.variable().size())
    if abs(x.m) <= x.r: raise Undecided("a sign")
    return 1 if x.m > 0 else -1
def typical(x):         # a fraction near |x|, which chooses pivots; nothing is concluded from it
    if isinstance(x, Series): return typical(x.constant())
    return abs(x) if is_exact(x) else Fraction(max(abs(x.m) - x.r, 0), ONE)
# Elementary functions of balls.
def series_sum(first, ratio):
    """first (1 + ratio(0) + ratio(0) ratio(1) + ...) in balls. All ratios must be at most 1/2. Then
    all terms after one are together at most as large as this one."""
    total = term = first
    k = 0
    while abs(term.m) > 2 or k < 2:
        term = term * ratio(k)
        total, k = total + term, k + 1
    return total.widened(term.size() + 1)
def halved(x):
    """(y, k) with |y| < 2^-12, and y = m/2^k but for rounding, where m is the middle of x."""
    whole = (abs(x.m) >> BITS).bit_length()
    if whole > 20: raise Undecided("an argument above a million")
    return Ball(x.m >> (whole + 12), 1), whole + 12
def ball_exp(x):
    """exp(x) = exp(y)^(2^k). The radius of x enters by |exp(r) - 1| <= 2 r for r <= 1/4."""
    if x.r > ONE >> 2: raise Undecided("exp of a wide ball")
    y, k = halved(x)
    total = series_sum(Ball(ONE), lambda j: y.scaled(Fraction(1, j + 1)))
    for _ in range(k): total = total * total
    return total * Ball(ONE, 2 * x.r) if x.r else total
def ball_sin_cos(x):
    """sin and cos by series near 0, then doublings of the angle. |sin'|, |cos'| <= 1 adds r."""
    y, k = halved(x)
    square = -(y * y)
    s = series_sum(y, lambda j: square.scaled(Fraction(1, (2 * j + 2) * (2 * j + 3))))
    c = series_sum(Ball(ONE), lambda j: square.scaled(Fraction(1, (2 * j + 1) * (2 * j + 2))))
    for _ in range(k): s, c = 2 * (s * c), c * c - s * s
    return s.widened(x.r), c.widened(x.r)
def ball_sqrt(x):
    if x.m < x.r: raise Undecided("a root of a number that may be negative")
    low = isqrt((x.m - x.r) << BITS)
    high = isqrt((x.m + x.r) << BITS) + 1
    return Ball((low + high) >> 1, ((high - low + 1) >> 1) + 1)
def odd_series(z, s):
    """z + s z^3/3 + z^5/5 + s z^7/7 + ... for |z| <= 1/2: atanh(z) with s = 1, atan(z) with -1."""
    if z.size() > ONE >> 1: raise Undecided("a logarithm of a wide ball")
    square = z * z
    return series_sum(z, lambda j: square.scaled(Fraction(s * (2 * j + 1), 2 * j + 3)))
def ball_log(x):
    """log(x) = k log 2 + log(u), u in [1/2, 1], log(u) = 2 atanh((u - 1)/(u + 1))."""
    if x.m <= x.r: raise Undecided("a logarithm of a number that may be negative")
    k = x.m.bit_length() - BITS
    u = x * (Fraction(1, 2) ** k)
    return 2 * (odd_series((u - 1) * inverse(u + 1), 1) + k * odd_series(ball(Fraction(1, 3)), 1))
def ball_inverse(x):
    if abs(x.m) <= x.r: raise Undecided("a division by a number that may be zero")
    low = (ONE << BITS) // (abs(x.m) + x.r)
    high = -((-ONE << BITS) // (abs(x.m) - x.r))
    m = (low + high) >> 1
    return Ball(m if x.m > 0 else -m, high - m + 1)
BALL_FUNCTIONS = {"exp": ball_exp, "log": ball_log, "sqrt": ball_sqrt, "inv": ball_inverse,
                  "sin": lambda x: ball_sin_cos(x)[0], "cos": lambda x: ball_sin_cos(x)[1]}
PI = 16 * odd_series(ball(Fraction(1, 5)), -1) - 4 * odd_series(ball(Fraction(1, 239)), -1)
# Elementary functions of all kinds.
EXACT = {("exp", 0): 1, ("cos", 0): 1, ("sin", 0): 0, ("log", 1): 0}
def function(name, x):
    """exp, log, sqrt, inv, sin or cos of a number of any kind; fractions where they are known."""
    if isinstance(x, Series): return function_of_series(name, x)
    if is_exact(x):
        if (name, x) in EXACT: return Fraction(EXACT[name, x])
        if name == "inv" and x != 0: return 1 / Fraction(x)
        n, d = isqrt(abs(x.numerator)), isqrt(x.denominator)
        if name == "sqrt" and (n * n, d * d) == (x.numerator, x.denominator): return Fraction(n, d)
    return BALL_FUNCTIONS[name](ball(x))
def inverse(x): return function("inv", x)
SLOPES = {"exp": lambda p, f: f, "log": lambda p, f: inverse(p), "inv": lambda p, f: -(f * f),
          "sqrt": lambda p, f: inverse(2 * f), "sin": lambda p, f: function("cos", p),
          "cos": lambda p, f: -function("sin", p)}
EXPONENTS = {"inv": Fraction(-1), "sqrt": Fraction(1, 2), "log": Fraction(0)}
def function_of_series(name, x):
    """f(p + d) by its series in d up to the order K, where p is the constant term and |d| <= delta.
    The series of sin and cos leave at most delta^(K+1)/(K+1)!, that of exp leaves exp(p + delta)
    times this. With u = d/p, inv and sqrt are f(p) (1 + u)^a: the j-th coefficient is (a - j + 1)/j
    times the one before. With a = 0 this gives log, from its term u on. All coefficients of (1 +
    u)^a are at most 1. So for |u| <= q < 1 the series leave at most f(p) q^(K+1)/(1 - q), that of
    log without f(p)."""
    p, d = x.constant(), x.variable()
    if isinstance(x, Affine) and not x.is_constant(): raise Unsupported(name + " of an unknown")
    value = function(name, p)
    if x.is_constant(): return x.lift(value)
    if isinstance(x, Dual): return d * x.lift(SLOPES[name](p, value)) + value
    order = x.space[1]
    if name in EXPONENTS:
        d, a = d * inverse(p), EXPONENTS[name]
        delta = upper(d)
        if delta >= 1: raise Undecided("a quotient or root whose argument varies too much")
        left = delta ** (order + 1) / (1 - delta) * (1 if name == "log" else upper(value))
        series = [value, Fraction(1) if name == "log" else value * a]
        for j in range(2, order + 1): series.append(series[-1] * ((a - j + 1) / j))
    else:
        left = upper(d) ** (order + 1) / factorial(order + 1)
        if name == "exp": left *= upper(value * function("exp", ball(upper(d))))
        slope = SLOPES[name](p, value)
        cycle = [value] if name == "exp" else [value, slope, -value, -slope]
        series = [cycle[j % len(cycle)] * Fraction(1, factorial(j)) for j in range(order + 1)]
    result = x.lift(series[order])
    for c in reversed(series[:order]): result = result * d + c
    return result.widened(ball(left).size() + 1)
