"""Arguments of the tests of this folder, and how they skip."""
import os
import shutil
import subprocess
import sys

TREE, BUILD = sys.argv[1:3]
del sys.argv[1:3]
SKIPPED = 77  # SKIP_RETURN_CODE in CMakeLists.txt


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def run(*command, **options):
    """The finished command, whose output is text; AssertionError with its output when it fails."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    return done


def has(program):
    return shutil.which(program) is not None


def below(folder):
    return {os.path.relpath(os.path.join(where, name), folder) for where, _, names in os.walk(folder) for name in names}
