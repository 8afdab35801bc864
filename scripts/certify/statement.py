"""What a gain file states: the texts of problem and method, their data, unknowns and requirements.

The file is read with all numbers as the decimals that stand there. Keys that the checker does not
use (campaigns, plants, reports, margins) are not looked at.
"""

import hashlib
import json
import os
import re
from collections import namedtuple
from fractions import Fraction

import yaml

from arithmetic import ONE, Affine, Taylor, Undecided, Unsupported, inverse, is_exact, upper
from language import (Family, Function, Later, Scope, chebyshev, decimal, elementwise, evaluate,
                      holds, matrix, parse, power_of_number)
from matrices import Matrix, column, diagonal, flat, identity, join_blocks, number, zeros

LARGEST_FILE = 64_000_000
NOT_EVALUATED = (Undecided, Unsupported, ArithmeticError, LookupError, TypeError, ValueError,
                 AttributeError, RecursionError)

class Damaged(Exception):
    """This is not a gain file; the text says what was expected."""

class Numeral(str):
    """A number of the JSON file, as it is written."""

# Reading.

def read_gain_file(path):
    """The JSON object, with numbers as Numeral; its form is checked as far as it is used."""
    try:
        if os.path.getsize(path) > LARGEST_FILE: raise Damaged("more than %d bytes" % LARGEST_FILE)
        with open(path, encoding="utf-8") as stream:
            gain = json.load(stream, parse_float=Numeral, parse_int=Numeral,
                             parse_constant=decimal, object_pairs_hook=unique_keys)
    except OSError as error:
        raise Damaged("cannot read this file: %s" % error.strerror)
    except (ValueError, RecursionError, Unsupported) as error:
        raise Damaged("expected a JSON object: %s" % error)
    expect(isinstance(gain, dict), "a JSON object")
    expect(gain.get("verdict") in ("yes", "no", "undecided"), "verdict: yes, no or undecided")
    for key in ("gains", "unknowns", "statement", "searched", "parameters", "bases", "functions",
                "search", "gain_functions"):
        default = None if key in ("gains", "unknowns", "statement") else {}
        expect(isinstance(gain.get(key, default), dict), key + ": an object")
        if key in ("gains", "unknowns", "bases"):
            for name, value in gain.get(key, {}).items():
                matrix_of_json(value, "%s.%s" % (key, name))
    check_statement(gain["statement"])
    return gain

def expect(condition, what):
    if not condition: raise Damaged("expected " + what)

def unique_keys(pairs):
    if len({key for key, _ in pairs}) < len(pairs): raise ValueError("a key occurs twice")
    return dict(pairs)

def check_statement(statement):
    """The texts are there, and their sha256 is right (docs/gain-file.md says of which bytes)."""
    for key in ("method_text", "problem_text", "sha256"):
        expect(isinstance(statement.get(key), str), "statement.%s: a text" % key)
    parts = [statement["method_text"], statement["problem_text"]]
    settings, files = statement.get("set", {}), statement.get("files", [])
    expect(isinstance(settings, dict) and isinstance(files, list), "statement.set, statement.files")
    for name, value in settings.items(): parts += ["set", name, str(value)]
    for entry in files:
        expect(isinstance(entry, dict), "statement.files: objects")
        parts += ["file", entry.get("file", ""), entry.get("sha256", ""), entry.get("text", "")]
        matrices = dict(entry.get("matrices", {}))
        if "matrix" in entry: matrices[""] = entry["matrix"]
        for name, rows in matrices.items():
            flat_list = not (isinstance(rows, list) and rows and isinstance(rows[0], list))
            value = matrix_of_json(rows, "statement.files")
            parts += [name, "list" if flat_list else "%d x %d" % value.shape()]
            parts += [str(x) for row in (rows if not flat_list else [rows]) for x in row]
    found = hashlib.sha256("\0".join(parts).encode()).hexdigest()
    expect(found == statement["sha256"], "a statement with the sha256 that it names: it was edited")

