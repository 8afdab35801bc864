"""Tables: columns by name."""
import html
from collections.abc import Mapping

from . import _matrices
from ._words import nearest


class Table(Mapping):
    """Columns by name, all of one length: pandas.DataFrame(dict(table)) takes it.

    rows: the number of rows
    """

    def __init__(self, columns: dict, rows: int):
        self._columns, self.rows = columns, rows

    def __getitem__(self, name):
        if name not in self._columns:
            raise KeyError(f"there is no column '{name}'; {nearest(name, self._columns)}")
        return self._columns[name]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def _cells(self, first=0, last=None):
        return [
            [_shown(self._columns[name][row]) for name in self._columns]
            for row in range(self.rows)[first:last]
        ]

    def __repr__(self):
        most = 40
        lines = [list(self._columns)] + self._cells(0, most)
        widths = [max(len(line[i]) for line in lines) for i in range(len(self._columns))]
        text = "\n".join(
            "  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in lines
        )
        return text if self.rows <= most else f"{text}\n... {self.rows} rows"

    def _repr_html_(self):
        most = 1000
        head = "".join(f"<th>{html.escape(name)}</th>" for name in self._columns)
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in line) + "</tr>"
            for line in self._cells(0, most)
        )
        rest = "" if self.rows <= most else f"<p>{most} of {self.rows} rows</p>"
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{rest}"


class Scan(Table):
    """The points of a grid: a column for each scalar, `verdict`, `objective`, and one for each
    expression of `show`.

    verdict: 'yes' if some point is feasible, 'no' if none is by certificates, else 'undecided'
    points: the points as the program writes them
    """

    def __init__(self, points: list, verdict: str):
        self.points, self.verdict = points, verdict
        columns = {}
        for name in points[0]["at"] if points else ():
            columns[name] = _matrices.column([point["at"][name] for point in points])
        columns["verdict"] = [point["verdict"] for point in points]
        if any("objective" in point for point in points):
            columns["objective"] = _matrices.column([point.get("objective") for point in points])
        for name in points[0].get("figures", ()) if points else ():
            columns[name] = _matrices.column(
                [point.get("figures", {}).get(name) for point in points]
            )
        super().__init__(columns, len(points))


class Run(Table):
    """One run: `t` (time), `j` (jumps so far), `event`, states, signals, the value of each claim.

    run["x"] of a vector that has the columns x1, x2, ... is the array (rows, n).
    ending: why the run ended; end: its time; units: those that the problem states
    summary: what the program says
    """

    def __init__(self, file: dict, summary: str, draw):
        self.file, self.summary, self._draw = file, summary, draw
        self.ending, self.end, self.units = file["ending"], file["end"], file.get("units", {})
        names, rows = file["columns"], file["rows"]
        cells = list(zip(*rows)) if rows else [()] * len(names)
        super().__init__(
            {name: _matrices.column(each) for name, each in zip(names, cells)}, len(rows)
        )

    @property
    def t(self):
        """The times (rows,)."""
        return self["t"]

    @property
    def j(self):
        """The numbers of jumps so far (rows,)."""
        return self["j"]

    def __getitem__(self, name):
        if name not in self._columns and f"{name}1" in self._columns:
            parts = []
            while f"{name}{len(parts) + 1}" in self._columns:
                parts.append(self._columns[f"{name}{len(parts) + 1}"])
            return _matrices.beside(parts)
        return super().__getitem__(name)

    def plot(self, path, **options):
        """Draws the run into a file .svg, .pdf or .png.

        Options: panels='x1,e,claims', phase='x1,x2', band='xh:P'
        """
        return self._draw(path, **options)

    def __repr__(self):
        return self.summary

    def _repr_html_(self):
        return self._draw(None)


def _shown(value):
    if isinstance(value, str):
        return value
    return "" if value != value else f"{value:.8g}"
