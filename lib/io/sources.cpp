// Files by name. Of a problem they are read from the disk. Of a gain file the texts and matrices in
// it come first; what is on the disk beside it must have the same SHA-256.
#include "io/sources.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/file.h"
#include "base/hash.h"
#include "base/named.h"
#include "base/nearest.h"
#include "base/number.h"

namespace gainsmith::io {

namespace {

namespace fs = std::filesystem;

/// Bytes: 256 MiB. What is larger is hardly a file of data, and would be held in memory.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 28U;

/// "; did you mean 'B.csv'?"
std::string nearest_file(const fs::path& path) {
  constexpr std::size_t kMost = 1000;
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(path.has_parent_path() ? path.parent_path() : ".", error), end;
       !error && entry != end && names.size() < kMost; entry.increment(error))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  const auto near = nearest(path.filename().string(), names);
  return near ? "; did you mean '" + *near + "'?" : "";
}

}  // namespace

Sources::Sources(const std::string& problem_file) : folder_(fs::path(problem_file).parent_path()) {}

Sources::Sources(const std::string& gain_file, std::vector<model::StatedFile> stated)
    : folder_(fs::path(gain_file).parent_path()),
      gain_file_(gain_file),
      stated_(std::move(stated)) {}

std::string Sources::name_of(const std::string& path, const std::string& by) {
  return (fs::path(by).parent_path() / path).lexically_normal().generic_string();
}

std::string Sources::path_of(const std::string& name) const {
  return (folder_ / name).lexically_normal().string();
}

std::string Sources::shown(const std::string& name) const {
  return is_gain_file() ? gain_file_ + " (" + name + ")" : path_of(name);
}

std::string Sources::shown_option(const std::string& option) const {
  return is_gain_file() ? shown(option) : option;
}

model::StatedFile& Sources::noted(const std::string& name) {
  if (model::StatedFile* known = find_named(files_, name)) return *known;
  files_.push_back({name, {}, {}, {}});
  return files_.back();
}

const model::StatedFile* Sources::stated(const Reference& reference) const {
  const model::StatedFile* found = find_named(stated_, reference.name);
  if (found == nullptr) return nullptr;
  const std::string path = path_of(reference.name);
  std::error_code error;
  const std::uintmax_t size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
  // A file that is gone is no difference: the gain file has what was in it.
  const bool there = !error && fs::is_regular_file(path, error);
  if (there && (size > kLargestFile || sha256(read_text(path)) != found->sha256))
    throw InputError(reference.place,
                     reference.what + ": " + path +
                         " has changed since these gains were made (its SHA-256 is another): "
                         "synthesize again, or put the file back that it was");
  return found;
}

std::string Sources::read(const Reference& reference) {
  const std::string path = path_of(reference.name);
  const auto refuse = [&](const std::string& message) {
    throw InputError(reference.place, reference.what + ": " + message);
  };
  std::error_code error;
  if (!fs::exists(path, error))
    refuse("there is no file " + path +
           (is_gain_file() ? "; the data of a gain file's problem are expected beside itself: copy "
                             "them there, or take the problem instead"
                           : nearest_file(path)));
  if (!fs::is_regular_file(path, error))
    refuse(path + " is no ordinary file, but a folder, a device or a pipe");
  const std::uintmax_t size = fs::file_size(path, error);
  if (size > kLargestFile)
    refuse(path + " has " + std::to_string(size >> 20U) + " MB; a file of data may have " +
           std::to_string(kLargestFile >> 20U));
  std::string bytes = read_text(path);
  model::StatedFile& file = noted(reference.name);
  if (file.sha256.empty()) file.sha256 = sha256(bytes);
  return bytes;
}

std::string Sources::problem(const Reference& reference) {
  if (const model::StatedFile* known = stated(reference)) {
    model::StatedFile& file = noted(reference.name);
    file.sha256 = known->sha256;
    return file.text = known->text;
  }
  std::string text = read(reference);
  noted(reference.name).text = text;
  return text;
}

std::optional<std::string> Sources::method(const Reference& reference,
                                           std::optional<std::string> text) {
  if (const model::StatedFile* known = stated(reference)) text = known->text;
  if (!text) return {};
  model::StatedFile& file = noted(reference.name);
  file.sha256 = sha256(*text);
  file.text = *text;
  return text;
}

/// What the gain file states of it is compared, and then it is read.
std::string Sources::log(const Reference& reference) {
  stated(reference);
  return read(reference);
}

/// A matrix that the gain file holds has no positions: those were of the file that is not there.
FileMatrix Sources::matrix(
    const Reference& reference, const std::string& key,
    const std::function<FileMatrix(const std::string&, const std::string&)>& read_matrix) {
  const auto find_key = [&](const std::vector<model::StatedMatrix>& list) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.key == key; });
    return found == list.end() ? nullptr : &*found;
  };
  const model::StatedFile* known = stated(reference);
  const model::StatedMatrix* kept = known ? find_key(known->matrices) : nullptr;
  FileMatrix result;
  if (kept != nullptr) {
    noted(reference.name).sha256 = known->sha256;
    result.matrix = *kept;
  } else {
    result = read_matrix(read(reference), path_of(reference.name));
    result.matrix.key = key;
  }
  model::StatedFile& file = noted(reference.name);
  // A gain file has the matrix that is the whole file before those that have names.
  if (find_key(file.matrices) == nullptr)
    file.matrices.insert(key.empty() ? file.matrices.begin() : file.matrices.end(), result.matrix);
  return result;
}

void Sources::has_origin(const std::string& log, bool stated, const Place& place) {
  if (origins_.emplace(log, stated).first->second != stated)
    throw InputError(place, "`from` is said of " + log +
                                " in one place and not in another: its rows would be moved against "
                                "each other");
  for (const auto& [other, is_stated] : origins_)
    if (other != log && !(stated && is_stated))
      throw InputError(place, "the times of " + log + " and of " + other +
                                  " are dates or Unix times: `from` has to say of both when a run "
                                  "begins");
}

void Sources::takes_unit(const std::string& times, double unit, const Place& place) {
  const double before = units_.emplace(times, unit).first->second;
  if (before != unit)
    throw InputError(place, "scale: the times of " + times + " are in units of " + brief(unit) +
                                " s here, and of " + brief(before) +
                                " s elsewhere in this problem");
}

}  // namespace gainsmith::io
