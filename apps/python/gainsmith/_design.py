"""Commands that solve problems."""

import json
import os
import tempfile
from typing import Optional, Sequence, Union

from . import _arguments, _program, _results, _sources
from ._errors import ProgramError
from ._results import Design, Explanation, Solution
from ._sources import Problem
from ._tables import Scan
from ._words import known_options


@known_options
def synth(
    problem: Problem,
    *,
    set: Optional[dict] = None,
    effort: Optional[str] = None,
    sdpa=None,
    threads: Optional[int] = None,
    time: Optional[float] = None,
) -> Design:
    """Gains from a problem.

    problem  the path of a file, a dict, or a text with line breaks; a matrix is an array, a list of
             rows or a formula
    set      name: value, in place of those of the problem: {"alpha": 4, "A": numpy.eye(2)}
    effort   'full': what double precision does not decide gets any time
    sdpa     a path: writes the semidefinite program there
    time     seconds, after which it ends with what is known
    """
    return _design(
        "synth", problem, set, effort=effort, sdpa=_arguments.full(sdpa), threads=threads, time=time
    )


@known_options
def optimize(
    problem: Problem,
    *,
    over: Optional[dict] = None,
    largest: Optional[dict] = None,
    smallest: Optional[dict] = None,
    minimize: Optional[str] = None,
    tolerance: Optional[float] = None,
    refine: bool = False,
    evaluations: Optional[int] = None,
    resume=None,
    set: Optional[dict] = None,
    threads: Optional[int] = None,
    time: Optional[float] = None,
) -> Design:
    """The best values of a few scalars outside of the inequalities.

    They are in `searched` of the result.

    over               name: (low, high); without it the search of the problem
    largest, smallest  {name: (low, high)}: the scalar to make large or small
    minimize           an expression such as "trace(P)"
    resume             a folder that keeps what is done: the same call goes on from it
    """
    return _design(
        "optimize",
        problem,
        set,
        over=_arguments.ranges(over),
        largest=_arguments.ranges(largest),
        smallest=_arguments.ranges(smallest),
        minimize=minimize,
        tolerance=tolerance,
        refine=refine,
        evaluations=evaluations,
        resume=_arguments.full(resume),
        threads=threads,
        time=time,
    )


@known_options
def bisect(
    problem: Problem,
    *,
    largest: Union[str, dict, None] = None,
    smallest: Union[str, dict, None] = None,
    tolerance: Optional[float] = None,
    claims: bool = False,
    set: Optional[dict] = None,
    time: Optional[float] = None,
) -> Design:
    """The largest or smallest feasible value of a scalar, with the gains at it.

    largest, smallest  {name: (low, high)}, or the name alone where the problem has its range
    tolerance          width of the final bracket
    claims             a value counts as feasible only if the claims hold in the campaign
    result.search      value: the feasible end; beyond: the nearest value that is infeasible
    result.samples     list of {value, answer}
    """
    arguments = []
    for name, wanted in (("--largest", largest), ("--smallest", smallest)):
        if isinstance(wanted, dict):
            ((scalar, ends),) = wanted.items()
            arguments += [name, scalar, "--in", *(_arguments.number(end) for end in ends)]
        elif wanted is not None:
            arguments += [name, wanted]
    source = _sources.problem_source(problem)
    with tempfile.TemporaryDirectory(prefix="gainsmith-") as folder:
        gains = os.path.join(folder, "gains.json")
        done = _program.run(
            [
                "bisect",
                source.argument,
                *arguments,
                *_arguments.of_set(set),
                "--json",
                "-o",
                gains,
                *_arguments.flags(tolerance=tolerance, claims=claims, time=time),
            ],
            source,
        )
        file = json.loads(done.out)
        text = _results.read(gains) if os.path.exists(gains) else json.dumps(file["result"])
    search = file["result"].get("search") or {}
    beyond = search.get("beyond")
    said = [
        f"{file['goal']} {file['scalar']} = {search.get('value')} is feasible"
        if search.get("value") is not None
        else f"no feasible value of {file['scalar']} was found",
        f"{beyond} is infeasible by a checked certificate" if beyond is not None else None,
        f"{len(file['samples'])} values tried",
    ]
    design = Design(text, folder=_sources.folder_of(source), samples=file["samples"])
    design.summary = (
        "search      " + ", ".join(part for part in said if part) + "\n" + design.summary
    )
    return design


@known_options
def scan(
    problem: Problem,
    over: dict,
    *,
    show: Sequence[str] = (),
    set: Optional[dict] = None,
    resume=None,
    threads: Optional[int] = None,
    time: Optional[float] = None,
) -> Scan:
    """Solves a problem at every point of a grid.

    over  name: a number, (low, high), (low, high, count) or (low, high, count, 'log' or 'lin'); or
          an array of values that are evenly spaced, as numpy.linspace and numpy.logspace give them
    show  expressions that have a column: ["norm(L)", "trace(P)"]
    """
    source = _sources.problem_source(problem)
    shown = [show] if isinstance(show, str) else show
    done = _program.run(
        [
            "scan",
            source.argument,
            *_arguments.of_set(set),
            "--json",
            *_arguments.flags(
                over=_arguments.grid(over),
                show=list(shown),
                resume=_arguments.full(resume),
                threads=threads,
                time=time,
            ),
        ],
        source,
    )
    return Scan(_program.json_of("scan", done), done.verdict)


@known_options
def explain(
    problem: Problem,
    *,
    set: Optional[dict] = None,
    effort: Optional[str] = None,
    time: Optional[float] = None,
) -> Explanation:
    """Why a problem has no solution, or why it has no better one."""
    source = _sources.problem_source(problem)
    done = _program.run(
        [
            "explain",
            source.argument,
            *_arguments.of_set(set),
            "--json",
            *_arguments.flags(effort=effort, time=time),
        ],
        source,
    )
    file = _program.json_of("explain", done)
    conflict = file["conflict"]
    said = f"\nconflict    {' and '.join(conflict['requirements'])}" if conflict else ""
    return Explanation(file, f"problem     {file['problem']}\nverdict     {file['verdict']}{said}")


@known_options
def solve(
    program,
    *,
    precision: Optional[str] = None,
    tolerance: Optional[float] = None,
    iterations: Optional[int] = None,
    threads: Optional[int] = None,
    time: Optional[float] = None,
) -> Solution:
    """Solves a semidefinite program in SDPA sparse format: the path of a .dat-s file, or its text.

    precision  'auto', 'double', 'quad' or a number of digits
    """
    source = _sources.problem_source(program)
    with tempfile.TemporaryDirectory(prefix="gainsmith-") as folder:
        path = os.path.join(folder, "solution.json")
        done = _program.run(
            [
                "solve",
                source.argument,
                "--json",
                "-o",
                path,
                *_arguments.flags(
                    precision=precision,
                    tolerance=tolerance,
                    iterations=iterations,
                    threads=threads,
                    time=time,
                ),
            ],
            source,
        )
        point = json.loads(_results.read(path)) if os.path.exists(path) else {}
    return Solution(_program.json_of("solve", done), point)


def _design(command, problem, values, **options):
    source = _sources.problem_source(problem)
    done = _program.run(
        [
            command,
            source.argument,
            *_arguments.of_set(values),
            "-o",
            "-",
            *_arguments.flags(**options),
        ],
        source,
    )
    try:
        return Design(done.out, _program.said(done.err), _sources.folder_of(source))
    except ValueError:
        raise ProgramError(
            f"gainsmith {command}: no gain file was written\n{done.err.strip()}", done.code
        ) from None
