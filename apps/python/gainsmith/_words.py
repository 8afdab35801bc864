"""The nearest word of a list, and options that are refused with it."""
import difflib
import functools
import inspect


def nearest(word, known):
    """What to say behind an unknown word."""
    names = {name.lower(): name for name in known}
    close = difflib.get_close_matches(str(word).lower(), list(names), 1, 0.5)
    return f"did you mean '{names[close[0]]}'?" if close else "known: " + ", ".join(known)


def known_options(function):
    """The function, which refuses an unknown option by the name of the nearest one."""
    parameters = inspect.signature(function).parameters.values()
    names = [each.name for each in parameters]
    called = function.__name__.lstrip("_")

    @functools.wraps(function)
    def checked(*positional, **options):
        for name in options:
            if name not in names:
                raise TypeError(f"{called}() has no option '{name}'; {nearest(name, names)}")
        return function(*positional, **options)

    return checked