def matrix_of_json(value, where):
    """The matrix of a number, a list of numbers (a column) or a list of rows."""
    rows = value if isinstance(value, list) else [[value]]
    rows = [row if isinstance(row, list) else [row] for row in rows]
    expect(all(isinstance(x, Numeral) for row in rows for x in row), where + ": numbers")
    try:
        return Matrix([[decimal(x) for x in row] for row in rows])
    except Unsupported as error:
        raise Damaged("%s: %s" % (where, error))

class TextLoader(yaml.BaseLoader):
    """YAML with all scalars as texts (0.1 is a decimal, not a double), without repeated keys."""

    def construct_mapping(self, node, deep=False):
        keys = [key.value for key, _ in node.value]
        if len(set(map(str, keys))) < len(keys): raise yaml.YAMLError("a key occurs twice")
        return super().construct_mapping(node, deep)

def read_yaml(text):
    try:
        result = yaml.load(text, Loader=TextLoader)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise Damaged("a YAML text was expected: %s" % " ".join(str(error).split()))
    expect(isinstance(result, dict), "a YAML mapping")
    return result

# Problems that are like another one, methods with parts replaced (docs/language.md).

def variant(base, over):
    """Sections of `base`, also those of its method, with the entries of `over` in their place.

    An entry `none` stays, since it may remove one of a built-in method; without_none ends this.
    """
    result = dict(base)
    for key, value in over.items():
        old = base.get(key)
        if key == "method" and old and not isinstance(value, str):
            result[key] = variant({"like": old} if isinstance(old, str) else old, value)
        else:
            both = isinstance(value, dict) and isinstance(old, dict)
            result[key] = {**old, **value} if both else value
    return result

def without_none(mapping):
    return {key: {k: v for k, v in value.items() if v != "none"} if isinstance(value, dict)
            else value for key, value in mapping.items() if value != "none"}

def problem_and_method(statement):
    """Both texts with all variants applied."""
    files = statement.get("files", [])

    def text_of(name):
        found = [f for f in files if f.get("file") == name] or \
            [f for f in files if os.path.basename(f.get("file", "")) == os.path.basename(name)]
        expect(len(found) == 1 and isinstance(found[0].get("text"), str), "the text of " + name)
        return found[0]["text"]

    def built_in(name):
        named = any(f.get("file") == "method " + name for f in files)
        return read_yaml(text_of("method " + name) if named else statement["method_text"])

    problem, depth = read_yaml(statement["problem_text"]), 0
    while "like" in problem:
        problem, depth = variant(read_yaml(text_of(problem.pop("like"))), problem), depth + 1
        expect(depth < 100, "a problem that is not like itself")
    method = problem.get("method")
    expect(isinstance(method, (str, dict)), "the method of the problem")
    if isinstance(method, str): method = built_in(method)
    elif "like" in method: method = variant(built_in(method.pop("like")), method)
    return without_none(problem), without_none(method)

def section(mapping, key):
    value = mapping.get(key) or {}
    expect(isinstance(value, dict), key + ": a mapping")
    return value

# The statement.

Interval = namedtuple("Interval", "name index low high")    # index: element of a column, or None
Domain = namedtuple("Domain", "scope intervals choices hulls")
Comparison = namedtuple("Comparison", "name left sign right domains")
INDEX = re.compile(r"\s*(\w+)\s+in\s+(.*?)\.\.(.*)", re.S)
HEAD = re.compile(r"\s*(\w+)\s*\((.*)\)\s*", re.S)

