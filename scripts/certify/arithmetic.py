"""The numbers of the proofs. Nothing here is floating point.

    Fraction   a rational number, exact
    Ball       all reals x with |x - m/2^320| <= r/2^320, where m and r are whole numbers
    Taylor     all functions of t in [-1, 1]^k that differ from a polynomial by at most a remainder
    Dual       a value with its first derivatives
    Affine     c_0 + c_1 x_1 + ... + c_m x_m in the unknowns x

Every operation returns a set that contains all results of the operation on members of its
arguments. Two kinds may be mixed; the result has the later kind of the list. A question that a
set cannot answer, such as the sign of a ball around 0, raises Undecided.

(The file is not called numbers.py, since the standard library has a module of that name.)
"""

from fractions import Fraction
from math import factorial, isqrt
from operator import add

BITS = 320
ONE = 1 << BITS

class Undecided(Exception):
    """The enclosure is too wide to answer the question."""

class Unsupported(Exception):
    """The text asks for something that this checker does not know."""

def is_exact(x): return x.__class__ is Fraction or x.__class__ is int

class Number:
    """The operators of all kinds but fractions. `level` orders the kinds."""
    __slots__ = ()
    level = 0
    def __add__(self, other):
        a, b = same_kind(self, other)
        return a.plus(b)

    __radd__ = __add__
    def __sub__(self, other): return self + (-other)
    def __rsub__(self, other): return (-self) + other

    def __mul__(self, other):
        if is_exact(other):
            return Fraction(0) if other == 0 else self if other == 1 else self.scaled(other)
        a, b = same_kind(self, other)
        return a.times(b)

    __rmul__ = __mul__
    def __truediv__(self, other): return self * inverse(other)
    def __rtruediv__(self, other): return other * inverse(self)

def same_kind(a, b):
    """Both numbers in the later kind of the two."""
    level_a = 0 if is_exact(a) else a.level
    level_b = 0 if is_exact(b) else b.level
    if level_a < level_b: return b.lift(a), b
    return (a, b) if level_a == level_b else (a, a.lift(b))

