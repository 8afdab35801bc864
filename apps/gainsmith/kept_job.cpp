#include "gainsmith/kept_job.h"

#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "gainsmith/part_file.h"
#include "gainsmith/results_folder.h"
#include "io/json/json_reader.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFingerprint = "fingerprint";
constexpr const char* kLine = "line";

std::vector<std::string> items_of(const io::JsonReader& reader) {
  std::vector<std::string> texts;
  for (const io::JsonReader& item : reader.items()) texts.push_back(item.text());
  return texts;
}

bool are_there(const fs::path& folder, const std::vector<const char*>& names) {
  std::error_code none;
  for (const char* name : names)
    if (!fs::exists(folder / name, none)) return false;
  return true;
}

JobResult job_from(const io::Json& document, const std::string& file) {
  const io::JsonReader reader(document, file);
  JobResult result;
  result.exit = static_cast<ExitCode>(reader.at("exit").whole());
  result.name = reader.at("folder").text();
  result.line = reader.at(kLine).text();
  result.causes = items_of(reader.at("causes"));
  result.differences = items_of(reader.at("differences"));
  result.gains_hash = reader.at("gains_sha256").text();
  result.fingerprint = reader.at(kFingerprint).text();
  result.seconds = reader.at("timings").at("total").number();
  result.report = document;
  for (const char* key :
       {"gainsmith", "problem_file", "gains_sha256", "timings", kFingerprint, kLine})
    result.report.erase(key);
  return result;
}

}  // namespace

std::string job_fingerprint(const model::Instance& instance, const JobOptions& options) {
  const auto number = [](const std::optional<std::uint64_t>& value) {
    return value ? io::Json(*value) : io::Json();
  };
  io::Json statement = begin_statement("problem");
  statement["problem"] = instance.design->statement.hash;
  statement["runs"] = number(options.runs);
  statement["seed"] = number(options.seed);
  if (options.strict) statement["strict"] = true;
  return sha256(io::to_text(statement));
}

io::Json with_fingerprint(io::Json document, const JobResult& result) {
  document[kFingerprint] = result.fingerprint;
  document[kLine] = result.line;
  return document;
}

std::optional<JobResult> kept_job(const fs::path& folder, const std::string& name,
                                  const std::string& fingerprint) {
  const fs::path file = folder / "result.json";
  std::error_code none;
  if (!fs::exists(file, none)) return std::nullopt;
  try {
    const io::Json document = io::parse_json(read_text(file), file.string());
    if (!document.is_object() || document.value(kFingerprint, "") != fingerprint)
      return std::nullopt;
    JobResult result = job_from(document, file.string());
    if (result.name != name || !are_there(folder, {"gains.json", "summary.txt"}))
      return std::nullopt;
    if (!document.at("campaign").is_null() &&
        !are_there(folder, {"campaign.json", "worst-run.svg"}))
      return std::nullopt;
    if (read_folder(folder, name).changed) return std::nullopt;
    result.kept = true;
    return result;
  } catch (const InputError&) {
    return std::nullopt;  // a file was cut
  }
}

}  // namespace gainsmith::app
