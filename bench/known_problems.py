"""What the benches of verdicts share: exact matrices, problem files, and one run of the program.

A matrix is a list of rows of Fractions whose denominators are products of twos and fives, so that a problem file
holds it without rounding and what is planted is true of the file.
"""
import math
import os
import random
import resource
import shutil
import signal
import subprocess
import tempfile
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

SINGLE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
VERDICTS = {0: "yes", 1: "no", 3: "undecided"}


# Matrices.

def zeros(rows, columns):
    return [[Fraction(0)] * columns for _ in range(rows)]


def diagonal(elements):
    return [[Fraction(x) if i == j else Fraction(0) for j in range(len(elements))] for i, x in enumerate(elements)]


def identity(n):
    return diagonal([1] * n)


def transpose(A):
    return [list(column) for column in zip(*A)]


def product(A, *others):
    for B in others:
        columns = transpose(B)
        A = [[sum(a * b for a, b in zip(row, column) if a and b) for column in columns] for row in A]
    return A


def combined(A, B, factor=1):
    """A + factor B."""
    return [[a + factor * b for a, b in zip(*rows)] for rows in zip(A, B)]


def trace(A):
    return sum(A[i][i] for i in range(len(A)))


def he(A):
    return combined(A, transpose(A))


def blocks(*rows):
    """[A, B; C, D] of matrices."""
    return [[x for part in parts for x in part] for row in rows for parts in zip(*row)]


def drawn(rng, rows, columns, size, digits=3):
    """Entries size N(0, 1), rounded to `digits` after the point."""
    return [[Fraction(round(rng.gauss(0, size) * 10**digits), 10**digits) for _ in range(columns)]
            for _ in range(rows)]


def growing(rng, n, size):
    """Drawn entries, with trace(A) > 0: an eigenvalue has a positive real part."""
    while True:
        A = drawn(rng, n, n, size)
        if trace(A) != 0:
            return A if trace(A) > 0 else [[-x for x in row] for row in A]


class Coordinates(NamedTuple):
    """T with whole numbers and the determinant 1, and its inverse."""
    T: list
    inverse: list

    def of(self, A):
        """T^-1 A T."""
        return product(self.inverse, A, self.T)


def sheared(rng, n, count=None):
    """A product of `count` shears I +- e_i e_j'."""
    T, inverse = identity(n), identity(n)
    for _ in range(0 if n < 2 else n if count is None else count):
        i, j = rng.sample(range(n), 2)
        sign = rng.choice((-1, 1))
        for row in T:
            row[j] += sign * row[i]
        inverse[i] = [x - sign * y for x, y in zip(inverse[i], inverse[j])]
    return Coordinates(T, inverse)


def is_positive_definite(M):
    """Sylvester's criterion for a symmetric M, in whole numbers (Bareiss, Math. Comp. 22, 1968)."""
    scale = math.lcm(*(x.denominator for row in M for x in row))
    W = [[int(x * scale) for x in row] for row in M]
    previous = 1
    for k, pivots in enumerate(W):
        pivot = pivots[k]
        if pivot <= 0:
            return False
        for i in range(k + 1, len(W)):
            row, factor = W[i], pivots[i]
            for j in range(i, len(W)):
                row[j] = (pivot * row[j] - factor * pivots[j]) // previous
        previous = pivot
    return True


