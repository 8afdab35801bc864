"""The files for editors find file, line and column in what the program prints."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

TREE, PROGRAM = sys.argv.pop(1), sys.argv.pop(1)
EDITORS = os.path.join(TREE, "apps", "editors")


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)


class Editors(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file = os.path.join(self.folder.name, "wrong.yaml")
        with open(self.file, "w", encoding="utf-8") as file:
            file.write("problem: p\nmethod: lqr\ndata: {A: [[0]], B: [[q]]}\n")

    def expect(self, pattern, text):
        found = re.search(pattern, text, re.M)
        self.assertTrue(found, f"{pattern} in {text}")
        self.assertEqual(found.groups()[:3], (self.file, "3", "23"))
        self.assertIn("'q'", found.group(4))

    def test_visual_studio_code(self):
        with open(os.path.join(EDITORS, "vscode-tasks.json"), encoding="utf-8") as file:
            check, watch = json.load(file)["tasks"]
        printed = run(check["args"][0], self.file)
        self.expect(check["problemMatcher"]["pattern"]["regexp"], printed.stderr + printed.stdout)
        printed = run("run", self.file, "-o", os.path.join(self.folder.name, "results"))
        self.expect(watch["problemMatcher"]["pattern"]["regexp"], printed.stdout)

    def test_efm_langserver(self):
        with open(os.path.join(EDITORS, "efm-langserver.yaml"), encoding="utf-8") as file:
            text = file.read()
        command, = re.findall(r"lint-command: '(.*)'", text)
        self.assertEqual(command, "gainsmith check ${INPUT}")
        form, = re.findall(r"lint-formats: \['(.*)'\]", text)
        pattern = re.escape(form)
        for mark, means in {"%f": "(.+?)", "%l": r"(\d+)", "%c": r"(\d+)", "%m": "(.*)"}.items():
            pattern = pattern.replace(mark, means)
        self.expect(pattern, run("check", self.file).stderr)


if __name__ == "__main__":
    unittest.main()
