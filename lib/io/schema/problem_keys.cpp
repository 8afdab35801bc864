// The keys of problem files.
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "base/named.h"
#include "io/schema/keys.h"

namespace gainsmith::io {

namespace {

template <class Item, std::size_t N, std::size_t M>
constexpr std::array<Item, N + M> joined(const std::array<Item, N>& first,
                                         const std::array<Item, M>& second) {
  std::array<Item, N + M> all{};
  std::copy(first.begin(), first.end(), all.begin());
  std::copy(second.begin(), second.end(), all.begin() + N);
  return all;
}

constexpr std::array kProblem = {
    Key{"problem", "text", "the name of the problem", kRequired},
    Key{"method", "text | method",
        "the name of a built-in method, one that is 'like' it, or a method of its own", kRequired},
    Key{"data", "nothing | data", "matrices, scalars and functions of the method, by name"},
    Key{"parameters", "{matrix}?", "values of the method's parameters"},
    Key{"let", "{text}?", "definitions that campaign, report, compare and expect may use"},
    Key{"synthesis", "synthesis", "how gains are searched"},
    Key{"search", "search", "scalars that are searched besides the unknowns"},
    Key{"negotiable", "{range}?", "scalars that explain may move, with their ranges"},
    Key{"uncertain", "{uncertain}?", "data that differ from run to run"},
    Key{"campaign", "campaign", "the runs that check the claims"},
    Key{"no campaign", "text", "why there is none"},
    Key{"report", "{text}?", "expressions to be shown beside the gains"},
    Key{"units", "{text | [text]+}?", "units of states and signals, for pictures and tables"},
    Key{"covariance", "{text}?", "for an estimate: the state that is the covariance of its error"},
    Key{"compare", "[figure]", "figures of runs, side by side for each observer"},
    Key{"figures", "{system figure}?", "pictures of linear systems, by name"},
    Key{"expect", "expectation", "what gainsmith run compares the results with"}};
constexpr std::array kProblemRules = {Rule::at_most_one("campaign,no campaign")};

constexpr std::array kData = {Key{"f(x)", "text", "a function of the method: its formula"}};

constexpr std::array kDataFile = {
    Key{"csv", "text", "a file of numbers, separated by commas"},
    Key{"npy", "text", "a file of NumPy"}, Key{"mat", "text", "a file of MATLAB"},
    Key{"json", "text", "a file of JSON"},
    Key{"name", "text", "of the matrix in a file that may hold several"}};
constexpr std::array kDataFileRules = {Rule::exactly_one("csv,npy,mat,json"),
                                       Rule::excludes("name", "csv,npy")};

constexpr std::array kSynthesis = {
    Key{"margin", "number", "the margin of strict inequalities, relative to the data's scale"},
    Key{"gain_bound", "number | 'none' | {number}+", "a bound on the gains, for all or by name"},
    Key{"forall", "ways | way", "how 'for all' is imposed"},
    Key{"effort", "'ordinary' | 'full'",
        "what double does not decide: an allowance of work, or any"}};

constexpr std::array kWay = {Key{"way", "ways", "", kRequired},
                             Key{"slices", "whole", "of the hull"}};

constexpr std::array kCampaign = {
    Key{"runs", "whole", "how many"},
    Key{"seed", "whole", "of the draws"},
    Key{"horizon", "text", "how long a run is"},
    Key{"accuracy", "accuracy", "of the integration"},
    Key{"first", "text", "the first value of the timer"},
    Key{"sampling", "laws | {laws}",
        "how intervals are drawn: a law, a list of laws, or those of each event"},
    Key{"initial", "{matrix | start}?", "where the states start"}};

constexpr std::array kLaw = {Key{"constant", "text", "always this interval"},
                             Key{"list", "[text]+", "these intervals"}};
constexpr std::array kLawRules = {Rule::exactly_one("constant,list")};

constexpr std::array kAccuracy = {
    Key{"relative", "number"}, Key{"absolute", "number | {number}", "for all states, or by name"}};

constexpr Key kDeviation = {"deviation", "matrix", "element by element"};
constexpr Key kCovariance = {"covariance", "matrix", "of a column"};
constexpr std::array kNormal = {Key{"mean", "matrix"}, kDeviation, kCovariance};
constexpr std::array kLognormal = {Key{"median", "matrix"}, kDeviation, kCovariance};
constexpr std::array kSpreadRules = {Rule::exactly_one("deviation,covariance")};

constexpr std::array kStart = {Key{"box", "[matrix, matrix]", "[low, high]"},
                               Key{"list", "[matrix]+", "one of these values"},
                               Key{"ellipsoid", "ellipsoid"}, kNormalKey, kLognormalKey};
constexpr std::array kStartRules = {Rule::exactly_one("box,list,ellipsoid,normal,lognormal")};

constexpr std::array kEllipsoid = {Key{"center", "matrix"},
                                   Key{"matrix", "matrix", "P of e'*P*e <= level", kRequired},
                                   Key{"level", "matrix", "a number, or [low, high]"}};

constexpr std::array kSystemFigure = {
    Key{"bode", "systems", "size and phase over the frequency"},
    Key{"singular values", "systems", "over the frequency"},
    Key{"nyquist", "systems", "in the complex plane, one input and one output"},
    Key{"nichols", "systems", "size over phase, one input and one output"},
    Key{"step", "systems", "outputs over time, for each input"},
    Key{"impulse", "systems", "the same of impulses"},
    Key{"poles", "systems", "poles and zeros in the complex plane"},
    Key{"margins", "systems", "over the scanned scalar, one input and one output"},
    Key{"over", "range", "of the frequency in radians per unit of time, or of the time"},
    Key{"scan", "{range}", "a scalar for whose values the gains are designed anew"},
    Key{"title", "text", "above the picture, in place of its name"}};
constexpr std::array kSystemFigureRules = {
    Rule::exactly_one("bode,singular values,nyquist,nichols,step,impulse,poles,margins"),
    Rule::excludes("over", "poles,margins"), Rule::needs("margins", "scan")};

constexpr std::array kExpectation = {
    Key{"verdict", "'yes' | 'no' | 'undecided'"},
    Key{"status", "'optimal' | 'feasible' | 'infeasible' | 'undecided'", "of the solver"},
    Key{"campaign", "'held' | 'violated' | 'undecided'"},
    Key{"active_bounds", "[text]", "gain bounds that are reached"},
    Key{"values", "{expected value}?", "expressions with their values"},
    Key{"run", "[expected figure]", "figures of one run"}};

constexpr std::array kExpectedValue = {
    Key{"value", "matrix"}, Key{"relative", "number", "tolerance"},
    Key{"absolute", "number", "tolerance"}, Key{"below", "matrix", "each element is at most this"},
    Key{"above", "matrix", "each element is at least this"}};
constexpr std::array kExpectedValueRules = {Rule::some("value,below,above")};

constexpr std::array kFigure = {
    Key{"observer", "text", "of which observer"},
    Key{"at", "moment", "when"},
    Key{"value", "text", "the value then"},
    Key{"peak", "text", "the largest value"},
    Key{"least", "text", "the smallest value"},
    Key{"settles", "text", "the time from which on it stays below a bound"},
    Key{"below", "text", "that bound"},
    Key{"rms", "text", "the root of the mean square"},
    Key{"integral", "text", "the integral"},
    Key{"over", "range", "of these times"},
    Key{"nees", "text", "e'*inv(P)*e of this error e"},
    Key{"nis", "text", "its mean over the samples of this innovation"},
    Key{"covariance", "text", "P"},
    Key{"count", "text", "how often an event came"},
    Key{"passes", "text", "passes of the loops of an event"},
    Key{"lost", "text", "how often an event was lost"}};
constexpr std::array kFigureParts = {
    Rule::needs("at", "value,nees,nis"), Rule::needs("value", "at"),
    Rule::needs("settles", "below"),     Rule::needs("below", "settles"),
    Rule::needs("rms", "over"),          Rule::needs("integral", "over"),
    Rule::needs("over", "rms,integral"), Rule::needs("nees", "at"),
    Rule::needs("nees", "covariance"),   Rule::needs("nis", "at"),
    Rule::needs("nis", "covariance"),    Rule::needs("covariance", "nees,nis")};
constexpr auto kFigureRules =
    joined(kFigureParts, std::array{Rule::exactly_one(
                             "value,peak,least,settles,rms,integral,nees,nis,count,passes,lost")});

constexpr auto kExpectedFigure = joined(
    kFigure,
    std::array{
        Key{"ended",
            "'horizon' | 'escaped' | 'undefined' | 'left' | 'stuck' | 'zeno' | 'chattering' | "
            "'sliding' | 'passes' | 'full' | 'interrupted' | 'lost'",
            "why the run ended"},
        Key{"is", "text | limits", "the wanted value, or its limits"},
        Key{"relative", "number", "tolerance"}, Key{"absolute", "number", "tolerance"}});
constexpr auto kExpectedFigureRules = joined(
    kFigureParts,
    std::array{
        Rule::exactly_one("value,peak,least,settles,rms,integral,nees,nis,count,passes,lost,ended"),
        Rule::exactly_one("is,ended"), Rule::excludes("ended", "is,relative,absolute")});

constexpr std::array kLimits = {Key{"below", "text", "at most"}, Key{"above", "text", "at least"}};
constexpr std::array kLimitRules = {Rule::some("below,above")};

constexpr std::array kMoment = {Key{"event", "text"}, Key{"t", "text", "a time"},
                                Key{"count", "whole", "which one of the event"},
                                Key{"side", "'before' | 'after'"}};
constexpr std::array kMomentRules = {Rule::exactly_one("event,t"),
                                     Rule::excludes("t", "count,side")};

constexpr std::array kSearch = {
    Key{"largest", "{range}1", "the largest feasible value of a scalar"},
    Key{"smallest", "{range}1", "the smallest one"},
    Key{"tolerance", "number", "how wide its bracket may be"},
    Key{"over", "{range}?", "scalars with their ranges"},
    Key{"minimize", "text | figure", "an expression, or a figure of runs"},
    Key{"runs", "whole", "of that figure"},
    Key{"evaluations", "whole", "at most"}};
constexpr std::array kSearchRules = {Rule::some("largest,smallest,over"),
                                     Rule::at_most_one("largest,smallest"),
                                     Rule::excludes("minimize", "largest,smallest"),
                                     Rule::needs("tolerance", "largest,smallest"),
                                     Rule::needs("evaluations", "over"),
                                     Rule::needs("runs", "minimize")};

constexpr std::array kUncertain = {
    Key{"box", "[matrix, matrix]", "[low, high]"},
    Key{"vertices", "text | data file | [matrix]+", "one of these values"},
    Key{"sampling", "'uniform' | 'vertices'", "of the box"}, kNormalKey, kLognormalKey};
constexpr std::array kUncertainRules = {Rule::exactly_one("box,vertices,normal,lognormal"),
                                        Rule::needs("sampling", "box")};

}  // namespace

namespace keys {

const Level problem = {"problem", "A problem file of gainsmith", kProblem, kProblemRules};
const Level data = {"data", "Data by name", kData, {}, "datum"};
const Level data_file = {"data file", "A matrix in a file", kDataFile, kDataFileRules};
const Level synthesis = {"synthesis", "How gains are searched", kSynthesis};
const Level way = {"way", "How 'for all' is imposed", kWay};
const Level campaign = {"campaign", "Runs that check the claims", kCampaign};
const Level law = {"law", "A law of intervals", kLaw, kLawRules};
const Level accuracy = {"accuracy", "Accuracy of the integration", kAccuracy};
const Level start = {"start", "Where a state starts", kStart, kStartRules};
const Level ellipsoid = {"ellipsoid", "Starts in an ellipsoid", kEllipsoid};
const Level normal = {"normal", "A normal distribution", kNormal, kSpreadRules};
const Level lognormal = {"lognormal", "Its logarithm is normal, with this deviation or covariance",
                         kLognormal, kSpreadRules};
const Level system_figure = {"system figure", "A picture of linear systems", kSystemFigure,
                             kSystemFigureRules};
const Level expectation = {"expectation", "What results are compared with", kExpectation};
const Level expected_value = {"expected value", "A value with its tolerance, or bounds",
                              kExpectedValue, kExpectedValueRules};
const Level expected_figure = {"expected figure", "A figure with its value", kExpectedFigure,
                               kExpectedFigureRules};
const Level limits = {"limits", "What a figure is at most, and at least", kLimits, kLimitRules};
const Level figure = {"figure", "A figure of a run", kFigure, kFigureRules};
const Level moment = {"moment", "A time, or an event", kMoment, kMomentRules};
const Level search = {"search", "Scalars that are searched", kSearch, kSearchRules};
const Level uncertain = {"uncertain", "A datum that differs from run to run", kUncertain,
                         kUncertainRules};

constexpr std::array kProblemLevels = {
    &problem,       &data,           &data_file,       &synthesis, &way,         &campaign,
    &law,           &accuracy,       &start,           &ellipsoid, &normal,      &lognormal,
    &expectation,   &expected_value, &expected_figure, &limits,    &figure,      &moment,
    &system_figure, &search,         &uncertain,       &method,    &declaration, &parameter,
    &unknown,       &requirement,    &claim,           &cost,      &component,   &map,
    &loop,          &output,         &flow_set,        &state,     &log_plant,   &log,
    &log_output,    &measured_input, &measured_times,  &event,     &lost,        &noise,
    &sinusoid,      &timer};

}  // namespace keys

const Key* Level::find(std::string_view key) const { return find_named(keys, key); }

void require_known(const Level& level, std::string_view key) {
  if (level.find(key) == nullptr)
    throw std::logic_error("the key '" + std::string(key) +
                           "' is missing in the table of keys of a '" + std::string(level.name) +
                           "' (lib/io/*_keys.cpp)");
}

std::span<const Level* const> problem_levels() { return keys::kProblemLevels; }

std::span<const NamedForm> problem_forms() {
  static constexpr std::array kNamedForms = {
      NamedForm{"written matrix", "text | [text]+ | [[text]+]+"},
      NamedForm{"matrix", "written matrix | data file"},
      NamedForm{"datum", "matrix | matrices"},
      NamedForm{"range", "[text, text]"},
      NamedForm{"ends", "text | [matrix, matrix]"},
      NamedForm{"texts", "text | [text]"},
      NamedForm{"systems", "text | [text]+ | {text}+"},
      NamedForm{"ways", "'auto' | 'hull' | 'exchange' | 'vertex_gains'"},
      NamedForm{"one law", "'uniform' | 'extremes' | 'sinusoid' | 'golden' | law"},
      NamedForm{"laws", "one law | [one law]+"},
      NamedForm{"pass", "loop | nothing | map"},
      NamedForm{"reaction", "pass | [pass]"},
      NamedForm{"plant", "log plant | component"}};
  return kNamedForms;
}

}  // namespace gainsmith::io
