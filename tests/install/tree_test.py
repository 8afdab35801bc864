"""What `cmake --install` puts where, and that it is of use there.

    tree_test.py TREE BUILD [Tree|Library]
"""
import json
import os
import re
import shutil
import sys
import tempfile
import unittest

from installed import BUILD, TREE, below, has, run


def install(prefix):
    run("cmake", "--install", BUILD, "--prefix", prefix)


def options_in(text):
    """The names of options that help shows."""
    return set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", "\n".join(re.findall(r"^  (-.*?)(?:   |$)", text, re.M)))) - {"-h", "--help"}


class Tree(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.prefix = os.path.join(cls.folder.name, "prefix")
        install(cls.prefix)
        cls.program = os.path.join(cls.prefix, "bin/gainsmith")
        cls.names = re.findall(r"^  ([a-z]+) ", run(cls.program, "--help").stdout.partition("Subcommands:")[2], re.M)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def read(self, path):
        with open(os.path.join(self.prefix, path), encoding="utf-8") as file:
            return file.read()

    def help(self, name):
        return run(self.program, name, "--help").stdout

    def test_everything_has_its_place(self):
        there = below(self.prefix)
        for path in ("share/man/man1/gainsmith.1.gz", "share/bash-completion/completions/gainsmith",
                     "share/zsh/site-functions/_gainsmith", "share/fish/vendor_completions.d/gainsmith.fish",
                     "share/gainsmith/README.md", "share/gainsmith/LICENSE", "share/gainsmith/docs/tutorial.md",
                     "share/gainsmith/schemas/problem.schema.json", "share/doc/gainsmith/copyright",
                     "include/gainsmith/gainsmith.h",
                     "lib/python3/dist-packages/gainsmith/__init__.py", "share/octave/site/m/gainsmith.m"):
            self.assertIn(path, there)
        problems = {path for path in below(os.path.join(TREE, "problems"))}
        self.assertEqual(problems, below(os.path.join(self.prefix, "share/gainsmith/problems")))
        self.assertFalse([path for path in there if TREE in path or path.endswith((".cpp.o", ".cmake.in"))])

    def test_links_of_pages_lead_somewhere(self):
        share = os.path.join(self.prefix, "share/gainsmith")
        for page in below(share):
            if not page.endswith(".md"):
                continue
            text = re.sub(r"`[^`\n]*`", "", self.read(os.path.join("share/gainsmith", page)))
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
                self.assertTrue(os.path.exists(os.path.join(share, os.path.dirname(page), target)), f"{page}: {target}")

    def test_the_modules_of_python_and_octave_find_the_program(self):
        environment = {name: value for name, value in os.environ.items() if name != "GAINSMITH"}
        environment.update(PATH="/usr/bin:/bin", PYTHONPATH=os.path.join(self.prefix, "lib/python3/dist-packages"))
        problem = os.path.join(self.prefix, "share/gainsmith/problems/designs/lqr.yaml")
        code = "import sys, gainsmith; print(gainsmith.synth(sys.argv[1]).verdict)"
        self.assertEqual(run(sys.executable, "-B", "-c", code, problem, env=environment).stdout, "yes\n")
        if not has("octave-cli"):
            self.skipTest("octave is not installed")
        code = f"addpath('{self.prefix}/share/octave/site/m'); disp(gainsmith('synth', '{problem}').verdict)"
        self.assertEqual(run("octave-cli", "--no-init-file", "--eval", code, env=environment).stdout, "yes\n")

    def test_problems_run_from_there(self):
        problem = os.path.join(self.prefix, "share/gainsmith/problems/ferrante-seuret-2021/t2-0.70.yaml")
        gains = os.path.join(self.folder.name, "gains.json")
        run(self.program, "synth", problem, "-o", gains)
        with open(gains, encoding="utf-8") as file:
            self.assertEqual(json.load(file)["verdict"], "yes")

    @unittest.skipUnless(os.geteuid() == 0, "only root changes the root folder")
    def test_the_program_needs_the_c_library_alone(self):
        node = os.path.join(self.folder.name, "node")
        os.makedirs(node)
        needed = re.findall(r"(/\S+)", run("ldd", self.program).stdout)
        self.assertEqual(sorted(os.path.basename(library) for library in needed),
                         ["ld-linux-x86-64.so.2", "libc.so.6", "libm.so.6"])
        for file in [self.program, *needed]:
            os.makedirs(node + os.path.dirname(file), exist_ok=True)
            shutil.copy(os.path.realpath(file), node + file)
        problem = os.path.join(self.prefix, "share/gainsmith/problems/ferrante-seuret-2021/t2-0.70.yaml")
        shutil.copy(problem, os.path.join(node, "problem.yaml"))
        command = ["chroot", node, self.program]
        run(*command, "synth", "/problem.yaml", "-o", "/gains.json")
        self.assertIn("held in 5000 runs", run(*command, "verify", "/gains.json", "--runs", "5000").stdout)

    def test_the_manual_page_says_what_help_says(self):
        page = run("gzip", "-dc", os.path.join(self.prefix, "share/man/man1/gainsmith.1.gz")).stdout
        sections = dict(re.findall(r"\.SS gainsmith (\w+)\n(.*?)(?=\n\.S[SH] )", page, re.S))
        self.assertEqual(sorted(sections), sorted(self.names))
        for name, section in sections.items():
            heads = "\n".join(re.findall(r"\.TP\n(.*)", section)).replace("\\-", "-")
            self.assertEqual(set(re.findall(r"\\fB(-[\w-]+)\\fR", heads)), options_in(self.help(name)), name)
        if has("groff"):
            self.assertEqual(run("groff", "-man", "-Tutf8", "-ww", "-z", input=page).stderr, "")

    def test_bash_completes(self):
        def completed(*words):
            line = " ".join(f"'{word}'" for word in words)
            script = (f"source '{self.prefix}/share/bash-completion/completions/gainsmith'\n"
                      f"COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _gainsmith; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
            return set(run("bash", "-c", script).stdout.split())

        self.assertEqual(completed("gainsmith", ""), {*self.names, "help", "--help", "--version"})
        self.assertEqual(completed("gainsmith", "help", ""), set(self.names))
        self.assertEqual(completed("gainsmith", "help", "sy"), {"synth"})
        self.assertEqual(completed("gainsmith", "export", "--to", "ma"), {"matlab", "mat"})
        self.assertEqual(completed("gainsmith", "sy"), {"synth"})
        for name in self.names:
            self.assertEqual(completed("gainsmith", name, "-"), options_in(self.help(name)) | {"--help"}, name)
        self.assertEqual(completed("gainsmith", "solve", "--format", ""), {"json", "csdp", "sdpa"})
        self.assertEqual(completed("gainsmith", "init", "lq"), {"lqr"})
        self.assertEqual(completed("gainsmith", "synth", "problems/"), set())  # bash completes files

    def test_fish_completes(self):
        if not has("fish"):
            self.skipTest("fish is not installed")
        script = os.path.join(self.prefix, "share/fish/vendor_completions.d/gainsmith.fish")
        env = {**os.environ, "HOME": self.folder.name, "PATH": os.path.dirname(self.program) + os.pathsep + os.environ["PATH"]}

        def completed(line):
            done = run("fish", "--no-config", "-c", f"source '{script}'; complete -C '{line}'", env=env)
            return {word.split("\t")[0] for word in done.stdout.splitlines()}

        self.assertEqual(completed("gainsmith "), {*self.names, "help"})
        self.assertEqual(completed("gainsmith help "), set(self.names))
        for name in self.names:
            self.assertTrue(options_in(self.help(name)) <= completed(f"gainsmith {name} -") | completed(f"gainsmith {name} --"), name)
        self.assertEqual(completed("gainsmith solve --format "), {"json", "csdp", "sdpa"})

    def test_zsh_reads_its_script(self):
        if not has("zsh"):
            self.skipTest("zsh is not installed")
        script = os.path.join(self.prefix, "share/zsh/site-functions/_gainsmith")
        run("zsh", "-n", script)
        test = (f"fpath=({os.path.dirname(script)} $fpath); autoload -U compinit; compinit -u -D; autoload +X _gainsmith; "
                "print -- $_comps[gainsmith]; print -- $functions[_gainsmith]")
        printed = run("zsh", "-f", "-c", test).stdout
        self.assertTrue(printed.startswith("_gainsmith\n"), printed[:100])
        for name in [*self.names, "help"]:
            self.assertIn(f"({name}) _arguments", re.sub(r"[()]+(\w+)\)\s+_arguments", r"(\1) _arguments", printed), name)


class Library(unittest.TestCase):
    def test_a_project_finds_links_and_uses_it(self):
        with tempfile.TemporaryDirectory() as folder:
            prefix = os.path.join(folder, "prefix")
            install(prefix)
            example = os.path.join(folder, "example")
            shutil.copytree(os.path.join(prefix, "share/gainsmith/docs/api"), example)
            build = os.path.join(example, "build")
            run("cmake", "-S", example, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}",
                "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror")
            run("cmake", "--build", build)
            with open(os.path.join(TREE, "README.md"), encoding="utf-8") as file:
                motor = re.search(r"```yaml\n(problem: motor.*?)```", file.read(), re.S).group(1)
            problem = os.path.join(folder, "motor.yaml")
            with open(problem, "w", encoding="utf-8") as file:
                file.write(motor)
            program = os.path.join(build, "observer")
            printed = run(program, problem).stdout
            with open(os.path.join(TREE, "docs/api.md"), encoding="utf-8") as file:
                page = file.read()
            shown = re.search(r"    build/observer motor\.yaml\n((?:    .*\n)+)", page).group(1)
            pattern = re.escape("".join(line[4:] + "\n" for line in shown.splitlines())).replace(r"\.\.\.", r".*")
            self.assertRegex(printed, f"^{pattern}$")
            # The same gains as the program.
            gains = json.loads(run(os.path.join(prefix, "bin/gainsmith"), "synth", problem, "--json").stdout)["gains"]["L"]
            for row, (value,) in enumerate(gains):
                self.assertIn(f"L({row + 1}, 1) = {value:.3f}\n", printed)

    def test_the_page_shows_the_example_and_the_header(self):
        with open(os.path.join(TREE, "docs/api.md"), encoding="utf-8") as file:
            page = file.read()
        for name in ("main.cpp", "CMakeLists.txt"):
            with open(os.path.join(TREE, "docs/api", name), encoding="utf-8") as file:
                self.assertIn(file.read(), page)
        with open(os.path.join(TREE, "lib/api/gainsmith.h"), encoding="utf-8") as file:
            declared = re.findall(r"^(?:struct|class|enum class) (\w+)|^\w[\w:]* (\w+)\(", file.read(), re.M)
        for name in {one or two for one, two in declared}:
            self.assertIn(f"`{name}`", page)


if __name__ == "__main__":
    unittest.main()
