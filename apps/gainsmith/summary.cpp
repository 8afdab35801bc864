#include "gainsmith/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "gainsmith/search_text.h"
#include "sdp/solution.h"

namespace gainsmith::app {

namespace {

constexpr std::size_t kWide = 120;  // columns

/// "[1, 2; 3, 4]", or a row on each line where it is wide, the first in the column `at`.
std::string rows_text(const numbers::Matrix& matrix, std::size_t at) {
  std::string text = matrix_text(matrix);
  if (at + text.size() <= kWide) return text;
  const std::string between = ";\n" + std::string(at + 1, ' ');
  for (auto end = text.find("; "); end != std::string::npos; end = text.find("; ", end))
    text.replace(end, 2, between);
  return text;
}

/// "gains       L = [1; 2]", and what is an estimate.
std::string named_matrices(const std::string& title, const model::NamedMatrices& matrices,
                           const model::Gains& gains) {
  std::string text;
  for (const auto& [name, matrix] : matrices) {
    const auto estimate = gains.estimates.find(name);
    const std::string head = fmt::format("{:<12}{} = ", text.empty() ? title : "", name);
    text += fmt::format("{}{}{}\n", head,
                        gains.eigenvalues.contains(name) ? eigenvalues_text(matrix)
                                                         : rows_text(matrix, head.size()),
                        estimate == gains.estimates.end() ? "" : " (" + estimate->second + ")");
  }
  return text;
}

/// What the report asks for, and what of it has no value at these gains.
std::string report_text(const model::Gains& gains) {
  std::string text = named_matrices("report", gains.report, gains);
  for (const auto& [name, reason] : gains.not_computed)
    text +=
        fmt::format("{:<12}{} is not computed: {}\n", text.empty() ? "report" : "", name, reason);
  return text;
}

/// The scalars that a search found.
std::string searched_text(const model::Gains& gains) {
  if (gains.search && !gains.search->value) return "";
  std::string text;
  for (const auto& [name, value] : gains.searched)
    text += fmt::format("{:<12}{} = {}\n", text.empty() ? "searched" : "", name, brief(value, 10));
  return text;
}

/// "[1; 2] + [3; 4]*tau^2".
std::string polynomial_text(const model::GainFunction& gain) {
  std::string text;
  for (std::size_t k = 0; k < gain.coefficients.size(); ++k) {
    if (gain.coefficients[k].isZero(0)) continue;
    text += (text.empty() ? "" : " + ") + matrix_text(gain.coefficients[k]);
    if (k > 0) text += "*" + gain.variable + (k > 1 ? "^" + std::to_string(k) : "");
  }
  return text;
}

std::string functions_text(const model::Gains& gains) {
  std::string text;
  for (const model::GainFunction& gain : gains.gain_functions) {
    const bool polynomial = gain.kind == model::GainFunction::Kind::polynomial;
    text += fmt::format("{:<12}{}({}) = {}{}\n", text.empty() && gains.gains.empty() ? "gains" : "",
                        gain.name, gain.variable, polynomial ? polynomial_text(gain) : gain.formula,
                        polynomial ? "" : ", with the unknowns of the gain file");
  }
  return text;
}

/// A sum over several lines where one is too short.
std::string wrapped(const std::string& sum, std::size_t at) {
  std::string text, line;
  for (std::size_t from = 0; from < sum.size();) {
    const std::size_t end =
        std::min({sum.find(" + ", from + 1), sum.find(" - ", from + 1), sum.size()});
    const std::string term = sum.substr(from, end - from);
    if (!line.empty() && at + line.size() + term.size() > kWide) {
      text += line + "\n" + std::string(at, ' ');
      line.clear();
    }
    line += term;
    from = end;
  }
  return text + line;
}

/// The unknown functions, where the method asks for no gains.
std::string unknown_functions_text(const model::Gains& gains) {
  if (!gains.gains.empty() || !gains.gain_functions.empty() || gains.unknowns.empty()) return "";
  std::string text;
  for (const model::StatedFunction& function : gains.functions)
    if (const auto sum = with_values(function, gains)) {
      const std::string head =
          fmt::format("{:<12}{} = ", text.empty() ? "unknowns" : "", function.signature);
      text += head + wrapped(*sum, head.size()) + "\n";
    }
  if (!text.empty() || gains.sums_of_squares.empty()) return text;
  for (const auto& [name, value] : gains.unknowns)
    if (value.size() == 1)
      text += fmt::format("{:<12}{} = {}\n", text.empty() ? "unknowns" : "", name,
                          brief(value(0, 0), 10));
  return text;
}

std::string margins_text(const model::Gains& gains) {
  if (gains.margins.empty()) return "";
  std::size_t width = 10;
  for (const model::Margin& margin : gains.margins) width = std::max(width, margin.name.size());
  std::string text = fmt::format("{:<{}}  {:>12}  {:>10}  {:>12}  {}\n", "inequality", width,
                                 "margin", "asked", "eigenvalue", "worst at");
  for (const model::Margin& margin : gains.margins)
    text +=
        fmt::format("{:<{}}  {:>12}  {:>10}  {:>12}  {}{}\n", margin.name, width,
                    brief(margin.reached, 3), margin.strict ? brief(margin.required, 3) : ">= 0",
                    brief(margin.smallest_eigenvalue, 3), margin.worst_point,
                    margin.holds   ? ""
                    : margin.fails ? "  DOES NOT HOLD"
                                   : "  not shown");
  return text;
}

std::string bounds_text(const model::Gains& gains) {
  std::string text;
  for (const model::GainBound& bound : gains.bounds) {
    if (!bound.active) continue;
    const std::string reached = brief(bound.reached);
    const std::string allowed = brief(bound.bound);
    text += "gain bound  active on " + bound.what + ": ";
    if (bound.is_balanced)
      text += reached + " of the default " + allowed +
              ", in balanced units, not those of the file;\n"
              "            synthesis.gain_bound states a bound in the units of the file\n";
    else
      text += "its norm is at most " + reached + ", and " + allowed + " is allowed\n";
  }
  return text;
}

std::string certificate_text(const model::Gains& gains) {
  if (!gains.certificate) return "";
  const model::CertificateRecord& c = *gains.certificate;
  const std::string of = subject_of(c);
  if (c.exact && c.multipliers.empty() && !c.algebraic)
    return fmt::format("certificate in fractions: {}\n", model::shown_by(c));
  if (c.algebraic)
    return fmt::format("certificate {}, exact in fractions of {}:\n            {}\n",
                       to_string(*c.algebraic), of, model::shown_by(c));
  if (c.exact)
    return fmt::format(
        "certificate multipliers Y > 0, checked in {} digits on {}: an exact certificate lies "
        "near\n"
        "            them, so {}\n",
        c.digits, of, model::shown_by(c));
  return fmt::format(
      "certificate multipliers Y >= 0, checked in {} digits on {}:\n"
      "            {}\n",
      c.digits, of, model::shown_by(c));
}

/// Limits that somebody set are named; how else an iteration ended says nothing.
std::string undecided_because(const model::Gains& gains) {
  if (gains.search && !gains.search->value) return "nothing feasible was found";
  const std::string& cause = gains.solver.cause;
  for (const char* limit : {"iteration-limit", "interrupted"})
    if (cause == limit) return cause;
  return "neither a point that holds nor a certificate was found";
}

}  // namespace

std::string matrix_text(const numbers::Matrix& matrix) {
  if (matrix.size() == 1) return brief(matrix(0, 0));
  std::string text = "[";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (i > 0) text += "; ";
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += (j > 0 ? ", " : "") + brief(matrix(i, j));
  }
  return text + "]";
}

