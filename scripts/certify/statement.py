"""What a gain file states: the texts of problem and method, their data, unknowns and requirements.

The file is read with all numbers as the decimals that stand there. Keys that the checker does not
use (campaigns, plants, reports, margins) are not looked at.
"""
import hashlib, json, math, os, re
from collections import namedtuple
from fractions import Fraction
from functools import reduce
from itertools import count, product
from operator import add
import yaml
from arithmetic import Affine, Series, Undecided, Unsupported, is_exact, middle, upper
from language import (Family, Function, Later, Scope, basis_functions, decimal, defined,
                      elementwise, evaluate, holds, matrix, members, parse, parse_range)
from matrices import Matrix, diagonal, flat, identity, is_positive, norm_block, number, zeros
LARGEST_FILE = 64_000_000
OBJECTS = ("gains", "unknowns", "statement")
OPTIONAL = ("searched", "parameters", "bases", "functions", "search", "gain_functions", "optimum")
NOT_EVALUATED = (Undecided, Unsupported, ArithmeticError, LookupError, TypeError, ValueError,
                 AttributeError, RecursionError)
class Damaged(Exception): """This is not a gain file; the text says what was expected."""
class Numeral(str): """A number of the JSON file, as it is written."""
def listed(x): return x if isinstance(x, list) else [x]
def refuse(text): raise Unsupported(text)
def expect(condition, what):
    if not condition: raise Damaged("expected " + what)
# Reading.
def read_gain_file(path):
    """The JSON object, with numbers as Numeral; its form is checked as far as it is used."""
    try:
        source = 0 if path == "-" else path         # standard input
        if os.path.getsize(source) > LARGEST_FILE:
            raise Damaged("more than %d bytes" % LARGEST_FILE)
        with open(source, encoding="utf-8") as stream:
            gain = json.load(stream, parse_float=Numeral, parse_int=Numeral,
                             parse_constant=decimal, object_pairs_hook=unique_keys)
    except (OSError, ValueError, RecursionError, Unsupported) as error:
        raise Damaged("cannot read this file: %s" % (getattr(error, "strerror", None) or error))
    expect(isinstance(gain, dict), "a JSON object")
    expect(gain.get("verdict") in ("yes", "no", "undecided"), "verdict: yes, no or undecided")
    for key in OPTIONAL: gain.setdefault(key, {})
    for key in OBJECTS + OPTIONAL: expect(isinstance(gain.get(key), dict), key + ": an object")
    for key in ("gains", "unknowns", "bases"):
        for name, value in gain[key].items(): matrix_of_json(value, "%s.%s" % (key, name))
    check_statement(gain["statement"])
    if "proof" in gain: check_results(gain)
    return gain
def unique_keys(pairs):
    if len({key for key, _ in pairs}) < len(pairs): raise ValueError("a key occurs twice")
    return dict(pairs)
# Hashes; docs/gain-file.md says of which bytes.
def expect_sha256(stated, parts, what):
    found = hashlib.sha256("\0".join(parts).encode()).hexdigest()
    expect(found == stated, what)
def check_statement(statement):
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
            size = "%d x %d" % matrix_of_json(rows, "statement.files").shape()
            parts += [name, size if rows and isinstance(rows[0], list) else "list"]
            parts += [str(x) for row in rows for x in listed(row)]
    expect_sha256(statement["sha256"], parts, "a statement with its sha256: it was edited")
def check_results(gain):
    groups = {"gains": gain["gains"]}
    for name, entry in gain["gain_functions"].items():
        groups["gain_functions." + name] = {"coefficients[%d]" % k: x for k, x in
                                            enumerate(entry.get("coefficients", []))}
    for key in ("unknowns", "parameters", "bases", "searched", "optimum"): groups[key] = gain[key]
    parts = [gain["statement"]["sha256"]]
    def add(key, matrices):
        for name, x in matrices.items():
            parts.extend([key + name] + [str(y) for row in listed(x) for y in listed(row)])
    for key, matrices in groups.items(): add(key + ".", matrices)
    for key, part in (("", gain), ("search.", gain["search"])):
        certificate = part.get("certificate", {})
        add(key + "certificate.multipliers.", certificate.get("multipliers", {}))
        algebraic = certificate.get("algebraic", {})
        parts.extend(map(str, algebraic.get("polynomial", [])))
        for term in algebraic.get("terms", []):
            add("", {term.get("block"): term.get("vector", [])})
            parts.extend(map(str, [*term.get("weight", []), *listed(term.get("step", []))]))
    for name, text in gain["functions"].items(): parts += [name, str(text)]
    for name, entry in gain["gain_functions"].items(): parts += [name, entry.get("formula", "")]
    expect(isinstance(gain["proof"], dict), "proof: an object")
    expect_sha256(gain["proof"].get("sha256"), parts, "results with their sha256: they were edited")
