#!/usr/bin/env python3
"""Writes what the fuzzers start from.

    seeds.py TREE FOLDER

FOLDER/TARGET.seeds holds one file a seed, FOLDER/TARGET.dict the words that are worth trying, for each target.
"""
import glob
import hashlib
import os
import re
import sys

# What a formula is made of: a scalar of YAML that holds none of these is no formula.
FORMULA = re.compile(r"[*+'<>()\[\]^]|\b\d")
SMALL_SDP = '"a comment\n2 = m\n2 = blocks\n2 -1\n1.0, 1.0\n0 1 1 2 -1.0\n1 1 1 1 1.0\n2 1 2 2 1e0\n2 2 1 1 1\n'
CSVS = ['t,y,"z, 1"\r\n0,1.5,-2\r\n0.1,,3e-3\r\n', "0.2, -1.01\n1,0\n"]
JSONS = ['{"A": [[1, -2.5e-3], [3, 0.1]], "gains": {"L": [1, 2]}}\n', "[1.5, -2, 3e5]"]
NPYS = [b"\x93NUMPY\x01\x00v\x00" + b"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1), }".ljust(117) + b"\n" + bytes(range(16))]
OPERATORS = ["<=", ">=", "<", ">", "+", "-", "*", "/", "^", "'", ",", ";", ":", "(", ")", "[", "]", "*,", "; *", "1e308",
             "1e-320", "pi", "I", "0", "^-1", ":)"]
NAMES = ["A", "C", "T2", "tol", "P", "L", "g", "tau", "Q", "mu(", "f(", "n", "p"]
YAML_WORDS = ["{", "}", "[", "]", "- ", ": ", "\n  ", "&a ", "*a", "!!str ", "|\n", ">\n", "#", "\n---\n", "<<: ", "~", ".nan", ".inf",
              "\"", "'"]


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write_seeds(folder, seeds):
    os.makedirs(folder, exist_ok=True)
    for seed in seeds:
        content = seed if isinstance(seed, bytes) else seed.encode()
        with open(os.path.join(folder, hashlib.sha256(content).hexdigest()[:16]), "wb") as file:
            file.write(content)


def write_dictionary(path, words):
    """In the syntax of libFuzzer: bytes that are not plain as \\xNN."""
    with open(path, "w", encoding="ascii") as file:
        for word in sorted(set(words)):
            plain = "".join(c if c.isascii() and c.isprintable() and c not in '"\\' else
                            "".join(f"\\x{byte:02X}" for byte in c.encode()) for c in word)
            file.write(f'"{plain}"\n')


def without_comments(text):
    return re.sub(r"(?m)(^|\s)#[^\n]*", r"\1", text)


def formulas(text):
    """What stands in quotes, or behind a key up to the end of its line or of its entry."""
    text = without_comments(text)
    found = re.findall(r'"([^"\n]*)"', text)
    found += re.findall(r"[\w)]:\s+([^\n{}\"]+?)\s*(?:[},]|$)", text, re.M)
    found += re.findall(r"[\w)]:\s+([^\n{}\"]+?)\s*$", text, re.M)
    return [formula for formula in found if FORMULA.search(formula)]


def definitions(text):
    """The lines "name: formula" and "name(tau): formula" below let:."""
    block = re.search(r"(?m)^let:\n((?:  [^\n]*\n)+)", without_comments(text))
    lines = re.findall(r"(?m)^  (\w+(?:\([\w, ]*\))?: [^\n{]+)$", block.group(1)) if block else []
    return [line.replace('"', "") for line in lines]


def main():
    tree, folder = sys.argv[1:]
    methods = {os.path.basename(path)[:-len(".yaml")]: read(path)
               for path in sorted(glob.glob(os.path.join(tree, "lib/methods/*.yaml")))}
    problems = [read(path) for path in sorted(glob.glob(os.path.join(tree, "problems/**/*.yaml"), recursive=True))]
    if not methods or not problems:
        sys.exit(f"seeds: no methods or no problems below {tree}")

    language, yaml = set(), set(problems)
    for text in [*methods.values(), *problems]:
        let = definitions(text)
        for formula in formulas(text):
            language.add(formula)
            if let:
                language.add("\n".join([*let, formula]))
    for problem in problems:
        name = re.search(r"(?m)^method: ([\w-]+)\s*$", problem)
        if name and name.group(1) in methods:
            yaml.add(problem.rstrip("\n") + "\n---\n" + methods[name.group(1)])
    # Small ones go faster: those that the tests of io break in one place at a time.
    problem, method = re.findall(r'R"\((.*?)\)"', read(os.path.join(tree, "tests/io/problem_text.h")), re.S)[:2]
    yaml.update([problem, "problem: a\nmethod: own\ndata: {A: [[1, 2], [3, 4]]}\n---\n" + method])
    write_seeds(os.path.join(folder, "language_fuzz.seeds"), language)
    write_seeds(os.path.join(folder, "yaml_fuzz.seeds"), yaml)
    write_seeds(os.path.join(folder, "sdpa_fuzz.seeds"), [SMALL_SDP])
    write_seeds(os.path.join(folder, "csv_fuzz.seeds"), CSVS)
    write_seeds(os.path.join(folder, "json_fuzz.seeds"), JSONS)
    write_seeds(os.path.join(folder, "npy_fuzz.seeds"), NPYS)
    write_seeds(os.path.join(folder, "mat_fuzz.seeds"),
                [open(path, "rb").read() for path in sorted(glob.glob(os.path.join(tree, "tests/data/*-v6.mat")))])

    functions = re.findall(r'^FUNCTION\([^"]*"(\w+)"', read(os.path.join(tree, "lib/expr/operations.def")), re.M)
    if not functions:
        sys.exit("seeds: no functions in lib/expr/operations.def")
    keys = set()
    for text in yaml:
        keys.update(re.findall(r"(?:^|[{,\s])([A-Za-z_]\w*):", without_comments(text)))
    words = OPERATORS + NAMES + [name + "(" for name in functions]
    write_dictionary(os.path.join(folder, "language_fuzz.dict"), words)
    write_dictionary(os.path.join(folder, "yaml_fuzz.dict"),
                     words + YAML_WORDS + [key + ": " for key in keys] + ["symmetric n", "n x n", "scalar", "yes", "held"])
    for target in ("csv", "json", "mat", "npy"):
        write_dictionary(os.path.join(folder, target + "_fuzz.dict"), ["1e308", "\n", ",", "\"", "[", "]", "{", "}", "A", "'shape': "])
    write_dictionary(os.path.join(folder, "sdpa_fuzz.dict"), ["{", "}", "(", ")", ",", "-1", "1e308", "\n", "*", "\"", "+"])


if __name__ == "__main__":
    main()
