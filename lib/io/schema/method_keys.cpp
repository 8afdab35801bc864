// The keys of method files, and of methods inside a problem.
#include <array>

#include "io/schema/keys.h"

namespace gainsmith::io {

namespace {

constexpr std::array kMethod = {
    Key{"method", "text", "its name"},
    Key{"source", "text", "where it is published"},
    Key{"summary", "text", "what it gives, in a line"},
    Key{"task", "text", "under which it is listed"},
    Key{"example", "text", "the problem to begin with"},
    Key{"data", "{text | declaration}?", "matrices, scalars and functions, with their shapes"},
    Key{"parameters", "{nothing | text | parameter}?", "scalars with defaults"},
    Key{"assume", "{text}?", "conditions on the data"},
    Key{"unknowns", "{text | unknown}?", "what is searched, with its shapes"},
    Key{"let", "{text}?", "definitions"},
    Key{"require", "{text | requirement}?", "the matrix inequalities"},
    Key{"necessary", "{text | requirement}?", "inequalities that may show that there are no gains"},
    Key{"minimize", "text", "the objective"},
    Key{"gains", "{text}?", "the formulas of the gains"},
    Key{"report", "{text}?", "expressions to be shown beside the gains"},
    Key{"plant", "plant", "the plant"},
    Key{"observer", "component", "the observer"},
    Key{"observers", "{component}?", "several observers on one plant"},
    Key{"timer", "{timer}1", "a clock that is reset"},
    Key{"events", "{event}?", "what happens at instants"},
    Key{"order", "[text]", "of events at one instant"},
    Key{"inputs", "{written matrix | measured input}?", "functions of time, or measured ones"},
    Key{"noise", "{noise}?", "what is drawn anew in a run"},
    Key{"signals", "{text}?", "expressions to be shown along runs"},
    Key{"claims", "{claim}?", "what campaigns check"},
    Key{"no campaign", "text", "why nothing is simulated"}};
constexpr std::string_view kDynamics = "plant,observer,observers,timer,events,order,inputs,noise";
constexpr std::array kMethodRules = {
    Rule::some("require,minimize,report,plant,observer,observers,timer,events,order,inputs,noise"),
    Rule::excludes("no campaign", kDynamics)};

constexpr std::array kDeclaration = {Key{"shape", "text", "such as n x p", kRequired},
                                     Key{"default", "matrix"}, Key{"help", "text"},
                                     Key{"for", "texts", "the indices of a family"},
                                     Key{"of", "{text}?", "the arguments of a function"}};

constexpr std::array kParameter = {Key{"default", "text"}, Key{"help", "text"},
                                   Key{"search", "range", "where it is searched"}};

constexpr std::array kUnknown = {
    Key{"shape", "text", "such as symmetric n", kRequired},
    Key{"help", "text"},
    Key{"of", "text | {text}", "the variable of a function, or the columns of a polynomial"},
    Key{"for", "texts", "the indices of a family"},
    Key{"degree", "text | [text, text]", "of a polynomial, or [least, largest] of its terms"},
    Key{"in", "range", "where the variable is"}};
constexpr std::array kUnknownRules = {Rule::needs("degree", "of"), Rule::needs("in", "of")};

constexpr std::array kRequirement = {
    Key{"forall", "texts", "such as tau in [0, T]"},
    Key{"that", "text", "the inequality"},
    Key{"blocks", "{{text}?}+", "its blocks by the names of their rows"},
    Key{"is", "text", "< 0 or > 0"},
    Key{"where", "texts", "comparisons of polynomials that the variables satisfy"},
    Key{"by", "text", "sos: as a sum of squares"},
    Key{"degree", "text", "of all terms of the sum of squares; +2 adds to that of the inequality"}};
constexpr std::array kRequirementRules = {Rule::exactly_one("that,blocks"),
                                          Rule::needs("blocks", "is"), Rule::needs("is", "blocks")};

constexpr std::array kClaim = {Key{"nonincreasing", "text", "this never increases"},
                               Key{"cost", "cost", "its integral stays below a bound"},
                               Key{"shrinks", "text", "this shrinks by the factor 'to'"},
                               Key{"below", "text", "this stays below the bound"},
                               Key{"above", "text", "this stays above the bound"},
                               Key{"bound", "text"},
                               Key{"to", "text"},
                               Key{"after", "text", "from this time on"},
                               Key{"over", "text", "at the jumps of this event"},
                               Key{"tolerance", "number", "a part of the bound"}};
constexpr std::array kClaimRules = {Rule::some("nonincreasing,cost,shrinks,below,above"),
                                    Rule::at_most_one("nonincreasing,cost,shrinks,above"),
                                    Rule::excludes("below", "nonincreasing,shrinks,above"),
                                    Rule::needs("cost", "below"),
                                    Rule::needs("below", "bound,cost"),
                                    Rule::needs("above", "bound"),
                                    Rule::needs("bound", "below,above"),
                                    Rule::excludes("cost", "bound,after,over"),
                                    Rule::needs("shrinks", "to"),
                                    Rule::needs("to", "shrinks"),
                                    Rule::excludes("shrinks", "after,over")};

constexpr std::array kCost = {Key{"flow", "text", "its rate"},
                              Key{"jump", "text", "what each jump adds"}};

}  // namespace

namespace keys {

const Level method = {"method", "A method of gainsmith", kMethod, kMethodRules};
const Level declaration = {"declaration", "A datum", kDeclaration};
const Level parameter = {"parameter", "A parameter", kParameter};
const Level unknown = {"unknown", "An unknown", kUnknown, kUnknownRules};
const Level requirement = {"requirement", "An inequality", kRequirement, kRequirementRules};
const Level claim = {"claim", "A claim", kClaim, kClaimRules};
const Level cost = {"cost", "An integral and a sum", kCost};

}  // namespace keys

}  // namespace gainsmith::io