def matrix_of_json(value, where):
    """The matrix of a number, a list of numbers (a column) or a list of rows."""
    rows = [listed(row) for row in listed(value)]
    expect(all(isinstance(x, Numeral) for row in rows for x in row), where + ": numbers")
    try: return Matrix([[decimal(x) for x in row] for row in rows])
    except Unsupported as error: raise Damaged("%s: %s" % (where, error))
class TextLoader(yaml.BaseLoader):
    """YAML with all scalars as texts (0.1 is a decimal, not a double), without repeated keys."""
    def construct_mapping(self, node, deep=False):
        unique_keys([(str(key.value), None) for key, _ in node.value])
        return super().construct_mapping(node, deep)
def read_yaml(text):
    try: result = yaml.load(text, Loader=TextLoader)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise Damaged("a YAML text was expected: %s" % " ".join(str(error).split()))
    expect(isinstance(result, dict), "a YAML mapping")
    expect(not re.search("[\x85\u2028\u2029]", text), "a text without Unicode's ends of lines")
    return result
# Problems that are like another one, methods with parts replaced (docs/language.md).
def variant(base, over):
    """Sections of `base`, also those of its method, with the entries of `over` in their place. An
    entry `none` stays, since it may remove one of a built-in method; without_none ends this."""
    result = {**base, **over}
    for key in base.keys() & over.keys():
        old, new = base[key], over[key]
        if key == "method" and not isinstance(new, str):
            result[key] = variant({"like": old} if isinstance(old, str) else old, new)
        elif isinstance(old, dict) and isinstance(new, dict):
            result[key] = variant(old, new) if key == "search" else {**old, **new}
    return result
def without_none(mapping):
    return {key: {k: v for k, v in value.items() if v != "none"} if isinstance(value, dict)
            else value for key, value in mapping.items() if value != "none"}
def files_named(statement, name):       # or else of the same name in another folder
    files = [f for f in statement.get("files", []) if isinstance(f.get("file"), str)]
    found = [f for f in files if f["file"] == name] or \
        [f for f in files if os.path.basename(f["file"]) == os.path.basename(name)]
    expect(len({f["file"] for f in found}) <= 1, "one file with the name " + name)
    return found
def problem_and_method(statement):
    """Both texts with all variants applied."""
    def text_of(name):
        found = files_named(statement, name)
        expect(len(found) == 1 and isinstance(found[0].get("text"), str), "the text of " + name)
        return read_yaml(found[0]["text"])
    def built_in(name):
        named = any(f.get("file") == "method " + name for f in statement.get("files", []))
        return text_of("method " + name) if named else read_yaml(statement["method_text"])
    problem = read_yaml(statement["problem_text"])
    for _ in range(100):
        if "like" in problem: problem = variant(text_of(problem.pop("like")), problem)
    expect("like" not in problem, "a problem that is not like itself")
    method = problem.get("method")
    if isinstance(method, str): method = {"like": method}
    expect(isinstance(method, dict), "the method of the problem")
    if "like" in method: method = variant(built_in(method.pop("like")), method)
    return without_none(problem), without_none(method)
def section(mapping, key):
    value = mapping.get(key) or {}
    expect(isinstance(value, dict), key + ": a mapping")
    return value
def declarations(mapping, key, short="shape"):
    """The entries of a section, where a text alone is a shape (or what `short` says)."""
    return {name: entry if isinstance(entry, dict) else {short: entry}
            for name, entry in section(mapping, key).items()}
