"""certify GAINS.json...: an independent check of what gain files of gainsmith say.

Exit code 0: all is proved, or there is nothing to prove. 1: something is refuted. 3: something is
open, or it was interrupted. 2: a file is not a gain file, or printing failed. 70: a fault.
"""
import argparse, json, math, os, signal, sys, time, traceback
from collections import Counter
try: import yaml                 # what the other files need and Python does not bring along
except ImportError:
    print("certify: PyYAML is not installed (package python3-yaml in Debian)", file=sys.stderr)
    sys.exit(2)
from no import prove_no, prove_optimum
from statement import Damaged, expect, read_gain_file
from yes import Claim, prove_objective, prove_yes
SECONDS_BESIDE = 2       # for the certificate of the value beyond the one that a search found
MOST_ULPS = 2 ** 20         # a gain farther from its formula is open
EXIT = {"nothing to prove": 0, "proved": 0, "refuted": 1, "open": 3, "not a gain file": 2}
class OutOfTime(BaseException): pass
def out_of_time(*_): raise OutOfTime()
def within(seconds, work):
    """work(), or OutOfTime after so many seconds of the processor."""
    signal.signal(signal.SIGPROF, out_of_time)
    signal.setitimer(signal.ITIMER_PROF, max(seconds, 0.001))
    try: return work()
    finally: signal.setitimer(signal.ITIMER_PROF, 0)
def check(path, seconds):
    """What is found about one file, as a dictionary."""
    began = time.process_time()
    found = {"file": path, "verdict": "open", "message": "", "claims": [], "gains": [],
             "proved_at_printed_gains": [], "beside": []}
    try:
        gain = within(seconds, lambda: read_gain_file(path))
        found["says"] = gain["verdict"]
        within(seconds, lambda: check_verdict(gain, found))
        check_beside(gain, found, seconds - (time.process_time() - began))
        if any(c.result == "refuted" for c in found["beside"]): found["verdict"] = "refuted"
    except (OutOfTime, MemoryError) as error:
        limit = "%g s" % seconds if isinstance(error, OutOfTime) else "the memory"
        after = " after the claim %s" % found["claims"][-1].name if found["claims"] else ""
        found.update(verdict="open", message="the limit of %s was reached%s" % (limit, after))
    except Exception as error:      # Damaged, or a form of the file that no check expects
        found.update(verdict="not a gain file", message=("" if isinstance(error, Damaged) else
                     "it cannot be read: %s " % type(error).__name__) + str(error))
    found["seconds"] = time.process_time() - began
    return found
def check_verdict(gain, found):
    claims = found["claims"]
    if gain["verdict"] == "undecided": found["message"] = "the file says undecided"
    elif gain["verdict"] == "no":
        expect(isinstance(gain.get("certificate"), dict), "certificate: an object")
        claims.append(prove_no(dict(gain, searched=None), gain["certificate"]))
    else:
        _, found["gains"], found["proved_at_printed_gains"] = prove_yes(gain, claims)
        if not claims: found["message"] = "the method has no inequalities"
    results = {c.result for c in claims}
    found["verdict"] = next((r for r in ("refuted", "open", "proved") if r in results),
                            "nothing to prove")
    far = [g.name for g in found["gains"] if g.ulps is not None and g.ulps > MOST_ULPS and
           g.name not in found["proved_at_printed_gains"]]
    if found["verdict"] == "proved" and far:
        found.update(verdict="open", message="far from their formulas: " + ", ".join(far))
def check_beside(gain, found, seconds):
    """Claims beside the verdict: bounds of the objective, a no beyond the best searched value."""
    if gain["verdict"] == "yes" and isinstance(gain.get("objective"), str):
        found["beside"].append(within(seconds, lambda: prove_objective(gain)))
    if gain["verdict"] == "yes" and gain["optimum"] and "objective_lower_bound" in gain:
        found["beside"].append(within(seconds, lambda: prove_optimum(gain)))
    search = gain["search"]
    certificate, figure = search.get("certificate"), search.get("figure")
    if not isinstance(certificate, dict) or certificate.get("about") != "problem" or \
            not isinstance(figure, str) or search.get("beyond") is None: return
    name = figure.split()[-1]
    beyond = dict(gain, searched={**gain["searched"], name: search["beyond"]})
    label = "no solution at %s = %s" % (name, search["beyond"])
    try: claim = within(min(SECONDS_BESIDE, seconds), lambda: prove_no(beyond, certificate, label))
    except OutOfTime: claim = Claim(label, "open", "not decided in %d s" % SECONDS_BESIDE)
    found["beside"].append(claim)
