"""The schemas that the program prints accept what its readers accept, and refuse what they refuse for its structure.

    schema_test.py TREE GAINSMITH

Mistakes are made from the problems of the tree: every key that is known there is misspelt, left out and given values of
other kinds; then reader and schema are asked.
"""
import copy
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
    import yaml
except ImportError as error:
    print(f"skipped: {error}; scripts/packages installs python3-jsonschema and python3-yaml")
    sys.exit(77)

PROGRAM = os.environ.get("GAINSMITH_TEST_PROGRAM") or sys.argv[2]
TREE = sys.argv[1]
del sys.argv[1:3]

# What a reader says of keys and kinds of values, in contrast to what they hold.
STRUCTURE = re.compile(
    r"unknown key|the key '.*' is missing|expected a mapping|expected a (text|list)|expected an expression, found"
    r"|expected a number or an expression here, found|expected \[low, high\]|expected a range|expected a row"
    r"|list is empty|row is empty|expected a shape, such as|: expected an object|expected true or false|expected a whole number$"
    r"|expected a number$|not both|the formula is missing|expected a number, found ''")

OTHER_VALUES = [None, 7, "a word", [], [1, 2], ["a", "b", "c"], [[1, 2], [3, 4]], [[[1]]], {}, {"zz": 1}, {"zz": {"zz": [1]}}]


class Core(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
    """YAML 1.2: yes and 1:20 are texts, 1e-3 is a number."""


Core.yaml_implicit_resolvers = {}
for tag, pattern, first in (("null", r"~|null|Null|NULL|", ["~", "n", "N", ""]),
                            ("bool", r"true|True|TRUE|false|False|FALSE", list("tTfF")),
                            ("int", r"[-+]?[0-9]+", list("-+0123456789")),
                            ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", list("-+.0123456789"))):
    Core.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile(f"^(?:{pattern})$"), first)


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, **options)


def schema(kind):
    document = json.loads(run("schema", kind).stdout)
    jsonschema.Draft7Validator.check_schema(document)
    return jsonschema.Draft7Validator(document)


def load(path):
    with open(path, encoding="utf-8") as file:
        return yaml.load(file, Loader=Core)


class Walk:
    """The places of a document where a level of the schema stands: (its name, the path of keys)."""

    def __init__(self, validator):
        self.validator = validator
        self.definitions = validator.schema["definitions"]

    def level(self, name):
        root = self.validator.schema
        return self.definitions[name or "problem"] if name or "else" in root else root

    def levels(self, value, form=None, name="", path=()):
        form = self.level("") if form is None else form
        while "$ref" in form:
            name = form["$ref"].rsplit("/", 1)[1]
            form = self.definitions[name]
        if "allOf" in form and "properties" not in form:
            yield from self.levels(value, form["allOf"][0], name, path)
            return
        if "anyOf" in form and "properties" not in form:
            # Where none fits, a mapping is meant as one with known keys.
            fits = [one for one in form["anyOf"] if self.validator.evolve(schema=one).is_valid(value)]
            for one in fits or [one for one in form["anyOf"] if ("$ref" in one or "allOf" in one) and isinstance(value, dict)]:
                yield from self.levels(value, one, name, path)
                return
        if isinstance(value, list) and "items" in form:
            for k, item in enumerate(value):
                each = form["items"]
                yield from self.levels(item, each[k] if isinstance(each, list) else each, name, path + (k,))
        if not isinstance(value, dict):
            return
        if "properties" in form:
            yield name, path
        for key, item in value.items():
            below = form.get("properties", {}).get(key, form.get("additionalProperties"))
            if "(" in key and "patternProperties" in form:
                below = form["patternProperties"]["\\("]
            if isinstance(below, dict):
                yield from self.levels(item, below, name, path + (key,))


def at(document, path):
    for key in path:
        document = document[key]
    return document


def misspelt(key, known):
    for k in range(len(key) - 1):
        other = key[:k] + key[k + 1] + key[k] + key[k + 2:]
        if other not in known:
            return other
    return key + key[-1]


def mutants(walk, documents, values=OTHER_VALUES, levels=""):
    """(description, file, document): each key of each level, once; `levels`: how their names begin."""
    seen = set()
    for path, document in documents:
        for name, place in list(walk.levels(document)):
            if not name.startswith(levels):
                continue
            known = walk.level(name)["properties"]
            strict = walk.level(name)["additionalProperties"] is False
            for key in list(at(document, place)):
                if (name, key) in seen or key not in known:
                    continue
                seen.add((name, key))

                def changed(change):
                    other = copy.deepcopy(document)
                    level = at(other, place)
                    items = list(level.items())
                    level.clear()
                    for one, value in items:
                        if one != key:
                            level[one] = value
                        else:
                            change(level, value)
                    return other

                if strict:
                    wrong = misspelt(key, known)
                    yield f"{name}: {key} as {wrong}", path, changed(lambda level, value: level.update({wrong: value}))
                yield f"{name}: without {key}", path, changed(lambda level, value: None)
                for value in values:
                    yield f"{name}: {key}: {value}", path, changed(lambda level, old, new=value: level.update({key: new}))


