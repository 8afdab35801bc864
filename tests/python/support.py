"""Arguments of the tests of this folder, and how they skip: TEST.py TREE GAINSMITH.

GAINSMITH_TEST_PROGRAM in the environment names another program, as for the end-to-end tests.
"""
import os
import subprocess
import sys
import unittest

SKIPPED = 77  # SKIP_RETURN_CODE in CMakeLists.txt
TREE, BUILT = (os.path.abspath(each) for each in sys.argv[1:3])
PROGRAM = os.path.abspath(os.environ.get("GAINSMITH_TEST_PROGRAM") or BUILT)
MODULE = os.path.join(TREE, "apps", "python")
os.environ["GAINSMITH"] = PROGRAM
sys.path.insert(0, MODULE)


def problem(name):
    return os.path.join(TREE, "problems", name + ".yaml")


def spring(**changes):
    """A problem that holds in simulation, as a dict without NumPy."""
    return {
        "problem": "spring",
        "method": "observer",
        "data": {"A": [[0, 1], [-2, -0.5]], "C": [[1, 0]]},
        "parameters": {"alpha": 3},
        "campaign": {"horizon": 2, "initial": {"x": {"box": [-1, 1]}}},
        **changes,
    }


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def with_numpy():
    """Goes on in an interpreter that has NumPy, or skips."""
    try:
        import numpy  # noqa: F401

        return
    except ImportError:
        pass
    debian = "/usr/bin/python3"
    has = os.path.exists(debian) and subprocess.run(
        [debian, "-c", "import numpy"], capture_output=True, check=False
    )
    if (
        not has
        or has.returncode != 0
        or os.path.realpath(debian) == os.path.realpath(sys.executable)
    ):
        skip("python3-numpy is not installed")
    os.execv(debian, [debian, "-B", *sys.argv])


def main():
    del sys.argv[1:3]
    unittest.main()