def solved(M, right):
    """x with M x = right, without rounding: elimination without fractions, exchanging rows."""
    scale = math.lcm(*(x.denominator for row in M for x in row), *(x.denominator for x in right))
    W = [[int(x * scale) for x in [*row, y]] for row, y in zip(M, right)]
    n, previous = len(W), 1
    for k in range(n):
        chosen = next(i for i in range(k, n) if W[i][k])
        W[k], W[chosen] = W[chosen], W[k]
        for i in range(k + 1, n):
            factor = W[i][k]
            rest = zip(W[i][k + 1:], W[k][k + 1:])
            W[i] = [0] * (k + 1) + [(W[k][k] * x - factor * y) // previous for x, y in rest]
        previous = W[k][k]
    x = [Fraction(0)] * n
    for k in reversed(range(n)):
        x[k] = (W[k][n] - sum(W[k][j] * x[j] for j in range(k + 1, n))) / Fraction(W[k][k])
    return x


def inverse_in_double(M):
    """Gauss and Jordan with exchanges of rows, of real or complex numbers."""
    n = len(M)
    W = [[*row, *(1.0 if i == j else 0.0 for j in range(n))] for i, row in enumerate(M)]
    for k in range(n):
        chosen = max(range(k, n), key=lambda i: abs(W[i][k]))
        W[k], W[chosen] = W[chosen], W[k]
        pivot = W[k][k]
        W[k] = [x / pivot for x in W[k]]
        for i in range(n):
            factor = W[i][k]
            if i != k and factor:
                W[i] = [x - factor * y for x, y in zip(W[i], W[k])]
    return [row[n:] for row in W]


def lyapunov_certificate(A):
    """P > 0 with He(P A) < 0, checked without rounding, or None.

    With M = (I + A) (I - A)^-1, M'PM < P is the same inequality; P = sum of M'^k M^k, by doubling.
    """
    n = len(A)
    near = [[float(x) for x in row] for row in A]
    one = [[float(i == j) for j in range(n)] for i in range(n)]
    M = product(combined(one, near), inverse_in_double(combined(one, near, -1)))
    P = one
    for _ in range(12):
        P = combined(P, product(transpose(M), P, M))
        M = product(M, M)
        largest = max(abs(x) for row in P for x in row)
        if not largest < 1e12:
            return None
    whole = [[Fraction(round(x / largest * 2**44)) for x in row] for row in P]
    P = he(whole)
    decrease = [[-x for x in row] for row in he(product(P, A))]
    return P if is_positive_definite(P) and is_positive_definite(decrease) else None


def stable(rng, n, size):
    """Drawn entries minus s I, s = 1.1 size sqrt(n) or the next value for which a certificate exists.

    The eigenvalues of the drawn part fill a disk of the radius size sqrt(n).
    """
    A = drawn(rng, n, n, size)
    shift = Fraction(round(110 * size * math.sqrt(n)), 100)
    while lyapunov_certificate(combined(A, identity(n), -shift)) is None:
        shift += Fraction(1, 10)
    return combined(A, identity(n), -shift)


# Problem files.

def decimal(value):
    """All digits of a number."""
    value = Fraction(value)
    exponent = 0
    while value.denominator > 1:
        value, exponent = value * 10, exponent - 1
        if exponent < -1000:
            raise ValueError("no decimal")
    whole = value.numerator
    return str(Decimal((int(whole < 0), tuple(int(digit) for digit in str(abs(whole))), exponent))).lower()


def yaml(value):
    if not isinstance(value, list):
        return decimal(value)
    return "[" + ", ".join(yaml(x) for x in value) + "]"


class Problem(NamedTuple):
    family: str
    n: int
    truth: str
    text: str


def problem(family, truth, method, n, parameters=None, **data):
    """`method`: the name of a built-in one, or lines of a method of its own."""
    inline = "\n" in method
    text = f"# {truth}\nproblem: {family}\nmethod:" + ("\n" + method.rstrip() if inline else f" {method}") + "\n"
    for key, values in (("data", data), ("parameters", parameters or {})):
        text += f"{key}:\n" * bool(values) + "".join(f"  {name}: {yaml(value)}\n" for name, value in values.items())
    return Problem(family, n, truth, text + ("no campaign: static\n" if inline else ""))


LYAPUNOV = """  method: lyapunov
  data: {A: n x n}
  unknowns: {P: symmetric n}
  require: {positive: P > 0, decrease: He(P*A) < 0}
"""
OBSERVER = """  method: observer
  data: {A: n x n, C: p x n}
  unknowns: {P: symmetric n, Y: n x p}
  require: {positive: P > 0, decrease: He(P*A - Y*C) < 0}
"""
FEEDBACK = """  method: state-feedback
  data: {A: n x n, B: n x m}
  unknowns: {P: symmetric n, Y: m x n}
  require: {positive: P > 0, decrease: He(A*P + B*Y) < 0}
"""
BOUNDED_REAL = """  method: bounded-real
  data: {A: n x n, B: n x m, C: p x n, g: scalar}
  unknowns: {P: symmetric n}
  require:
    positive: P > 0
    gain: "[He(P*A) + C'*C, P*B; *, -g*I] < 0"
"""


# Runs.

class Answer(NamedTuple):
    verdict: str  # yes, no, undecided; "no answer" at the limit; otherwise the exit code
    seconds: float  # of the processor
    output: str


def timed(command, limit):
    """(exit code, processor seconds, output) of one process that is ended after `limit` of them.

    User and system time together: the sum is measured, their parts are sampled and may be 0 for a short process.
    """
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                   env={**os.environ, **SINGLE_THREAD},
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1)))
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        return process.returncode, usage.ru_utime + usage.ru_stime, out.read()


