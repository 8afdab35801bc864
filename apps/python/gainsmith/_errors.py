"""The two exceptions of the module."""
from typing import Optional


class InputError(ValueError):
    """The program refuses a problem, a gain file or an option (exit code 2).

    message: what is wrong and what was expected
    file, line, column: the place in a file or a text, counted from 1; None where there is none
    key: of a dict, the place in it, such as method.require.decay or data.A(2);
        column is then that of the formula
    """

    def __init__(
        self,
        message: str,
        *,
        file: Optional[str] = None,
        line: Optional[int] = None,
        column: Optional[int] = None,
        key: Optional[str] = None,
    ):
        self.message, self.file, self.line, self.column, self.key = message, file, line, column, key
        super().__init__(message)

    def __str__(self) -> str:
        if self.key is not None:
            place = self.key if self.column is None else f"{self.key}, column {self.column}"
        else:
            place = ":".join(
                str(part) for part in (self.file, self.line, self.column) if part is not None
            )
        return f"{place}: {self.message}" if place else self.message


class ProgramError(RuntimeError):
    """The program is missing, ended by a fault (exit code 70), or was ended from outside.

    code: the exit code; minus the number of the signal that ended it; None where it did not start
    """

    def __init__(self, message: str, code: Optional[int] = None):
        self.code = code
        super().__init__(message)
