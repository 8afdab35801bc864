// The keys of plants, observers, events and what drives them.
#include <array>

#include "io/schema/keys.h"

namespace gainsmith::io {

namespace {

constexpr Key kState = {"state", "{text | state}?", "shapes, or shapes with a start"};
constexpr Key kMode = {"mode", "{text}?", "whole numbers with their starts"};
constexpr Key kOutput = {"output", "{written matrix | output}?", "what others read"};
constexpr Key kLet = {"let", "{text}?", "definitions"};
constexpr Key kFlow = {"flow", "{matrix}?", "derivatives of the states"};
constexpr Key kJump = {"jump", "{matrix}?", "states after the timer has run down"};
constexpr Key kEvents = {"events", "{event}?", "events of its own"};
constexpr Key kFrozen = {"frozen", "text", "the condition under which its states are constant"};
constexpr Key kWhile = {"while", "flow set", "the condition under which it flows"};

constexpr std::array kComponent = {
    Key{"like", "text", "the observer before it that it is a copy of; 'none' removes a part"},
    Key{"for", "texts", "the indices of a family of observers"},
    kState,
    kMode,
    kOutput,
    kLet,
    kFlow,
    kJump,
    Key{"at", "{reaction | 'none'}?", "what it does at events"},
    Key{"events", "{event | 'none'}?", "events of its own"},
    kFrozen,
    kWhile};

constexpr std::array kMap = {kLet, Key{"repeat", "never"}};

constexpr std::array kLoop = {Key{"repeat", "nothing | map", "a map", kRequired},
                              kLet,
                              Key{"until", "text", "a condition"},
                              Key{"at_most", "text", "passes"},
                              Key{"times", "text", "passes"},
                              Key{"else", "'go on'"}};
constexpr std::array kLoopRules = {Rule::exactly_one("at_most,times"),
                                   Rule::needs("until", "at_most"), Rule::needs("at_most", "until"),
                                   Rule::needs("else", "until")};

constexpr std::array kOutputParts = {Key{"value", "matrix", "", kRequired},
                                     Key{"at", "text", "the event that it is sampled at"}};

constexpr std::array kFlowSet = {Key{"c", "text", "the condition", kRequired},
                                 Key{"say", "text", "what is said when it fails", kRequired}};

constexpr std::array kStateParts = {Key{"shape", "text", "", kRequired}, Key{"start", "matrix"},
                                    Key{"help", "text"}};

constexpr Key kCsv = {"csv", "text", "a file beside this one", kRequired};
constexpr Key kColumn = {"column", "text", "its column, or the name of a vector", kRequired};
constexpr Key kTime = {"time", "text", "the column of the time; t or time by default"};
constexpr Key kScale = {"scale", "number", "the unit of its times in seconds, 1e-3 for ms"};
constexpr Key kFrom = {"from", "number | text", "the time that is 0, or 'first row'"};
constexpr Key kRows = {"rows", "{text}?", "only rows with these words"};
constexpr Key kBetween = {"between", "'hold' | 'line'", "the value between the rows"};

constexpr std::array kLogPlant = {Key{"log", "text | log", "a file of measured data", kRequired},
                                  Key{"output", "{text | log output}?", "its columns"}, kEvents};
constexpr std::array kLog = {kCsv, kTime, kScale, kFrom, kRows, kBetween};
constexpr std::array kLogOutput = {kColumn, kBetween,
                                   Key{"at", "text", "the event that it is sampled at"}};
constexpr std::array kMeasuredInput = {kCsv, kColumn, kTime, kScale, kFrom, kRows, kBetween};
constexpr std::array kMeasuredTimes = {
    kCsv, Key{"column", "text", "the column of the time"}, kTime, kScale, kFrom, kRows};

constexpr std::array kEvent = {Key{"when", "text", "a condition"},
                               Key{"rises", "text", "an expression that becomes positive"},
                               Key{"falls", "text", "an expression that becomes negative"},
                               Key{"crosses", "text", "an expression that changes its sign"},
                               Key{"every", "ends", "an interval, or [shortest, longest]"},
                               Key{"at", "text | [text]+ | measured times", "instants"},
                               Key{"first", "ends", "the first interval"},
                               Key{"if", "text", "only under this condition"},
                               Key{"lost", "number | lost", "how likely it does not come"}};
constexpr std::array kEventRules = {Rule::exactly_one("when,rises,falls,crosses,every,at"),
                                    Rule::needs("first", "every")};

constexpr std::array kLost = {Key{"probability", "number", "", kRequired},
                              Key{"in_a_row", "whole", "at most"}};

constexpr std::array kNoise = {kNormalKey,
                               kLognormalKey,
                               Key{"uniform", "[matrix, matrix]", "[low, high]"},
                               Key{"sinusoid", "sinusoid"},
                               Key{"new at", "text", "the event that it is drawn at"},
                               Key{"every", "text", "how often it is drawn"}};
constexpr std::array kNoiseRules = {Rule::exactly_one("normal,lognormal,uniform,sinusoid"),
                                    Rule::at_most_one("new at,every"),
                                    Rule::excludes("sinusoid", "new at,every")};

constexpr std::array kSinusoid = {Key{"amplitude", "ends", "", kRequired},
                                  Key{"frequency", "ends", "", kRequired}, Key{"phase", "ends"}};

constexpr std::array kTimer = {Key{"reset", "[matrix, matrix]", "[shortest, longest]", kRequired},
                               Key{"first", "[matrix, matrix]", "where it starts"}};

}  // namespace

namespace keys {

const Level component = {"component", "A plant or an observer", kComponent};
const Level map = {"map", "New values of states", kMap, {}, "matrix"};
const Level loop = {"loop", "A map that is repeated", kLoop, kLoopRules};
const Level output = {"output", "An output that is sampled", kOutputParts};
const Level flow_set = {"flow set", "Where it flows", kFlowSet};
const Level state = {"state", "A state with its start", kStateParts};
const Level log_plant = {"log plant", "A plant that is a log", kLogPlant};
const Level log = {"log", "A file of measured data", kLog};
const Level log_output = {"log output", "A column of the log", kLogOutput};
const Level measured_input = {"measured input", "A column of a file", kMeasuredInput};
const Level measured_times = {"measured times", "Instants of a file", kMeasuredTimes};
const Level event = {"event", "An event", kEvent, kEventRules};
const Level lost = {"lost", "How it is lost", kLost};
const Level noise = {"noise", "A noise", kNoise, kNoiseRules};
const Level sinusoid = {"sinusoid", "A sinusoid, drawn once a run", kSinusoid};
const Level timer = {"timer", "A clock", kTimer};

}  // namespace keys

}  // namespace gainsmith::io