# The statement.
# index: the element of a column, or None; title: the name with it, such as x_1
Interval = namedtuple("Interval", "name index low high title")
Domain = namedtuple("Domain", "scope intervals choices hulls")
Comparison = namedtuple("Comparison", "left sign right domains entry squares", defaults=({}, ()))
SHAPE = re.compile(r"\s*(?:(symmetric|diagonal)\s+)?(.+?)(?:\s+x\s+(.+))?\s*", re.S)
REALS = re.compile(r"R\s*(?:\^\s*(.+))?", re.S)
HEAD = re.compile(r"\s*(\w+)\s*\((.*)\)\s*", re.S)

class Statement:
    """Data, definitions and requirements, with the unknowns given by `unknown_value`.
    unknown_value(name, rows, cols, kind) is the matrix of an unknown, a member of a family or a
    coefficient of an unknown function; kind is symmetric, diagonal or full."""
    def __init__(self, gain, unknown_value):
        self.gain, self.unknown_value, self.scope = gain, unknown_value, Scope()
        self.problem, self.method = problem_and_method(gain["statement"])
        self.settings, found = gain["statement"].get("set", {}), gain.get("searched", {})
        self.searched = found and {name: x for name, x in found.items() if name != "gain_bound"}
        self.given = {**section(self.problem, "data"), **section(self.problem, "parameters")}
        self.unknowns = declarations(self.method, "unknowns")
        self.ranges = self.searched_ranges()
        self.declare_definitions()
        self.declare_data()
        self.check_searched()
        for name, declared in self.unknowns.items(): self.declare(name, self.unknown, declared)
    def searched_ranges(self):
        """{name: range} of what the texts ask to search. A value that is given ends that."""
        found = {name: p["search"] for name, p in
                 declarations(self.method, "parameters", "default").items() if "search" in p}
        for name in self.given: found.pop(name, None)
        asked = yaml.load(self.settings.get("search", ""), Loader=TextLoader)
        for value in section({"search": asked} if asked else self.problem, "search").values():
            if isinstance(value, dict): found.update(value)
        for name in self.settings: found.pop(name, None)
        return found
    def check_searched(self):
        """Values under `searched` replace those of the texts, which must ask for a search."""
        for name, x in (self.searched or {}).items():
            expect(name in self.ranges, "a search for the searched name " + name)
            low, high = [middle(y) for y in flat(self.value(self.ranges[name]))]
            x, off = decimal(x), max(abs(low), abs(high)) / 10 ** 9
            expect(low - off <= x <= high + off, "a value in the range of " + name)
    def later(self, name, compute): self.scope.names[name] = Later(compute)
    def declare(self, name, compute, declared):
        """The name gets its value now; if there is none, its use is refused."""
        try: self.scope.names[name] = compute(name, declared)
        except NOT_EVALUATED as error:
            text = "%s of the datum %s" % (error, name)
            self.later(name, lambda: refuse(text))
    def declare_definitions(self):
        for head, text in {**section(self.method, "let"), **section(self.problem, "let")}.items():
            text, call = self.given_value(head) or text, HEAD.fullmatch(head)
            if call:
                names = [x.split()[0] for x in call.group(2).split(",")]
                self.scope.names[call.group(1)] = defined(names, text, self.scope)
            else: self.later(head, lambda text=text: evaluate(parse(text), self.scope))
        declared = {**section(self.method, "data"), **section(self.method, "parameters")}
        for name in self.given:
            if name not in declared and not HEAD.fullmatch(name):
                self.later(name, lambda name=name: self.value(self.given_value(name)))
    def given_value(self, name):
        """The value of a datum or parameter: searched, set on the command line, or given."""
        if self.searched is None and name in self.ranges: refuse("the searched value of " + name)
        if self.searched and name in self.searched: return str(self.searched[name])
        if name in self.settings:
            text = self.settings[name].strip()
            if text[:1] not in "[{" or ";" in text: return text
            return yaml.load(text, Loader=TextLoader)
        return self.given.get(name)
    def value(self, x, shape=(None, None), scope=None):
        """The matrix that a YAML value is: a text, a flat list, a list of rows, a file."""
        scope = scope or self.scope
        if isinstance(x, dict): x = self.matrix_of_file(x)
        if isinstance(x, str): return matrix(parse(x), scope)
        rows = x if x and isinstance(x[0], list) else [x]
        result = Matrix([[matrix(parse(y), scope).number() for y in row] for row in rows])
        return result.transposed() if rows[0] is x and \
            shape[0] != 1 and (shape[1] == 1 or shape[0] == len(x)) else result
    def matrix_of_file(self, reference):
        path = next((reference[k] for k in ("csv", "mat", "npy", "json") if k in reference), "")
        for entry in files_named(self.gain["statement"], path):
            found = entry.get("matrices", {}).get(reference.get("name"), entry.get("matrix"))
            if found is not None: return found
        return refuse("a matrix from a file")
    def declare_data(self):
        for name, declared in declarations(self.method, "parameters", "default").items():
            self.later(name, lambda n=name, d=declared: self.value(self.parameter(n, d)))
        for name, declared in declarations(self.method, "data").items():
            self.declare(name, self.datum, declared)
    def parameter(self, name, declared):
        given = self.given_value(name)
        return declared.get("default") if given is None else given
    def datum(self, name, declared):
        x = self.given_value(name)
        if "of" in declared: return self.function_of_data(name, x, declared)
        if x is None: x = declared["default"]
        if "for" in declared: return self.family_of_data(x, declared)
        if name in self.gain.get("bases", {}): return self.basis(name, x, declared["shape"])
        return self.shaped(x, declared["shape"], self.scope)
    def function_of_data(self, name, x, declared):
        """A datum with arguments. Its value at zero shows a size that nothing else gives."""
        names = list(declared["of"])
        for head in filter(None, map(HEAD.fullmatch, self.given)):
            if head[1] == name: x, names = self.given[head[0]], head[2].replace(",", " ").split()
        result = defined(names, declared["default"] if x is None else x, self.scope)
        try:
            shapes = [self.shape(s) for s in declared["of"].values()]
            self.unify(declared["shape"], result.apply(*[zeros(*s) for s in shapes[:len(names)]]))
        except NOT_EVALUATED: pass
        return result
    def basis(self, name, x, shape):
        """The basis of the file, if it is the one of the text up to rounding; of gains any."""
        result = matrix_of_json(self.gain["bases"][name], name)
        self.unify(shape, result)
        if re.match("..call., ..name., .(discrete_)?output_gain", str(parse(str(x)))): return result
        words, lets = [str(x)], {**section(self.method, "let"), **section(self.problem, "let")}
        for text in words:          # and those of the definitions that it uses
            used = set(re.findall(r"\w+", text))
            words += [str(lets.pop(head)) for head in list(lets) if head.split("(")[0] in used]
        if not re.search(r"\b(orth|null)\b", str(words)): refuse("a basis without orth or null")
        scale = max(map(abs, flat(result)), default=0)
        if all(upper(y) <= scale / 10 ** 13 for y in flat(self.value(x, result.shape()) - result)):
            return result
        raise Unsupported("a basis that is not the one of the text")
    def family_of_data(self, x, declared):
        """One text for all members, or a list of them, which may give the last index."""
        texts = listed(declared["for"])
        several = isinstance(x, list) and len(texts) == 1
        _, _, low, high = parse_range(texts[0])
        if several: self.unify_size(high, len(x) + matrix(low, self.scope).whole() - 1)
        return Family({key: self.shaped(x[k] if several else x, declared["shape"], scope)
                       for k, (key, scope) in enumerate(self.members(texts))})
    def members(self, texts):       # of `for: [i in 1..N, k in 0..2]`
        return members([parse_range(text) for text in listed(texts)], self.scope)
    # Shapes.
    def parts(self, shape):
        """The trees of the rows and columns of `n x m`, `n`, `symmetric n`, `scalar`."""
        kind, rows, cols = SHAPE.fullmatch("1" if shape == "scalar" else shape).groups()
        return [parse(rows), parse(rows if kind else cols or "1")]
    def size(self, tree):
        """The whole number that a text is, or None."""
        try: return matrix(tree, self.scope).whole()
        except Unsupported: return None
    def shape(self, shape): return tuple(self.size(p) for p in self.parts(shape))
    def unify(self, shape, value):
        for tree, size in zip(self.parts(shape), value.shape()): self.unify_size(tree, size)
    def unify_size(self, tree, size):
        """A name whose size is not known yet gets it."""
        known = self.size(tree)
        if known is None and tree[0] == "name": self.scope.names[tree[1]] = number(Fraction(size))
        elif known != size: raise Unsupported("the size of a datum: %d, not %s" % (size, known))
    def shaped(self, x, shape, scope):
        rows, cols = self.shape(shape)
        value = self.value(x, (rows, cols), scope)
        if value.flexible and rows: value = identity(rows, value.number())
        elif value.is_zero() and rows is not None and cols is not None: value = zeros(rows, cols)
        self.unify(shape, value)
        return value
    # Unknowns.
    def unknown(self, name, declared):
        if "for" not in declared: return self.member(name, declared)
        return Family({key: self.member("_".join(map(str, (name,) + key)), declared)
                       for key, _ in self.members(declared["for"])})
    def member(self, name, declared):
        kind = SHAPE.fullmatch(declared["shape"]).group(1) or "full"
        rows, cols = self.shape(declared["shape"])
        if "of" not in declared: return self.unknown_value(name, rows, cols, kind)
        if isinstance(declared["of"], dict):
            return self.polynomial(name, declared, rows, cols, kind)
        way = section(self.problem, "synthesis").get("forall")
        if "vertex_gains" in (way, way.get("way") if isinstance(way, dict) else ""):
            return self.vertex_function(name, rows, cols, kind)
        degree = matrix(parse(declared.get("degree") or "0"), self.scope).whole()
        names = ["%s_%d" % (name, k) for k in range(degree + 1)]
        parts = [self.unknown_value(n, rows, cols, kind) for n in names]
        self.scope.names.update(zip(names, parts))
        span = declared.get("in")
        if isinstance(span, str): span = span.strip()[1:-1].split(",")
        return polynomial(parts, span and [matrix(parse(x), self.scope).number() for x in span])
    def polynomial(self, name, declared, rows, cols, kind):
        """The sum of V_e1_e2_... x(1)^e1 x(2)^e2 ..., in the elements of all arguments."""
        n = sum(self.shape(s)[0] for s in declared["of"].values())
        span = [matrix(parse(d), self.scope).whole() for d in listed(declared["degree"])]
        low, high = span if len(span) > 1 else (0, span[0])
        terms = {e: self.unknown_value("_".join(map(str, (name, *e))), rows, cols, kind)
                 for e in product(range(high + 1), repeat=n) if low <= sum(e) <= high}
        self.scope.names.update({"_".join(map(str, (name, *e))): c for e, c in terms.items()})
        def value(*columns):
            x = [y for c in columns for y in flat(c)]
            return reduce(add, [c * number(math.prod(
                [power for y, k in zip(x, e) for power in [y] * k], start=Fraction(1)))
                for e, c in terms.items()])
        return Function(value)
    def vertex_function(self, name, rows, cols, kind):
        """An unknown with a matrix for each vertex: the file has its formula. This is one of many
        functions, so it proves no *no*."""
        if isinstance(self.unknown_value, Symbols): raise Unsupported("a no of vertex gains")
        for head, text in self.gain.get("functions", {}).items():
            call = HEAD.fullmatch(head)
            if call and call.group(1) == name:
                for word in set(re.findall(r"\b%s_\d+\b" % re.escape(name), text)):
                    self.scope.names[word] = self.unknown_value(word, rows, cols, kind)
                found = defined([call.group(2).strip()], text, self.scope).apply
                def shaped(x): return x if x.shape() == (rows, cols) else refuse("another shape")
                if kind == "full": return Function(lambda *values: shaped(found(*values)))
        return refuse("the formula of " + name)
    # Requirements.
    def comparisons(self):
        """All comparisons of all requirements, for a no also of what is only necessary. One that
        cannot be read is an exception instead."""
        beside = section(self.method, "necessary") if self.gain["verdict"] == "no" else {}
        for name, entry in {**section(self.method, "require"), **beside}.items():
            try:
                entry = entry if isinstance(entry, dict) else {"that": entry}
                tree = named_blocks(entry) if "blocks" in entry else parse(entry["that"])
                found = chain_parts(tree)
                domains = self.domains(entry.get("forall", []))
            except NOT_EVALUATED as error:
                yield name, error
                continue
            for k, comparison in enumerate(found):
                yield ("%s.%d" % (name, k + 1) if len(found) > 1 else name,
                       Comparison(*comparison, domains, entry))
    def domains(self, texts):
        """The finite choices of `forall`, each with the intervals that remain. An interval has no
        value, and a vertex stands for a whole polytope: no later entry may depend on them."""
        found, hidden = [Domain(self.scope, (), (), ())], {}
        later = Later(lambda: refuse("an entry of forall that depends on the one before"))
        for text in listed(texts):
            entry = re.fullmatch(r"\s*(\w+)\s+in\s+(.*)", text, re.S)
            if not entry:
                found = [d for d in found if holds(parse(text), Scope(d.scope, hidden))]
                continue
            name, where = entry[1], entry[2].strip()
            if name in hidden or any(name == n for d in found for n, _, _ in d.choices):
                raise Unsupported("a variable that occurs twice")
            found = [new for d in found for new in choices(d, Scope(d.scope, hidden), name, where)]
            if where.startswith(("[", "conv")) or REALS.fullmatch(where): hidden[name] = later
        return found
