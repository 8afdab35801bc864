"""Sums of squares: identities of a yes, moments of a no, and what is changed in them."""

import unittest

from helper import Numeral, gain, one_claim, problem, with_text
from no import prove_no
from statement import Damaged
from yes import prove_yes

def results(found):
    claims, gains, at_gains = prove_yes(found)
    return {c.name: c.result for c in claims}

def changed(name, change):
    found = gain(name)
    change(found)
    return found

def record(name, times=0, basis=("1",), gram=(("1",),), free=()):
    return {"name": name, "variables": ["x"], "squares": [
        {"times": times, "basis": list(basis), "gram": [list(row) for row in gram]}],
        "free": list(free)}

def of_x(that, records, where=""):
    text = ("problem: p\nmethod:\n  unknowns: {u: scalar}\n  require:\n"
            "    c: {forall: x in R, %sthat: \"%s\"}\n" % (where, that))
    found = problem(text, {"u": "0"})
    found["sums_of_squares"] = records
    return results(found)["c"]

class Yes(unittest.TestCase):
    def test_identities_are_expanded(self):
        self.assertEqual(results(gain("squares")), dict.fromkeys(
            ["positive", "observer", "disc", "circle", "pair"], "proved"))

    def test_what_is_changed_proves_nothing(self):
        def gram(found): found["sums_of_squares"][2]["squares"][0]["gram"][0][0] += "1"
        def basis(found): found["sums_of_squares"][2]["squares"][0]["basis"][-1] += "*x(1)"
        def free(found):
            for one in found["sums_of_squares"]:
                for term in one.get("free", []): term["polynomial"] += " + s"
        def unknown(found): found["unknowns"]["b"] = Numeral("100")
        def absent(found): found["sums_of_squares"] = found["sums_of_squares"][:-1]
        for change, name in ((gram, "disc"), (basis, "disc"), (free, "circle"), (unknown, "disc"),
                             (absent, "pair")):
            self.assertEqual(results(changed("squares", change))[name], "open", change)
        found = with_text("squares", ("x(1)^3 - x(1)*x(2) + 2", "x(1)^3 - x(1)*x(2) + 1"))
        self.assertEqual(results(found)["disc"], "open")
        found = with_text("squares", ("\"x'*x <= 1\"", "\"x'*x <= 2\""))
        self.assertEqual(results(found)["disc"], "open")

    def test_squares_of_one_variable(self):
        x2 = record("c", basis=("x",))
        self.assertEqual(of_x("x^2 >= 0", [x2]), "proved")
        self.assertEqual(of_x("x^2 > 0", [x2]), "open")             # it is 0 at 0
        both = record("c", basis=("1", "x"), gram=(("1",), ("0", "1")))
        self.assertEqual(of_x("x^2 + 1 > 0", [both]), "proved")
        negative = record("c", basis=("x",), gram=(("-1",),))
        self.assertEqual(of_x("-x^2 >= 0", [negative]), "open")
        self.assertEqual(of_x("x^2 + 1e-9 >= 0", [x2]), "open")
        self.assertEqual(of_x("x^2 + 1e-9*x >= 0", [x2]), "open")
        third = record("c", gram=(("1/3",),))
        self.assertEqual(of_x("1/3 + 0*x >= 0", [third]), "proved")

    def test_multipliers(self):
        sets = "where: [x >= 1, 2 - x >= 0], "
        first, second = record("c", times=1), record("c", times=2)
        self.assertEqual(of_x("x - 1 >= 0", [first], sets), "proved")
        self.assertEqual(of_x("2 - x >= 0", [first], sets), "open")
        self.assertEqual(of_x("2 - x >= 0", [second], sets), "proved")
        with self.assertRaises(Damaged): of_x("x - 1 >= 0", [record("c", times=3)], sets)
        on = "where: x^2 == 4, "
        free = record("c", gram=(("1",),), free=({"times": 1, "polynomial": "1 - x"},))
        self.assertEqual(of_x("1 + (x^2 - 4)*(1 - x) >= 0", [free], on), "proved")
        self.assertEqual(of_x("1 + (x^2 - 4)*(1 + x) >= 0", [free], on), "open")

    def test_polynomials_alone(self):
        x2 = record("c", basis=("x",))
        self.assertEqual(of_x("x^2 + exp(x) - exp(x) >= 0", [x2]), "open")
        self.assertEqual(results(one_claim("x in R^2", "x'*x >= 0")), {"c": "open"})

