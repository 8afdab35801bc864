"""What a command reads: a file by its path, or a text, a dict or a result by standard input."""
import os
from collections.abc import Mapping
from typing import Optional, Union

from . import _problem

Problem = Union[str, "os.PathLike[str]", Mapping]


class Source:
    """argument: what the command line names; text: standard input; folder: the working folder."""

    def __init__(
        self, argument: str, text: Optional[str] = None, folder: Optional[str] = None, problem=None
    ):
        self.argument, self.text, self.folder, self.problem = argument, text, folder, problem

    def place(self, line, column):
        """The key at a place of a dict; (None, None) for a text."""
        return (
            (None, None) if self.problem is None else _problem.place_in(self.problem, line, column)
        )


def problem_source(problem: Problem) -> Source:
    """A str with a line break is the text of a problem, any other str the path of its file."""
    if isinstance(problem, Mapping):
        return Source("-", _problem.text_of(problem), problem=problem)
    if isinstance(problem, str) and "\n" in problem:
        return Source("-", problem)
    if isinstance(problem, (str, os.PathLike)):
        path = os.fspath(problem)
        return Source(os.path.join(".", path) if path.startswith("-") else path)
    raise TypeError(f"a problem is a path, a text or a dict, not a {type(problem).__name__}")


def gains_source(gains) -> Source:
    """A Design, the path of a gain file, its content as a dict, or a problem without unknowns."""
    if hasattr(gains, "text") and hasattr(gains, "folder"):
        return Source("-", gains.text, gains.folder)
    return problem_source(gains)


def folder_of(source: Source) -> str:
    """Where the files that a problem names are looked for."""
    return (
        os.getcwd()
        if source.text is not None
        else os.path.dirname(os.path.abspath(source.argument))
    )