class Ball(Number):
    """The interval [m - r, m + r]/2^320."""
    __slots__ = ("m", "r")
    level = 1
    def __init__(self, m, r=0): self.m, self.r = m, r
    def lift(self, x): return ball(x)

    def size(self):
        """An upper bound of |x| 2^320."""
        return abs(self.m) + self.r

    def plus(self, other): return Ball(self.m + other.m, self.r + other.r)

    def times(self, other):
        # Both shifts round down, by less than 1 each.
        spread = abs(self.m) * other.r + self.r * other.size()
        return Ball((self.m * other.m) >> BITS, (spread >> BITS) + 2)

    def scaled(self, q):
        n, d = q.numerator, q.denominator
        return Ball(self.m * n // d, self.r * abs(n) // d + 2)

    def __neg__(self): return Ball(-self.m, self.r)

def ball(x):
    """The ball of a fraction; a ball stays as it is."""
    if isinstance(x, Ball): return x
    if not is_exact(x): raise Unsupported("a number is expected, not a function")
    m, rest = divmod(x.numerator << BITS, x.denominator)
    return Ball(m, 1 if rest else 0)

def upper(x):
    """A fraction that is at least |x|, for fractions, balls and Taylor models."""
    return abs(x) if is_exact(x) else Fraction(x.size(), ONE)

def middle(x):
    """The fraction in the middle of a fraction or a ball."""
    return Fraction(x) if is_exact(x) else Fraction(ball(x).m, ONE)

class Taylor(Number):
    """sum of c_e t^e plus a function between -rest/2^320 and rest/2^320, t in [-1, 1]^k.

    `terms` maps exponents e to fractions or balls. `space` is (k, order); products drop the terms
    above the order and add their size to the rest.
    """
    __slots__ = ("terms", "rest", "space")
    level = 2
    def __init__(self, terms, rest, space): self.terms, self.rest, self.space = terms, rest, space
    def lift(self, x): return Taylor({self.origin(): x}, 0, self.space)
    def origin(self): return (0,) * self.space[0]
    def constant(self): return self.terms.get(self.origin(), Fraction(0))

    def without_constant(self):
        terms = {e: c for e, c in self.terms.items() if any(e)}
        return Taylor(terms, self.rest, self.space)

    def size(self):
        """An upper bound of |f| 2^320 on the box."""
        return sum(ball(c).size() for c in self.terms.values()) + self.rest

    def plus(self, other):
        terms = dict(self.terms)
        for e, c in other.terms.items():
            terms[e] = terms[e] + c if e in terms else c
        return Taylor(terms, self.rest + other.rest, self.space)

    def times(self, other):
        left = [(e, sum(e), c) for e, c in self.terms.items()]
        right = [(e, sum(e), c) for e, c in other.terms.items()]
        exact = all(is_exact(c) for _, _, c in left + right)
        if not exact:
            left = [(e, d, ball(c)) for e, d, c in left]
            right = [(e, d, ball(c)) for e, d, c in right]
        terms, rest, order = {}, 0, self.space[1]
        for e, d, a in left:
            for f, g, b in right:
                if d + g > order: rest += (ball(a).size() * ball(b).size() >> BITS) + 1
                else: terms.setdefault(tuple(map(add, e, f)), []).append((a, b))
        total = sum_of_fractions if exact else sum_of_balls
        terms = {e: total(pairs) for e, pairs in terms.items()}
        if self.rest or other.rest:
            polynomial = self.size() - self.rest
            rest += ((polynomial * other.rest + self.rest * other.size()) >> BITS) + 1
        return Taylor(terms, rest, self.space)

    def scaled(self, q):
        rest = self.rest * abs(q.numerator) // q.denominator + 1 if self.rest else 0
        return Taylor({e: c * q for e, c in self.terms.items()}, rest, self.space)

    def __neg__(self): return Taylor({e: -c for e, c in self.terms.items()}, self.rest, self.space)

class Dual(Number):
    """A value and its derivatives by the elements 0, 1, ... of one variable."""
    __slots__ = ("value", "slopes")
    level = 3
    def __init__(self, value, slopes): self.value, self.slopes = value, slopes
    def lift(self, x): return Dual(x, {})

    def plus(self, other):
        return Dual(self.value + other.value, merged_sum(self.slopes, other.slopes))

    def times(self, other):
        left = {i: s * other.value for i, s in self.slopes.items()}
        right = {i: s * self.value for i, s in other.slopes.items()}
        return Dual(self.value * other.value, merged_sum(left, right))

    def scaled(self, q): return Dual(self.value * q, {i: s * q for i, s in self.slopes.items()})
    def __neg__(self): return Dual(-self.value, {i: -s for i, s in self.slopes.items()})

class Affine(Number):
    """c[0] + sum of c[i] x_i. A product of two unknowns raises Unsupported.

    So a matrix that was evaluated with Affine elements is known to be affine in the unknowns.
    """
    __slots__ = ("c",)
    level = 4
    def __init__(self, c): self.c = c
    def lift(self, x): return Affine({0: x})
    def is_constant(self): return not any(self.c)
    def plus(self, other): return Affine(merged_sum(self.c, other.c))

    def times(self, other):
        a, b = (self, other) if self.is_constant() else (other, self)
        if not a.is_constant(): raise Unsupported("the text is not affine in the unknowns")
        factor = a.c.get(0, Fraction(0))
        return Affine({i: c * factor for i, c in b.c.items()})

    def scaled(self, q): return Affine({i: c * q for i, c in self.c.items()})
    def __neg__(self): return Affine({i: -c for i, c in self.c.items()})

def sum_of_fractions(pairs): return sum((a * b for a, b in pairs), Fraction(0))

def sum_of_balls(pairs):
    """The sum of products of balls, rounded once."""
    m = sum(a.m * b.m for a, b in pairs)
    r = sum(abs(a.m) * b.r + a.r * (abs(b.m) + b.r) for a, b in pairs)
    return Ball(m >> BITS, (r >> BITS) + 2)

def merged_sum(a, b):
    result = dict(a)
    for i, x in b.items(): result[i] = result[i] + x if i in result else x
    return result

def affine_terms(x):
    """{i: c_i} of x = c_0 + sum c_i x_i, without exact zeros."""
    terms = x.c if isinstance(x, Affine) else {0: x}
    return {i: c for i, c in terms.items() if not (is_exact(c) and c == 0)}

def inverse(x):
    """1/x."""
    if is_exact(x):
        if x == 0: raise Undecided("a division by zero")
        return 1 / Fraction(x)
    if isinstance(x, Ball):
        if abs(x.m) <= x.r: raise Undecided("a division by a number that may be zero")
        low = (ONE << BITS) // (abs(x.m) + x.r)
        high = -((-ONE << BITS) // (abs(x.m) - x.r))
        m = (low + high) >> 1
        return Ball(m if x.m > 0 else -m, high - m + 1)
    if isinstance(x, Taylor): return taylor_function("inv", x)
    if isinstance(x, Dual):
        value = inverse(x.value)
        return Dual(value, {i: -(value * value * s) for i, s in x.slopes.items()})
    if x.is_constant(): return inverse(x.c.get(0, Fraction(0)))
    raise Unsupported("a quotient by an unknown")

def sign(x):
    """1, 0 or -1 if all members of x have this sign."""
    if is_exact(x): return (x > 0) - (x < 0)
    if isinstance(x, Dual): return sign(x.value)
    if isinstance(x, Ball): m, r = x.m, x.r
    elif isinstance(x, Taylor):
        c = ball(x.constant())
        m, r = c.m, c.r + x.without_constant().size()
    elif x.is_constant(): return sign(x.c.get(0, Fraction(0)))
    else: raise Unsupported("the sign of an unknown")
    if abs(m) <= r: raise Undecided("a sign")
    return 1 if m > 0 else -1

def typical(x):
    """A fraction near |x|. It chooses pivots; nothing is concluded from it."""
    if isinstance(x, Taylor): return typical(x.constant())
    if isinstance(x, Dual): return typical(x.value)
    if isinstance(x, Affine): return typical(x.c.get(0, Fraction(0)))
    return abs(x) if is_exact(x) else Fraction(max(abs(x.m) - x.r, 0), ONE)

# Elementary functions of balls.

def halvings(m):
    """How often |m|/2^320 is halved to fall below 2^-12."""
    whole = (abs(m) >> BITS).bit_length()
    if whole > 20: raise Undecided("an argument above a million")
    return whole + 12

def ball_exp(x):
    """exp(x) = exp(y)^(2^k) with y = m/2^k. Below 2^-12, the rest of the series is less than its
    last term. The radius of x enters by |exp(r) - 1| <= 2 r, r <= 1/4."""
    k = halvings(x.m)
    y = Ball(x.m >> k, 1)
    total, term, n = Ball(ONE), Ball(ONE), 1
    while abs(term.m) > 1 or n < 4:
        term = (term * y).scaled(Fraction(1, n))
        total, n = total + term, n + 1
    total = Ball(total.m, total.r + term.size() + 1)
    for _ in range(k): total = total * total
    if x.r > ONE >> 2: raise Undecided("exp of a wide ball")
    return total * Ball(ONE, 2 * x.r) if x.r else total

def ball_sin_cos(x):
    """sin and cos by series below 2^-12, then doublings of the angle. |sin' | <= 1 adds r."""
    k = halvings(x.m)
    y = Ball(x.m >> k, 1)
    square = y * y

    def series(term, n):
        total = term
        while abs(term.m) > 2:
            term = -(term * square).scaled(Fraction(1, (n + 1) * (n + 2)))
            total, n = total + term, n + 2
        return Ball(total.m, total.r + term.size() + 4)

    s, c = series(y, 1), series(Ball(ONE), 0)
    for _ in range(k): s, c = 2 * (s * c), c * c - s * s
    return Ball(s.m, s.r + x.r), Ball(c.m, c.r + x.r)

def ball_sqrt(x):
    if x.m < x.r: raise Undecided("a root of a number that may be negative")
    low = isqrt((x.m - x.r) << BITS)
    high = isqrt((x.m + x.r) << BITS) + 1
    return Ball((low + high) >> 1, ((high - low + 1) >> 1) + 1)

def twice_atanh(z):
    """2 (z + z^3/3 + z^5/5 + ...) for |z| <= 1/2: the rest is less than twice the last term."""
    total = power = z
    square, n = z * z, 1
    while abs(power.m) > 1:
        power, n = power * square, n + 2
        total = total + power.scaled(Fraction(1, n))
    return 2 * Ball(total.m, total.r + 2 * power.size() + 4)

def ball_log(x):
    """log(x) = k log 2 + log(u), u in [1/2, 1], log(u) = 2 atanh((u - 1)/(u + 1))."""
    if x.m <= x.r: raise Undecided("a logarithm of a number that may be negative")
    k = x.m.bit_length() - BITS
    u = x * (Fraction(1, 2) ** k)
    return twice_atanh((u - 1) * inverse(u + 1)) + k * twice_atanh(ball(Fraction(1, 3)))

def ball_pi():
    """Machin: pi = 16 atan(1/5) - 4 atan(1/239), alternating series."""
    def atan_of_inverse(n):
        total = power = ONE // n
        k, negative = 1, True
        while power:
            power //= n * n
            k += 2
            total += -(power // k) if negative else power // k
            negative = not negative
        return Ball(total, k + 4)

    return 16 * atan_of_inverse(5) - 4 * atan_of_inverse(239)

PI = ball_pi()

def exact_value(name, x):
    """The value of a function at a fraction if it is rational and known, else None."""
    known = {("exp", 0): 1, ("cos", 0): 1, ("sin", 0): 0, ("log", 1): 0}
    if (name, x) in known: return Fraction(known[name, x])
    if name == "sqrt" and x >= 0:
        n, d = isqrt(x.numerator), isqrt(x.denominator)
        if n * n == x.numerator and d * d == x.denominator: return Fraction(n, d)
    return None

def function(name, x):
    """exp, sin, cos, sqrt or log of a number of any kind."""
    if isinstance(x, Affine):
        if not x.is_constant(): raise Unsupported(name + " of an unknown")
        return function(name, x.c.get(0, Fraction(0)))
    if isinstance(x, Taylor): return taylor_function(name, x)
    if isinstance(x, Dual):
        value = function(name, x.value)
        slope = {"exp": lambda: value, "sin": lambda: function("cos", x.value),
                 "cos": lambda: -function("sin", x.value),
                 "sqrt": lambda: inverse(2 * value), "log": lambda: inverse(x.value)}[name]()
        return Dual(value, {i: slope * s for i, s in x.slopes.items()})
    if is_exact(x):
        value = exact_value(name, Fraction(x))
        if value is not None: return value
    x = ball(x)
    if name in ("sin", "cos"): return ball_sin_cos(x)[0 if name == "sin" else 1]
    return {"exp": ball_exp, "sqrt": ball_sqrt, "log": ball_log}[name](x)

def taylor_function(name, x):
    """f(p + d) by its series in d, where p is the constant term of x and |d| <= delta.

    With K the order, the series of sin and cos leave at most delta^(K+1)/(K+1)!, that of exp
    leaves exp(delta) times this. inv, sqrt and log are series in u = d/p with coefficients of
    at most 1. For |u| <= q < 1 these leave at most q^(K+1)/(1 - q).
    """
    p, d, order = x.constant(), x.without_constant(), x.space[1]
    if not d.terms and not d.rest: return x.lift(inverse(p) if name == "inv" else function(name, p))
    if name in ("inv", "sqrt", "log"):
        d = x.lift(inverse(p)) * d
        if d.size() >= ONE:
            raise Undecided("a quotient, root or logarithm whose argument varies too much")
    coefficients = series_coefficients(name, p, order)
    result = x.lift(coefficients[order])
    for c in reversed(coefficients[:order]): result = result * d + c
    delta = Fraction(d.size(), ONE)
    left = delta ** (order + 1)
    if name in ("exp", "sin", "cos"):
        left = left / factorial(order + 1)
        left = upper(ball(left) * ball_exp(ball(delta))) if name == "exp" else left
    else: left = left / (1 - delta)
    result = Taylor(result.terms, result.rest + ball(left).size() + 1, result.space)
    if name == "log": return result + function("log", p)
    if name in ("exp", "sqrt"): return result * x.lift(function(name, p))
    return result * x.lift(inverse(p)) if name == "inv" else result

def series_coefficients(name, p, order):
    """Coefficients 0 to K of the series that taylor_function uses."""
    if name in ("sin", "cos"):
        s, c = function("sin", p), function("cos", p)
        cycle = [s, c, -s, -c] if name == "sin" else [c, -s, -c, s]
        return [cycle[j % 4] * Fraction(1, factorial(j)) for j in range(order + 1)]
    result = [Fraction(0 if name == "log" else 1)]
    for j in range(1, order + 1):
        if name == "exp": result.append(result[-1] / j)
        elif name == "inv": result.append(-result[-1])
        elif name == "sqrt": result.append(result[-1] * (Fraction(3, 2) - j) / j)
        else: result.append(Fraction((-1) ** (j + 1), j))
    return result