class Statement:
    """Data, definitions and requirements, with the unknowns given by `unknown_value`.

    unknown_value(name, rows, cols, kind) is the matrix of an unknown, a member of a family or a
    coefficient of an unknown function; kind is symmetric, diagonal or full.
    """

    def __init__(self, gain, unknown_value):
        self.gain, self.unknown_value = gain, unknown_value
        self.problem, self.method = problem_and_method(gain["statement"])
        self.scope = Scope()
        self.settings = gain["statement"].get("set", {})
        self.check_searched()
        self.given = {**section(self.problem, "data"), **section(self.problem, "parameters")}
        self.declare_definitions()
        self.declare_data()
        self.declare_unknowns()

    def check_searched(self):
        """Values under `searched` replace those of the texts: the texts must ask for a search."""
        asked = {"gain_bound"} | {name for name, p in section(self.method, "parameters").items()
                                  if isinstance(p, dict) and "search" in p}
        for value in section(self.problem, "search").values():
            asked |= set(value) if isinstance(value, dict) else set()
        for name in self.gain.get("searched", {}):
            expect(name in asked, "searched: names that are searched, not " + name)

    # Definitions and data.

    def declare_definitions(self):
        for source in (self.method, self.problem):
            for head, text in section(source, "let").items():
                self.define(head, self.settings.get(head, text))
        declared = {**section(self.method, "data"), **section(self.method, "parameters")}
        for name in self.given:
            if name not in declared and not HEAD.fullmatch(name):
                self.later(name, lambda name=name: self.value(self.given_value(name)))

    def later(self, name, compute): self.scope.names[name] = Later(compute)

    def define(self, head, text):
        call = HEAD.fullmatch(head)
        if not call:
            self.later(head.strip(), lambda: evaluate(parse(text), self.scope))
            return
        names = [x.split()[0] for x in call.group(2).split(",")]
        self.scope.names[call.group(1)] = self.function(names, text)

    def function(self, names, text):
        def apply(*values):
            if len(values) < len(names): raise Unsupported("the number of arguments")
            return matrix(parse(text), Scope(self.scope, dict(zip(names, values))))
        return Function(apply)

    def given_value(self, name):
        """The value of a datum or parameter: searched, set on the command line, or given."""
        if name in self.gain.get("searched", {}): return str(self.gain["searched"][name])
        if name in self.settings:
            text = self.settings[name].strip()
            listed = text[:1] in "[{" and ";" not in text
            return yaml.load(text, Loader=TextLoader) if listed else text
        return self.given.get(name)

    def value(self, x, shape=None, scope=None):
        """The matrix that a YAML value is: a text, a flat list, a list of rows, a file."""
        scope = scope or self.scope
        if isinstance(x, dict): x = self.matrix_of_file(x)
        if isinstance(x, str): return matrix(parse(x), scope)
        if x and isinstance(x[0], list):
            return Matrix([[matrix(parse(y), scope).number() for y in row] for row in x])
        values = [matrix(parse(y), scope).number() for y in x]
        rows, cols = shape or (None, None)
        return column(values) if cols == 1 and rows != 1 else Matrix([values], 1, len(values))

    def matrix_of_file(self, reference):
        path = next((reference[k] for k in ("csv", "mat", "npy", "json") if k in reference), None)
        for entry in self.gain["statement"].get("files", []):
            if path and os.path.basename(entry.get("file", "")) == os.path.basename(path):
                if "name" in reference and reference["name"] in entry.get("matrices", {}):
                    return entry["matrices"][reference["name"]]
                if "matrix" in entry: return entry["matrix"]
        raise Unsupported("a matrix from a file")

    def declare_data(self):
        for name, declared in section(self.method, "data").items():
            declared = declared if isinstance(declared, dict) else {"shape": declared}
            try:
                self.declare_datum(name, declared)
            except NOT_EVALUATED as error:
                self.later(name, lambda name=name, e=error: self.missing(name, e))
        for name, declared in section(self.method, "parameters").items():
            default = declared.get("default") if isinstance(declared, dict) else declared
            x = self.given_value(name)
            x = x if x is not None else default
            x = x if x is not None else self.gain.get("parameters", {}).get(name)
            self.later(name, lambda x=x: self.value(x))

    def missing(self, name, error): raise Unsupported("%s of the datum %s" % (error, name))

    def declare_datum(self, name, declared):
        x = self.given_value(name)
        if "of" in declared:
            heads = {HEAD.fullmatch(k).group(1): k for k in self.given if HEAD.fullmatch(k)}
            names = list(declared["of"])
            if name in heads:
                x = self.given[heads[name]]
                names = [a.strip() for a in HEAD.fullmatch(heads[name]).group(2).split(",")]
            x = declared["default"] if x is None else x
            self.scope.names[name] = self.function(names, x)
            self.size_of_function(name, declared, len(names))
            return
        x = x if x is not None else declared["default"]
        if "for" in declared: self.scope.names[name] = self.family_of_data(x, declared)
        elif name in self.gain.get("bases", {}):
            self.scope.names[name] = self.basis(name, x, declared["shape"])
        else: self.scope.names[name] = self.shaped(x, declared["shape"], self.scope)

    def size_of_function(self, name, declared, count):
        """The value at zero shows a size that nothing else gives."""
        try:
            shapes = [self.shape(s) for s in declared["of"].values()]
            value = self.scope.names[name].apply(*[zeros(*s) for s in shapes[:count]])
            self.unify(declared["shape"], value)
        except NOT_EVALUATED:
            pass

    def basis(self, name, x, shape):
        """The basis of the file, if it is the one of the text up to the rounding of doubles."""
        result = matrix_of_json(self.gain["bases"][name], name)
        self.unify(shape, result)
        difference = self.value(x, result.shape()) - result
        scale = max([abs(y) for y in flat(result)] + [Fraction(0)])
        if any(upper(y) > scale / 10 ** 13 for y in flat(difference)):
            raise Unsupported("a basis that is not the one of the text")
        return result

    def family_of_data(self, x, declared):
        texts = declared["for"] if isinstance(declared["for"], list) else [declared["for"]]
        name, low, high = INDEX.fullmatch(texts[0]).groups()
        if isinstance(x, list) and len(texts) == 1:
            if self.number_or_none(high) is None:
                self.set_size(high.strip(), len(x) + self.whole(low) - 1)
            keys = self.index_keys(texts)
            if len(keys) != len(x): raise Unsupported("the number of members")
            values = {key: y for (key, _), y in zip(keys, x)}
        else:
            keys = self.index_keys(texts)
            values = {key: x for key, _ in keys}
        return Family({key: self.shaped(values[key], declared["shape"], scope)
                       for key, scope in keys})

    def index_keys(self, texts):
        """[(indices, scope)] of `for: [i in 1..N, k in 0..2]`."""
        found = [((), self.scope)]
        for text in texts if isinstance(texts, list) else [texts]:
            name, low, high = INDEX.fullmatch(text).groups()
            found = [(key + (k,), Scope(scope, {name: number(Fraction(k))}))
                     for key, scope in found
                     for k in range(self.whole(low, scope), self.whole(high, scope) + 1)]
        return found

    # Shapes.

    def whole(self, text, scope=None): return matrix(parse(text), scope or self.scope).whole()

    def number_or_none(self, text):
        try:
            return self.whole(text)
        except Unsupported:
            return None

    def set_size(self, name, size):
        if not re.fullmatch(r"\w+", name): raise Unsupported("the size " + name)
        self.scope.names[name] = number(Fraction(size))

    def parts(self, shape):
        words = shape.split()
        if shape.strip() == "scalar": return ["1", "1"]
        if words[0] in ("symmetric", "diagonal"): return [shape.strip()[len(words[0]):]] * 2
        found = re.split(r"\s+x\s+", shape.strip())
        return found if len(found) == 2 else [shape, "1"]

    def shape(self, shape): return tuple(self.number_or_none(p) for p in self.parts(shape))

    def unify(self, shape, value):
        """Sizes of the shape that are not known yet become those of the value."""
        for text, size in zip(self.parts(shape), value.shape()):
            known = self.number_or_none(text)
            if known is None: self.set_size(text.strip(), size)
            elif known != size: raise Unsupported("the size of a datum: %d, not %d" % (size, known))

    def shaped(self, x, shape, scope):
        rows, cols = self.shape(shape)
        one_column = self.parts(shape)[1] == "1"
        value = self.value(x, (rows, 1 if one_column else cols), scope)
        if value.flexible and rows: value = identity(rows, value.number())
        elif value.is_zero() and rows is not None and cols is not None: value = zeros(rows, cols)
        self.unify(shape, value)
        return value

    # Unknowns.

    def declare_unknowns(self):
        self.unknowns = section(self.method, "unknowns")
        for name, declared in self.unknowns.items():
            declared = declared if isinstance(declared, dict) else {"shape": declared}
            try:
                if "for" in declared:
                    keys = [key for key, _ in self.index_keys(declared["for"])]
                    value = Family({key: self.unknown("_".join(map(str, (name,) + key)), declared)
                                    for key in keys})
                else: value = self.unknown(name, declared)
                self.scope.names[name] = value
            except NOT_EVALUATED as error:
                self.later(name, lambda name=name, e=error: self.missing(name, e))

    def unknown(self, name, declared):
        kind = declared["shape"].split()[0]
        kind = kind if kind in ("symmetric", "diagonal") else "full"
        rows, cols = self.shape(declared["shape"])
        if "of" not in declared: return self.unknown_value(name, rows, cols, kind)
        way = section(self.problem, "synthesis").get("forall")
        if "vertex_gains" in (way, way.get("way") if isinstance(way, dict) else ""):
            return self.vertex_function(name, rows, cols, kind)
        names = ["%s_%d" % (name, k) for k in range(self.whole(declared.get("degree") or "0") + 1)]
        parts = [self.unknown_value(n, rows, cols, kind) for n in names]
        self.scope.names.update(zip(names, parts))
        span = declared.get("in")
        if isinstance(span, str): span = span.strip()[1:-1].split(",")
        return polynomial(parts, span and [matrix(parse(x), self.scope).number() for x in span])

    def vertex_function(self, name, rows, cols, kind):
        """An unknown with a matrix for each vertex: the file has its formula."""
        for head, text in self.gain.get("functions", {}).items():
            call = HEAD.fullmatch(head)
            if call and call.group(1) == name:
                for word in set(re.findall(r"[A-Za-z_]\w*", text)):
                    if re.fullmatch(re.escape(name) + r"_\d+", word):
                        self.scope.names[word] = self.unknown_value(word, rows, cols, kind)
                return self.function([call.group(2).strip()], text)
        raise Unsupported("the formula of " + name)

    # Requirements.

    def comparisons(self):
        """All comparisons of all requirements. One that cannot be read is an exception instead."""
        for name, entry in section(self.method, "require").items():
            try:
                entry = entry if isinstance(entry, dict) else {"that": entry}
                tree = self.named_blocks(entry) if "blocks" in entry else parse(entry["that"])
                found = list(chain_parts(tree))
                domains = self.domains(entry.get("forall", []))
            except NOT_EVALUATED as error:
                yield name, error
                continue
            for k, (left, sign, right) in enumerate(found):
                label = "%s.%d" % (name, k + 1) if len(found) > 1 else name
                yield label, Comparison(name, left, sign, right, domains)

    def named_blocks(self, entry):
        blocks = entry["blocks"]
        zero = ("number", Fraction(0))

        def place(a, b):
            if b in (blocks[a] or {}): return parse(blocks[a][b])
            return ("'", parse(blocks[b][a])) if a in (blocks[b] or {}) else zero

        sign, right = re.fullmatch(r"\s*(<=|>=|<|>)(.*)", entry["is"]).groups()
        rows = [[place(a, b) for b in blocks] for a in blocks]
        return ("compare", [("block", rows), sign, parse(right)])

    def domains(self, texts):
        """The finite choices of `forall`, each with the intervals that remain."""
        found = [Domain(self.scope, (), (), ())]
        for text in texts if isinstance(texts, list) else [texts]:
            entry = re.fullmatch(r"\s*(\w+)\s+in\s+(.*)", text, re.S)
            if not entry:
                found = [d for d in found if holds(parse(text), d.scope)]
                continue
            name, where = entry.group(1), entry.group(2).strip()
            found = [new for d in found for new in self.choices(d, name, where)]
        return found

    def choices(self, domain, name, where):
        if where.startswith("["):
            ends = parse(where)
            if ends[0] != "block" or len(ends[1]) != 1 or len(ends[1][0]) != 2:
                raise Unsupported("the interval " + where)
            low, high = [matrix(x, domain.scope) for x in ends[1][0]]
            shape = high if low.is_number() else low
            if shape.cols != 1 or not (high.is_number() or high.shape() == shape.shape()):
                raise Unsupported("the interval " + where)
            places = [None] if shape.is_number() else range(shape.rows)
            new = tuple(Interval(name, i, low.spread(i or 0, 0), high.spread(i or 0, 0))
                        for i in places)
            empty = {name: shape} if shape.rows == 0 else {}
            return [domain._replace(scope=Scope(domain.scope, empty),
                                    intervals=domain.intervals + new)]
        hulls = domain.hulls
        if "{" in where:
            values = [matrix(x, domain.scope) for x in
                      parse("[" + where[where.index("{") + 1:where.rindex("}")] + "]")[1][0]]
            if where.startswith("conv"): hulls += ((name, values),)
        elif ".." in where:
            low, _, high = where.partition("..")
            values = [number(Fraction(k)) for k in range(self.whole(low, domain.scope),
                                                         self.whole(high, domain.scope) + 1)]
        else: values = [number(x) for x in flat(matrix(parse(where), domain.scope))]
        return [Domain(Scope(domain.scope, {name: v}), domain.intervals,
                       domain.choices + ((name, k + 1, v),), hulls) for k, v in enumerate(values)]

