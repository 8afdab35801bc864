"""Commands that simulate."""

import functools
import json
import os
import tempfile
from typing import Optional

from . import _arguments, _problem, _program, _results, _sources
from ._results import Campaign, Gains, Worst
from ._tables import Run
from ._words import known_options


@known_options
def verify(
    gains: Gains,
    *,
    set: Optional[dict] = None,
    runs: Optional[int] = None,
    probability: Optional[float] = None,
    confidence: Optional[float] = None,
    seed: Optional[int] = None,
    until: Optional[str] = None,
    strict: bool = False,
    resume=None,
    threads: Optional[int] = None,
    time: Optional[float] = None,
) -> Campaign:
    """Checks the claims of a design in simulated runs.

    gains        a Design, the path of a gain file, or a problem without unknowns
    probability  instead of runs: as many as show that at most this part of such runs violates
    until        'violated': ends with the first run that violates a claim
    strict       a note on noise or an observer that is perhaps not meant so is an error
    """
    source = _sources.gains_source(gains)
    with tempfile.TemporaryDirectory(prefix="gainsmith-") as folder:
        report = os.path.join(folder, "campaign.json")
        done = _program.run(
            [
                "verify",
                source.argument,
                *_arguments.of_set(set),
                "-o",
                report,
                *_arguments.flags(
                    runs=runs,
                    probability=probability,
                    confidence=confidence,
                    seed=seed,
                    until=until,
                    strict=strict,
                    resume=_arguments.full(resume),
                    threads=threads,
                    time=time,
                ),
            ],
            source,
        )
        file = json.loads(_results.read(report))
    return Campaign(file, _program.said(done.out), gains)


@known_options
def worst(
    gains: Gains,
    *,
    set: Optional[dict] = None,
    runs: Optional[int] = None,
    seed: Optional[int] = None,
    threads: Optional[int] = None,
    time: Optional[float] = None,
) -> Worst:
    """Searches the worst run of each claim, over starts, lengths, noise and uncertain data."""
    source = _sources.gains_source(gains)
    done = _program.run(
        [
            "verify",
            source.argument,
            "--worst",
            "--json",
            *_arguments.of_set(set),
            *_arguments.flags(runs=runs, seed=seed, threads=threads, time=time),
        ],
        source,
    )
    file = _program.json_of("verify", done)
    lines = [f"worst       {file['verdict']} ({file['runs']} runs tried)"]
    lines += [
        f"  {each['name']}: {each['verdict']}, {each.get('value')} against {each.get('bound')}"
        for each in file["claims"]
    ]
    return Worst(file, "\n".join(lines))


@known_options
def simulate(
    gains: Gains,
    *,
    run: Optional[int] = None,
    set: Optional[dict] = None,
    given: Optional[dict] = None,
    seed: Optional[int] = None,
    step: Optional[float] = None,
    time: Optional[float] = None,
) -> Run:
    """One run of a campaign, as a table.

    gains  a Design, the path of a gain file, or a problem without unknowns
    run    its number, from 0
    given  starts, lengths, losses and noise in place of draws, as `worst` returns them
    step   points of flows this far apart; without it those of the integration
    time   seconds of computation, after which it ends; the length of a run is campaign.horizon
    """
    source = _sources.gains_source(gains)
    chosen = [
        *_arguments.of_set(set),
        *_arguments.flags(
            run=run,
            given=json.dumps(_problem.plain(given, "given")) if given else None,
            seed=seed,
            step=step,
            time=time,
        ),
    ]
    done = _program.run(["simulate", source.argument, "--json", "-o", "-", *chosen], source)

    return Run(
        _program.json_of("simulate", done),
        _program.said(done.err),
        functools.partial(_draw, source, chosen),
    )


@known_options
def _draw(source, chosen, path, *, panels=None, phase=None, band=None):
    """Draws the run that these arguments choose into a file, or returns it as SVG."""
    with tempfile.TemporaryDirectory(prefix="gainsmith-") as folder:
        picture = os.path.abspath(path) if path is not None else os.path.join(folder, "run.svg")
        _program.run(
            [
                "simulate",
                source.argument,
                *chosen,
                "--plot",
                picture,
                "-o",
                os.devnull,
                *_arguments.flags(panels=panels, phase=phase, band=band),
            ],
            source,
        )
        return _results.read(picture) if path is None else None
