// Dynamics, claims and starts as rows: rates with a dot, values after a jump with a plus, outputs
// and definitions as equations; what mathematics has no sign for is a remark behind them.
#include "page/motion.h"

#include <filesystem>

#include "drawing/text.h"
#include "page/element.h"
#include "page/lines.h"
#include "page/mathml.h"
#include "page/rows.h"
#include "page/symbol.h"

namespace gainsmith::page {

namespace {

using EventKind = model::Dynamics::EventKind;
using NoiseKind = model::Dynamics::NoiseKind;
using drawing::escaped;

std::string quoted(const std::string& name) { return text_element("b", name); }

/// How values are drawn, in the order in which they are shown.
std::string drawn_text(NoiseKind kind, bool covariance) {
  const std::string spread = covariance ? "covariance" : "standard deviation";
  if (kind == NoiseKind::normal) return "normal: mean, " + spread;
  if (kind == NoiseKind::lognormal) return "lognormal: median, " + spread + " of the logarithm";
  if (kind == NoiseKind::uniform) return "uniform in this range";
  return kind == NoiseKind::corners ? "the corners between these, in turn"
                                    : "one of these, in turn";
}

/// The rows of one problem; `notation` must outlive it.
class Motion {
 public:
  explicit Motion(const Notation& notation) : notation_(notation) {}

  /// A plant or an observer: outputs, definitions, rates, jumps, where it flows and rests, its
  /// events.
  std::string component(const model::Component& component, const std::string& title) const {
    std::string rows;
    for (const model::Output& output : component.outputs)
      rows += formula_row("", defined(output.name, output.value),
                          output.at.empty() ? "" : "at " + quoted(output.at));
    for (const model::Let& let : component.let) rows += definition(let, "");
    for (const model::Named& rate : component.flow)
      rows +=
          formula_row("", equation(element("mover", name(rate.name) + mo("˙")), of(rate.value)));
    for (const model::Named& next : component.jump) rows += jump(next, "timer");
    for (const model::ReactionText& reaction : component.at)
      for (const model::PassText& pass : reaction.passes) rows += pass_rows(pass, reaction.event);
    for (const model::FlowSetText& set : component.flow_sets)
      rows += formula_row("", of(set.condition), "while it flows");
    if (component.frozen) rows += formula_row("", of(*component.frozen), "where it rests");
    for (const model::EventText& own : component.events) rows += event(own);
    return group(title, rows);
  }

  /// What an event is due by, and besides its first time, its condition and its losses.
  std::string event(const model::EventText& stated) const {
    std::string math;
    std::string how;
    switch (stated.kind) {
      case EventKind::when:
        how = "while this is true";
        break;
      case EventKind::rises:
        how = "when this rises above 0";
        break;
      case EventKind::falls:
        how = "when this falls below 0";
        break;
      case EventKind::crosses:
        how = "when this crosses 0";
        break;
      case EventKind::every:
        how = stated.numbers.size() == 1 ? "the time between two"
                                         : "the time between two, from this range";
        break;
      case EventKind::at:
        how = stated.rows.empty() ? "its times"
                                  : "at " + count_of(stated.rows.size(), "time") + " of a file";
        break;
    }
    if (stated.what) math = of(*stated.what);
    if (!stated.numbers.empty()) math = range_mathml(stated.numbers, notation_);
    if (!stated.first.empty())
      how += ", the first after " + formula(range_mathml(stated.first, notation_));
    if (stated.only_if) how += ", only if " + formula(of(*stated.only_if));
    if (stated.lost > 0) how += ", lost with probability " + formula(value(stated.lost));
    return formula_row(stated.name, math, how);
  }

