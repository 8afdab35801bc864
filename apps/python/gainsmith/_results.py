"""Results of commands: a design with its gains, a campaign, and records of the rest."""
import html
import json
from typing import Any, Dict, List, Optional, Union

from . import _matrices
from ._sources import Problem
from ._words import nearest


class Record:
    """What a command says, with its keys as attributes.

    file: the same as a dict, as the program writes it
    """

    def __init__(self, file: dict, summary: str):
        self.file, self.summary = file, summary

    def __getattr__(self, name):
        if name.startswith("_") or name == "file":
            raise AttributeError(name)
        if name not in self.file:
            raise AttributeError(
                f"{type(self).__name__} has no '{name}'; {nearest(name, self.file)}"
            )
        return self.file[name]

    def __dir__(self):
        return [*super().__dir__(), *self.file]

    def __repr__(self):
        return self.summary

    def _repr_html_(self):
        return f"<pre>{html.escape(self.summary)}</pre>"


class Check(Record):
    """Whether a problem is valid, or the inequalities hold at the gains of a gain file.

    verdict: 'yes', 'no' or 'undecided'
    of a problem: problem, method, dimensions, unknown_scalars, blocks, notes
    of a gain file: own_unknowns, edited, not_shown, margins, message
    """

    verdict: str


class Proof(Record):
    """What the second program proves of a gain file.

    verdict: 'proved', 'refuted', 'open', or what the program says where there is nothing to prove
    claims: list of dicts with name and result; seconds
    """

    verdict: str


class Explanation(Record):
    """Why there is no solution, or no better one.

    verdict: 'yes', 'no' or 'undecided'
    conflict, relaxations, negotiable, held, limits: docs/gain-file.md
    """

    verdict: str


class Worst(Record):
    """The worst runs that a search found.

    verdict, runs, seed, horizon
    claims: list of dicts with name, verdict, value, bound, t, j and given
    simulate(gains, given=claim["given"]) replays one.
    """

    verdict: str
    claims: List[dict]


class Solution(Record):
    """Of a semidefinite program: minimise c'x subject to X = sum x_i F_i - F_0 >= 0.

    status: 'optimal', 'primal-infeasible', 'dual-infeasible' or 'undecided'
    primal_objective, dual_objective, dimacs_errors, ...: docs/gain-file.md
    x: the unknowns (m,)
    X, Y: list of the blocks of the primal and the dual matrix; of a diagonal block its diagonal
    """

    def __init__(self, file: dict, point: dict):
        super().__init__(file, f"{file['status']}, objective {file.get('primal_objective')}")
        self.x = _matrices.column(point.get("x", []))
        self.X = [_matrices.block(each) for each in point.get("X", [])]
        self.Y = [_matrices.block(each) for each in point.get("Y", [])]


class GainFunction:
    """A gain that depends on a scalar: of (its variable), kind, formula, coefficients.

    A gain of the kind 'polynomial' is called with a number. `export` writes the others as code.
    """

    def __init__(self, name: str, file: dict):
        self.name, self.of, self.kind, self.formula = (
            name,
            file["of"],
            file["kind"],
            file["formula"],
        )
        self.coefficients = [_matrices.matrix(each) for each in file.get("coefficients", [])]

    def __call__(self, value: float):
        if not self.coefficients:
            raise TypeError(
                f"{self.name}({self.of}) is no polynomial but {self.formula}: "
                "export(design, to='python') writes it as code"
            )
        return _matrices.polynomial(self.coefficients, value)

    def __repr__(self):
        return f"{self.name}({self.of}) = {self.formula}"


