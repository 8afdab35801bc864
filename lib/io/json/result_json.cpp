#include "io/json/result_json.h"

#include "base/version.h"
#include "io/json/json_reader.h"

namespace gainsmith::io {

Json result_json(const Json& report, const std::string& problem_file, const std::string& gains_hash,
                 double seconds) {
  Json document = {{"gainsmith", kVersion}};
  document.update(report);
  if (!problem_file.empty()) document["problem_file"] = problem_file;
  if (!gains_hash.empty()) document["gains_sha256"] = gains_hash;
  document["timings"] = {{"total", seconds}};
  return document;
}

RunResult parse_result(const std::string& text, const std::string& file) {
  const Json document = parse_json(text, file);
  const JsonReader reader(document, file, text);
  version_of(reader.at("gainsmith"));
  RunResult result;
  result.exit = reader.at("exit").whole();
  result.seconds = reader.at("timings").at("total").number();
  if (reader.has("problem_file")) result.problem_file = reader.at("problem_file").text();
  if (reader.has("gains_sha256")) result.gains_hash = reader.at("gains_sha256").text();
  if (reader.has("error")) {
    result.error = reader.at("error").text();
    return result;
  }
  if (reader.has("no_campaign")) result.no_campaign = reader.at("no_campaign").text();
  for (const JsonReader& difference : reader.at("differences").items())
    result.differences.push_back(difference.text());
  if (result.gains_hash.empty()) reader.at("gains_sha256");  // which says that it is missing
  return result;
}

}  // namespace gainsmith::io