  /// "w ~ (0, 0.03)" with its law and when it is drawn anew.
  std::string noise(const model::NoiseText& drawn) const {
    std::string how = drawn_text(drawn.kind, drawn.covariance);
    if (!drawn.event.empty()) how += ", new at " + quoted(drawn.event);
    if (drawn.every) how += ", new every " + formula(of(*drawn.every));
    // A range has brackets, the parameters of a law parentheses.
    const bool plain = drawn.kind == NoiseKind::uniform;
    std::string math = drawn.values.empty() ? ""
                                            : range_mathml(drawn.values, notation_,
                                                           plain ? "[" : "(", plain ? "]" : ")");
    if (!drawn.sinusoid.empty()) {
      how = "a sinusoid";
      std::vector<std::string> parts;
      for (const auto& [part, ends] : drawn.sinusoid)
        parts.push_back(equation(text_element("mi", part), range_mathml(ends, notation_), ":"));
      math = row(listed(parts));
    }
    return formula_row("", equation(name(drawn.name), math, math.empty() ? "" : "∼"), how);
  }

  std::string defined(const std::string& left, const expr::Expression& right) const {
    return equation(name(left), of(right));
  }

  /// The inequality of a claim; `shrinks` is V at the end <= factor V at the start.
  std::string claim(const model::Claim& claim) const {
    using model::ClaimKind;
    std::string math = of(claim.value);
    std::string remark;
    switch (claim.kind) {
      case ClaimKind::nonincreasing:
        remark = "never increases";
        break;
      case ClaimKind::cost:
        math = cost(claim);
        break;
      case ClaimKind::shrinks: {
        const auto at = [&](const std::string& when) {
          return row(factor(claim.value) + element("msub", mo("|") + when));
        };
        math = row(at("<mtext>end</mtext>") + mo("≤") +
                   (claim.factor ? factor(*claim.factor) : "") + at("<mn>0</mn>"));
        break;
      }
      case ClaimKind::below:
      case ClaimKind::above:
        math = row(math + mo(claim.kind == ClaimKind::below ? "≤" : "≥") +
                   (claim.bound ? of(*claim.bound) : ""));
        break;
    }
    const auto add = [&](const std::string& part) {
      remark += (remark.empty() ? "" : ", ") + part;
    };
    if (claim.after) add("from " + formula(equation("<mi>t</mi>", of(*claim.after))) + " on");
    if (!claim.over.empty()) add("just after " + quoted(claim.over));
    if (claim.tolerance > 0) add("within " + formula(value(claim.tolerance)) + " of the bound");
    const std::string members = for_all_text(claim.indices, notation_);
    if (!members.empty()) add(members);
    return formula_row(claim.name, math, remark);
  }

  /// z(0) = a value, or what it is drawn from.
  std::string start(const model::InitialValue& initial) const {
    using model::StartKind;
    std::vector<std::string> values;
    for (const model::Value& part : initial.values) values.push_back(value_mathml(part, notation_));
    const std::string left = name(initial.state) + fenced("<mn>0</mn>");
    switch (initial.kind) {
      case StartKind::expression:
        return formula_row("", equation(row(left), row(listed(values))));
      case StartKind::box:
        return formula_row("", equation(row(left), fenced(listed(values), "[", "]"), "∈"),
                           "uniform");
      case StartKind::list:
        return formula_row("", equation(row(left), fenced(listed(values), "{", "}"), "∈"),
                           "in turn");
      case StartKind::normal:
      case StartKind::lognormal:
        return formula_row(
            "", equation(row(left), fenced(listed(values)), "∼"),
            drawn_text(initial.kind == StartKind::normal ? NoiseKind::normal : NoiseKind::lognormal,
                       initial.covariance));
      case StartKind::ellipsoid:
        return formula_row(
            "", equation(row(left), row("<mi>ellipsoid</mi>" + fenced(listed(values))), "∈"),
            "uniform; centre, matrix, level");
    }
    return "";
  }

 private:
  std::string name(const std::string& text) const { return name_mathml(text, notation_); }
  std::string of(const expr::Expression& expression) const { return mathml(expression, notation_); }

  /// In parentheses where it is neither a number nor a name nor a value of a function.
  std::string factor(const expr::Expression& expression) const {
    const expr::NodeKind kind = expression.root->kind;
    const bool alone = kind == expr::NodeKind::number || kind == expr::NodeKind::name ||
                       kind == expr::NodeKind::call;
    return alone ? of(expression) : fenced(of(expression));
  }

  std::string definition(const model::Let& let, const std::string& remark) const {
    return formula_row("", equation(signature_mathml(let.signature, notation_), of(let.body)),
                       remark);
  }

