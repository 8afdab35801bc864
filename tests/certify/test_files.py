"""Whole gain files: what is proved, what is not, and damaged files."""

import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

import helper
from helper import CERTIFY, gain, one_claim, path, problem, with_text
from no import prove_no, prove_optimum
from statement import Damaged, read_gain_file
from yes import prove_objective, prove_yes

YES = ["lyapunov", "observer", "sampled", "equations", "modes", "polytope", "clock", "box",
       "bounds", "edge"]
NO = ["lyapunov-no", "undetectable", "uncontrollable", "sampled-no", "disk-no", "two-steps"]

def results(found):
    claims, gains, at_gains = prove_yes(found)
    return {c.name: c.result for c in claims}

def result(*arguments, **more):
    """The result of a problem with one claim."""
    (found,) = results(one_claim(*arguments, **more)).values()
    return found

def least_of_flow(a):
    """The least eigenvalue of expm(a t)'expm(a t), t in [0, 2], by a search with 40 digits."""
    def least(t):
        # Squares of a shorter time keep the series of the helper exact enough.
        e = helper.exponential(a, t / 4)
        e = helper.product(e, e)
        e = helper.product(e, e)
        g = helper.product(helper.transposed(e), e)
        half, d = (g[0][0] + g[1][1]) / 2, (g[0][0] - g[1][1]) / 2
        return helper.to_decimal(half) - helper.to_decimal(d * d + g[0][1] ** 2).sqrt()

    centre = min((Fraction(k, 40) for k in range(81)), key=least)
    low, high = max(centre - Fraction(1, 40), Fraction(0)), min(centre + Fraction(1, 40),
                                                                Fraction(2))
    for _ in range(45):
        third = (high - low) / 3
        if least(low + third) < least(high - third): high -= third
        else: low += third
        low, high = Fraction(round(low * 2 ** 90), 2 ** 90), Fraction(round(high * 2 ** 90),
                                                                      2 ** 90)
    return min(Fraction(least(t)) for t in (low, high, centre))

