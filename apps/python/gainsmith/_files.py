"""Commands on gain files: check, proofs, reports, exports."""

import json
import os
import tempfile
from typing import Optional

from . import _arguments, _program, _results, _sources
from ._errors import InputError
from ._results import Campaign, Check, Design, Gains, Proof
from ._words import known_options


@known_options
def check(
    file: Gains, *, set: Optional[dict] = None, strict: bool = False, time: Optional[float] = None
) -> Check:
    """Validates a problem without solving it; proves the inequalities at the gains of a gain file.

    The gain file may have been edited: numpy arrays may stand in its dict.
    """
    source = _sources.gains_source(file)
    done = _program.run(
        [
            "check",
            source.argument,
            "--json",
            *_arguments.of_set(set),
            *_arguments.flags(strict=strict, time=time),
        ],
        source,
    )
    (found,) = _program.json_of("check", done)
    if "verdict" not in found:
        found["verdict"] = "yes"
        return Check(
            found, f"valid: method {found['method']}, {found['unknown_scalars']} unknown scalars"
        )
    lines = [
        f"{found['verdict']}: {found['message'] or 'the inequalities at the gains of the file'}"
    ]
    lines += [f"  {each['name']:16} {each['reached']:.3g}" for each in found["margins"]]
    return Check(found, "\n".join(lines))


@known_options
def certify(gains: Gains, *, time: Optional[float] = None) -> Proof:
    """Proves a design by the second program, which shares no code with the first one.

    It needs python3 and PyYAML on PATH. time: seconds after which it is open.
    """
    source = _sources.gains_source(gains)
    file = _program.json_of(
        "certify",
        _program.run(["certify", source.argument, "--json", *_arguments.flags(time=time)], source),
    )
    proved = sum(each["result"] == "proved" for each in file["claims"])
    return Proof(
        file,
        f"{file['verdict']}: {proved} of {len(file['claims'])} inequalities proved"
        + (f"; {file['message']}" if file["message"] else ""),
    )


@known_options
def report(
    results: Gains, path=None, *, campaign: Optional[Campaign] = None, time: Optional[float] = None
) -> str:
    """One page of HTML: mathematics, verdicts, gains, pictures. It needs no other file.

    results   a Design, the path of a gain file, or a folder that `gainsmith run` wrote
    path      where to write the page
    campaign  what verify said of the design
    """
    source = _sources.gains_source(results)
    with tempfile.TemporaryDirectory(prefix="gainsmith-") as folder:
        where = source.argument
        if source.text is not None:  # `report` does not read standard input
            where = os.path.join(folder, "gains.json")
            _results.write(where, source.text)
        if campaign is not None:
            if source.text is None:
                _results.write(os.path.join(folder, "gains.json"), _results.read(where))
            _results.write(os.path.join(folder, "campaign.json"), json.dumps(campaign.file))
            where = folder
        page = _program.run(["report", where, *_arguments.flags(time=time)]).out
    if path is not None:
        _results.write(path, page)
    return page


@known_options
def compare(designs: dict, path=None, *, time: Optional[float] = None) -> dict:
    """What differs between designs: {"L": {"slow": "[6; 9]", "fast": "[20; 100]"}, ...}, as text.

    designs  {name: Design or path of a gain file}, two at least
    path     where to write the page, with common pictures
    """
    with tempfile.TemporaryDirectory(prefix="gainsmith-") as folder:
        files = []
        if not isinstance(designs, dict):
            raise TypeError("designs is a dict such as {'slow': a, 'fast': b}")
        if len(designs) < 2:
            raise TypeError("compare takes two designs at least")
        for name, design in designs.items():
            source = _sources.gains_source(design)
            text = source.text if source.text is not None else _results.read(source.argument)
            files.append(os.path.join(folder, name + ".json"))
            _results.write(files[-1], text)
        page = os.path.join(folder, "page.html")
        options = _arguments.flags(output=page, time=time)
        run = _program.run(["report", *files, "--json", *options])
        table = _program.json_of("report", run)
        if path is not None:
            _results.write(path, _results.read(page))
    return {row["what"]: dict(zip(table["designs"], row["values"])) for row in table["rows"]}


@known_options
def export(
    gains: Gains, to: str, path=None, *, single: bool = False, time: Optional[float] = None
) -> Optional[str]:
    """The gains and observers for other programs.

    to      'c', 'matlab', 'python', 'json', 'csv', 'mat' or 'latex'
    path    where to write it; without it the text is returned ('csv' and 'mat' need a path)
    single  rounds the gains to single precision, and proves every inequality again
    """
    source = _sources.gains_source(gains)
    done = _program.run(
        [
            "export",
            source.argument,
            "--to",
            to,
            *_arguments.flags(output=_arguments.full(path), float=single, time=time),
        ],
        source,
    )
    if done.code != 0:
        raise _program.error_of(done.err, source)
    return done.out if path is None else None


def load(path) -> Design:
    """A gain file that `save`, `gainsmith synth -o` or `gainsmith run` wrote."""
    try:
        return Design(_results.read(os.fspath(path)), folder=os.path.dirname(os.path.abspath(path)))
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"no gain file: {error!r}", file=str(path)) from None
