"""Options of functions as words of a command line."""

import os
from collections.abc import Mapping

from . import _problem
from ._errors import InputError


def flags(**options):
    """--name value for each option; none of it for None and False, and no value for True."""
    arguments = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        for each in value if isinstance(value, list) else [value]:
            arguments.append(f"--{name}")
            if each is not True:
                arguments.append(each if isinstance(each, str) else number(each))
    return arguments


def of_set(values):
    """--set NAME=VALUE for each name."""
    return [
        word
        for name, value in _pairs("set", values or {})
        for word in ("--set", f"{name}={_problem.one_line(value, f'set.{name}')}")
    ]


def full(path):
    """The program may run in another folder."""
    return None if path is None else os.path.abspath(os.fspath(path))


def number(value):
    value = _problem.plain(value)
    return str(value)


def ranges(wanted):
    """NAME=LOW:HIGH of {name: (low, high)}."""
    if wanted is None:
        return None
    return [
        f"{name}={number(low)}:{number(high)}" for name, (low, high) in _pairs("a range", wanted)
    ]


def grid(over):
    """NAME=LOW:HIGH:COUNT of the points of a scan."""
    return [f"{name}={_values(name, values)}" for name, values in _pairs("over", over)]


def _pairs(option, values):
    if not isinstance(values, Mapping):
        raise TypeError(f"{option} is a dict of names and values, not {values!r}")
    return values.items()


def _values(name, values):
    """LOW:HIGH:COUNT:log or lin, as --over takes it."""
    if isinstance(values, (tuple, list)):
        return ":".join(number(each) for each in values)
    if not hasattr(values, "__len__") or isinstance(values, str):
        return number(values)
    values = _problem.plain(values, f"over.{name}")
    low, high, count = values[0], values[-1], len(values)
    if count == 1:
        return number(low)
    if _evenly(values, [low + (high - low) * i / (count - 1) for i in range(count)]):
        return f"{number(low)}:{number(high)}:{count}:lin"
    if (
        low > 0
        and high > 0
        and _evenly(values, [low * (high / low) ** (i / (count - 1)) for i in range(count)])
    ):
        return f"{number(low)}:{number(high)}:{count}:log"
    raise InputError(
        "the values of a grid are evenly spaced, or evenly on a logarithmic scale: scan other "
        "values in a loop",
        key=f"over.{name}",
    )


def _evenly(values, wanted):
    width = max(abs(each) for each in values)
    return all(abs(a - b) <= 1e-9 * width for a, b in zip(values, wanted))