  /// x with a plus: the value after the event.
  std::string jump(const model::Named& next, const std::string& event) const {
    return formula_row("",
                       equation(element("msup", row(name(next.name)) + mo("+")), of(next.value)),
                       "at " + quoted(event));
  }

  /// Definitions, then new values, then the end of a loop.
  std::string pass_rows(const model::PassText& pass, const std::string& event) const {
    std::string rows;
    for (const model::Let& let : pass.let) rows += definition(let, "at " + quoted(event));
    for (const model::Named& next : pass.map) rows += jump(next, event);
    if (pass.repeats && pass.until)
      rows += formula_row("", of(*pass.until), "until then repeated, at " + quoted(event));
    return rows;
  }

  /// integral of the flow cost dt + sum over jumps of the jump cost <= V at the start.
  std::string cost(const model::Claim& claim) const {
    std::string sum;
    if (claim.flow_cost) sum = mo("∫") + row(factor(*claim.flow_cost) + "<mi>d</mi><mi>t</mi>");
    if (claim.jump_cost)
      sum += (sum.empty() ? "" : mo("+")) + element("munder", mo("∑") + "<mtext>jumps</mtext>") +
             factor(*claim.jump_cost);
    return row(sum + mo("≤") + factor(claim.value) + element("msub", mo("|") + "<mn>0</mn>"));
  }

  const Notation& notation_;
};

/// How campaigns draw the times between events.
std::string laws(const model::Campaign& campaign, const Notation& notation) {
  std::string rows;
  for (const model::SamplingLaw& law : campaign.sampling) {
    std::string values;
    if (!law.values.empty()) values = range_mathml(law.values, notation, "[");
    rows += formula_row(law.event, values, escaped(to_string(law.kind)));
  }
  return rows;
}

}  // namespace

/// In the order in which a person reads them: what moves first, then what disturbs and shows it.
std::string dynamics(const model::Problem& problem, const Notation& notation) {
  const model::Method& method = *problem.method;
  if (!method.has_dynamics) return "";
  const Motion motion(notation);
  std::string text = motion.component(method.plant, "Plant");
  for (const model::Component& observer : method.observers)
    text += motion.component(
        observer, observer.name == "observer" ? "Observer" : "Observer " + observer.name);
  std::string events;
  for (const model::EventText& event : method.events) events += motion.event(event);
  std::string inputs;
  for (const model::Named& input : method.inputs)
    inputs += formula_row("", motion.defined(input.name, input.value));
  for (const model::MeasuredText& measured : method.measured)
    inputs += formula_row(
        "", name_mathml(measured.name, notation),
        "measured" +
            std::string(
                measured.series
                    ? ", " + count_of(measured.series->times.size(), "row") + " of " +
                          escaped(std::filesystem::path(measured.series->file).filename().string())
                    : ""));
  std::string noise;
  for (const model::NoiseText& drawn : method.noise) noise += motion.noise(drawn);
  for (const model::UncertainText& datum : problem.uncertain) {
    std::vector<std::string> values;
    for (const model::Value& end : datum.values) values.push_back(value_mathml(end, notation));
    noise += formula_row(
        "", equation(name_mathml(datum.name, notation), fenced(listed(values), "{", "}"), "∈"),
        "uncertain: " + drawn_text(datum.kind, datum.covariance));
  }
  std::string signals;
  for (const model::Named& signal : method.signals)
    signals += formula_row("", motion.defined(signal.name, signal.value));
  return text + group("Events", events) + group("Inputs", inputs) +
         group("Noise and uncertainty", noise) + group("Signals", signals);
}

std::string claimed(const model::Problem& problem, const Notation& notation) {
  if (!problem.method->has_dynamics) return "";
  const Motion motion(notation);
  std::string claims;
  for (const model::Claim& claim : problem.method->claims) claims += motion.claim(claim);
  std::string starts;
  for (const model::InitialValue& initial : problem.campaign.initial)
    starts += motion.start(initial);
  return group("Claims", claims) + group("Where runs start", starts) +
         group("Times between events", laws(problem.campaign, notation));
}

}  // namespace gainsmith::page