class No(unittest.TestCase):
    def claim(self, found): return prove_no(found, found["certificate"])

    def test_moments_exclude_all(self):
        for name in ("squares-no", "squares-strict-no"):
            claim = self.claim(gain(name))
            self.assertEqual((claim.result, claim.how), ("proved", "moments"), name)

    def test_what_has_a_solution_is_not_excluded(self):
        for name, change in (("squares-no", ("x'*x <= 9", "x'*x <= 1")),
                             ("squares-no", ("x(1) - x(2) + x(1)^2*x(2)", "x(1) - x(2)")),
                             ("squares-strict-no", ("[0, 0.8]", "[0, 0.5]")),
                             ("squares-strict-no", ("1.2, 0; 0, 0.5", "0.2, 0; 0, 0.1"))):
            self.assertEqual(self.claim(with_text(name, change)).result, "open", (name, change))
        weak = with_text("squares-strict-no", ("He(P(s)*A) < 0", "He(P(s)*A) <= 0"),
                         ("P(T) < 0", "P(T) <= 0"), ("P(0) > 0", "P(0) >= 0"))
        self.assertEqual(self.claim(weak).result, "open")       # P = 0

    def test_moments_that_are_changed(self):
        for at, name in ((0, "x(1)^2"), (1, "x(1)^2"), (1, "x(2)^4")):
            def other(found): found["certificate"]["moments"][at][name] = "-1000000"
            self.assertEqual(self.claim(changed("squares-no", other)).result, "open", (at, name))
        def none(found): found["certificate"]["moments"] = []
        for name in ("squares-no", "squares-strict-no"):
            self.assertEqual(self.claim(changed(name, none)).result, "open")
        def turned(found):
            for moments in found["certificate"]["moments"]:
                for name, value in moments.items():
                    moments[name] = value[1:] if value[0] == "-" else "-" + value
        for name in ("squares-no", "squares-strict-no"):
            self.assertEqual(self.claim(changed(name, turned)).result, "open")

    def test_one_coefficient(self):
        text = ("problem: p\nmethod:\n  unknowns: {u: scalar}\n  require:\n"
                "    c: {forall: x in R^2, that: \"%s\"}\n")
        for that, expected in (("x(1)^4*x(2)^2 + x(1)^2*x(2)^4 - 3*x(1)^2*x(2)^2 + 1 >= 0", "proved"),
                               ("x'*x > 0", "proved"), ("x'*x >= 0", "open"),
                               ("x(1)^2 - x(1)*x(2) + x(2)^2 >= 0", "open"),
                               ("x(1)^4 - u*x(2)^2 >= 0", "open"), ("x'*x + 1 > 0", "open")):
            found = dict(problem(text % that, {}), verdict="no")
            found["certificate"] = {"about": "sums of squares"}
            self.assertEqual(self.claim(found).result, expected, that)

    def test_moments_without_a_constant(self):
        text = ("problem: p\nmethod:\n  require:\n"
                "    c: {forall: x in R^2, that: \"(x(1) - x(2))^2 + 1 > 0\"}\n")
        found = dict(problem(text, {}), verdict="no")
        found["certificate"] = {"about": "sums of squares", "moments": [
            {"x(1)^2": "0.5", "x(1)*x(2)": "0.5", "x(2)^2": "0.5"}]}
        self.assertEqual(self.claim(found).result, "open")

    def test_a_value_that_is_set_is_not_searched(self):
        text = ("problem: p\nmethod:\n  data: {c: scalar}\n  require:\n"
                "    c: {forall: x in R, that: x^2 - c >= 0}\nsearch: {largest: {c: [-1, 1]}}\n")
        found = dict(problem(text, {}), verdict="no", searched=None)
        found["statement"]["set"] = {"c": "1"}
        found["certificate"] = {"about": "sums of squares"}
        self.assertEqual(self.claim(found).result, "proved")
        del found["statement"]["set"]
        self.assertEqual(self.claim(found).result, "open")

if __name__ == "__main__":
    unittest.main()
