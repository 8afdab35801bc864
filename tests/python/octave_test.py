"""apps/matlab/gainsmith.m in Octave, and the example of docs/python.md.

    octave_test.py TREE GAINSMITH
"""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from support import TREE, main, skip

OCTAVE = shutil.which("octave-cli")
if not OCTAVE:
    skip("octave is not installed")


def octave(*arguments, folder=None):
    return subprocess.run(
        [OCTAVE, "--no-init-file", *arguments],
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
    )


class Octave(unittest.TestCase):
    def test_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            done = octave(os.path.join(TREE, "tests/python/octave_test.m"), TREE, folder=folder)
        self.assertRegex(done.stdout, r"\n?\d\d+ passed\n$", done.stdout + done.stderr)

    def test_the_example_of_the_page(self):
        with open(os.path.join(TREE, "docs/python.md"), encoding="utf-8") as file:
            (example,) = re.findall(r"```matlab\n(.*?)```", file.read(), re.S)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "example.m")
            with open(path, "w", encoding="utf-8") as file:
                file.write(
                    f"addpath('{TREE}/apps/matlab')\n"
                    + example.replace("plot(run.t, [", "disp([run.t, ")
                )
            done = octave(path)
        for line in re.findall(r"% prints (.*)", example):
            self.assertIn(line, done.stdout, done.stderr)
        self.assertNotIn("error: '", done.stderr)

    def test_temporary_files_are_removed(self):
        with tempfile.TemporaryDirectory() as folder:
            code = (
                f"addpath('{TREE}/apps/matlab'); "
                "try, gainsmith('synth', struct('problem', 'a')), catch e, end; "
                "gainsmith('solve', sprintf('1\\n1\\n1\\n1\\n1 1 1 1 1\\n'));"
            )
            done = subprocess.run(
                [OCTAVE, "--no-init-file", "--eval", code],
                env={**os.environ, "TMPDIR": folder},
                capture_output=True,
                text=True,
                check=False,
            )
            self.assertEqual((done.returncode, os.listdir(folder)), (0, []), done.stderr)


if __name__ == "__main__":
    main()
