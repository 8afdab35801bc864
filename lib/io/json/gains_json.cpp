// Gain files. Optional keys are written where there is something to say, and may be missing where
// they are read.
#include "io/json/gains_json.h"

#include <array>
#include <tuple>

#include "io/json/json_fields.h"
#include "io/json/statement_json.h"
#include "io/sources.h"

namespace gainsmith::io {

template <>
inline constexpr auto kWords<model::GainFunction::Kind> =
    std::array{model::GainFunction::Kind::polynomial, model::GainFunction::Kind::vertices,
               model::GainFunction::Kind::formula};

namespace {

/// Of the rules by which verdicts were shown. Files of another version are refused.
constexpr int kProofVersion = 1;

/// How the solver ended: status, cause and measures of its best point.
constexpr auto kSolverFields = [](auto& at, auto& solver) {
  at("status", solver.status);
  at("cause", solver.cause);
  at("message", solver.message);
  at("iterations", solver.iterations);
  at("relative_gap", solver.relative_gap);
  at("primal_infeasibility", solver.primal_infeasibility);
  at("dual_infeasibility", solver.dual_infeasibility);
  at("precision", solver.precision);
};

/// One inequality at the decimals of the file; margins are relative, eigenvalues are not.
constexpr auto kMarginFields = [](auto& at, auto& margin) {
  at.name("name", margin.name);
  at("strict", margin.strict);
  at("holds", margin.holds);
  at("reached", margin.reached);
  at("required", margin.required);
  at("smallest_eigenvalue", margin.smallest_eigenvalue);
  at("worst_point", margin.worst_point);
};

/// A bound on a gain and what was reached; null where that is not finite.
constexpr auto kBoundFields = [](auto& at, auto& bound) {
  at("gain", bound.what);
  at("bound", bound.bound);
  at.with(JsonNumbers::or_null, [&] { at("reached", bound.reached); });
  at("active", bound.active);
  at.loose("balanced_units", bound.is_balanced);
};

/// F(s) as its formula; a polynomial has the coefficients F_0, F_1, ... too.
constexpr auto kGainFunctionFields = [](auto& at, auto& gain) {
  at("of", gain.variable);
  at("kind", gain.kind);
  at("formula", gain.formula);
  if (gain.kind == model::GainFunction::Kind::polynomial) at("coefficients", gain.coefficients);
};

constexpr auto kTermFields = [](auto& at, auto& term) {
  at("block", term.block);
  at("vector", term.vector);
  at("weight", term.weight);
  at.some_but("step", term.step, 1);
};

/// All coefficients are fractions as texts.
constexpr auto kAlgebraicFields = [](auto& at, auto& algebraic) {
  std::array<double, 2> near{algebraic.re, algebraic.im};
  at("near", near);
  if constexpr (kReads<decltype(at)>)
    std::tie(algebraic.re, algebraic.im) = std::tie(near[0], near[1]);
  at("polynomial", algebraic.polynomial);
  at("terms", algebraic.terms, kTermFields);
  at.some("of", algebraic.of);
};

/// What shows that there is no solution: multipliers, terms at an algebraic number, or moments.
constexpr auto kCertificateFields = [](auto& at, auto& certificate) {
  at("exact", certificate.exact);
  std::string shows = model::shown_by(certificate);
  at.loose("shows", shows);  // follows from the others
  at.loose("about", certificate.about);
  at("backward_error", certificate.backward_error);
  at("digits", certificate.digits);
  at("multipliers", certificate.multipliers);
  at.some("algebraic", certificate.algebraic, kAlgebraicFields);
  at.some("moments", certificate.moments);
};

constexpr auto kRefinementFields = [](auto& at, auto& refinement) {
  at("before", refinement.before);
  at("after", refinement.after);
  at("kept", refinement.kept);
  at("cause", refinement.cause);
};

/// What a search found. Keys of a kind of search alone are left out by the others.
constexpr auto kSearchFields = [](auto& at, auto& search) {
  at("figure", search.figure);
  at("value", search.value);
  at("beyond", search.beyond);
  at("open", search.open);
  at("breaks", search.breaks);
  at("over", search.over);
  at.loose("at_end", search.at_end);
  at("evaluations", search.evaluations);
  at("feasible", search.feasible);
  at("finished", search.finished);
  at.with(JsonNumbers::or_null, [&] { at.some("error", search.error); });
  at.some("joint_refinement", search.joint_refinement, kRefinementFields);
  at.some("certificate", search.certificate, kCertificateFields);
};

constexpr auto kSquareFields = [](auto& at, auto& square) {
  at("times", square.times);
  at.name("basis", square.basis);
  at.name("gram", square.gram);
};

constexpr auto kFreeFields = [](auto& at, auto& free) {
  at("times", free.times);
  at.name("polynomial", free.polynomial);
};

/// The identity of an inequality M(x) >= 0
///   row' M(x) row = sum over squares of g_k(x) z' Q z + sum over free terms of h_k(x) t         (1)
/// with g_k >= 0 and h_k = 0 under `where`, g_0 = 1, and k the `times` of the term. `basis` is z,
/// `gram` the lower triangle of Q by rows, `polynomial` t. All numbers are fractions, as texts.
constexpr auto kSumOfSquaresFields = [](auto& at, auto& sum) {
  at.name("name", sum.name);
  at.name("variables", sum.variables);
  at("squares", sum.squares, kSquareFields);
  at.some("free", sum.free, kFreeFields);
};

/// A report that has no value is null, and `not_computed` says why.
void report_fields(FieldWriter& at, const model::Gains& gains) {
  at.some("report", gains.report);
  for (const auto& [name, reason] : gains.not_computed) {
    at.object()["report"][name] = nullptr;
    at.object()["not_computed"][name] = reason;
  }
}

void report_fields(FieldReader& at, model::Gains& gains) {
  at.some("not_computed", gains.not_computed);
  if (!at.has("report")) return;
  for (const auto& [name, item] : at.reader().at("report").members())
    if (!item.is_null() || !gains.not_computed.contains(name))
      gains.report.emplace_back(name, matrix_of(item, &gains));
}

/// Scalars that keep their decimals.
void searched_fields(FieldWriter& at, const model::Gains& gains) {
  model::NamedMatrices searched;
  for (const auto& [name, value] : gains.searched)
    searched.emplace_back(name, numbers::Matrix::Constant(1, 1, value));
  at.some("searched", searched);
}

void searched_fields(FieldReader& at, model::Gains& gains) {
  at.some("searched", gains.searched);
  if (!gains.searched.empty())
    for (const auto& [name, value] : at.reader().at("searched").members()) matrix_of(value, &gains);
}

struct Proof {
  int version = kProofVersion;
  std::string sha256;
};

constexpr auto kProofFields = [](auto& at, auto& proof) {
  at("version", proof.version);
  at("sha256", proof.sha256);
};

/// Timings are last: gains_hash() leaves them out.
constexpr auto kGainsFields = [](auto& at, auto& gains) {
  at("gainsmith", gains.version);
  at.name("problem", gains.problem_name);
  at("verdict", gains.verdict);
  // Both are at the top for people, and in the record of the solver.
  std::string status = gains.solver.status, cause = gains.solver.cause;
  at.loose("status", status);
  at.loose("cause", cause);
  at.some("objective", gains.objective);
  at.some("objective_lower_bound", gains.objective_lower_bound);
  at.some("solution_within", gains.solution_within);
  at("gains", gains.gains);
  at.by_name("gain_functions", gains.gain_functions, &model::GainFunction::name,
             kGainFunctionFields);
  at("unknowns", gains.unknowns);
  at.by_name("functions", gains.functions, &model::StatedFunction::signature,
             &model::StatedFunction::text);
  report_fields(at, gains);
  at.some("estimates", gains.estimates);
  at("parameters", gains.parameters);
  at.some("bases", gains.bases);
  searched_fields(at, gains);
  at.some("search", gains.search, kSearchFields);
  at("margins", gains.margins, kMarginFields);
  at("bounds", gains.bounds, kBoundFields);
  at.some("certificate", gains.certificate, kCertificateFields);
  at.some("optimum", gains.optimum_multipliers);
  at.some("sums_of_squares", gains.sums_of_squares, kSumOfSquaresFields);
  Proof proof;
  if constexpr (!kReads<decltype(at)>) proof.sha256 = model::results_hash(gains);
  at.loose("proof", proof, kProofFields);
  at("solver", gains.solver, kSolverFields);
  at.as("statement", gains.statement, statement_json, statement_of);
  at("timings", gains.timings);
  if constexpr (kReads<decltype(at)>) {
    for (const auto& [key, text, same] : {std::tuple{"status", &status, &gains.solver.status},
                                          {"cause", &cause, &gains.solver.cause}})
      if (at.has(key) && *text != *same)
        at.reader().at(key).fail("differs from solver." + std::string(key));
    if (proof.version != kProofVersion)
      at.reader().at("proof").at("version").fail("another version of gainsmith wrote this proof");
    // The results are hashed beside the statement: a number that was edited is seen, and allowed.
    gains.is_edited = !proof.sha256.empty() && proof.sha256 != model::results_hash(gains);
  }
};

}  // namespace

Json matrix_json(const numbers::Matrix& matrix, const std::string& path,
                 const model::Gains* gains) {
  const bool other = gains != nullptr && gains->decimals.contains(path);
  std::vector<std::string> decimals;
  if (other) decimals = decimals_at(*gains, path, matrix).elements;
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      row.push_back(other ? decimal_json(decimals[static_cast<std::size_t>(i * matrix.cols() + j)])
                          : Json(matrix(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json matrix_json(const numbers::Matrix& matrix) { return matrix_json(matrix, "", nullptr); }

numbers::Matrix matrix_of(const JsonReader& reader, model::Gains* gains) {
  numbers::Matrix matrix = reader.matrix();
  if (gains == nullptr) return matrix;
  std::vector<std::string> decimals = reader.decimals();
  if (model::decimals_at({}, "", matrix).elements != decimals)
    gains->decimals[reader.path()] = std::move(decimals);
  return matrix;
}

Json to_json(const model::Gains& gains) {
  return FieldWriter(JsonNumbers::finite, &gains).json(gains, "", kGainsFields);
}

std::string gains_text(const model::Gains& gains) { return to_text(to_json(gains)); }

model::Gains parse_gains(const std::string& text, const std::string& file) {
  const Json document = parse_json(text, file);
  const JsonReader reader(document, file, text, gain_file_levels());
  version_of(reader.at("gainsmith"));
  model::Gains gains;
  gains.file = file;
  FieldReader(reader, JsonNumbers::finite, &gains).take(reader, gains, kGainsFields);
  reader.finish();
  return gains;
}

model::Problem stated_problem(const model::Gains& gains, const std::string& file) {
  const model::Statement& statement = gains.statement;
  // The only method that this statement may name is the one whose text it holds.
  const MethodLibrary library{
      [&](const std::string& name) {
        return name == statement.method_name ? std::optional(statement.method_text) : std::nullopt;
      },
      {statement.method_name}};
  Sources sources(file, statement.files);
  return parse_problem(statement.problem_text, sources.shown(statement.problem_file), library,
                       statement.settings, sources);
}

}  // namespace gainsmith::io
