"""Pictures of linear systems: their curves as arrays, and the picture itself."""

import os
import tempfile
from collections.abc import Mapping, Sequence
from typing import Optional, Union

from . import _arguments, _matrices, _program, _results, _sources
from ._results import Gains
from ._words import known_options


class System:
    """One system of a figure. What its kind of picture has not is None.

    frequency        (N,), radians per unit of time
    response         {(output, input): (N,) complex}, counted from 1
    singular_values  (N, number of them)
    margins          dict: gain, phase and delay, each with value and frequency, or None
    peak             dict: value, frequency, low and high, between which it is proved to lie
    time, outputs    (N,), and {input: (outputs, N)}
    steps            list of dicts, one for each output and input: final_value, largest, overshoot,
                     undershoot, rise, settling
    poles, zeros     lists of complex numbers
    stable           of each value of a scan, or draw of uncertain data
    locus            the poles of each, lists of complex numbers
    gain_margin, phase_margin, delay_margin   of each, (N,), nan where there is none
    """

    def __init__(self, file):
        self.label = file["system"]
        self.frequency = _column(file, "frequency")
        self.time = _column(file, "time")
        self.response = {
            (one["output"], one["input"]): _complex(one["real"], one["imaginary"])
            for one in file.get("response", [])
        } or None
        self.singular_values = _matrix(file, "singular_values")
        self.outputs = {
            one["input"]: _matrices.matrix(one["y"]) for one in file.get("outputs", [])
        } or None
        self.margins, self.peak, self.steps = (
            file.get(key) for key in ("margins", "peak", "steps")
        )
        self.poles, self.zeros = (
            [complex(*root) for root in file[key]] if key in file else None
            for key in ("poles", "zeros")
        )
        self.stable = file.get("stable")
        self.locus = [[complex(*root) for root in one] for one in file.get("locus", [])] or None
        self.gain_margin, self.phase_margin, self.delay_margin = (
            _with_gaps(file, key) for key in ("gain_margin", "phase_margin", "delay_margin")
        )

    def __repr__(self):
        return f"<system {self.label}>"


class Figure:
    """A picture: name, kind ('bode', ...), systems, facts as lines of text, and svg.

    scan   of a scanned scalar (name, values); None otherwise
    draws  systems over draws of the plant's uncertain data; empty without
    bands  dicts of the panel, x, low and high: where the curves of all draws lie
    """

    def __init__(self, file, svg):
        self.name, self.kind, self.svg = file["name"], file["kind"], svg
        self.systems = [System(one) for one in file.get("systems", [])]
        self.draws = [System(one) for one in file.get("draws", [])]
        self.bands = [
            {"panel": one["panel"], **{key: _with_gaps(one, key) for key in ("x", "low", "high")}}
            for one in file.get("bands", [])
        ]
        self.facts = file.get("facts", [])
        scan = file.get("scan")
        self.scan = scan and (scan["name"], _matrices.column(scan["values"]))

    def __repr__(self):
        return "\n".join([self.name, *("  " + fact for fact in self.facts)])

    def _repr_svg_(self):
        return self.svg

    def save(self, path):
        """Writes the picture, as SVG."""
        _results.write(path, self.svg)


@known_options
def plot(
    what: Union[Gains, Mapping],
    *,
    figures: Sequence[str] = (),
    set: Optional[dict] = None,
    time: Optional[float] = None,
) -> dict:
    """The figures of linear systems that a problem has under `figures`: name -> Figure.

    what     a Design, the path of a gain file, or a problem, whose gains are then synthesized
    figures  names of some; without them all
    """
    source = _sources.gains_source(what)
    chosen = [figures] if isinstance(figures, str) else list(figures)
    with tempfile.TemporaryDirectory(prefix="gainsmith-") as folder:
        made = _program.json_of(
            "plot",
            _program.run(
                [
                    "plot",
                    source.argument,
                    "--json",
                    *_arguments.of_set(set),
                    *_arguments.flags(
                        figure=chosen or None, output=os.path.join(folder, "p.svg"), time=time
                    ),
                ],
                source,
            ),
        )
        return {
            one["name"]: Figure(one, _results.read(one["file"]) if "file" in one else None)
            for one in made
        }


def _column(file, key):
    return _matrices.column(file[key]) if key in file else None


def _with_gaps(file, key):
    if key not in file:
        return None
    return _matrices.column([float("nan") if value is None else value for value in file[key]])


def _matrix(file, key):
    return _matrices.matrix(file[key]) if key in file else None


def _complex(real, imaginary):
    if _matrices.numpy is None:
        return [complex(a, b) for a, b in zip(real, imaginary)]
    return _matrices.column(real) + 1j * _matrices.column(imaginary)