def sample(walk, form):
    """A value that the form accepts."""
    while "$ref" in form:
        form = walk.definitions[form["$ref"].rsplit("/", 1)[1]]
    if "enum" in form:
        return form["enum"][0]
    if "not" in form:
        return None
    if "anyOf" in form and "properties" not in form:
        return sample(walk, form["anyOf"][-1] if "$ref" in form["anyOf"][-1] else form["anyOf"][0])
    kind = form.get("type", "string")
    if "array" in kind:
        items = form["items"]
        return [sample(walk, one) for one in items] if isinstance(items, list) else [sample(walk, items)]
    if "object" in kind:
        if "properties" in form:
            chosen = list(form.get("required", []))
            for rule in form.get("allOf", []):
                if "oneOf" in rule:
                    chosen += rule["oneOf"][0]["required"]
            return {key: sample(walk, form["properties"][key]) for key in chosen}
        return {"zz": sample(walk, form["additionalProperties"])}
    return "1" if "string" in kind else 1 if "number" in kind or "integer" in kind else True


class OfProblems:
    """The schema of problems beside the reader."""

    @classmethod
    def setUpClass(cls):
        cls.validator = schema("problem")
        cls.walk = Walk(cls.validator)
        cls.paths = sorted(glob.glob(os.path.join(TREE, "problems", "**", "*.yaml"), recursive=True))
        # The smaller ones first: what all have is changed in them.
        cls.documents = [(path, load(path)) for path in sorted(cls.paths, key=os.path.getsize)]
    def answers(self, cases):
        """What the reader says of (path, document): None, or its message. Data files are found beside."""
        with tempfile.TemporaryDirectory() as folder:
            files = []
            for k, (path, document) in enumerate(cases):
                beside = os.path.join(folder, str(self.paths.index(path)))
                if not os.path.isdir(beside):
                    shutil.copytree(os.path.dirname(path), beside, ignore=shutil.ignore_patterns("*.md"))
                files.append(os.path.join(beside, f"{k}.yaml"))
                with open(files[-1], "w", encoding="utf-8") as file:
                    json.dump(document, file)
            said = []
            for k in range(0, len(files), 200):
                checked = run("check", "--json", *files[k:k + 200])
                self.assertIn(checked.returncode, (0, 2), checked.stderr[-2000:])
                # In the order of the files: a mistake may stand in another one, which the file is like.
                said += [None if result["valid"] else result["message"] for result in json.loads(checked.stdout)]
            self.assertEqual(len(said), len(files))
            return said

    def compare(self, cases, least):
        """Every mistake of the cases is refused, and what is read is accepted. `least`: so many are mistakes."""
        said = self.answers([case[1:] for case in cases])
        mistakes = wrong = 0
        for (what, path, document), message in zip(cases, said):
            accepts = self.validator.is_valid(document)
            is_structure = message is not None and STRUCTURE.search(message) is not None
            mistakes += is_structure
            if (message is None and not accepts) or (is_structure and accepts):
                wrong += 1
                print(f"{os.path.relpath(path, TREE)}: {what}: the schema {'accepts' if accepts else 'refuses'}; the reader: {message}")
        print(f"{len(cases)} changes, {mistakes} mistakes")
        self.assertEqual(wrong, 0)
        self.assertGreater(mistakes, least)