def polynomial(parts, span):
    """The unknown function sum parts[k] b_k(t): b_k = t^k, or Chebyshev polynomials on the span.

    b_k' = k b_(k-1) for powers. On the span with u = (2 t - low - high)/(high - low), T_k' is
    k U_(k-1) u', where U_k = 2 u U_(k-1) - U_(k-2), U_0 = 1, U_(-1) = 0.
    """
    def base(k, t, derivative):
        if not span:
            if derivative: return k * power_of_number(t, Fraction(k - 1))
            return power_of_number(t, Fraction(k))
        scale = inverse(span[1] - span[0])
        u = (2 * t - span[0] - span[1]) * scale
        if not derivative: return chebyshev(k, u)
        before, now = Fraction(0), Fraction(1)
        for _ in range(k - 1): before, now = now, 2 * (u * now) - before
        return 2 * scale * (k * now)

    def function(derivative):
        def apply(argument):
            total = parts[0].map(lambda x: x * 0) if derivative else parts[0]
            for k in range(1, len(parts)):
                b = base(k, argument.number(), derivative)
                total = total + parts[k].map(lambda x: b * x)
            return total
        return apply
    return Function(function(False), function(True))

def chain_parts(tree):
    """(left, sign, right) of each comparison of a requirement."""
    if tree[0] == "and":
        yield from chain_parts(tree[1])
        yield from chain_parts(tree[2])
        return
    if tree[0] != "compare" or "!=" in tree[1][1::2]:
        raise Unsupported("a requirement that is not an inequality")
    for k in range(0, len(tree[1]) - 2, 2): yield tree[1][k:k + 3]