std::string eigenvalues_text(const numbers::Matrix& rows) {
  std::string text;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double imaginary = rows(i, 1);
    if (imaginary < 0) continue;  // said with the one before
    text += (text.empty() ? "" : ", ") + brief(rows(i, 0)) +
            (imaginary > 0 ? " +- " + brief(imaginary) + "i" : "");
  }
  return text;
}

/// Whether the lower bound is about gains within their bounds alone.
bool is_within_gain_bounds(const model::Gains& gains) {
  return std::ranges::any_of(gains.optimum_multipliers, [&](const auto& multiplier) {
    return std::ranges::none_of(gains.margins, [&](const model::Margin& margin) {
      return multiplier.first.starts_with(margin.name);
    });
  });
}

std::string objective_line(const model::Gains& gains) {
  if (!gains.objective) return "";
  std::string text = brief(*gains.objective, 10);
  if (gains.objective_lower_bound) {
    constexpr double kTells =
        0.1;  // of the objective: a wider bracket says little of its upper end
    const std::string optimum = is_within_gain_bounds(gains)
                                    ? "with the condition on the gains the optimum"
                                    : "the optimum";
    const std::string low = brief_below(*gains.objective_lower_bound, 10);
    const std::string high = brief_above(*gains.objective, 10);
    const double width = *gains.objective - *gains.objective_lower_bound;
    if (brief(*gains.objective_lower_bound, 10) == text)
      text += fmt::format("  ({} is this to all digits shown)", optimum);
    else if (width < kTells * std::abs(*gains.objective))
      text += fmt::format("  ({} is between {} and {})", optimum, low, high);
    else
      text += fmt::format("  ({} is at least {})", optimum, low);
  }
  return text;
}

