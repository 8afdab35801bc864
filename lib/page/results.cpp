// The sections of one problem, in their order on the page: verdict, gains, margins, certificate,
// campaign, pictures, problem, provenance.
#include "page/results.h"

#include <algorithm>

#include "base/number.h"
#include "drawing/text.h"
#include "model/stated_file.h"
#include "page/element.h"
#include "page/mathml.h"
#include "page/motion.h"
#include "page/rows.h"
#include "page/squares.h"
#include "page/statement.h"
#include "page/symbol.h"

namespace gainsmith::page {

namespace {

using drawing::escaped;

std::string paragraph(const std::string& text, std::string_view attributes = {}) {
  return text.empty() ? "" : text_element("p", text, attributes) + "\n";
}

/// What a yes rests on: sums of squares, or bounds of every inequality at the unknowns.
std::string proof_of_yes(const model::Gains& gains) {
  if (gains.margins.empty())
    return "The problem has no inequalities: its gains are formulas, evaluated in double "
           "precision.";
  const std::string about =
      gains.solution_within
          ? "a solution within " + brief(*gains.solution_within, 2) + " of the unknowns"
          : "the decimals of the unknowns";
  if (!gains.sums_of_squares.empty())
    return "This yes is a proof for " + about +
           " in the gain file. Every inequality is a sum of squares: an identity in fractions, "
           "which "
           "the gain file has, and which anybody can expand. So it does not trust the solver. The "
           "page shows what the gain file says; it proves nothing again.";
  return "This yes is a proof for " + about +
         " in the gain file; the gains are computed from the unknowns. Every inequality was "
         "evaluated again from its text, with bounds for the "
         "errors "
         "of decimals, functions and sums, for all values of its variables. So it does not trust "
         "the "
         "solver. It trusts the compiler, the processor, and the code of the check, which shares "
         "nothing with the solver. The page shows what the gain file says; it proves nothing "
         "again.";
}

/// What a no rests on: moments, an algebraic certificate in fractions, or multipliers.
std::string proof_of_no(const model::Gains& gains) {
  if (!gains.certificate) return "";
  const model::CertificateRecord& certificate = *gains.certificate;
  std::string text;
  if (!certificate.is_about_problem())
    text = "This no is about a condition that is only sufficient for the inequalities, " +
           subject_of(certificate) + ": the inequalities themselves may have a solution. ";
  if (certificate.is_about_squares())
    return text + "It rests on " +
           (certificate.moments.empty() ? "one coefficient of an inequality" : "moments") +
           ", in fractions of the decimals of the problem file, without the solver.";
  text += certificate.algebraic
              ? "It rests on " + to_string(*certificate.algebraic) +
                    ", checked in fractions on the decimals of the problem file."
              : "It rests on multipliers for the inequalities below. They were checked in " +
                    std::to_string(certificate.digits) +
                    " digits on the decimals of the problem file, without the solver.";
  return text + " They show that " + model::shown_by(certificate) + ".";
}

std::string rests_on(const model::Gains& gains) {
  switch (gains.verdict) {
    case model::Verdict::yes:
      return proof_of_yes(gains);
    case model::Verdict::no:
      return proof_of_no(gains);
    case model::Verdict::undecided:
      return "Neither is shown: that gains exist, or that none do. The numbers below are not "
             "proved.";
  }
  return "";
}

/// Which of the reported values are no bounds.
std::string estimates_text(const model::Gains& gains) {
  std::string names;
  for (const auto& [name, kind] : gains.estimates)
    names += (names.empty() ? "" : ", ") + name + " (" + kind + ")";
  if (names.empty()) return "";
  return "Maxima over boxes were found by a search and are estimates, no proof: " + names + ".";
}

/// The verdict, its reasons, a warning for an edited file, and differences from what is expected.
std::string verdict_section(const Results& results) {
  const model::Gains& gains = results.gains;
  std::string text = text_element("p", results.verdict_line,
                                  "class=\"verdict " + to_string(gains.verdict) + "\"") +
                     "\n";
  if (results.changed)
    text += paragraph(
        "The gain file is not the one that was run: verdict, margins and campaign may be those of "
        "other numbers.",
        "class=\"warning\"");
  text += paragraph(rests_on(gains)) + paragraph(estimates_text(gains));
  text += paragraph(gains.solver.message);
  if (results.expects && results.differences.empty())
    text += paragraph("All is as the problem expects.");
  if (!results.differences.empty()) {
    std::string list;
    for (const std::string& difference : results.differences)
      list += text_element("li", difference);
    text += paragraph("Not as the problem expects:", "class=\"warning\"") + element("ul", list);
  }
  return section("Verdict", text);
}

/// Reports whose expression is eig(...): "poles: eig(A - L*C)".
bool is_eigenvalues(const Results& results, const std::string& name) {
  if (!results.problem) return results.gains.eigenvalues.contains(name);
  for (const auto* list : {&results.problem->method->report, &results.problem->report})
    for (const model::Named& named : *list)
      if (named.name == name && named.value.root) return named.value.root->text == "eig";
  return false;
}

/// F(s) = F_0 + F_1 s + F_2 s^2 + ..., without the matrices that are 0; a formula as its text.
std::string function_row(const model::GainFunction& gain) {
  std::string sum;
  for (std::size_t k = 0; k < gain.coefficients.size(); ++k) {
    if (gain.coefficients[k].isZero(0)) continue;
    std::string term = matrix(gain.coefficients[k]);
    if (k == 1) term += symbol(gain.variable);
    if (k > 1) term += element("msup", symbol(gain.variable) + number(std::to_string(k)));
    sum += (sum.empty() ? "" : mo("+")) + term;
  }
  const std::string left = row(symbol(gain.name) + fenced(symbol(gain.variable)));
  if (gain.kind == model::GainFunction::Kind::polynomial)
    return formula_row("", equation(left, sum.empty() ? "<mn>0</mn>" : row(sum)));
  return formula_row("", left,
                     text_element("code", gain.formula) + " with the unknowns of the gain file");
}

/// Matrices by their names; eigenvalues, n x 2, as complex numbers.
std::string matrices(const Results& results, const model::NamedMatrices& named) {
  std::string rows;
  for (const auto& [name, value] : named) {
    const auto estimate = results.gains.estimates.find(name);
    const bool poles = value.cols() == 2 && is_eigenvalues(results, name);
    // A name with a space is a sentence beside the formula, not its left side.
    const bool says = poles || name.find(' ') != std::string::npos;  // it is no symbol
    const std::string right = poles ? eigenvalues(value) : matrix(value);
    rows += formula_row(says ? name : "", says ? right : equation(symbol(name), right),
                        estimate == results.gains.estimates.end() ? "" : escaped(estimate->second));
  }
  return rows;
}

/// Gains first, then what the search found, functions, reports, and the unknowns folded.
std::string gains_section(const Results& results, const Notation& notation) {
  const model::Gains& gains = results.gains;
  std::string functions;
  for (const model::GainFunction& function : gains.gain_functions)
    functions += function_row(function);
  std::string searched;
  for (const auto& [name, found] : gains.searched)
    searched += formula_row("", equation(symbol(name), value(found)));
  const std::string search = results.search_lines.empty() ? "" : preformatted(results.search_lines);
  return section(
      "Gains",
      matrices(results, gains.gains) + functions +
          paragraph(results.objective_line.empty() ? "" : "Objective: " + results.objective_line) +
          group("Found by the search", searched + search) +
          group("Unknown functions", unknown_functions(gains, notation)) +
          group("Poles and other values", matrices(results, gains.report)) +
          folded("Unknowns", matrices(results, gains.unknowns)));
}

std::string cells(std::initializer_list<std::string> texts) {
  std::string line;
  for (const std::string& text : texts) line += text_element("td", text);
  return line;
}

/// Margins as a table, with those of gain bounds, and the sums of squares.
std::string margins_section(const Results& results, const Notation& notation) {
  const model::Gains& gains = results.gains;
  if (gains.margins.empty() && gains.bounds.empty()) return "";
  std::string lines;
  for (const model::Margin& margin : gains.margins)
    lines += element(
        "tr",
        cells({margin.name, margin.holds ? "holds" : "does not hold", brief(margin.reached, 3),
               margin.strict ? brief(margin.required, 3) : "\u2265 0",
               brief(margin.smallest_eigenvalue, 3), margin.worst_point}),
        margin.holds ? "" : "class=\"bad\"");
  std::string text;
  if (!lines.empty())
    text = paragraph(
               "A margin is the smallest eigenvalue after scaling the diagonal to 1: from 0 to 1, "
               "the same in all units, at the worst point.") +
           headed_table({"inequality", "", "margin", "asked", "eigenvalue", "worst at"}, lines);
  std::string bounds;
  for (const model::GainBound& bound : gains.bounds)
    bounds += element(
        "tr", cells({bound.what, brief(bound.reached), brief(bound.bound),
                     bound.active ? "active" : "", bound.is_balanced ? "balanced units" : ""}));
  if (!bounds.empty()) text += headed_table({"bound on", "reached", "allowed", "", ""}, bounds);
  if (gains.verdict == model::Verdict::yes && gains.objective)
    text += paragraph("Which requirements limit the optimum, and what each of them costs:") +
            preformatted("gainsmith explain " + model::problem_words(gains.statement.problem_file,
                                                                     gains.statement.settings));
  return section("Margins", text + squares(gains, notation));
}

/// The requirement that a multiplier "flow at tau = 0.7" or "bounds.2" belongs to.
const model::Requirement* requirement_of(const model::Problem& problem, const std::string& name) {
  // Of "flow at tau = 0.7" the part before " at ".
  const std::string base = name.substr(0, name.find(" at "));
  for (const model::Requirement& requirement : problem.method->require)
    if (requirement.name == base || base.starts_with(requirement.name + ".")) return &requirement;
  return nullptr;
}

/// Each inequality that has a multiplier once; only its name where the problem is not readable.
std::string conflict_rows(const Results& results, const Notation& notation,
                          const model::NamedMatrices& multipliers) {
  std::string rows;
  std::vector<const model::Requirement*> shown;
  for (const auto& [name, matrix] : multipliers) {
    const model::Requirement* requirement =
        results.problem ? requirement_of(*results.problem, name) : nullptr;
    if (requirement == nullptr) {
      rows += formula_row(name, "");
    } else if (std::find(shown.begin(), shown.end(), requirement) == shown.end()) {
      shown.push_back(requirement);
      rows += formula_row(requirement->name, inequality_mathml(requirement->that, notation),
                          holds_for(*requirement, notation));
    }
  }
  return rows;
}

std::string certificate_part(const Results& results, const Notation& notation,
                             const model::CertificateRecord& certificate) {
  std::string multipliers;
  for (const auto& [name, value] : certificate.multipliers)
    multipliers += formula_row(name, matrix(value));
  return group("Inequalities in conflict",
               conflict_rows(results, notation, certificate.multipliers)) +
         folded("Multipliers", multipliers);
}

/// The certificate of a no, and that of the value beyond the best one of a search.
std::string certificate_section(const Results& results, const Notation& notation) {
  const model::Gains& gains = results.gains;
  std::string text;
  if (gains.certificate)
    text +=
        certificate_part(results, notation, *gains.certificate) +
        paragraph(
            "gainsmith explain says which of them conflict, and how far each would have to give.");
  if (gains.search && gains.search->certificate && gains.search->beyond)
    text += paragraph("Beyond the value found, at " + brief(*gains.search->beyond, 9) +
                      ", the problem is infeasible by a checked certificate.") +
            certificate_part(results, notation, *gains.search->certificate);
  return section("Certificate", text);
}

/// A text folded under its title.
std::string text_of_file(std::string_view title, const std::string& text) {
  constexpr std::size_t kMost = 50'000;  // bytes: longer ones are matrices, which nobody reads
  if (text.empty()) return "";
  return folded(title, text.size() <= kMost
                           ? preformatted(text)
                           : paragraph(count_of(text.size(), "byte") + ", in the gain file."));
}

/// The mathematics of the problem with its texts folded below; the texts alone where these cannot
/// be read.
std::string problem_section(const Results& results, const Notation& notation) {
  const model::Statement& statement = results.gains.statement;
  const std::string source = text_of_file("Problem file", statement.problem_text) +
                             text_of_file("Method file", statement.method_text);
  if (!results.problem)
    return section("Problem", paragraph("Its mathematics is not shown: " + results.unreadable,
                                        "class=\"warning\"") +
                                  source);
  const model::Problem& problem = *results.problem;
  const model::Method& method = *problem.method;
  std::string text = paragraph(method.summary);
  if (!method.source.empty()) text += paragraph(method.source, "class=\"remark\"");
  text += given(problem, results.gains, notation) + wanted(problem, notation) +
          dynamics(problem, notation) + claimed(problem, notation);
  return section("Problem", text + source);
}

/// Versions, hashes, precision and times: what is needed to repeat the result.
std::string provenance_section(const Results& results) {
  const model::Gains& gains = results.gains;
  std::string lines;
  const auto add = [&](const std::string& what, const std::string& value) {
    if (!value.empty())
      lines += element("tr", text_element("th", what) + element("td", text_element("code", value)));
  };
  add("gainsmith", gains.version);
  add("problem file", gains.statement.problem_file);
  add("method", gains.statement.method_name);
  add("SHA-256 of both texts", gains.statement.hash);
  for (const auto& [name, hash] : results.files) add("SHA-256 of " + name, hash);
  add("how it ended", results.solver_line);
  add("precision", gains.solver.precision);
  for (const auto& [what, seconds] : gains.timings) add(what + " time", brief(seconds, 3) + " s");
  if (results.seconds) add("time of all", brief(*results.seconds, 3) + " s");
  return section("Provenance", element("table", element("tbody", lines)));
}

/// The picture of a run, or a sentence where it was left out.
std::string picture_of(const Results& results) {
  if (results.picture.empty())
    return results.picture_title.empty()
               ? ""
               : paragraph(results.picture_title +
                           ": the picture is left out, as this page would be too "
                           "large. The report of this problem alone has it.");
  return element("figure", element("div", results.picture, "class=\"picture\"") +
                               text_element("figcaption", results.picture_title)) +
         "\n";
}

std::string figures_section(const Results& results) {
  return results.figures.empty() ? "" : section("Figures", figures_of(results.figures));
}

}  // namespace

std::string figures_of(const std::vector<SystemFigure>& figures) {
  std::string text;
  for (const SystemFigure& figure : figures) {
    text += text_element("h4", figure.title);
    if (!figure.svg.empty())
      text += element("figure", element("div", figure.svg, "class=\"picture\""));
    for (const std::string& fact : figure.facts) text += paragraph(fact);
    text += "\n";
  }
  return text;
}

std::string sections(const Results& results) {
  std::string failed;
  if (!results.error.empty())
    failed = section("No result", preformatted(results.error, "class=\"verdict no\""));
  if (results.gains.version.empty()) return failed;  // nor gains
  const Notation notation = results.problem ? notation_of(*results.problem) : Notation{};
  return failed + verdict_section(results) + gains_section(results, notation) +
         margins_section(results, notation) + certificate_section(results, notation) +
         campaign_section(results) + picture_of(results) + figures_section(results) +
         problem_section(results, notation) + provenance_section(results);
}

}  // namespace gainsmith::page
