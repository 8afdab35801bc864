"""Gains of observers and controllers by linear matrix inequalities, with the program gainsmith.

    import numpy as np
    import gainsmith as gs

    problem = {
        "problem": "spring",
        "method": "observer",
        "data": {"A": np.array([[0, 1], [-2, -0.5]]), "C": np.array([[1, 0]])},
        "parameters": {"alpha": 3},
        "campaign": {"horizon": 2, "initial": {"x": {"box": [-1, 1]}}},
    }
    design = gs.synth(problem)
    design.verdict                    # 'yes': proved for the numbers of the gain file
    design.gains["L"]                 # array (2, 1)
    design.verify(runs=1000).verdict  # 'held'
    run = design.simulate(run=3)
    run.t, run["e"]                   # arrays (rows,) and (rows, 2)

A problem is a dict, the path of a YAML file, or a text. The program is found by the environment
variable GAINSMITH, beside the installed module, or on PATH. The verdicts 'no' and 'undecided' are
results. A wrong problem raises InputError with its place, a fault of the program ProgramError.
"""
from ._design import bisect, explain, optimize, scan, solve, synth
from ._errors import InputError, ProgramError
from ._figures import Figure, plot
from ._files import certify, check, compare, export, load, report
from ._results import (
    Campaign,
    Check,
    Design,
    Explanation,
    GainFunction,
    Proof,
    Record,
    Solution,
    Worst,
)
from ._runs import simulate, verify, worst
from ._tables import Run, Scan, Table

__all__ = [
    "synth",
    "optimize",
    "bisect",
    "scan",
    "explain",
    "verify",
    "worst",
    "simulate",
    "plot",
    "check",
    "certify",
    "report",
    "compare",
    "export",
    "solve",
    "load",
    "InputError",
    "ProgramError",
    "Design",
    "Campaign",
    "Run",
    "Figure",
    "Scan",
    "Check",
    "Proof",
    "Explanation",
    "Worst",
    "Solution",
    "GainFunction",
    "Record",
    "Table",
]