def named_blocks(entry):
    """The comparison of a matrix that is given by named block rows and columns."""
    rows = {a: row or {} for a, row in entry["blocks"].items()}
    for b in [b for row in rows.values() for b in row]: rows.setdefault(b, {})
    def place(a, b):
        if b in rows[a]: return parse(rows[a][b])
        return ("'", parse(rows[b][a])) if a in rows[b] else ("number", Fraction(0))
    sign, right = re.fullmatch(r"\s*(<=|>=|<|>)(.*)", entry["is"]).groups()
    return ("compare", [("block", [[place(a, b) for b in rows] for a in rows]), sign, parse(right)])
def choices(domain, scope, name, where):
    """The domains that an entry `name in where` of forall makes of one, evaluated in the scope."""
    if where.startswith("["):
        ends = parse(where)
        if ends[0] != "block" or len(ends[1]) != 1 or len(ends[1][0]) != 2:
            raise Unsupported("the interval " + where)
        low, high = [matrix(x, scope) for x in ends[1][0]]
        shape = high if low.is_number() else low
        if shape.cols != 1 or not (high.is_number() or high.shape() == shape.shape()):
            raise Unsupported("the interval " + where)
        new = [Interval(name, None, low.number(), high.number(), name)] if shape.is_number() else \
            [Interval(name, i, low.spread(i, 0), high.spread(i, 0), "%s_%d" % (name, i + 1))
             for i in range(shape.rows)]
        empty = {name: shape} if shape.rows == 0 else {}
        return [Domain(Scope(domain.scope, empty), domain.intervals + tuple(new), *domain[2:])]
    reals = REALS.fullmatch(where)
    if reals and (reals[1] or scope.find("R") is None):
        n = matrix(parse(reals[1]), scope).whole() if reals[1] else 1
        new = [Interval(name, None if n == 1 else i, None, None, name) for i in range(n)]
        return [Domain(domain.scope, domain.intervals + tuple(new), *domain[2:])]
    if "{" in where:
        values = where[where.index("{") + 1:where.rindex("}")]
        values = [matrix(x, scope) for x in parse("[%s]" % values)[1][0]]
    elif ".." in where:
        low, high = [matrix(parse(x), scope).whole() for x in where.split("..", 1)]
        values = [number(Fraction(k)) for k in range(low, high + 1)]
    else: values = [number(x) for x in flat(matrix(parse(where), scope))]
    hulls = domain.hulls + (((name, values),) if where.startswith("conv") else ())
    return [Domain(Scope(domain.scope, {name: v}), domain.intervals,
                   domain.choices + ((name, k + 1, v),), hulls) for k, v in enumerate(values)]
