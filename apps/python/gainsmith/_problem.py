"""A dict as the text of a problem, and the key that stands in each line of this text.

The text is JSON, which is YAML too. Each key has a line of its own, so that a line says which key
is meant.
"""
import decimal
import fractions
import json
import math
import numbers
from collections.abc import Mapping

from . import _matrices
from ._errors import InputError

# Without this line `verify` and `simulate` take a text that begins with { for a gain file.
HEAD = "# A dict of Python.\n"


def plain(value, key=""):
    """value with NumPy's arrays and numbers as lists and numbers.

    InputError where it is nothing that a problem may have.
    """
    if isinstance(value, Mapping):
        return {_name(name, key): plain(each, _below(key, name)) for name, each in value.items()}
    if value is None or isinstance(value, (str, bool)):
        return value
    if isinstance(value, decimal.Decimal):
        return _finite(value, key)
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, fractions.Fraction):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, numbers.Real):
        return _finite(float(value), key)
    if isinstance(value, (list, tuple)):
        return [plain(each, _element(key, i)) for i, each in enumerate(value, 1)]
    if hasattr(value, "toarray"):  # sparse matrices of SciPy
        value = value.toarray()
    if _matrices.numpy is not None and hasattr(value, "__array__"):
        return _of_array(_matrices.numpy.asanyarray(value), key)
    raise InputError(
        f"a {type(value).__name__} is neither a number, a matrix, a text, a list nor a dict",
        key=key,
    )


def text_of(problem):
    """The text of a problem, or of a gain file, that is a dict."""
    try:
        head = "" if "gainsmith" in problem else HEAD
        return head + "".join(line for line, _, _ in _lines(plain(problem), ""))
    except RecursionError:
        raise InputError("this dict contains itself") from None


def place_in(problem, line, column):
    """The key in a line of text_of(problem), and the column in the formula there, or None."""
    for number, (_, key, formula_from) in enumerate(_lines(plain(problem), ""), 2):
        if number == line:
            inside = column - formula_from + 1 if formula_from and column else None
            return key, inside if inside is not None and inside > 0 else None
    return None, None


def one_line(value, key):
    """value as the value of --set: a text is a formula."""
    value = plain(value, key)
    return (
        value
        if isinstance(value, str)
        else _scalar(value)
        if _is_scalar(value)
        else "".join(line.rstrip("\n") for line, _, _ in _lines(value, key))
    )


def _lines(value, key, before="", after="\n"):
    """Lines of JSON as (line, key, column at which a formula begins or 0)."""
    if isinstance(value, dict):
        yield before + "{\n", key, 0
        last = len(value) - 1
        for i, (name, each) in enumerate(value.items()):
            yield from _lines(
                each,
                _below(key, name),
                json.dumps(name, ensure_ascii=False) + ": ",
                "\n" if i == last else ",\n",
            )
        yield "}" + after, key, 0
    elif isinstance(value, list) and not all(
        _is_scalar(each) and not isinstance(each, str) for each in value
    ):
        yield before + "[\n", key, 0
        for i, each in enumerate(value):
            yield from _lines(
                each, _element(key, i + 1), "", "\n" if i == len(value) - 1 else ",\n"
            )
        yield "]" + after, key, 0
    elif isinstance(value, list):
        yield before + "[" + ", ".join(_scalar(each) for each in value) + "]" + after, key, 0
    else:
        written = _scalar(value)
        same = isinstance(value, str) and written == f'"{value}"' and value.isascii()
        yield before + written + after, key, len(before) + 2 if same else 0


def _is_scalar(value):
    return not isinstance(value, (dict, list))


def _scalar(value):
    if isinstance(value, decimal.Decimal):
        return str(value)
    return repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False)


def _finite(value, key):
    if not math.isfinite(value):
        raise InputError(f"{value}: a number must be finite", key=key)
    return value


def _of_array(array, key):
    if array.size == 0:
        raise InputError(
            f"this matrix is empty ({' x '.join(str(size) for size in array.shape)})", key=key
        )
    if _matrices.numpy.ma.is_masked(array):
        raise InputError("this matrix has elements that are masked", key=key)
    if array.dtype.kind == "c":
        raise InputError(
            "complex numbers are not allowed; the real and the imaginary part are matrices", key=key
        )
    if array.dtype.kind == "f":
        wrong = _matrices.numpy.argwhere(~_matrices.numpy.isfinite(array))
        if len(wrong):
            where = ", ".join(str(i + 1) for i in wrong[0])
            raise InputError(
                f"{array[tuple(wrong[0])]}: a number must be finite",
                key=f"{key}({where})" if where else key,
            )
        return array.astype(float).tolist()
    if array.dtype.kind in "biu":
        return array.astype(int).tolist()
    return plain(array.tolist(), key)


def _name(name, key):
    if not isinstance(name, str):
        raise InputError(f"the key {name!r} is not a text", key=key or None)
    return name


def _element(key, i):
    return f"{key[:-1]}, {i})" if key.endswith(")") else f"{key}({i})"


def _below(key, name):
    return f"{key}.{name}" if key else str(name)
