"""Where the program is, and how it is run."""
import contextlib
import errno
import json
import os
import re
import shutil
import signal
import subprocess
import threading
from typing import NamedTuple

from ._errors import InputError, ProgramError


class Done(NamedTuple):
    """A command that ended with the exit code 0, 1 or 3."""

    code: int
    out: str
    err: str

    @property
    def verdict(self):
        return {0: "yes", 1: "no"}.get(self.code, "undecided")


def find():
    """The program: GAINSMITH of the environment, else beside the module, else that of PATH."""
    stated = os.environ.get("GAINSMITH")
    if stated:
        found = shutil.which(stated)
        if not found:
            raise ProgramError(f"GAINSMITH={stated}: there is no such program")
        return os.path.abspath(found)
    # PREFIX/lib/python3/dist-packages/gainsmith/_program.py
    parts = os.path.abspath(__file__).split(os.sep)
    found = None
    if parts[-3] in ("dist-packages", "site-packages"):
        found = shutil.which(os.sep.join([*parts[:-5], "bin", "gainsmith"]))
    found = found or shutil.which("gainsmith")
    if not found:
        raise ProgramError(
            "the program gainsmith was not found: put it on PATH, or its path into the environment "
            "variable GAINSMITH"
        )
    return os.path.abspath(found)


def run(arguments, source=None):
    """Runs `gainsmith ARGUMENTS` in the folder of a source, with its text as standard input.

    InputError for the exit code 2, ProgramError for one that is no result. An interrupt ends the
    program too.
    """
    command = [find(), *arguments]
    text = None if source is None else source.text
    process = None
    try:
        with _interrupts_deferred():
            process = _start(command, text is not None, source)
        out, err = process.communicate(None if text is None else text.encode("utf-8"))
    except BaseException:
        if process:
            _end(process)
        raise
    done = Done(process.returncode, out.decode("utf-8", "replace"), err.decode("utf-8", "replace"))
    if done.code == 2:
        raise error_of(done.err, source)
    if done.code not in (0, 1, 3):
        raise ProgramError(_fault(arguments[0], done), done.code)
    return done


def json_of(command, done):
    try:
        return json.loads(done.out)
    except ValueError:
        raise ProgramError(
            f"gainsmith {command}: no result was written\n{done.err.strip()}", done.code
        ) from None


def said(text):
    """The summary, without lines of the log and commands about standard input."""
    kept = [line.rstrip() for line in text.splitlines() if not line.startswith("gainsmith: ")]
    return "\n".join(line for line in kept if " - " not in line or "gainsmith " not in line)


def error_of(err, source=None):
    """The InputError that standard error states as `gainsmith: FILE:LINE:COLUMN: MESSAGE`."""
    stated = [
        line[len("gainsmith: ") :] for line in err.splitlines() if line.startswith("gainsmith: ")
    ]
    stated = [line for line in stated if not line.startswith("wrote ")] or [err.strip()]
    message = "\n".join(stated)
    option = re.match(r"--set (\w+)(?::\d+:(\d+))?: (.*)", message, re.S)
    if option:
        return InputError(
            option[3], key=f"set.{option[1]}", column=int(option[2]) if option[2] else None
        )
    placed = re.match(r"(.+?):(\d+):(\d+): (.*)", message, re.S)
    if placed:
        return _at(placed[1], int(placed[2]), int(placed[3]), placed[4], source)
    of_file = re.match(r"(\S.*?): (.*)", message, re.S)
    if of_file and source is not None and of_file[1] == source.argument:
        return InputError(of_file[2], file=None if source.argument == "-" else of_file[1])
    return InputError(message)


def _at(file, line, column, message, source):
    """The error at a place; of standard input at a key of the dict, or in the text."""
    if file != "-":
        inside = re.fullmatch(r".* \((.+)\)", file)  # a gain file, and in parentheses its problem
        return InputError(message, file=inside[1] if inside else file, line=line, column=column)
    key, of_formula = source.place(line, column)
    if key is not None:
        return InputError(message, key=key or None, column=of_formula)
    return InputError(message, file="<text>", line=line, column=column)


def _fault(name, done):
    cause = (
        f"exit code {done.code}"
        if done.code >= 0
        else f"ended by {signal.Signals(-done.code).name}"
    )
    return f"gainsmith {name}: {cause}\n{done.err.strip()}".strip()


def _start(command, has_input, source):
    in_folder = source and source.folder and os.path.isdir(source.folder)
    try:
        return subprocess.Popen(
            command,
            stdin=subprocess.PIPE if has_input else subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=source.folder if in_folder else None,
        )
    except OSError as error:
        if error.errno == errno.E2BIG:
            raise InputError(
                "the values of 'set' are too large for a command line: put them into the problem"
            ) from None
        raise ProgramError(f"{command[0]}: {error.strerror}") from None


@contextlib.contextmanager
def _interrupts_deferred():
    """An interrupt within the block comes at its end: Popen would leave its program running."""
    before = signal.getsignal(signal.SIGINT)
    if before is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    deferred = []
    signal.signal(signal.SIGINT, lambda number, _: deferred.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if deferred:
            signal.raise_signal(signal.SIGINT)


def _end(process):
    """Ends the program: it stops within a second by itself, and is killed if it does not."""
    process.terminate()
    for stream in (process.stdin, process.stdout, process.stderr):
        try:
            if stream:
                stream.close()
        except OSError:  # what was not written yet
            pass
    try:
        process.wait(5)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