def polynomial(parts, span):
    """The unknown function sum parts[k] b_k(t), with powers or Chebyshev polynomials b_k."""
    return Function(lambda t: reduce(add, [
        part * number(b) for part, b in zip(parts, basis_functions(t.number(), span))]))
def chain_parts(tree):
    """(left, sign, right) of each comparison of a requirement."""
    if tree[0] == "and": return chain_parts(tree[1]) + chain_parts(tree[2])
    if tree[0] != "compare" or "!=" in tree[1][1::2]:
        raise Unsupported("a requirement that is not an inequality")
    return [tree[1][k:k + 3] for k in range(0, len(tree[1]) - 2, 2)]
def values_of_file(gain): return lambda name, *kind: checked(gain["unknowns"], name, *kind)
def checked(values, name, rows, cols, kind="full"):
    """A matrix of the file, if it has this size and is of this kind; a flat list may be a row."""
    if name not in values: raise Unsupported("a file without " + name)
    a = matrix_of_json(values[name], name)
    if a.shape() != (rows, cols) and a.cols == 1: a = a.transposed()
    if 0 in (rows, cols): a = zeros(rows, cols)
    if a.shape() != (rows, cols): raise Unsupported("the size of " + name)
    wanted = {"full": lambda i, j: a[i, j], "symmetric": lambda i, j: a[j, i],
              "diagonal": lambda i, j: a[i, j] if i == j else 0}[kind]
    if all(a[i, j] == wanted(i, j) for i in range(rows) for j in range(cols)): return a
    raise Unsupported("%s, which is not %s" % (name, kind))