class Design:
    """A gain file: the result of synth, optimize and bisect, or of load.

    verdict    'yes', 'no' or 'undecided'
    status     'optimal', 'feasible', 'infeasible' or 'undecided'
    objective  a float, or None
    gains, unknowns, report   name: matrix (rows, columns), 1 x 1 for a number
    parameters, searched      name: float
    values     all of these by name; design["L"] is design.values["L"]
    gain_functions            name: GainFunction
    margins    requirement: {reached, required, holds, worst_point, ...}, margins between 0 and 1
    margin     the smallest margin that was reached, or None
    search     how a search ended (docs/gain-file.md), or None
    samples    of bisect: list of {value, answer}
    file       the whole gain file as a dict; text: its text
    folder     where the files that the problem names are
    """

    def __init__(
        self,
        text: str,
        summary: str = "",
        folder: Optional[str] = None,
        samples: Optional[list] = None,
    ):
        self.text, self.folder, self.samples = text, folder, samples
        self.file: Dict[str, Any] = json.loads(text)
        file = self.file
        self.verdict: str = file["verdict"]
        self.status: str = file["status"]
        self.objective: Optional[float] = file.get("objective")
        self.gains = _matrices.matrices(file["gains"])
        self.unknowns = _matrices.matrices(file["unknowns"])
        self.report = _matrices.matrices(file.get("report", {}))
        self.parameters: Dict[str, float] = file["parameters"]
        self.searched: Dict[str, float] = file.get("searched", {})
        self.gain_functions = {
            name: GainFunction(name, each) for name, each in file.get("gain_functions", {}).items()
        }
        self.margins: Dict[str, dict] = {each["name"]: each for each in file["margins"]}
        self.margin: Optional[float] = min(
            (each["reached"] for each in file["margins"]), default=None
        )
        self.search: Optional[dict] = file.get("search")
        self.values: Dict[str, Any] = {
            **self.parameters,
            **self.report,
            **self.unknowns,
            **self.gains,
            **self.searched,
        }
        self.summary = summary or self._short()

    def __getitem__(self, name: str):
        if name not in self.values:
            raise KeyError(f"the design has no '{name}'; {nearest(name, self.values)}")
        return self.values[name]

    def save(self, path) -> None:
        """Writes the gain file, for every command of the program."""
        write(path, self.text)

    def verify(self, **options):
        """verify(self, ...)"""
        return _commands().verify(self, **options)

    def worst(self, **options):
        """worst(self, ...)"""
        return _commands().worst(self, **options)

    def simulate(self, **options):
        """simulate(self, ...)"""
        return _commands().simulate(self, **options)

    def plot(self, **options):
        """plot(self, ...)"""
        return _commands().plot(self, **options)

    def check(self, **options):
        """check(self, ...)"""
        return _commands().check(self, **options)

    def certify(self, **options):
        """certify(self, ...)"""
        return _commands().certify(self, **options)

    def export(self, to: str, path=None, **options):
        """export(self, to, path, ...)"""
        return _commands().export(self, to, path, **options)

    def _short(self):
        lines = [
            f"problem     {self.file['problem']}",
            f"verdict     {self.verdict} ({self.status})",
        ]
        if self.objective is not None:
            lines.append(f"objective   {self.objective:.10g}")
        return "\n".join(lines + [f"{name} = {value}" for name, value in self.gains.items()])

    def __repr__(self):
        return self.summary

    def _repr_html_(self):
        return in_frame(_commands().report(self))


class Campaign(Record):
    """What simulated runs say of the claims.

    verdict: 'held', 'violated' or 'undecided'
    runs, seed, horizon, violations, undecided, worst_run, confidence: as the program writes them
    probability: with this confidence at most this part of such runs violates
    claims: name: {violations, worst_run, worst: {value, bound, t, j, ...}, ...}
    """

    verdict: str
    runs: int
    violations: int

    def __init__(self, file: dict, summary: str, gains):
        super().__init__(file, summary)
        self._gains = gains
        self.probability: Optional[float] = file.get("violation_probability_at_most")
        self.claims: Dict[str, dict] = {each["claim"]: each for each in file["checks"]}

    def replay(self):
        """The worst run, as simulate gives it."""
        return _commands().simulate(self._gains, run=self.file["worst_run"], seed=self.file["seed"])

    def _repr_html_(self):
        if isinstance(self._gains, Design):
            return in_frame(_commands().report(self._gains, campaign=self))
        return super()._repr_html_()


def in_frame(page: str) -> str:
    """A page inside another one, each with its own style."""
    return (
        f'<iframe srcdoc="{html.escape(page, quote=True)}" '
        'style="width: 100%; height: 40em; border: 0"></iframe>'
    )


def read(path) -> str:
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def _commands():
    import gainsmith  # commands make results, and results call commands

    return gainsmith


Gains = Union[Design, Problem]