# Reports.
def summary(found):
    """The rest of the line about a file."""
    if found["verdict"] == "not a gain file": return found["message"]
    if found["verdict"] == "nothing to prove": return "nothing to prove: " + found["message"]
    claims, gains = found["claims"], found["gains"]
    parts = [summary_of_claims(claims) if claims else "", found["message"]]
    parts += ["%s: %s" % (c.name, c.how) for c in claims if c.result != "proved"][:1]
    worst = max((g for g in gains if g.ulps is not None), key=lambda g: g.ulps, default=None)
    if worst:
        ulps = min(max(1, math.ceil(worst.ulps)), 10 ** 300)
        parts.append("%s within %s ulp" % ("gains" if ulps == 1 else "gains (%s)" % worst.name,
                                           ulps if ulps < 10 ** 6 else "%.1e" % ulps))
    for text, names in (("proved at the printed ", found["proved_at_printed_gains"]),
                        ("not compared: ", [g.name for g in gains if g.ulps is None])):
        if names: parts.append(text + ", ".join(names))
    parts += ["%s: %s" % (c.name, c.result) for c in found["beside"]]
    return ", ".join(filter(None, parts))
def summary_of_claims(claims):
    proved, texts = [c for c in claims if c.result == "proved"], []
    for how, count in Counter(c.how for c in proved).items():
        word = "for" if how.startswith("all ") else "in" if how in ("balls", "fractions") else "by"
        texts.append("%d %s %s" % (count, word, how))
        pieces = sum(c.pieces for c in proved if c.how == how)
        if word == "for": texts.append(counted(pieces, "piece"))
    return counted(len(claims), "claim") + (" (%s)" % ", ".join(texts) if texts else "")
def counted(number, word): return "%d %s%s" % (number, word, "s" if number > 1 else "")
def text_of_claim(c):
    lines = ["  %-9s %s  (%s%s)" % (c.result, c.name, c.how,
                                    ", " + counted(c.pieces, "piece") if c.pieces else "")]
    if c.point: lines.append("at " + ", ".join("%s = %s" % p for p in c.point.items()))
    if c.vector: lines.append("v = [%s]" % ", ".join(map(str, c.vector)))
    return "\n            ".join(lines)
def json_of(found):         # with named tuples as objects, and fractions as texts
    plain = {key: [x._asdict() if hasattr(x, "_asdict") else x for x in value]
             if isinstance(value, list) else value for key, value in found.items()}
    return json.dumps(plain, default=str)
def main():
    parser = argparse.ArgumentParser(prog="certify", description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="+", metavar="GAINS.json")
    parser.add_argument("--claims", action="store_true", help="a line for each claim")
    parser.add_argument("--json", action="store_true", help="a JSON object for each file")
    parser.add_argument("--time", type=float, default=60, metavar="SECONDS",
                        help="limit for each file; what is not decided then is open (60)")
    options = parser.parse_args()
    sys.setrecursionlimit(5000)
    sys.set_int_max_str_digits(0)
    counts = Counter()
    for path in options.files:
        found = check(path, options.time)
        counts[found["verdict"]] += 1
        if options.json: print(json_of(found))
        else:
            shown = found["verdict"].replace("nothing to prove", "nothing")
            print("%-8s %s  %s  %.2f s" % (shown, path, summary(found), found["seconds"]))
            for c in found["claims"] + found["beside"] if options.claims else ():
                print(text_of_claim(c))
        sys.stdout.flush()
    if len(options.files) > 1 and not options.json:
        texts = ["%d %s" % (counts[verdict], verdict) for verdict in EXIT if counts[verdict]]
        print("%d files: %s" % (len(options.files), ", ".join(texts)))
    return next((code for code in (1, 2, 3) if code in {EXIT[v] for v in counts}), 0)
def exit_code():
    """That of main(). Python's own code of an exception, 1, would say that a file is refuted."""
    try: return main()
    except KeyboardInterrupt: return 3
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)    # nothing is printed at the exit either
        print("certify: cannot print: %s" % error.strerror, file=sys.stderr)
        return 2
    except Exception:
        traceback.print_exc()
        return 70
if __name__ == "__main__": sys.exit(exit_code())