std::string verdict_line(const model::Gains& gains) {
  std::string text = to_string(gains.verdict);
  if (gains.verdict == model::Verdict::no)
    text +=
        ", infeasible" + model::limits_of(gains.certificate.value()) + " by a checked certificate";
  if (gains.verdict == model::Verdict::undecided) text += ", " + undecided_because(gains);
  if (gains.objective && gains.verdict == model::Verdict::yes)
    text += ", objective " + brief(*gains.objective);
  return text;
}

std::string margins_note(const model::Gains& gains) {
  // A minimum lies on the boundary of its constraints: its margins are small.
  if (gains.objective_lower_bound) return "";
  std::string below;
  for (const model::Margin& margin : gains.margins) {
    if (margin.is_far_below()) return "";  // the message says so
    if (margin.is_below())
      below += fmt::format("{}{} {} of {}", below.empty() ? "" : ", ", margin.name,
                           brief(margin.reached, 2), brief(margin.required, 2));
  }
  if (below.empty()) return "";
  return "margins     less than asked for (" + below +
         ")"
         "\n            the check decides, which shows each inequality at the printed decimals\n";
}

std::string objective_text(const model::Gains& gains) {
  return gains.objective ? "objective   " + objective_line(gains) + "\n" : "";
}

/// What a yes is about where no decimals satisfy the equations.
std::string solution_line(const model::Gains& gains) {
  return gains.solution_within
             ? "solution    within " + brief(*gains.solution_within, 2) +
                   " of the unknowns as printed; no decimals satisfy the equations exactly\n"
             : "";
}

std::string message_lines(const model::Gains& gains) {
  return gains.solver.message.empty() ? "" : "            " + gains.solver.message + "\n";
}

/// A yes rests on the check of the point alone.
std::string solver_line(const model::Gains& gains) {
  const model::SolverRecord& solver = gains.solver;
  // Of nothing there is no optimum.
  const bool no_objective = solver.status == "optimal" && !gains.objective;
  const std::string ended =
      solver.cause == to_string(sdp::Cause::enough)
          ? fmt::format("solver: a strictly feasible point after {} iterations", solver.iterations)
          : fmt::format("solver: {}{}, {} iterations", no_objective ? "" : solver.status + ", ",
                        solver.cause, solver.iterations);
  const bool alone = gains.verdict == model::Verdict::yes && solver.status == "undecided";
  return alone ? "the point was checked and holds; " + ended : ended;
}

std::string synthesis_summary(const model::Gains& gains) {
  std::string text =
      fmt::format("problem     {}\nmethod      {}\nverdict     {} ({})\n", gains.problem_name,
                  gains.statement.method_name, to_string(gains.verdict), solver_line(gains));
  text += message_lines(gains);
  text += objective_text(gains) + solution_line(gains) +
          named_matrices("gains", gains.gains, gains) + functions_text(gains) +
          unknown_functions_text(gains) + report_text(gains) +
          named_matrices("parameters", gains.parameters, gains) + searched_text(gains) +
          search_text(gains);
  text += bounds_text(gains) + certificate_text(gains) + margins_text(gains) + margins_note(gains);
  return text;
}

}  // namespace gainsmith::app