def values_of_file(gain):
    """unknown_value of the decimals of the file. Symmetric unknowns must be symmetric."""
    def value(name, rows, cols, kind):
        if name not in gain["unknowns"]: raise Unsupported("a file without the unknown " + name)
        result = matrix_of_json(gain["unknowns"][name], name)
        if result.shape() != (rows, cols) and rows == 1 and result.cols == 1:
            result = result.transposed()        # a flat list
        if result.shape() != (rows, cols) and 0 in (rows, cols): result = zeros(rows, cols)
        if result.shape() != (rows, cols): raise Unsupported("the size of " + name)
        if kind == "symmetric" and result.elements != result.transposed().elements:
            raise Unsupported("%s, which is not symmetric" % name)
        if kind == "diagonal" and any(result[i, j] != 0 for i in range(rows) for j in range(cols)
                                      if i != j):
            raise Unsupported("%s, which is not diagonal" % name)
        return result
    return value

class Symbols:
    """unknown_value with a new scalar x_i for each free element; `names` lists them."""

    def __init__(self): self.names = []

    def __call__(self, name, rows, cols, kind):
        result = [[Fraction(0)] * cols for _ in range(rows)]
        for j in range(cols):
            for i in range(rows):
                if kind == "diagonal" and i != j or kind == "symmetric" and i < j: continue
                self.names.append((name, i, j))
                result[i][j] = Affine({len(self.names): Fraction(1)})
                if kind == "symmetric": result[j][i] = result[i][j]
        return Matrix(result, rows, cols)