def ask(program, text, limit, *options):
    """`PROGRAM synth` on a problem."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.yaml"
        path.write_text(text)
        code, seconds, output = timed([program, "synth", str(path), *options], limit)
    ended = code in (-signal.SIGXCPU, -signal.SIGKILL)
    return Answer("no answer" if ended else VERDICTS.get(code, f"exit {code}"), seconds, output)


def csdp_seconds(program, text, limit):
    """Processor seconds of CSDP on the exported program, or None."""
    if not shutil.which("csdp"):
        return None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "program.dat-s"
        ask(program, text, limit, "--sdpa", str(path), "--no-solve")
        return timed(["csdp", str(path)], limit)[1] if path.exists() else None


def outcome(truth, verdict):
    """Right, undecided or wrong; what is neither an answer nor a wish for more time is wrong."""
    if verdict == truth:
        return "right"
    return "undecided" if verdict in ("undecided", "no answer") else "wrong"


def generator(*key):
    """Random numbers of their own for each problem, so that each replays alone."""
    return random.Random("/".join(str(part) for part in key))


def judge(problems, options):
    """Runs (name, Problem) pairs, prints a line each and the counts; the exit code, 1 when one is wrong."""
    counts = {"wrong": 0, "undecided": 0, "right": 0}
    said = {}
    longest = (0.0, "-")
    whole = 0.0
    print(f"{'problem':<24} {'n':>3} {'truth':<5} {'verdict':<9} {'cpu s':>8}  {'':<9}")
    for name, known in problems:
        answer = ask(options.program, known.text, options.limit)
        mark = outcome(known.truth, answer.verdict)
        counts[mark] += 1
        said[answer.verdict] = said.get(answer.verdict, 0) + 1
        whole += answer.seconds
        longest = max(longest, (answer.seconds, name))
        print(f"{name:<24} {known.n:>3} {known.truth:<5} {answer.verdict:<9} {answer.seconds:>8.3f}  "
              f"{'' if mark == 'right' else mark}", flush=True)
        if options.keep and mark != "right":
            options.keep.mkdir(parents=True, exist_ok=True)
            (options.keep / f"{mark}-{name.replace('/', '-')}.yaml").write_text(known.text)
    print("said: " + ", ".join(f"{count} {verdict}" for verdict, count in sorted(said.items())))
    print(f"cpu s: {whole:.1f} together, {longest[0]:.3f} for {longest[1]}")
    print(", ".join(f"{count} {mark}" for mark, count in counts.items()) + f" of {sum(counts.values())}")
    return 1 if counts["wrong"] else 0


def options_of(parser, count, limit):
    """The options that the benches with one line a problem share."""
    parser.add_argument("program")
    parser.add_argument("--count", "--cases", type=int, default=count)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=int, default=limit, help="seconds of processor time for each problem")
    parser.add_argument("--family", help="this family alone")
    parser.add_argument("--keep", type=Path, help="write what is not answered rightly to this folder")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program) if os.path.sep in options.program else options.program
    return options


def cases(families, options, draw):
    """(name, Problem) for each case; case k belongs to family k modulo their number, whatever is chosen."""
    if options.family and options.family not in families:
        raise SystemExit(f"no family {options.family}; known: {', '.join(families)}")
    names = list(families)
    for index in range(options.count):
        family = names[index % len(names)]
        if options.family in (None, family):
            yield f"{family}/{index}", draw(family, index)
