"""docs/papers.md: what it names is there, and no number of the papers is left out.

    papers_test.py TREE GAINSMITH
"""
import json
import os
import re
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop(2)
TREE = sys.argv.pop(1)

# The last number of each kind in each paper.
LAST = {
    "Sampled-data observer": {"": 25, "definition": 1, "assumption": 1, "theorem": 3, "proposition": 1, "remark": 1, "table": 1, "fig": 1},
    "Linear hybrid plants": {"": 100, "definition": 5, "assumption": 5, "theorem": 8, "lemma": 3, "corollary": 1, "remark": 10, "example": 5,
                             "table": 1},
    "Coupled observers": {"": 23, "definition": 1, "assumption": 5, "theorem": 3, "remark": 6, "example": 2, "fig": 1},
    "Constrained estimates": {"": 72, "assumption": 4, "theorem": 3, "lemma": 8, "proposition": 1, "remark": 6, "table": 3, "fig": 5},
    "Uniting observers": {"": 32, "definition": 1, "assumption": 10, "theorem": 2, "proposition": 2, "remark": 6, "table": 2, "fig": 6},
}


def read(path):
    with open(os.path.join(TREE, path), encoding="utf-8") as file:
        return file.read()


def rows():
    """The rows of the tables as (paper, cells)."""
    for section in read("docs/papers.md").split("\n## ")[1:]:
        title, text = section.split("\n", 1)
        for line in text.splitlines():
            if line.startswith("| ") and not line.startswith("| in the paper"):
                yield title, [cell.strip() for cell in line[1:-1].split("|")]


def whole(numeral):
    return {"I": 1, "II": 2, "III": 3}.get(numeral) or int(numeral)


def numbers(entry):
    """The numbers that the first cell of a row names, by their kind."""
    text = entry.split("*Errs*")[0]
    found = {"": set()}
    for first, last in re.findall(r"\((\d+)\)(?:-\((\d+)\))?", text):
        found[""] |= set(range(int(first), int(last or first) + 1))
    one = r"(?:\d+|I+\b)"
    for kind, listed in re.findall(rf"\b([a-z]+?)(?:mma)?s?\.? ({one}(?:(?:, | to ){one})*)", text):
        kind = {"le": "lemma"}.get(kind, kind)
        for part in listed.split(", "):
            ends = [whole(end) for end in part.split(" to ")]
            found.setdefault(kind, set()).update(range(ends[0], ends[-1] + 1))
    return found


class Papers(unittest.TestCase):
    def test_every_row_has_four_cells(self):
        for title, cells in rows():
            self.assertEqual(len(cells), 4, f"{title}: {cells}")
            reason = re.search("nothing to compute|not yet", " ".join(cells[1:3]))
            self.assertTrue(cells[1].startswith("`") or reason, f"{title}: {cells[0]}: neither a file nor a reason")
            self.assertTrue(cells[3] or reason, f"{title}: {cells[0]}: no test")

    def test_methods_and_problems_are_there(self):
        known = {method["method"] for method in json.loads(
            subprocess.run([PROGRAM, "methods", "--json"], capture_output=True, text=True, check=True).stdout)}
        known |= set(re.findall(r"^\| `([a-z_0-9]+)\(", read("docs/language.md"), re.M))
        for title, cells in rows():
            for name in re.findall(r"`([^`]+)`", cells[1]):
                there = os.path.exists(os.path.join(TREE, "problems", name + ".yaml")) if "/" in name else name in known
                self.assertTrue(there, f"{title}: {cells[0]}: {name}")

    def test_tests_are_there(self):
        sources = "".join(read(os.path.relpath(os.path.join(folder, name), TREE))
                          for folder, _, names in os.walk(os.path.join(TREE, "tests")) for name in names if name.endswith(".cpp"))
        known = {f"{suite}.{name}" for suite, name in re.findall(r"TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", sources)}
        for title, cells in rows():
            for name in re.findall(r"`([^`]+)`", cells[3]):
                self.assertIn(name, known, f"{title}: {cells[0]}")
            if cells[3] == "expect":
                self.assertTrue("`" in cells[1], f"{title}: {cells[0]}: expect of which file?")

    def test_every_number_has_its_row(self):
        found = {}
        for title, cells in rows():
            for kind, of in numbers(cells[0]).items():
                found.setdefault((title, kind), set()).update(of)
        for title, kinds in LAST.items():
            for kind, last in kinds.items():
                missing = sorted(set(range(1, last + 1)) - found.get((title, kind), set()))
                self.assertEqual(missing, [], f"{title}: {kind or 'equation'}")


if __name__ == "__main__":
    unittest.main()