# Inequalities as symmetric matrices.

def inequality(comparison, scope):
    """The symmetric matrix that a comparison asks to be positive (semi)definite.

    A column is compared element by element, so its elements become a diagonal. Norms, absolute
    values, maxima and eigenvalues on the right side of the comparison are replaced as in
    docs/language.md.
    """
    small, large = comparison.left, comparison.right
    if comparison.sign in (">", ">="): small, large = large, small
    for function, arguments, other, factor in (called(small) + (large, 1),
                                               called(large) + (small, -1)):
        if function in BOUNDED[factor] and scope.find(function) is None:
            bound = matrix(other, scope)
            values = [matrix(x, scope) for x in arguments]
            if len(values) > 1 and function not in ("max", "min"):
                raise Unsupported("%s of several arguments" % function)
            if function == "norm": return norm_block(values[0], bound)
            if function.startswith("lambda"):
                return symmetric((identity(values[0].rows, bound.number()) - values[0]).map(
                    lambda x: x * factor))
            if function == "abs": values += [-values[0]]
            differences = [elementwise(lambda x, y: (x - y) * factor)(bound, v) for v in values]
            return diagonal([x for d in differences for x in flat(d)])
    difference = matrix(large, scope) - matrix(small, scope)
    if difference.rows != difference.cols:
        if 1 not in difference.shape():
            raise Unsupported("an inequality of %d x %d matrices" % difference.shape())
        return diagonal(flat(difference))
    return symmetric(difference)