class Yes(unittest.TestCase):
    def test_files_are_proved(self):
        count = {"modes": 6, "bounds": 5, "observer": 3, "lyapunov": 2, "equations": 4, "edge": 4}
        for name in YES:
            found = results(gain(name))
            self.assertEqual(set(found.values()), {"proved"}, name)
            self.assertEqual(len(found), count.get(name, len(found)), name)

    def test_every_requirement_is_a_claim(self):
        self.assertEqual(list(results(gain("sampled"))), ["positive", "step"])
        self.assertEqual(list(results(gain("modes"))), [
            "positive at i = 1", "positive at i = 2", "mode at i = 1", "mode at i = 2",
            "switch at i = 1, j = 2", "switch at i = 2, j = 1"])
        found = with_text("lyapunov", ("decrease: He(P*A) < 0", "decrease: eig(P) < 0"))
        self.assertEqual(results(found), {"positive": "proved", "decrease": "open"})
        found = with_text("lyapunov", ("P > I", "I < P < 1e9*I"))
        self.assertEqual(list(results(found)), ["positive.1", "positive.2", "decrease"])

    def test_strict_and_not_strict(self):
        found = results(with_text("edge", ("psd: P >= 0", "psd: P > 0")))
        self.assertEqual(found["psd"], "refuted")
        for that, value, expected in (
                ("x >= 0", "0", "proved"), ("x > 0", "0", "refuted"), ("x <= 0", "0", "proved"),
                ("x < 0", "0", "refuted"), ("x < 1e-200", "0", "proved"), ("0 < x < 1", "1", None),
                ("x == 1", "1", "proved"), ("x == 1", "1.0000000000000001", "refuted"),
                ("[x, 1; 1, 1] >= 0", "1", "proved"), ("[x, 1; 1, 1] > 0", "1", "refuted"),
                ("[0, x; x, 1] >= 0", "1e-90", "refuted"), ("norm(x) <= 1", "1", "proved"),
                ("norm([x; 0]) < 1", "1", "refuted"), ("abs(x) <= 1", "-1", "proved"),
                ("abs(x) < 1", "-1", "refuted"), ("max(x, 2*x) <= 2", "1", "proved"),
                ("max(x, 2*x) < 2", "1", "refuted"), ("max(x, 0) <= [3; 0.5]", "1", "refuted"),
                ("max([3; x]) <= [4; 1]", "0", "refuted"), ("max([3; x]) <= 3", "3", "proved"),
                ("abs(x) <= [3; 0.5]", "1", "refuted"), ("abs(x) <= [3; 1]", "-1", "proved"),
                ("min(x, 2*x) >= 1", "1", "proved"),
                ("min(x, 2*x) > 1", "1", "refuted"), ("[x; 2; -1] > 0", "1", "refuted"),
                ("[x; 2; 1] > 0", "1", "proved"), ("[x, 2, -1] > 0", "1", "refuted"),
                ("lambda_max([x, 1; 1, x]) <= 2", "1", "proved"),
                ("lambda_max([x, 1; 1, x]) < 2", "1", "refuted"),
                ("lambda_min([x, 1; 1, x]) >= 0", "1", "proved"),
                ("lambda_min([x, 1; 1, x]) > 0", "1", "refuted")):
            found = set(results(one_claim("", that, {"x": value})).values())
            if expected: self.assertEqual(found, {expected}, (that, value))
            else: self.assertEqual(found, {"proved", "refuted"})

    def test_intervals(self):
        for forall, that, expected in (
                ("t in [0, 1]", "exp(t) >= x + t + 1", "open"),         # touches at 0
                ("t in [0, 1]", "exp(t) > t + 0.9999999", "proved"),
                ("t in [0, 3]", "cos(t) > -0.9899925", "proved"),       # cos 3 = -0.98999249660
                ("t in [0, 3]", "cos(t) > -0.9899924", "refuted"),
                ("t in [0, 4]", "cos(t) > -1.0000001", "proved"),
                ("t in [0, 4]", "cos(t) > -0.9999999", "refuted"),
                ("t in [1, 2]", "1/t > 0.4999999", "proved"),
                ("t in [1, 2]", "1/t > 0.5000001", "refuted"),
                ("t in [1, 2]", "1/t > 0.5", "refuted"),
                ("t in [1, 2]", "log(t) + 1 > 0.9999999", "proved"),
                ("t in [1, 2]", "log(t) > 0.0000001", "refuted"),
                ("t in [1, 9]", "sqrt(t) > 0.9999999", "proved"),
                ("t in [1, 9]", "sqrt(t) > 1.0000001", "refuted"),
                ("t in [-1, 1]", "1/t > -1e9", "refuted"),
                ("t in [0, 2]", "x < 1", "proved"), ("t in [0, 2]", "x < 0", "refuted"),
                ("t in [0, 2]", "(t - 1)*0 == 0", "proved"),
                ("t in [0, 2]", "t*x == x", "proved"), ("t in [0, 2]", "t == 1", "open"),
                ("t in [0, 2]", "(t - 1.3)^2 > 1e-9*(t - 5)", "proved"),
                ("t in [0, 2]", "(t - 1.3)^2 > 1e-9", "refuted"),
                ("t in [-1, 2]", "t^2 > 0", "open"),
                ("t in [0, pi]", "sin(t) > -1e-9", "proved"),
                ("t in [2, 1]", "x < 1", "open"),
                ("t in {0.1, 0.5}", "t < 0.5", None),
                ("k in 1..3", "k < 3", None)):
            found = results(one_claim(forall, that))
            if expected: self.assertEqual(set(found.values()), {expected}, (forall, that))
            else: self.assertEqual(set(found.values()), {"proved", "refuted"}, that)

    def test_values_just_below_and_above_the_least_of_a_flow(self):
        """expm(A t)'expm(A t) > g I on [0, 2], with g 1e-8 below and above the true least value.

        CERTIFY_FLOWS is the number of random matrices A."""
        for k in range(int(os.environ.get("CERTIFY_FLOWS", "2"))):
            random = helper.random.Random(k)
            a = [[Fraction(random.randint(-150, 150), 100) for _ in range(2)] for _ in range(2)]
            bottom = least_of_flow(a)
            rows = "; ".join(", ".join(str(helper.to_decimal(x)) for x in r) for r in a)
            for side, expected in ((-1, "proved"), (1, "refuted")):
                g = bottom * (1 + Fraction(side, 10 ** 8))
                text = "expm([%s]*t)'*expm([%s]*t) > %s*eye(2)" % (
                    rows, rows, str(helper.to_decimal(g))[:40])
                found = result("t in [0, 2]", text)
                self.assertIn(found, (expected, "open"), (k, text))
                if side < 0: self.assertEqual(found, "proved", (k, text))

    def test_a_piece_with_a_constant_matrix_does_not_prove_the_others(self):
        text = "where(t < 1.2, 1, where(t > 1.4, 1, -1)) > 0"
        self.assertEqual(result("t in [0, 2]", text), "refuted")

    def test_entries_of_forall_that_depend_on_intervals_or_vertices(self):
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar}\n  require: {c: {forall: %s,"
                " that: t < 0.6}}\ndata: {t: 1}\n")
        for forall in ('["t in conv{0, 1}", "t < 0.5"]', '["t in [0, 1]", "t > 2"]',
                       '["t in [0, 1]", "t in {0.5}"]', '["t in {0.5}", "t in [0, 1]"]',
                       '["t in [0, 0.5]", "s in [0, t]"]'):
            found = results(problem(text % forall, {"x": "0"}))
            self.assertEqual(set(found.values()), {"open"}, forall)

    def test_boxes_and_columns(self):
        for that, expected in (("v(1)^2 + v(2)^2 < 5.0001", "proved"),
                               ("v(1)^2 + v(2)^2 < 4.9999", "refuted"),
                               ("v(1)*v(2) > -2.0001", "proved"),
                               ("v(1)*v(2) > -1.999", "refuted")):
            self.assertEqual(result("v in [[-1; -2], [1; 2]]", that), expected, that)

    def test_polytopes_need_affine_matrices(self):
        self.assertEqual(set(results(one_claim("t in conv{-1, 1}", "t^2 >= 1")).values()), {"open"})
        self.assertEqual(set(results(one_claim("t in conv{-1, 1}", "t >= -1")).values()),
                         {"proved"})

    def test_unknowns(self):
        found = gain("lyapunov")
        found["unknowns"]["P"][0][1] = helper.Numeral("0.1")
        self.assertEqual(set(results(found).values()), {"open"})
        text = "problem: p\nmethod:\n  unknowns: {P: symmetric 2}\n  require: {c: P > 0}\n"
        self.assertEqual(results(problem(text, {"P": [["2", "1"], ["-1", "2"]]})), {"c": "open"})
        self.assertEqual(results(problem(text, {"P": [["2", "1"], ["1", "2"]]})), {"c": "proved"})
        self.assertEqual(results(problem(text, {"P": [["2"]]})), {"c": "open"})
        self.assertEqual(results(problem(text, {})), {"c": "open"})
        text = text.replace("symmetric 2", "2 x 2")
        self.assertEqual(results(problem(text, {"P": [["2", "1"], ["-1", "2"]]})), {"c": "open"})
        text = text.replace("2 x 2", "diagonal 2")
        self.assertEqual(results(problem(text, {"P": [["2", "1"], ["1", "2"]]})), {"c": "open"})

    def test_unknown_functions(self):
        text = ("problem: p\nmethod:\n  unknowns: {P: {shape: scalar, of: s, %s degree: 2}}\n"
                "  require: {c: P(3) == %s, d: derivative(P)(3) == %s}\n")
        values = {"P_0": "1", "P_1": "2", "P_2": "3"}
        powers = text % ("", "34", "20")
        self.assertEqual(results(problem(powers, values)), {"c": "proved", "d": "proved"})
        # On [0, 4], u = (3 - 2)/2 and T_2 = 2 u^2 - 1: 1 + 1 - 3/2, and 2/2 + 3*4*u/2.
        chebyshev = text % ("in: [0, 4],", "0.5", "4")
        self.assertEqual(results(problem(chebyshev, values)), {"c": "proved", "d": "proved"})

    def test_gains(self):
        claims, gains, at_gains = prove_yes(gain("observer"))
        self.assertEqual(at_gains, ["L"])
        self.assertLessEqual(gains[0].ulps, 1)
        found = gain("observer")
        found["gains"]["L"][0][0] = helper.Numeral("9.5")
        claims, gains, at_gains = prove_yes(found)
        self.assertEqual((at_gains, gains[0].ulps > 10 ** 9), ([], True))

    def test_gains_over_intervals(self):
        """Y*(1 + s) < 3 on [0, 1] holds for Y below 1.5."""
        text = ("problem: p\nmethod:\n  unknowns: {P: 1 x 1, Y: 1 x 1}\n"
                "  require: {c: {forall: \"s in [0, 1]\", that: Y*(1 + s)*P < 3}}\n"
                "  gains: {K: inv(P)*Y}\n")
        for k, at_printed in (("1", ["K"]), ("1.49", ["K"]), ("1.51", []), ("2", [])):
            claims, _, at_gains = prove_yes(problem(text, {"P": [["1"]], "Y": [["1"]]},
                                                    {"K": [[k]]}))
            self.assertEqual([c.result for c in claims], ["proved"])
            self.assertEqual(at_gains, at_printed)

    def test_gains_that_are_functions_and_families(self):
        text = ("problem: p\nmethod:\n  unknowns:\n    P: {shape: 2, of: s, degree: 1}\n"
                "    Q: {shape: scalar, for: i in 1..2}\n"
                "  require: {c: P(1) > 0, d: {forall: i in 1..2, that: Q(i) > 0}}\n"
                "  gains: {\"F(s)\": 2*P(s), \"K(i in 1..2)\": 1/Q(i), H: K_1*P(0)}\n")
        found = problem(text, {"P_0": ["1", "2"], "P_1": ["3", "4"], "Q_1": "4", "Q_2": "5"},
                        {"K_1": "0.25", "K_2": "0.2000000001", "H": ["0.25", "0.5"]})
        found["gain_functions"] = {"F": {"coefficients": [[[helper.Numeral(x)] for x in c] for c in
                                                          (("2", "4"), ("6", "8.00001"))]}}
        claims, gains, _ = prove_yes(found)
        self.assertEqual({c.result for c in claims}, {"proved"})
        ulps = {g.name: g.ulps for g in gains}
        self.assertEqual((ulps["K_1"], ulps["H"]), (0, 0))
        self.assertGreater(ulps["F"], 10 ** 9)
        self.assertGreater(ulps["K_2"], 10 ** 6)

    def test_files_of_one_name_in_two_folders(self):
        text = ("problem: p\nmethod:\n  data: {a: scalar}\n  unknowns: {x: scalar}\n"
                "  require: {c: x < a}\ndata: {a: {csv: %s/m.csv}}\n")
        for folder, expected in (("one", "proved"), ("two", "refuted")):
            found = problem(text % folder, {"x": "0"})
            found["statement"]["files"] = [{"file": k + "/m.csv", "matrix": [[helper.Numeral(v)]]}
                                           for k, v in (("one", "1"), ("two", "-1"))]
            self.assertEqual(results(found), {"c": expected})

    def test_variants(self):
        found = gain("lyapunov")
        base = found["statement"]["problem_text"]
        found["statement"]["files"] = [{"file": "b.yaml", "text": base, "sha256": ""}]
        found["statement"]["problem_text"] = "problem: v\nlike: b.yaml\ndata: {A: '[1, 0; 0, 1]'}\n"
        self.assertEqual(results(found)["decrease"], "refuted")
        found["statement"]["problem_text"] = ("problem: v\nlike: b.yaml\n"
                                              "method: {require: {decrease: none}}\n")
        self.assertEqual(results(found), {"positive": "proved"})
        found["statement"]["problem_text"] = "problem: v\nlike: b.yaml\n"
        found["statement"]["set"] = {"A": "[1, 0; 0, 1]"}
        self.assertEqual(results(found)["decrease"], "refuted")

    def test_objectives_are_those_of_the_unknowns(self):
        text = ("problem: p\nmethod:\n  unknowns: {P: symmetric 2, y: scalar}\n"
                "  require: {a: P >= I}\n  minimize: %s\n")
        unknowns = {"P": [["3", "1"], ["1", "2"]], "y": "1"}
        for minimize, value in (("trace(P) + y", 6), ("norm(P)", 3.618033988749895),
                                ("lambda_max(P)", 3.618033988749895), ("2*y + norm(P)", 5.618034),
                                ('"lambda_max(P, [2, 0; 0, 1])"', 2.5), ("abs(y)", 1)):
            for factor, expected in ((1, "proved"), (1 - 1e-6, "refuted"), (1 + 1e-6, "proved")):
                found = problem(text % minimize, unknowns)
                found["objective"] = helper.Numeral(repr(value * factor))
                claim = prove_objective(found)
                if minimize.startswith("2*y") and factor == 1: continue     # 7 digits
                self.assertEqual(claim.result, expected, (minimize, factor, claim))
        for minimize in ('"lambda_max(P, [1, 0; 0, 0])"', '"lambda_max(P, [1, 2; 2, 1])"'):
            found = problem(text % minimize, unknowns)
            found["objective"] = helper.Numeral("100")
            self.assertEqual(prove_objective(found).result, "open", minimize)

class No(unittest.TestCase):
    def test_files_are_proved(self):
        for name in NO:
            found = gain(name)
            claim = prove_no(found, found["certificate"])
            self.assertEqual(claim.result, "proved", (name, claim.how))

    def test_feasible_problems_have_no_proof(self):
        for name, change in (("lyapunov-no", ("[0.1, -2, -3]", "[-0.1, -2, -3]")),
                             ("lyapunov-no", ("[0.1, -2, -3]", "[-1e-12, -2, -3]")),
                             ("undetectable", ("C: [0, 0]", "C: [1, 0]")),
                             ("undetectable", ("A: [[1, 0]", "A: [[-1, 0]")),
                             ("uncontrollable", ("B: [[0], [1], [1]]", "B: [[1], [1], [1]]")),
                             ("uncontrollable", ("A: [[1, 0, 0]", "A: [[-1, 0, 0]")),
                             ("sampled-no", ("k: 1.5", "k: 1000")),
                             ("sampled-no", ("k: 1.5", "k: 12")),
                             ("disk-no", ("r: 1.3", "r: 1.6")),
                             ("lyapunov-no", ("P > 0, decrease: He(P*A) < 0",
                                              "P >= 0, decrease: He(P*A) <= 0"))):
            found = with_text(name, change)
            claim = prove_no(found, found["certificate"])
            self.assertEqual(claim.result, "open", (name, change))

    def test_columns_of_blocks_without_a_row(self):
        text = ("problem: p\nmethod:\n  data: {A: 2 x 2}\n  unknowns: {P: symmetric 2}\n"
                "  require: {f: {blocks: {x: {x: He(P*A), w: P}}, is: \"<= 0\"}}\n"
                "data: {A: [[-1, 1], [0, -1]]}\n")
        self.assertEqual(results(problem(text, {"P": [["2", "0"], ["0", "2"]]})), {"f": "refuted"})

    def test_a_flat_list_of_known_length_is_a_column(self):
        text = ("problem: p\nmethod:\n  data: {A: n x n, B: n x m}\n  unknowns: {x: scalar}\n"
                "  require: {c: \"x > [0, 1]*B\"}\ndata: {A: [[1, 2], [3, 4]], B: [7, 1]}\n")
        self.assertEqual(results(problem(text, {"x": "1.5"})), {"c": "proved"})

    def test_ends_of_lines_that_yaml_alone_knows_are_refused(self):
        for end in "\x85\u2028\u2029":
            text = ("problem: p # a%s\nmethod:\n  unknowns: {x: scalar}\n"
                    "  require: {c: x > 0}\n" % end)
            with self.assertRaises(Damaged): results(problem(text, {"x": "1"}))

    def test_searched_values_are_in_their_ranges(self):
        text = ("problem: p\nmethod:\n  parameters: {b: {search: [0.1, 100]}}\n"
                "  unknowns: {x: scalar}\n  require: {c: x > b}\n%s")
        for more, b, expected in (("", "0.5", "proved"), ("", "2", "refuted"), ("", "-50", None),
                                  ("", "101", None), ("parameters: {b: 50}\n", "0.5", None),
                                  ("search: {over: {b: [0.7, 1]}}\n", "0.5", None)):
            found = problem(text % more, {"x": "1"})
            found["searched"] = {"b": helper.Numeral(b)}
            if expected: self.assertEqual(results(found), {"c": expected}, (more, b))
            else:
                with self.assertRaises(Damaged, msg=(more, b)): results(found)

    def test_a_parameter_of_the_file_replaces_no_search(self):
        text = ("problem: p\nmethod:\n  parameters: {b: {search: [0.1, 100]}}\n"
                "  unknowns: {x: scalar}\n  require: {c: x > b}\n")
        found = problem(text, {"x": "1"})
        found["parameters"] = {"b": helper.Numeral("-50")}
        self.assertEqual(results(found), {"c": "open"})

    def test_a_no_is_one_of_all_searched_values(self):
        text = ("problem: p\nmethod:\n  parameters: {b: {search: [0.1, 100]}}\n"
                "  unknowns: {x: scalar}\n  require: {c: x > %s, d: x < 1}\n")
        for least, expected in (("2", "proved"), ("b", "open")):
            found = dict(problem(text % least, {}), searched=None)
            one = helper.Numeral("1")
            claim = prove_no(found, {"multipliers": {"c": one, "d": one}})
            self.assertEqual(claim.result, expected, least)

    def test_gains_are_compared_beyond_their_own_degree(self):
        text = ("problem: p\nmethod:\n  unknowns: {P: scalar, Y: {shape: scalar, of: t, degree: 2}}\n"
                "  require: {c: P > 0}\n  gains: {\"F(t)\": Y(t)/P}\n")
        values = {"P": "1", "Y_0": "1", "Y_1": "2", "Y_2": "-1"}
        for coefficients, most in ((["1", "2", "-1"], 1), (["1"], None), (["1", "2"], None)):
            found = problem(text, values)
            found["gain_functions"] = {"F": {"of": "t", "kind": "polynomial", "coefficients": [
                helper.Numeral(x) for x in coefficients]}}
            _, gains, _ = prove_yes(found)
            self.assertEqual(gains[0].ulps <= 1, most is not None, coefficients)

    def test_what_a_file_may_not_replace(self):
        """A basis of another datum, the value of a name gain_bound, a formula of another kind."""
        text = ("problem: p\nmethod:\n  data: {A: scalar}\n  unknowns: {x: scalar}\n"
                "  let: {f: \"%s\"}\n  require: {c: A + 0*x > 1}\ndata: {A: \"%s\"}\n")
        for let, datum, expected in (("1", "1", "open"), ("orth(1)", "1", "open"),
                                     ("1", "orth(1)", "proved"), ("orth(1)", "f*1", "proved"),
                                     ("1", "output_gain(1, 1, 1)", "proved"),
                                     ("1", "1 + 0*output_gain(1, 1, 1)", "open"),
                                     ("output_gain(1, 1, 1)", "f", "open")):
            found = problem(text % (let, datum), {"x": "0"})
            found["bases"] = {"A": helper.Numeral("1.00000000000005")}
            self.assertEqual(results(found), {"c": expected}, (let, datum))
        found = problem("problem: p\nmethod:\n  unknowns: {x: scalar}\n"
                        "  require: {c: gain_bound > 5}\ndata: {gain_bound: 1}\n", {"x": "0"})
        found["searched"] = {"gain_bound": helper.Numeral("9")}
        self.assertEqual(results(found), {"c": "refuted"})
        text = ("problem: p\nsynthesis: {forall: vertex_gains}\nmethod:\n"
                "  unknowns: {P: {shape: %s, of: t}}\n"
                "  require: {c: {forall: \"t in [0, 1]\", that: \"%s\"}}\n")
        for shape, that, formula, expected in (
                ("2 x 2", "P(t) - ones(2) > 0", "[1.1, 1; 1, 1.1]", "proved"),
                ("diagonal 2", "P(t) - ones(2) > 0", "[1.1, 1; 1, 1.1]", "open"),
                ("2 x 2", "P(t)*[1; 2] > 2", "[1, 1]", "open")):
            found = problem(text % (shape, that), {})
            found["functions"] = {"P(t)": formula}
            self.assertEqual(results(found), {"c": expected}, shape)

    def test_polytopes_and_intervals_that_are_none(self):
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar}\n  require:\n"
                "    c: {forall: \"%s\", that: \"%s\"}\n    b: x > 0\n")
        found = problem(text % ("A in conv{0, [2, 0; 0, 0], [0, 0; 0, 2]}", "det(A) < 1/2"),
                        {"x": "1"})
        self.assertEqual(results(found)["c at A = 0"], "open")
        found = problem(text % ("t in [sqrt(2) + 1e-97, sqrt(2)]", "x < 0"), {"x": "1"})
        self.assertEqual(results(found)["c"], "open")

    def test_unknowns_with_one_effect(self):
        """x and y enter as x + 3*y alone, before the root of 2: two equations that are one."""
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar, y: scalar, z: scalar}\n  require:\n"
                "    a: \"(x + 3*y + 0*z)*sqrt(2) >= sqrt(3)\"\n"
                "    b: \"-(%s)*sqrt(2) >= 0\"\n    c: z >= 1\n")
        certificate = {"multipliers": {"a": helper.Numeral("1"), "b": helper.Numeral("1"),
                                       "c": helper.Numeral("0")}}
        for that, expected in (("x + 3*y", "proved"), ("x + 3.0000001*y", "open"),
                               ("x + 2*y", "open"), ("x + 3*y - z", "open")):
            claim = prove_no(problem(text % that, {}), certificate)
            self.assertEqual(claim.result, expected, (that, claim.how))

    def test_constant_parts_count(self):
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar}\n"
                "  require: {a: x >= %s, b: x <= %s}\n")
        certificate = {"multipliers": {"a": helper.Numeral("1"), "b": helper.Numeral("1")}}
        for low, high, expected in (("2", "1", "proved"), ("1", "2", "open"), ("1", "1", "open"),
                                    ("1", "1.0000001", "open"), ("1.0000001", "1", "proved")):
            found = problem(text % (low, high), {})
            self.assertEqual(prove_no(found, certificate).result, expected, (low, high))
        found = problem(text.replace(">=", ">") % ("1", "1"), {})
        self.assertEqual(prove_no(found, certificate).result, "open")   # the rule needs v > 0

    def test_the_formula_of_vertex_gains_does_not_limit_them(self):
        found = problem("problem: p\nsynthesis: {forall: vertex_gains}\nmethod:\n"
                        "  unknowns: {L: {shape: scalar, of: t}}\n  require: {a: L(0) >= 1}\n", {})
        found["functions"] = {"L(t)": "0*L_1"}
        claim = prove_no(found, {"multipliers": {"a": helper.Numeral("1")}})
        self.assertEqual((claim.result, "vertex gains" in claim.how), ("open", True))

    def test_derivatives_of_terms_with_unknowns(self):
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar}\n  let: {f(v): x*v^2}\n  require:\n"
                "    a: {forall: \"t in {1}\", that: \"jacobian(f(t), t) >= 2\"}\n    b: x <= %s\n")
        certificate = {"multipliers": {"a at t = 1": helper.Numeral("1"),
                                       "b": helper.Numeral("2")}}
        for high, expected in (("0.5", "proved"), ("1", "open"), ("2", "open")):
            claim = prove_no(problem(text % high, {}), certificate)
            self.assertEqual(claim.result, expected, high)

    def test_a_polytope_needs_derivatives_that_are_affine(self):
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar}\n"
                "  let: {\"g(v, a)\": \"jacobian(a*v, v)\"}\n"
                "  require: {c: {forall: \"a in conv{-1, 1}\", that: \"%s > 0.5\"}}\n")
        for that, expected in (("g(1, a)*a", "open"), ("g(1, a) + 2", "proved")):
            found = results(problem(text % that, {"x": "0"}))
            self.assertEqual(set(found.values()), {expected}, that)

    def test_multipliers_that_use_nothing(self):
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar, y: scalar}\n"
                "  require: {a: {forall: \"t in [0, 1]\", that: x >= 0*t}, b: -x >= 0, c: y > 0,"
                " d: x > y}\n")
        def result(**multipliers):
            named = {"a at t = 0.5" if k == "a" else k: helper.Numeral(v)
                     for k, v in multipliers.items()}
            return prove_no(problem(text, {}), {"multipliers": named}).result
        self.assertEqual(result(a=1, b=1, c=0), "open")     # c has no multiplier
        self.assertEqual(result(a=1, b=1), "open")          # nothing is strict
        self.assertEqual(result(b=1, c=1, d=1), "proved")
        # A multiplier that is 0 except where z relaxes e. Feasible: x = 0, y = z = 1.
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar, y: scalar, z: scalar}\n"
                "  require: {a: \"[x, 0, 0; 0, 1, y; 0, y, 1] >= 0\", b: -x >= 0,"
                " e: \"[y, 0; 0, z] > 0\"}\n")
        multipliers = {k: [[helper.Numeral(x if i == j == at else 0) for j in range(n)]
                           for i in range(n)] for k, n, at, x in (("a", 3, 0, 1), ("b", 1, 0, 1),
                                                                  ("e", 2, 1, 1))}
        claim = prove_no(problem(text, {}), {"multipliers": multipliers})
        self.assertEqual(claim.result, "open")

    def test_points_in_all_decimals(self):
        """An end that is no decimal is found by the decimals of a double; other points are not."""
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar}\n  require: {a: {forall:"
                " \"t in [0, sqrt(2)]\", that: x >= t}, b: {forall: \"k in {1/3, 2/3}\","
                " that: x <= k}}\n")
        for t, k, expected in (("1.4142135623730951", "0.3333333333333333", "proved"),
                               ("1.4142135623730951", "0.6666666666666666", "proved"),
                               ("1.4142136", "0.3333333333333333", "open"),
                               ("1.4142135623730951", "0.333333", "open"),
                               ("0.5", "0.6666666666666666", "open"),
                               ("0.5", "0.3333333333333333", "proved")):
            certificate = {"multipliers": {"a at t = " + t: helper.Numeral("1"),
                                           "b at k = " + k: helper.Numeral("1")}}
            self.assertEqual(prove_no(problem(text, {}), certificate).result, expected, (t, k))

    def test_points_outside_of_their_interval_are_refused(self):
        text = ("problem: p\nmethod:\n  unknowns: {x: scalar}\n"
                "  require: {a: {forall: \"t in [0, 1]\", that: x >= t}, b: x <= 1.5}\n")
        for at, interval, expected in (("1", "[0, 1]", "open"), ("2", "[0, 1]", "open"),
                                       ("2", "[0, 2]", "proved"), ("2", "[2, 1]", "open")):
            certificate = {"multipliers": {"a at t = " + at: helper.Numeral("1"),
                                           "b": helper.Numeral("1")}}
            found = problem(text.replace("[0, 1]", interval), {})
            self.assertEqual(prove_no(found, certificate).result, expected)

class Bounds(unittest.TestCase):
    def proved(self, require, objective, multipliers, stated):
        """The bound that is proved, a fraction, or None."""
        def numerals(x):
            return [numerals(y) for y in x] if isinstance(x, list) else helper.Numeral(x)
        found = problem("problem: p\nmethod:\n  unknowns: {x: scalar, y: scalar}\n  require: {%s}\n"
                        "  minimize: %s\n" % (require, objective), {})
        found["optimum"] = {label: numerals(value) for label, value in multipliers.items()}
        found["objective_lower_bound"] = helper.Numeral(stated)
        return self.bound(found)
    def bound(self, found):
        claim = prove_optimum(found)
        self.assertIn(claim.result, ("proved", "open"))
        return Fraction(claim.name.split()[-1]) if claim.result == "proved" else None

    def test_bounds_of_small_problems(self):
        matrix = 'a: "[x, 1; 1, y] >= 0"'
        for require, objective, multipliers, stated in (
                ("a: x >= 1", "x", {"a": "1"}, "1"),
                ("a: x > 1", "x + 7", {"a": "1"}, "8"),
                ("a: x >= 1", "4*x", {"a": "4"}, "4"),
                ("a: x >= 1", "0.5*x", {"a": "0.5"}, "0.5"),
                ("a: x >= 1", "0.3*x", {"a": "0.30000000000000004"}, "0.3"),
                ("a: -5 <= x <= 1", "-x", {"a.2": "1"}, "-1"),
                ("a: x >= 1", "x", {"a": "1", "bound 1": "1"}, "1"),
                ("e: x == 2", "x", {"e": "1"}, "2"), ("e: x == 2", "-3*x", {"e": "-3"}, "-6"),
                ("e: x == 2", "x", {"e": [["0", "0.5"], ["0.5", "0"]]}, "2"),
                ("e: x - y == 2, a: y >= 3", "x", {"e": "1", "a": "1"}, "5"),
                (matrix, "x + y", {"a": [["1", "-0.9999999"], ["-0.9999999", "1"]]}, "2"),
                (matrix, "100*x + y", {"a": [["100", "-9.999999"], ["-9.999999", "1"]]}, "20"),
                ('a: {forall: "t in [0, 1]", that: x >= t}', "x", {"a at t = 1": "1"}, "1")):
            found = self.proved(require, objective, multipliers, stated)
            self.assertIsNotNone(found, (require, objective, multipliers))
            self.assertLessEqual(found, Fraction(stated))
            self.assertGreaterEqual(found, Fraction(stated) - abs(Fraction(stated)) / 10 ** 6)

    def test_bounds_that_are_wrong(self):
        for require, objective, multipliers, stated in (
                ("a: x >= 1", "x", {"a": "1"}, "1.00001"),
                ("a: x >= 1", "x", {"a": "1.00001"}, "1.00001"),    # needs a correction
                ("a: x >= 1", "x", {"a": "0.99999"}, "1.0001"),
                ("a: x >= 1", "x", {"a": "1.5"}, "1.5"), ("a: x >= 1", "x", {"a": "5"}, "5"),
                ("a: x >= 1", "0.5*x", {"a": "0.5"}, "1"), ("a: x >= 1", "x", {"a": "2"}, "2"),
                ("a: x <= 5", "x", {"a": "-1"}, "5"), ("a: x < 5", "x", {"a": "-1"}, "5"),
                ("a: x <= 5", "x", {"a": "1"}, "5"), ("a: x <= 5", "x", {"a": "1"}, "-5"),
                ("a: x >= 1", "-x", {"a": "-1"}, "-1"), ("a: x >= 1", "x + y", {"a": "1"}, "1"),
                ("a: x >= 1", "y", {"a": "0"}, "0"), ("a: x >= 1", "x*x", {"a": "1"}, "1"),
                ("e: x == 2", "x", {"e": "1.5"}, "3"), ("e: x == 2", "x", {"e": "-1"}, "3"),
                ("e: x == 2", "x", {"e": "2"}, "4"),
                ("e: x == 2", "x", {"e": [["0", "1"], ["1", "0"]]}, "4"),
                ("e: x - y == 2, a: y <= 3", "x", {"e": "1", "a": "-1"}, "5"),
                ('a: "[x, 1; 1, y] >= 0"', "x + y", {"a": [["1", "-2"], ["-2", "1"]]}, "4"),
                ('a: "[x, 1; 1, y] >= 0"', "x + y", {"a": [["1", "-1.1"], ["-1.1", "1"]]}, "2.2"),
                ('a: {forall: "t in [0, 1]", that: x >= t}', "x", {"a at t = 2": "1"}, "2"),
                ('a: {forall: "t in [0, 1]", that: x >= t}', "x", {"a": "1"}, "1")):
            found = self.proved(require, objective, multipliers, stated)
            self.assertIsNone(found, (require, objective, multipliers, stated))

    def test_the_bound_of_a_file(self):
        """Its optimum is 5.92: no multipliers and no stated bound prove more."""
        found = gain("s-procedure")
        bound = self.bound(found)
        self.assertTrue(Fraction("5.91999") < bound <= Fraction("5.92"), bound)
        random, count = helper.random.Random(5), 0
        for k in range(60):
            changed = gain("s-procedure")
            matrix = changed["optimum"]["lagrangian"]
            i, j = random.randrange(3), random.randrange(3)
            size = Fraction(random.randint(-9, 9), 10 ** random.randint(1, 12))
            value = helper.Numeral(helper.to_decimal(Fraction(matrix[i][j]) + size))
            matrix[i][j] = matrix[j][i] = value
            for stated in ("5.9", "5.91999", "5.92", "5.9200001", "5.93", "6.5"):
                changed["objective_lower_bound"] = helper.Numeral(stated)
                bound = self.bound(changed)
                count += bound is not None
                self.assertFalse(bound and bound > Fraction("5.92"), (stated, matrix))
                self.assertFalse(bound and Fraction(stated) > Fraction("5.93"))
        self.assertGreater(count, 60)

class Hash(unittest.TestCase):
    """docs/gain-file.md says which bytes the sha256 of `proof` is of."""
    N = [["1.5", "-2"], ["3e-7", "40"]]
    RESULTS = ("gains", "gain_functions", "unknowns", "parameters", "bases", "searched", "optimum",
               "certificate", "search")
    def file(self):
        with open(path("lyapunov"), encoding="utf-8") as stream: found = json.load(stream)
        multipliers = {"flow at t = 0.1": self.N, "e": "7"}
        found.update({
            "gains": {"K": self.N, "L": "12"}, "unknowns": {"P": self.N, "g": "0.25"},
            "gain_functions": {"F": {"of": "t", "coefficients": [[["31"]], [["32", "33"]]]},
                               "G": {"of": "t", "formula": "Y(t)/P"}},
            "functions": {"Y(t)": "Y_0 + Y_1*t"},
            "parameters": {"T": "0.7"}, "bases": {"B": [["0.6"], ["0.8"]]},
            "searched": {"rho": "0.5"}, "optimum": {"a": self.N},
            "certificate": {"multipliers": multipliers},
            "search": {"certificate": {"multipliers": {"b at t = 0.25": self.N}}}})
        parts = [found["statement"]["sha256"]]
        rows = ["1.5", "-2", "3e-7", "40"]
        for name, elements in (
                ("gains.K", rows), ("gains.L", ["12"]),
                ("gain_functions.F.coefficients[0]", ["31"]),
                ("gain_functions.F.coefficients[1]", ["32", "33"]), ("unknowns.P", rows),
                ("unknowns.g", ["0.25"]), ("parameters.T", ["0.7"]), ("bases.B", ["0.6", "0.8"]),
                ("searched.rho", ["0.5"]), ("optimum.a", rows),
                ("certificate.multipliers.flow at t = 0.1", rows),
                ("certificate.multipliers.e", ["7"]),
                ("search.certificate.multipliers.b at t = 0.25", rows)):
            parts += [name] + elements
        parts += ["Y(t)", "Y_0 + Y_1*t", "F", "", "G", "Y(t)/P"]
        digest = hashlib.sha256(b"\0".join(x.encode() for x in parts)).hexdigest()
        found["proof"] = {"version": "1", "sha256": digest}
        return found
    def places(self, x, at=()):
        """The places of all numbers of the results."""
        for k in x if isinstance(x, dict) else range(len(x)):
            if isinstance(x[k], (dict, list)): yield from self.places(x[k], at + (k,))
            elif k != "of": yield at + (k,)
    def error(self, found):
        """What read_gain_file says of the file, or None. Texts of results become numbers."""
        results = {key: value for key, value in found.items() if key in self.RESULTS}
        others = {key: value for key, value in found.items() if key not in self.RESULTS}
        text = json.dumps(others)[:-1] + ", " + re.sub(r'"(-?[0-9.]+(e-?[0-9]+)?)"', r"\1",
                                                       json.dumps(results)[1:])
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "gains.json")
            with open(name, "w", encoding="utf-8") as stream: stream.write(text)
            try:
                read_gain_file(name)
            except Damaged as error:
                return str(error)
        return None

    def test_a_changed_digit_is_named(self):
        self.assertIsNone(self.error(self.file()))
        for change in (lambda f: f["functions"].update({"Y(t)": "-Y_1"}),
                       lambda f: f["gain_functions"]["G"].update(formula="0*t")):
            found = self.file()
            change(found)
            self.assertIn("they were edited", self.error(found) or "")
        places = [place for place in
                  self.places({key: self.file()[key] for key in self.RESULTS})
                  if place[-1] != "formula"]
        self.assertEqual(len(places), 30)
        for place in places:
            found = self.file()
            holder = found
            for key in place[:-1]: holder = holder[key]
            old = holder[place[-1]]
            holder[place[-1]] = old[:-1] + str((int(old[-1]) + 1) % 10)
            self.assertIn("they were edited", self.error(found) or "", place)
        for key in ("unknowns", "optimum", "bases", "searched"):    # a name, or a part that is gone
            found = self.file()
            found[key] = {"other": value for value in found[key].values()}
            self.assertIn("they were edited", self.error(found) or "", key)
            self.assertIn("they were edited", self.error(dict(found, **{key: {}})) or "", key)
        found = self.file()
        del found["proof"]["sha256"]
        self.assertIn("they were edited", self.error(found) or "")
        del found["proof"]
        self.assertIsNone(self.error(found))

    def test_a_file_of_gainsmith(self):
        with open(path("s-procedure"), encoding="utf-8") as stream: text = stream.read()
        self.assertIn('"proof"', text)
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "gains.json")
            for old, new in (("0.35998017629176826", "0.35998017629176827"), ('"l": 3', '"l": 4'),
                             ('"l": 2', '"l": 1')):
                if old not in text: continue
                with open(name, "w", encoding="utf-8") as stream:
                    stream.write(text.replace(old, new, 1))
                with self.assertRaisesRegex(Damaged, "they were edited"): read_gain_file(name)

