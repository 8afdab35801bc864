// Gain files. Each record has a writer *_json and a reader *_of; optional keys are written where
// there is something to say, and may be missing where they are read.
#include "io/json/gains_json.h"

#include <cmath>
#include <limits>
#include <utility>

#include "io/json/json_reader.h"
#include "io/json/statement_json.h"
#include "io/json/sums_of_squares_json.h"
#include "io/sources.h"

namespace gainsmith::io {

namespace {

/// Of the rules by which verdicts were shown. Files of another version are refused.
constexpr int kProofVersion = 1;

/// The rows of a matrix with the decimals of its key.
Json rows_json(const model::Gains& gains, const std::string& key, const numbers::Matrix& matrix) {
  if (!gains.decimals.contains(key)) return matrix_json(matrix);
  const model::Decimals decimals = decimals_at(gains, key, matrix);
  auto decimal = decimals.elements.begin();
  Json rows = Json::array();
  for (int i = 0; i < decimals.shape.rows; ++i) {
    rows.push_back(Json::array());
    for (int j = 0; j < decimals.shape.cols; ++j) rows.back().push_back(decimal_json(*decimal++));
  }
  return rows;
}

/// A number when the matrix is 1 x 1.
Json element_json(const model::Gains& gains, const std::string& key,
                  const numbers::Matrix& matrix) {
  const Json rows = rows_json(gains, key, matrix);
  return matrix.size() == 1 ? rows[0][0] : rows;
}

/// Matrices by their names; `key`: the key that they are under, for their decimals.
Json matrices_json(const model::Gains& gains, const std::string& key,
                   const model::NamedMatrices& matrices) {
  Json result = Json::object();
  for (const auto& [name, matrix] : matrices)
    result[name] = element_json(gains, key + "." + name, matrix);
  return result;
}

/// How the solver ended: status, cause and measures of its best point.
Json solver_json(const model::SolverRecord& solver) {
  return {{"status", solver.status},
          {"cause", solver.cause},
          {"message", solver.message},
          {"iterations", solver.iterations},
          {"relative_gap", solver.relative_gap},
          {"primal_infeasibility", solver.primal_infeasibility},
          {"dual_infeasibility", solver.dual_infeasibility},
          {"precision", solver.precision}};
}

/// One inequality at the decimals of the file; margins are relative, eigenvalues are not.
Json margin_json(const model::Margin& margin) {
  return {{"name", margin.name},
          {"strict", margin.strict},
          {"holds", margin.holds},
          {"reached", margin.reached},
          {"required", margin.required},
          {"smallest_eigenvalue", margin.smallest_eigenvalue},
          {"worst_point", margin.worst_point}};
}

/// A bound on a gain and what was reached; null where that is not finite.
Json bound_json(const model::GainBound& bound) {
  return {{"gain", bound.what},
          {"bound", bound.bound},
          {"reached", finite_or_null(bound.reached)},
          {"active", bound.active},
          {"balanced_units", bound.is_balanced}};
}

/// F(s) as its formula; a polynomial has the coefficients F_0, F_1, ... too.
Json gain_function_json(const model::Gains& gains, const model::GainFunction& gain) {
  Json result = {{"of", gain.variable}, {"kind", to_string(gain.kind)}, {"formula", gain.formula}};
  if (gain.kind != model::GainFunction::Kind::polynomial) return result;
  result["coefficients"] = Json::array();
  for (std::size_t k = 0; k < gain.coefficients.size(); ++k) {
    const std::string key = model::coefficient_key(gain.name, k);
    result["coefficients"].push_back(rows_json(gains, key, gain.coefficients[k]));
  }
  return result;
}

Json algebraic_json(const model::AlgebraicRecord& algebraic) {
  Json terms = Json::array();
  for (const auto& [block, vector, weight, step] : algebraic.terms) {
    terms.push_back({{"block", block}, {"vector", vector}, {"weight", weight}});
    if (step > 1) terms.back()["step"] = step;
  }
  Json result = {{"near", {algebraic.re, algebraic.im}},
                 {"polynomial", algebraic.polynomial},
                 {"terms", std::move(terms)}};
  if (!algebraic.of.empty()) result["of"] = algebraic.of;
  return result;
}

/// What shows that there is no solution: multipliers, terms at an algebraic number, or moments.
Json certificate_json(const model::Gains& gains, const std::string& key,
                      const model::CertificateRecord& certificate) {
  Json result = {
      {"exact", certificate.exact},
      {"shows", model::shown_by(certificate)},
      {"about", certificate.about},
      {"backward_error", certificate.backward_error},
      {"digits", certificate.digits},
      {"multipliers", matrices_json(gains, key + ".multipliers", certificate.multipliers)}};
  if (certificate.algebraic) result["algebraic"] = algebraic_json(*certificate.algebraic);
  if (!certificate.moments.empty()) result["moments"] = certificate.moments;
  return result;
}

/// What a search found. Keys of a kind of search alone are left out by the others.
Json search_json(const model::Gains& gains, const model::SearchRecord& search) {
  const auto number = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json result = {{"figure", search.figure},         {"value", number(search.value)},
                 {"beyond", number(search.beyond)}, {"open", search.open},
                 {"breaks", search.breaks},         {"over", search.over},
                 {"at_end", search.at_end},         {"evaluations", search.evaluations},
                 {"feasible", search.feasible},     {"finished", search.finished}};
  if (search.error) result["error"] = std::isfinite(*search.error) ? Json(*search.error) : Json();
  if (const auto& refinement = search.joint_refinement)
    result["joint_refinement"] = {{"before", refinement->before},
                                  {"after", number(refinement->after)},
                                  {"kept", refinement->kept},
                                  {"cause", refinement->cause}};
  if (search.certificate)
    result["certificate"] = certificate_json(gains, "search.certificate", *search.certificate);
  return result;
}

model::Verdict verdict_of(const JsonReader& reader) {
  for (const auto verdict : {model::Verdict::yes, model::Verdict::no, model::Verdict::undecided})
    if (to_string(verdict) == reader.text()) return verdict;
  reader.fail("expected yes, no or undecided");
}

model::SolverRecord solver_of(const JsonReader& reader) {
  return {reader.at("status").text(),
          reader.at("cause").text(),
          reader.at("message").text(),
          reader.at("iterations").whole(),
          reader.at("relative_gap").number(),
          reader.at("primal_infeasibility").number(),
          reader.at("dual_infeasibility").number(),
          reader.at("precision").text()};
}

/// A matrix; `gains` keeps its decimals when they are not those that would be printed.
numbers::Matrix matrix_of(const JsonReader& reader, model::Gains& gains) {
  numbers::Matrix matrix = reader.matrix();
  std::vector<std::string> decimals = reader.decimals();
  if (model::decimals_at({}, "", matrix).elements != decimals)
    gains.decimals[reader.path()] = std::move(decimals);
  return matrix;
}

model::NamedMatrices matrices_of(const JsonReader& reader, model::Gains& gains) {
  model::NamedMatrices result;
  for (const auto& [name, item] : reader.members())
    result.emplace_back(name, matrix_of(item, gains));
  return result;
}

model::GainFunction gain_function_of(const std::string& name, const JsonReader& reader,
                                     model::Gains& gains) {
  using Kind = model::GainFunction::Kind;
  model::GainFunction gain{
      name, reader.at("of").text(), Kind::formula, reader.at("formula").text(), {}};
  const JsonReader kind = reader.at("kind");
  for (const Kind candidate : {Kind::polynomial, Kind::vertices, Kind::formula}) {
    if (to_string(candidate) != kind.text()) continue;
    gain.kind = candidate;
    if (candidate == Kind::polynomial)
      for (const JsonReader& item : reader.at("coefficients").items())
        gain.coefficients.push_back(matrix_of(item, gains));
    return gain;
  }
  kind.fail("expected polynomial, vertices or formula");
}

model::Margin margin_of(const JsonReader& reader) {
  return {reader.at("name").text(""),
          reader.at("strict").truth(),
          reader.at("reached").number(),
          reader.at("required").number(),
          reader.at("smallest_eigenvalue").number(),
          reader.at("worst_point").text(),
          reader.at("holds").truth()};
}

/// All coefficients are fractions as texts; `step` is 1 where it is left out.
model::AlgebraicRecord algebraic_of(const JsonReader& reader) {
  const auto fractions = [](const JsonReader& list) {
    model::AlgebraicRecord::Fractions texts;
    for (const JsonReader& item : list.items()) texts.push_back(item.text());
    return texts;
  };
  const std::vector<JsonReader> near = reader.at("near").items();
  if (near.size() != 2) reader.at("near").fail("expected two numbers");
  model::AlgebraicRecord result{reader.has("of") ? reader.at("of").text() : "",
                                near[0].number(),
                                near[1].number(),
                                fractions(reader.at("polynomial")),
                                {}};
  for (const JsonReader& term : reader.at("terms").items()) {
    std::vector<model::AlgebraicRecord::Fractions> rows;
    for (const JsonReader& row : term.at("vector").items()) rows.push_back(fractions(row));
    result.terms.push_back({term.at("block").text(), std::move(rows), fractions(term.at("weight")),
                            term.has("step") ? term.at("step").whole() : 1});
  }
  return result;
}

/// `about` is the problem itself where it is left out.
model::CertificateRecord certificate_of(const JsonReader& reader, model::Gains& gains) {
  if (reader.has("shows")) (void)reader.at("shows").text();  // follows from the others
  model::CertificateRecord result{reader.at("exact").truth(), reader.at("backward_error").number(),
                                  reader.at("digits").whole(),
                                  matrices_of(reader.at("multipliers"), gains),
                                  reader.has("about") ? reader.at("about").text() : "problem"};
  if (reader.has("algebraic")) result.algebraic = algebraic_of(reader.at("algebraic"));
  if (reader.has("moments"))
    for (const JsonReader& list : reader.at("moments").items())
      for (auto& moments = result.moments.emplace_back();
           const auto& [monomial, value] : list.members())
        moments[monomial] = value.text("");
  return result;
}

model::SearchRecord search_of(const JsonReader& reader, model::Gains& gains) {
  const auto number = [](const JsonReader& value) {
    return value.is_null() ? std::nullopt : std::optional(value.number());
  };
  const auto numbers = [](const JsonReader& list) {
    std::vector<double> values;
    for (const JsonReader& item : list.items()) values.push_back(item.number());
    return values;
  };
  model::SearchRecord search;
  search.figure = reader.at("figure").text();
  search.value = number(reader.at("value"));
  if (reader.has("error"))
    search.error = number(reader.at("error")).value_or(std::numeric_limits<double>::infinity());
  search.beyond = number(reader.at("beyond"));
  search.open = numbers(reader.at("open"));
  search.breaks = numbers(reader.at("breaks"));
  for (const JsonReader& item : reader.at("over").items()) search.over.push_back(item.text());
  if (reader.has("at_end"))
    for (const JsonReader& item : reader.at("at_end").items()) search.at_end.push_back(item.text());
  search.evaluations = reader.at("evaluations").whole();
  search.feasible = reader.at("feasible").whole();
  search.finished = reader.at("finished").truth();
  if (reader.has("joint_refinement")) {
    const JsonReader refinement = reader.at("joint_refinement");
    search.joint_refinement = {refinement.at("before").number(), number(refinement.at("after")),
                               refinement.at("kept").truth(), refinement.at("cause").text()};
  }
  if (reader.has("certificate"))
    search.certificate = certificate_of(reader.at("certificate"), gains);
  return search;
}

}  // namespace

Json matrix_json(const numbers::Matrix& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The order of the keys is that of the file. Timings are last: gains_hash() leaves them out.
Json to_json(const model::Gains& gains) {
  Json document = {{"gainsmith", gains.version},
                   {"problem", gains.problem_name},
                   {"verdict", to_string(gains.verdict)},
                   {"status", gains.solver.status},
                   {"cause", gains.solver.cause}};
  if (gains.objective) document["objective"] = *gains.objective;
  if (gains.objective_lower_bound) document["objective_lower_bound"] = *gains.objective_lower_bound;
  if (gains.solution_within) document["solution_within"] = *gains.solution_within;
  document["gains"] = matrices_json(gains, "gains", gains.gains);
  if (!gains.gain_functions.empty()) {
    document["gain_functions"] = Json::object();
    for (const model::GainFunction& gain : gains.gain_functions)
      document["gain_functions"][gain.name] = gain_function_json(gains, gain);
  }
  document["unknowns"] = matrices_json(gains, "unknowns", gains.unknowns);
  if (!gains.functions.empty()) {
    document["functions"] = Json::object();
    for (const model::StatedFunction& function : gains.functions)
      document["functions"][function.signature] = function.text;
  }
  if (!gains.report.empty()) document["report"] = matrices_json(gains, "report", gains.report);
  for (const auto& [name, reason] : gains.not_computed) {
    document["report"][name] = nullptr;
    document["not_computed"][name] = reason;
  }
  if (!gains.estimates.empty()) document["estimates"] = gains.estimates;
  document["parameters"] = matrices_json(gains, "parameters", gains.parameters);
  if (!gains.bases.empty()) document["bases"] = matrices_json(gains, "bases", gains.bases);
  for (const auto& [name, value] : gains.searched)
    document["searched"][name] =
        element_json(gains, "searched." + name, numbers::Matrix::Constant(1, 1, value));
  if (gains.search) document["search"] = search_json(gains, *gains.search);
  document["margins"] = list_json(gains.margins, margin_json);
  document["bounds"] = list_json(gains.bounds, bound_json);
  if (gains.certificate)
    document["certificate"] = certificate_json(gains, "certificate", *gains.certificate);
  if (!gains.optimum_multipliers.empty())
    document["optimum"] = matrices_json(gains, "optimum", gains.optimum_multipliers);
  if (!gains.sums_of_squares.empty())
    document["sums_of_squares"] = list_json(gains.sums_of_squares, sum_of_squares_json);
  document["proof"] = {{"version", kProofVersion}, {"sha256", model::results_hash(gains)}};
  document["solver"] = solver_json(gains.solver);
  document["statement"] = statement_json(gains.statement);
  Json timings = Json::object();
  for (const auto& [name, seconds] : gains.timings) timings[name] = seconds;
  document["timings"] = timings;
  return document;
}

std::string gains_text(const model::Gains& gains) { return to_text(to_json(gains)); }

model::Gains parse_gains(const std::string& text, const std::string& file) {
  const Json document = parse_json(text, file);
  const JsonReader reader(document, file, text, gain_file_levels());
  model::Gains gains;
  gains.file = file;
  gains.version = version_of(reader.at("gainsmith"));
  gains.problem_name = reader.at("problem").text("");
  gains.verdict = verdict_of(reader.at("verdict"));
  if (reader.has("objective")) gains.objective = reader.at("objective").number();
  if (reader.has("objective_lower_bound"))
    gains.objective_lower_bound = reader.at("objective_lower_bound").number();
  if (reader.has("solution_within")) gains.solution_within = reader.at("solution_within").number();
  gains.gains = matrices_of(reader.at("gains"), gains);
  if (reader.has("gain_functions"))
    for (const auto& [name, item] : reader.at("gain_functions").members())
      gains.gain_functions.push_back(gain_function_of(name, item, gains));
  gains.unknowns = matrices_of(reader.at("unknowns"), gains);
  if (reader.has("functions"))
    for (const auto& [name, item] : reader.at("functions").members())
      gains.functions.push_back({name, item.text(), std::nullopt});
  if (reader.has("not_computed"))
    for (const auto& [name, item] : reader.at("not_computed").members())
      gains.not_computed[name] = item.text();
  if (reader.has("report"))
    for (const auto& [name, item] : reader.at("report").members())
      if (!item.is_null() || !gains.not_computed.contains(name))
        gains.report.emplace_back(name, matrix_of(item, gains));
  if (reader.has("estimates"))
    for (const auto& [name, item] : reader.at("estimates").members())
      gains.estimates[name] = item.text();
  gains.parameters = matrices_of(reader.at("parameters"), gains);
  if (reader.has("bases")) gains.bases = matrices_of(reader.at("bases"), gains);
  if (reader.has("searched"))
    for (const auto& [name, value] : reader.at("searched").members()) {
      gains.searched[name] = value.number();
      matrix_of(value, gains);
    }
  if (reader.has("search")) gains.search = search_of(reader.at("search"), gains);
  for (const JsonReader& item : reader.at("margins").items())
    gains.margins.push_back(margin_of(item));
  for (const JsonReader& item : reader.at("bounds").items())
    gains.bounds.push_back({item.at("gain").text(), item.at("bound").number(),
                            item.at("reached").number_or_infinity(), item.at("active").truth(),
                            item.has("balanced_units") && item.at("balanced_units").truth()});
  if (reader.has("certificate"))
    gains.certificate = certificate_of(reader.at("certificate"), gains);
  if (reader.has("optimum")) gains.optimum_multipliers = matrices_of(reader.at("optimum"), gains);
  if (reader.has("sums_of_squares"))
    for (const JsonReader& item : reader.at("sums_of_squares").items())
      gains.sums_of_squares.push_back(sum_of_squares_of(item));
  gains.solver = solver_of(reader.at("solver"));
  // Both are at the top for people, and in the record of the solver.
  for (const auto& [key, value] :
       {std::pair{"status", &gains.solver.status}, {"cause", &gains.solver.cause}})
    if (reader.has(key) && reader.at(key).text() != *value)
      reader.at(key).fail("differs from solver." + std::string(key));
  gains.statement = statement_of(reader.at("statement"));
  if (reader.has("proof")) {
    const JsonReader proof = reader.at("proof");
    if (proof.at("version").whole() != kProofVersion)
      proof.at("version").fail("another version of gainsmith wrote this proof");
    // The results are hashed beside the statement: a number that was edited is seen, and allowed.
    gains.is_edited = proof.at("sha256").text() != model::results_hash(gains);
  }
  for (const auto& [name, seconds] : reader.at("timings").members())
    gains.timings.emplace_back(name, seconds.number());
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