BOUNDED = {1: ("norm", "abs", "max", "lambda_max"), -1: ("min", "lambda_min")}

def called(tree):
    """(function, arguments) of f(...), else ("", ())."""
    return (tree[1][1], tree[2]) if tree[0] == "call" and tree[1][0] == "name" else ("", ())

def norm_block(m, bound):
    """norm(M) <= g if and only if [g I, M; M', g I] >= 0."""
    g = bound.number()
    return join_blocks([[identity(m.rows, g), m], [m.transposed(), identity(m.cols, g)]])

def symmetric(a):
    """a if it is symmetric. Asymmetry of the size of rounding is averaged: v'av stays the same."""
    result = [list(row) for row in a.elements]
    for i in range(a.rows):
        for j in range(i):
            x, y = a[i, j], a[j, i]
            if x is y or is_exact(x) and is_exact(y) and x == y: continue
            check_rounding(x, y)
            result[i][j] = result[j][i] = (x + y) * Fraction(1, 2)
    return Matrix(result, a.rows, a.cols)

def check_rounding(x, y):
    """Raises Unsupported unless |x - y| is at most 1e-9 of their size, up to their errors."""
    difference = x - y
    parts = [(difference, x, y)]
    if isinstance(difference, Affine):
        terms = [z.c if isinstance(z, Affine) else {0: z} for z in (difference, x, y)]
        parts = [[t.get(i, Fraction(0)) for t in terms] for i in terms[0]]
    for d, *both in parts:
        error = sum(z.rest if isinstance(z, Taylor) else 0 for z in both)
        size = max(upper(z) for z in both) / 10 ** 9 + Fraction(1, 10 ** 80)
        if upper(d) > size + Fraction(2 * error, ONE):
            raise Unsupported("a matrix that is not symmetric")