class Symbols:
    """unknown_value with a new scalar x_i for each free element: x_i, or by `moved` x_i + f x_j."""
    def __init__(self, moved=()):
        self.new = (Affine({i: Fraction(1), **dict(moved).get(i, {})}) for i in count(1))
    def __call__(self, name, rows, cols, kind):
        result = zeros(rows, cols)
        for i, j in product(range(rows), range(cols)):
            if kind == "symmetric" and j < i: result.elements[i][j] = result.elements[j][i]
            elif kind != "diagonal" or i == j: result.elements[i][j] = next(self.new)
        return result
# Inequalities as symmetric matrices.
BOUNDED = {1: ("norm", "abs", "max", "lambda_max"), -1: ("min", "lambda_min")}
def inequality(comparison, scope):
    """The symmetric matrix that a comparison asks to be positive (semi)definite. A column is
    compared element by element, so its elements become a diagonal. Norms, absolute values, maxima
    and eigenvalues on the right side of the comparison are replaced as in docs/language.md. Of an
    equation, the matrix that must be 0."""
    small, large = comparison.left, comparison.right
    if comparison.sign == "==": return matrix(small, scope) - matrix(large, scope)
    if comparison.sign in (">", ">="): small, large = large, small
    for side, other, factor in ((small, large, 1), (large, small, -1)):
        name = side[1][1] if side[0] == "call" and side[1][0] == "name" else ""
        if name not in BOUNDED[factor] or scope.find(name) is not None: continue
        bound, values = matrix(other, scope), [matrix(x, scope) for x in side[2]]
        if len(values) > 1 and name in ("norm", "abs"): refuse(name + " of several arguments")
        if name == "norm": return norm_block(values[0], bound)
        if name.startswith("lambda"):       # of (M, N), N > 0: eigenvalues of inv(N)*M
            one = values[1] if len(values) > 1 else identity(values[0].rows, 1)
            if len(values) > 1 and not is_positive(one): refuse(name + " of a second matrix")
            return symmetric((one.map(lambda x: x * bound.number()) - values[0]).map(
                lambda x: x * factor))
        if name == "abs": values += [-values[0]]
        elif len(values) == 1: values = [number(x) for x in flat(values[0])]
        differences = [elementwise(lambda x, y: (x - y) * factor)(bound, v) for v in values]
        return diagonal([x for d in differences for x in flat(d)])
    difference = matrix(large, scope) - matrix(small, scope)
    if 1 in difference.shape(): return diagonal(flat(difference))
    if difference.rows == difference.cols: return symmetric(difference)
    raise Unsupported("an inequality of %d x %d matrices" % difference.shape())
def symmetric(a):
    """a if it is symmetric. Asymmetry of the size of rounding, at most 1e-9 of the coefficients, is
    averaged: v'av stays the same."""
    result = (a + a.transposed()).map(lambda x: x * Fraction(1, 2))
    for i, j in product(range(a.rows), repeat=2):
        x, y = a[i, j], a[j, i]
        if x is y or is_exact(x) and x == y: result.elements[i][j] = x
        elif largest(x - y) > max(largest(x), largest(y)) / 10 ** 9 + Fraction(1, 10 ** 80):
            raise Unsupported("a matrix that is not symmetric")
    return result
def largest(x):         # of its coefficients
    if isinstance(x, Series): return max(map(largest, x.terms.values()), default=Fraction(0))
    return abs(middle(x))