class Program(unittest.TestCase):
    def run_program(self, *arguments, stdin=None):
        done = subprocess.run([sys.executable, CERTIFY, *arguments], capture_output=True, text=True,
                              stdin=stdin)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout

    def test_a_no_at_a_searched_value_is_open(self):
        text = ("problem: p\nmethod:\n  parameters: {b: {search: [0.1, 100]}}\n"
                "  unknowns: {x: scalar}\n  require: {c: x > b, d: x < 1}\n")
        digest = hashlib.sha256(("\0" + text).encode()).hexdigest()
        found = {"verdict": "no", "gains": {}, "unknowns": {}, "searched": {"b": 50},
                 "certificate": {"multipliers": {"c": 1, "d": 1}},
                 "statement": {"method_text": "", "problem_text": text, "sha256": digest}}
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "gains.json")
            with open(name, "w", encoding="utf-8") as stream: json.dump(found, stream)
            code, out = self.run_program(name)
        self.assertEqual(code, 3, out)
        self.assertIn("the searched value of b", out)

    def test_exit_codes_and_lines(self):
        code, out = self.run_program(path("lyapunov"))
        self.assertEqual(code, 0)
        self.assertRegex(out, r"^proved .*2 claims \(2 in fractions\)")
        with open(path("lyapunov"), encoding="utf-8") as stream:
            self.assertEqual(self.run_program("-", stdin=stream)[0], 0)
        code, out = self.run_program(path("regulator"))
        self.assertEqual(code, 0)
        self.assertIn("nothing to prove", out)
        code, out = self.run_program(path("edge-no"), path("lyapunov"))
        self.assertEqual(code, 3)

    def test_refuted(self):
        with open(path("lyapunov"), encoding="utf-8") as stream: text = stream.read()
        found = json.loads(text)
        found["unknowns"]["P"] = [[1, 2], [2, 1]]
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "gains.json")
            with open(name, "w", encoding="utf-8") as stream: json.dump(found, stream)
            code, out = self.run_program("--claims", name)
            self.assertEqual(code, 1)
            self.assertIn("v = [", out)
            code, out = self.run_program("--json", name)
            claim = json.loads(out)["claims"][0]
            v = [Fraction(x) for x in claim["vector"]]
            p = [[Fraction(0), Fraction(2)], [Fraction(2), Fraction(0)]]     # P - I
            self.assertLess(sum(v[i] * p[i][j] * v[j] for i in range(2) for j in range(2)), 0)

    def test_damaged_files(self):
        with open(path("lyapunov"), encoding="utf-8") as stream: text = stream.read()
        good = json.loads(text)
        damaged = ["", "{", "[]", "1", "{}", text[:len(text) // 2], text.replace("yes", "maybe", 1),
                   text.replace("He(P*A)", "He(P*B)"), text.replace('"P"', '"P": 1, "P"', 1),
                   "[" * 100000, '{"verdict": NaN}', "\x00\xff", text.replace("[0, 1]", "[0, 2]")]
        for key, value in (("unknowns", 3), ("unknowns", {"P": "x"}), ("gains", None),
                           ("statement", {}), ("unknowns", {"P": [[True]]}), ("searched", [])):
            damaged.append(json.dumps(dict(good, **{key: value})))
        with tempfile.TemporaryDirectory() as folder:
            for k, content in enumerate(damaged):
                name = os.path.join(folder, "%d.json" % k)
                with open(name, "w", encoding="utf-8") as stream: stream.write(content)
            names = [os.path.join(folder, "%d.json" % k) for k in range(len(damaged))]
            code, out = self.run_program(*names, os.path.join(folder, "missing.json"))
            self.assertEqual(code, 2)
            lines = out.strip().split("\n")
            self.assertEqual(len(lines), len(damaged) + 2)
            self.assertEqual(lines.pop(), "%d files: %d not a gain file" % ((len(damaged) + 1,) * 2))
            for line in lines: self.assertTrue(line.startswith("not a gain file"), line)

    def test_time_limit(self):
        code, out = self.run_program("--time", "0.05", path("sampled"))
        self.assertIn(code, (0, 3))

    def test_what_fails_is_not_called_refuted(self):
        def run(name, **more):
            return subprocess.run([sys.executable, CERTIFY, name], stderr=subprocess.PIPE,
                                  text=True, **more)
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "yaml.py"), "w", encoding="utf-8") as stream:
                stream.write("raise ImportError")
            without = run(path("lyapunov"), env=dict(os.environ, PYTHONPATH=folder))
        self.assertEqual(without.returncode, 2)
        self.assertIn("python3-yaml", without.stderr)
        with open("/dev/full", "w", encoding="utf-8") as full:
            unprinted = run(path("lyapunov"), stdout=full)
        self.assertEqual(unprinted.returncode, 2)
        self.assertIn("No space left", unprinted.stderr)
        missing = run("missing.json", stdout=subprocess.PIPE)
        self.assertEqual(missing.returncode, 2)
        self.assertIn("cannot read this file: No such file", missing.stdout)

    def test_it_runs_alone(self):
        for name in os.listdir(CERTIFY):
            if name.endswith(".py"):
                with open(os.path.join(CERTIFY, name), encoding="utf-8") as stream:
                    for line in stream:
                        self.assertNotRegex(line, r"^\s*(from|import) (numpy|gmpy2|mpmath|scipy)")
                        self.assertLessEqual(len(line.rstrip("\n")), 100)

if __name__ == "__main__":
    unittest.main()
