"""Exact multipliers of a no, as the file has them: sums of c z z* at an eigenvalue l, or rational.

Feasibility may hang on an eigenvalue on the wrong side, as with an unstable A and P > 0,
He(P*A) < 0. Then every multiplier is singular. With A w = l w and m the conjugate of l,

    w*(-He(P A))w + (l + m) w*P w = 0      for every P,

so that w w* and (l + m) w w* are multipliers of both inequalities if l + m >= 0.

The file states a polynomial p, where a root l of it is near, and terms c z z* of the multipliers of
blocks: matrices Z, z = Z e with e = (1, l, ..., l^(d-1))', and c = a_0 + a_1 (l + m) + a_2 l m.
Whose eigenvalue l is does not matter; rational multipliers have p = l. So z*B z = e* (Z'B Z) e. In
the ring Q[l, m]/(p(l), p(m)) a matrix X stands for e*X e, and for 0 if X = 0. With the companion
matrix C, l e = C e: times l is X C, and times m is C'X. All equations are checked in this ring, so
with fractions only. What remains are signs at the root, which is isolated by a disk.

Rational multipliers may have several steps (facial reduction). If the sum of all c z'B z is 0 at
each solution, then all B z = 0, since B >= 0. Later sums are taken modulo these equations.
"""
import re
from fractions import Fraction
from arithmetic import Ball, Undecided, ball, is_exact, sign
from language import decimal
from matrices import Matrix, filled, flat, number, zeros
from statement import expect, listed
STRICT, FRACTION = ("<", ">"), re.compile(r"-?[0-9]+(/0*[1-9][0-9]*)?", re.ASCII)
def fractions(texts, what):
    """A list of fractions of a list of texts such as "-1/3"."""
    expect(isinstance(texts, list) and all(isinstance(x, str) and FRACTION.fullmatch(x)
                                           for x in texts), what + ": fractions")
    return [Fraction(x) for x in texts]
def companion(p):
    """C with l e = C e for e = (1, l, ..., l^(n-1))'."""
    n = len(p) - 1
    return filled(n, n, lambda i, j: Fraction(int(j == i + 1)) if i < n - 1 else -p[j])
# The root.
def root_near(p, re, im):
    """(Re l, Im l, |l|^2) of the root l of p in a small disk around a point near re + i im. Rouche:
    the disk of radius h <= 1 has one root if |p| + M h^2/2 < |p'| h at its centre, where M >= |p''|
    on the disk. A disk that is its own mirror image in an axis has its root on the axis, if p is
    real (the real axis), or even or odd (the imaginary axis). If 1/l is a root with l, so is
    1/conj(l); both are in the disk of radius 8 h if its centre is within h/4 of the unit circle."""
    if len(p) == 2: return -p[0], Fraction(0), p[0] ** 2
    d1 = [k * c for k, c in enumerate(p)][1:]
    d2 = [k * c for k, c in enumerate(d1)][1:]
    h = Fraction(1, 2 ** 200)
    mirrored = all(c == 0 for c in p[-2::-2])
    inverted = p[0] != 0 and [c / p[0] for c in p] == p[::-1]
    re, im = (Fraction(0) if on and abs(x) < Fraction(1, 10 ** 9) else x
              for x, on in ((re, mirrored), (im, True)))
    axis = re == 0 and mirrored, im == 0
    for _ in range(8):          # Newton, rounded
        f, g = complex_value(p, re, im), complex_value(d1, re, im)
        size = g[0] ** 2 + g[1] ** 2 or 1
        re -= (f[0] * g[0] + f[1] * g[1]) / size
        im -= (f[1] * g[0] - f[0] * g[1]) / size
        re, im = (Fraction(0) if on else Fraction(round(x * 2 ** 250), 2 ** 250)
                  for x, on in zip((re, im), axis))
    f, g = complex_value(p, re, im), complex_value(d1, re, im)
    bound = sum(abs(c) * (abs(re) + abs(im) + 1) ** k for k, c in enumerate(d2))
    def has_one(r): return abs(f[0]) + abs(f[1]) + bound * r * r / 2 < max(map(abs, g)) * r
    if not has_one(h): raise Undecided("the root of a polynomial")
    circle = inverted and abs(re ** 2 + im ** 2 - 1) < h / 4 and has_one(8 * h)
    re, im = (x if on else ball(x).widened(ball(h).size()) for x, on in zip((re, im), axis))
    return re, im, Fraction(1) if circle else re * re + im * im