class Problems(OfProblems, unittest.TestCase):
    def test_every_problem_and_method_is_accepted(self):
        for path, document in self.documents:
            errors = [f"{list(e.path)}: {e.message[:200]}" for e in self.validator.iter_errors(document)]
            self.assertEqual(errors, [], path)
        methods = schema("method")
        for path in glob.glob(os.path.join(TREE, "lib/methods/*.yaml")):
            errors = [f"{list(e.path)}: {e.message[:200]}" for e in methods.iter_errors(load(path))]
            self.assertEqual(errors, [], path)

    def test_mistakes_are_refused_and_what_is_read_is_accepted(self):
        # A variant may lack what the other problem has, so its schema asks for less.
        self.compare(list(mutants(self.walk, [each for each in self.documents if "like" not in each[1]])), 200)

    def test_the_reader_knows_every_key_of_the_schema(self):
        # What no problem writes out stands in the methods.
        documents = self.documents + [(self.paths[0], {"problem": "p", "method": load(path)})
                                      for path in sorted(glob.glob(os.path.join(TREE, "lib/methods/*.yaml")))]
        done, cases, levels = set(), [], set()
        for path, document in documents:  # grows below
            for name, place in list(self.walk.levels(document)):
                if name in levels:
                    continue
                levels.add(name)
                for key, form in self.walk.level(name)["properties"].items():
                    value = sample(self.walk, form)
                    stands = key in at(document, place) and not isinstance(value, dict)
                    if stands or (name, key) in done or value is None:
                        continue
                    done.add((name, key))
                    other = copy.deepcopy(document)
                    at(other, place)[key] = value
                    cases.append((key, name, path, other))
                    documents.append((path, other))
        for (key, name, _, _), message in zip(cases, self.answers([case[2:] for case in cases])):
            self.assertNotIn(f"unknown key '{key}'", message or "", name)
            self.assertNotIn("internal error", message or "", name)
        missing = {name for name, form in self.walk.definitions.items() if "properties" in form} - levels - {"", "problem", "variant"} - {
            name for name in self.walk.definitions if name.startswith("changed-")}
        self.assertEqual(missing, set(), "levels that no problem and no key leads to")


class ChangedMethods(OfProblems, unittest.TestCase):
    """Methods that are like those of the program."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.documents = list(cls.changed())

    @classmethod
    def changed(cls):
        """A problem of each method, which replaces each part of it by itself."""
        named = {}
        for path, document in cls.documents:
            if isinstance(document.get("method"), str):
                named.setdefault(document["method"], (path, document))
        for path, document in named.values():
            parts = load(os.path.join(TREE, "lib/methods", document["method"] + ".yaml"))
            parts = {key: part for key, part in parts.items() if key not in ("method", "task", "example")}
            yield path, {**document, "method": {"like": document["method"], **parts}}

    def test_what_is_replaced_by_itself_is_accepted(self):
        self.assertGreater(len(self.documents), 30)
        for (path, document), message in zip(self.documents, self.answers(self.documents)):
            self.assertIsNone(message, path)
            self.assertEqual([e.message[:200] for e in self.validator.iter_errors(document)], [], path)

    def test_mistakes_are_refused_and_what_is_read_is_accepted(self):
        self.compare(list(mutants(self.walk, self.documents, levels="changed-")), 200)

    def test_values_are_checked(self):
        for wrong in ({"gains": {"L": [1]}}, {"claims": {"error": {"zz": 1}}}, {"observer": {"state": [1]}}, {"zz": 1}):
            self.assertFalse(self.validator.is_valid({"problem": "p", "method": {"like": "observer", **wrong}}), wrong)
        for right in ({"claims": {"error": "none"}}, {"claims": None}, {"observer": {"flow": {"xh": "none"}}}, {"report": "none"}, {}):
            self.assertTrue(self.validator.is_valid({"problem": "p", "method": {"like": "observer", **right}}), right)


class GainFiles(unittest.TestCase):
    PROBLEMS = ("ferrante-seuret-2021/t2-0.[67]*", "clock-dependent/*", "lmi-book/*")

    def test_mistakes_are_refused_and_what_is_read_is_accepted(self):
        validator = schema("gains")
        walk = Walk(validator)
        with tempfile.TemporaryDirectory() as folder:
            documents = []
            for pattern in self.PROBLEMS:
                for path in sorted(glob.glob(os.path.join(TREE, "problems", pattern + ".yaml"))):
                    file = os.path.join(folder, f"{len(documents)}.json")
                    run("synth", path, "-o", file, "--time", "5")
                    if os.path.exists(file):
                        with open(file, encoding="utf-8") as stream:
                            documents.append((path, json.load(stream)))
            for path, document in documents:
                self.assertEqual([e.message[:200] for e in validator.iter_errors(document)], [], path)
            mistakes = wrong = 0
            for what, path, document in mutants(walk, documents, (None, 7, "a word", [[1, 2], [3, 4]], {"zz": 1})):
                file = os.path.join(folder, "changed.json")
                with open(file, "w", encoding="utf-8") as stream:
                    json.dump(document, stream)
                result = run("export", file, "--to", "json")
                message = result.stderr if result.returncode == 2 else None
                accepts = validator.is_valid(document)
                is_structure = message is not None and STRUCTURE.search(message.strip()) is not None
                mistakes += is_structure
                if (message is None and not accepts) or (is_structure and accepts):
                    wrong += 1
                    print(f"{os.path.relpath(path, TREE)}: {what}: the schema {'accepts' if accepts else 'refuses'}; {message}")
            print(f"changes of {len(documents)} gain files, {mistakes} mistakes")
            self.assertEqual(wrong, 0)
            self.assertGreater(mistakes, 100)


if __name__ == "__main__":
    unittest.main()
