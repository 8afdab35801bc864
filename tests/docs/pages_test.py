"""The pages show what is there: links, examples, inequalities, options.

    pages_test.py TREE GAINSMITH

GAINSMITH_TEST_PROGRAM in the environment names another program, as for the end-to-end tests; GAINSMITH_TEST_PAGES the pages
whose commands are run.
"""
import fnmatch
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILT = sys.argv.pop(2)
PROGRAM = os.environ.get("GAINSMITH_TEST_PROGRAM") or BUILT
TREE = sys.argv.pop(1)
GALLERY = "docs/gallery.md"


def read(path):
    with open(os.path.join(TREE, path), encoding="utf-8") as file:
        return file.read()


def pages():
    found = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "problems/README.md"]
    found += pages_below("docs") + pages_below("problems")
    return sorted(set(found))


def pages_below(root):
    return [os.path.relpath(os.path.join(folder, name), TREE) for folder, _, names in os.walk(os.path.join(TREE, root))
            for name in names if name.endswith(".md")]


def yaml_blocks(page, first_key):
    return [block for block in re.findall(r"```yaml\n(.*?)```", read(page), re.S) if block.startswith(first_key + ":")]


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)


def check(text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "problem.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return run("check", path)


def transcripts(page):
    """What a page shows of a shell, as pairs of a command and the lines that it prints, and the files that it shows: problems, and C and
    Python with their names in the first line."""
    problems = {}
    found = []
    for fenced, indented in re.findall(r"```(?:yaml|c|python)\n(.*?)```|((?:^    [^\n]*\n)+)", read(page), re.M | re.S):
        if fenced.startswith("problem:"):
            problems[fenced.splitlines()[0].split()[-1].split("/")[-1] + ".yaml"] = fenced
        elif fenced.startswith("/* ") or re.match(r"# \w+\.py\n", fenced):
            problems[fenced.split()[1]] = fenced
        lines = [line[4:].rstrip() for line in indented.splitlines()]
        for line in lines if indented.startswith("    $ ") else []:
            if line.startswith("$ "):
                found.append((line[2:], []))
            else:
                found[-1][1].append(line)
    return problems, found


def python_with_numpy():
    """An interpreter that has NumPy, which the examples in Python use."""
    for interpreter in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([interpreter, "-c", "import numpy"], capture_output=True, check=False).returncode == 0:
            return interpreter
    raise AssertionError("python3-numpy is not installed")


def prints(shown, printed):
    """Whether the output is as shown, where ... stands for the rest of a line, and in a line of its own for more lines."""
    pattern = "\n".join(re.escape(line) for line in shown)
    return re.fullmatch(pattern.replace("\n" + r"\.\.\.", r"(?:\n.*)*").replace(r"\.\.\.", ".*"), printed) is not None


class PagesSayWhatIsThere(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in pages():
            # What stands between backticks is code: [1, 2](1) is an index there.
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", re.sub(r"`[^`\n]*`", "", read(page))):
                path = os.path.join(TREE, os.path.dirname(page), target)
                self.assertTrue(os.path.exists(path), f"{page}: {target}")

    def test_every_problem_is_listed(self):
        listed = re.findall(r"`([\w.*-]+)`", read("problems/README.md"))
        for folder, _, names in os.walk(os.path.join(TREE, "problems")):
            for name in names:
                if name.endswith(".yaml"):
                    self.assertTrue(any(fnmatch.fnmatch(name[:-5], pattern) for pattern in listed), f"{folder}/{name}")
                    self.assertIn(os.path.basename(folder), read("problems/README.md"))

    def test_every_decision_has_its_number(self):
        for name in set(os.listdir(os.path.join(TREE, "docs/decisions"))) - {"README.md"}:
            title = read("docs/decisions/" + name).splitlines()[0]
            self.assertEqual(title.split(".")[0], f"# {int(name[:4])}", name)

    def test_the_page_of_a_paper_shows_the_inequalities_of_its_method(self):
        quoted = re.findall(r'^    (".*?(?:<|<=) 0")$', read("problems/ferrante-seuret-2021/README.md"), re.M | re.S)
        self.assertEqual(len(quoted), 2)
        method = re.sub(r"\s+", " ", read("lib/methods/sampled-data-hybrid.yaml"))
        for text in quoted:
            self.assertIn(re.sub(r"\s+", " ", text), method)

    def test_add_a_method_shows_the_method(self):
        page = re.findall(r"```yaml\n(.*?)```", read("docs/add-a-method.md"), re.S)
        shown = [block for block in page if not block.startswith("problem:")]
        self.assertEqual("\n".join(shown), read("lib/methods/reset-observer.yaml"))

    def test_example_problem_is_valid(self):
        for page in ("docs/language.md", "docs/dynamics.md", "README.md", "docs/add-a-method.md", "docs/tutorial.md"):
            for block in yaml_blocks(page, "problem"):
                found = check(block)
                self.assertEqual(found.returncode, 0, found.stderr)

    def test_example_method_is_valid(self):
        for block in yaml_blocks("docs/language.md", "method"):
            inline = "".join("  " + line + "\n" for line in block.splitlines())
            found = check("problem: example\nmethod:\n" + inline +
                          'data: {A: "[0.2, -1.01; 1, 0]", C: "[0.5, -1]", T1: 0.5, T2: 0.7}\n')
            self.assertEqual(found.returncode, 0, found.stderr)

    def test_readme_lists_the_subcommands(self):
        listed = re.findall(r"^\| `gainsmith (\w+)", read("README.md"), re.M)
        known = re.findall(r"^  (\w+)  ", run("--help").stdout.split("Subcommands:")[1], re.M)
        self.assertEqual(sorted(listed), sorted(known))

    def test_bibliography_names_the_methods(self):
        for method in json.loads(run("methods", "--json").stdout):
            self.assertIn(f"`{method['method']}`", read("docs/bibliography.md"))

    def test_keys_of_method_and_problem_files(self):
        page = read("docs/language.md")
        for source in ("method_yaml", "problem_yaml", "synthesis_yaml", "search_yaml", "expectation_yaml"):
            for key in re.findall(r'(?:find|require)\("(\w+)"\)', read(f"lib/io/yaml/{source}.cpp")):
                self.assertRegex(page, rf"(`|`\w+\.|\{{|\b){key}\b", f"{source}: {key}")


class OfCommands:
    def test_commands_print_what_is_shown(self):
        for page in self.pages():
            problems, found = transcripts(page)
            self.assertTrue(found or page not in ("README.md", "docs/tutorial.md", "docs/gallery.md", "docs/add-a-method.md", "docs/forall.md"), page)
            with tempfile.TemporaryDirectory() as folder:
                os.symlink(os.path.abspath(os.path.join(TREE, "problems")), os.path.join(folder, "problems"))
                for name, text in problems.items():
                    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                        file.write(text)
                path = os.path.dirname(os.path.abspath(PROGRAM)) + os.pathsep + os.environ["PATH"]
                if any(command.startswith("python3 ") for command, _ in found):
                    os.makedirs(os.path.join(folder, "bin"))
                    os.symlink(python_with_numpy(), os.path.join(folder, "bin", "python3"))
                    path = os.path.join(folder, "bin") + os.pathsep + path
                environment = {**os.environ, "PATH": path, "PYTHONPATH": os.path.abspath(os.path.join(TREE, "apps", "python")),
                               "PYTHONDONTWRITEBYTECODE": "1", "GAINSMITH": os.path.abspath(PROGRAM)}
                for command, shown in found:
                    printed = subprocess.run(["bash", "-c", command + " 2>&1"], cwd=folder, env=environment,
                                             capture_output=True, text=True, check=False).stdout
                    printed = "\n".join(line.rstrip() for line in printed.strip("\n").splitlines())
                    self.assertTrue(prints(shown, printed), f"{page}: {command}\n{printed}")
                self.compare_pictures(page, folder)

    def compare_pictures(self, page, folder):
        """Pictures that a page shows and its commands make have the same words; WRITE_PICTURES=1 replaces those shown."""
        for target in re.findall(r"!\[[^]]*\]\(([^)]+\.svg)\)", read(page)):
            shown = os.path.normpath(os.path.join(TREE, os.path.dirname(page), target))
            places = ["/".join(shown.split("/")[-2:]), os.path.basename(shown)]
            made = [path for path in (os.path.join(folder, place) for place in places) if os.path.exists(path)]
            self.assertTrue(made or page not in ("docs/tutorial.md", "docs/gallery.md"), f"{page}: no command makes {target}")
            if not made:
                continue
            if os.environ.get("WRITE_PICTURES"):
                shutil.copyfile(made[0], shown)
            words = [re.findall(r"<text[^>]*>([^<]*)</text>", read(os.path.relpath(path, TREE))) for path in [shown, *made]]
            for of in words[1:]:
                self.assertEqual(*[[word for word in each if re.match("[a-z]", word)] for each in (of, words[0])], f"{page}: {target}")


class Gallery(OfCommands, unittest.TestCase):
    """The page that runs longest."""

    @staticmethod
    def pages():
        return [GALLERY]


class Commands(OfCommands, unittest.TestCase):
    """Those of the other pages, or of GAINSMITH_TEST_PAGES."""

    @staticmethod
    def pages():
        return os.environ.get("GAINSMITH_TEST_PAGES", "").split() or [page for page in pages() if page != GALLERY]


if __name__ == "__main__":
    unittest.main()