def complex_value(p, re, im):
    a, b = re * 0, re * 0
    for c in reversed(p): a, b = a * re - b * im + c, a * im + b * re
    return a, b
def value_at(x, re, im):
    """The real part of e*X e at l = re + i im, by Horner's rule in l and in its conjugate."""
    a, b = Ball(0), Ball(0)
    for row in reversed(x.elements):
        u, v = complex_value(row, re, im)
        a, b = a * re + b * im + u, b * re - a * im + v
    return a
# The certificate.
def prove_algebraic(given, block_of):
    """None if the multipliers of `given` exclude a solution; else why not."""
    expect(isinstance(given, dict), "algebraic: an object")
    p, near, terms = (given.get(key) for key in ("polynomial", "near", "terms"))
    p = fractions(p, "polynomial")
    expect(len(p) > 1 and p[-1] == 1, "polynomial: 1 as the last coefficient")
    expect(isinstance(near, list) and len(near) == 2, "near: two numbers")
    expect(isinstance(terms, list) and all(isinstance(t, dict) for t in terms), "terms: objects")
    x, y, square = root_near(p, *(decimal(str(part)) for part in near))
    c, known = companion(p), []
    for step in sorted({int(str(term.get("step", 1))) for term in terms}):
        sums, strict, used = {}, False, []
        for term in (t for t in terms if int(str(t.get("step", 1))) == step):
            label, rows = term.get("block"), term.get("vector")
            expect(isinstance(label, str) and isinstance(rows, list), "terms: a block, a vector")
            z = Matrix([fractions(row, label) for row in rows])
            block, weight = block_of(label), fractions(term.get("weight"), label)
            size, entries = semidefinite(block)
            expect(z.shape() == (size, len(p) - 1) and len(weight) == 3, label + ": its size")
            side = sign(weight[0] + weight[1] * (2 * x) + weight[2] * square)
            weight = [number(w) for w in weight]
            if side < 0: return "a multiplier that is negative"
            if side > 0 and block.sign in STRICT:
                strict = strict or sign(value_at(z.transposed() * z, x, y)) > 0
            used.append({})
            for i, found in entries.items():
                if not all(map(is_exact, found.values())): return "no fractions as coefficients"
                image = filled(size, size, lambda a, b: found.get((a, b), Fraction(0))) * z
                form = z.transposed() * image
                form = weight[0] * form + weight[1] * (form * c + c.transposed() * form) + \
                    weight[2] * (c.transposed() * form * c)
                sums[i] = sums[i] + form if i in sums else form
                if side > 0: used[-1][i] = image
        if len(p) == 2:
            rest = reduced({i: x[0, 0] for i, x in sums.items()}, known)
            sums = {i: Matrix([[x]]) for i, x in rest.items()}
        constant = sums.pop(0, zeros(1, 1))
        if any(x != 0 for total in sums.values() for x in flat(total)):
            return "an equation of the multipliers does not hold"
        if any(x != 0 for x in flat(constant)):
            return None if sign(value_at(constant, x, y)) < 0 else "a constant part above 0"
        if strict: return None
        for images in used if len(p) == 2 else ():
            for equation in zip(*[[(i, x) for x in flat(image)] for i, image in images.items()]):
                found = reduced(dict(equation), known)
                if set(found) == {0}: return None
                if found: known.append((max(found), found))
    return "no strict inequality has a multiplier"
def semidefinite(block):
    """(n, coefficients) of B(x) >= 0; of an equation E(x) = 0 those of [0, E; E', 0] >= 0."""
    (height, width), terms = block.shape, block.terms
    return (height, terms) if block.sign != "==" else (height + width, {
        i: {key: x for (a, b), x in found.items() for key in ((a, height + b), (height + b, a))}
        for i, found in terms.items()})
def reduced(form, known):
    """A sum of a_i x_i without the last x_i of each sum that is known to be 0."""
    for pivot, zero in known:
        factor = form.get(pivot, 0) / zero[pivot]
        form = {i: form.get(i, 0) - factor * zero.get(i, 0) for i in {*form, *zero}}
    return {i: a for i, a in form.items() if a != 0}
