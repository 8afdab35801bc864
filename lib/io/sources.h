// Internal to io: the files that a problem names, on the disk or as a gain file states them. What
// was read is noted, with its SHA-256.
//
// A gain file states the problems that its own is `like`, and the matrices of files: it needs these
// files no more. Logs are too large for that. They are expected beside it, where the problem's
// paths lead from its folder. A file that is there must be the one that was read.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/matrix/file_matrix.h"
#include "model/stated_file.h"

namespace gainsmith::io {

/// A file as a problem names it.
struct Reference {
  std::string name;  ///< its path, from the folder of the problem on (Sources::name_of)
  std::string what;  ///< the key that names it, for messages
  Place place;
};

class Sources {
 public:
  /// Of a problem file.
  explicit Sources(const std::string& problem_file);
  /// Of the problem that a gain file states.
  Sources(const std::string& gain_file, std::vector<model::StatedFile> stated);

  /// The name of the file that `path` is in the file with the name `by`; the problem itself has
  /// none.
  static std::string name_of(const std::string& path, const std::string& by);
  /// Where it is on the disk.
  std::string path_of(const std::string& name) const;
  /// A file in messages: its path, or "gains.json (A.csv)".
  std::string shown(const std::string& name) const;

  /// A text of the command line in messages: itself, or "gains.json (--set T2)".
  std::string shown_option(const std::string& option) const;

  // All throw InputError for a file that is not there (with the nearest name of its folder), is no
  // ordinary file or too large, or is another one than the gain file was made with.

  /// A problem that another one is `like`.
  std::string problem(const Reference& reference);
  /// The text of a method of the program that the problem's method is `like`: as a gain file states
  /// it, otherwise `text`; none where there is neither.
  std::optional<std::string> method(const Reference& reference, std::optional<std::string> text);
  /// A log. A gain file does not hold it.
  std::string log(const Reference& reference);
  /// A matrix; `key` says which of the file, `read` makes it of its bytes and its path.
  FileMatrix matrix(const Reference& reference, const std::string& key,
                    const std::function<FileMatrix(const std::string&, const std::string&)>& read);

  /// Notes where the time of a log is 0: where a problem says (`stated`), or at its first row
  /// although nothing says so. InputError at `place` when another log begins by itself, or this one
  /// does beside another or does in one place only: rows would be moved against each other.
  void has_origin(const std::string& log, bool stated, const Place& place);

  /// Notes the unit in seconds of the times of a log. InputError at `place` when they were read in
  /// another one.
  void takes_unit(const std::string& times, double unit, const Place& place);

  /// What was read so far.
  const std::vector<model::StatedFile>& files() const { return files_; }

 private:
  /// The bytes, with their hash noted.
  std::string read(const Reference& reference);
  model::StatedFile& noted(const std::string& name);
  /// What the gain file states of a file; null without a gain file, and for files that it does not
  /// state.
  const model::StatedFile* stated(const Reference& reference) const;
  bool is_gain_file() const { return !gain_file_.empty(); }

  std::filesystem::path folder_;
  std::string gain_file_;
  std::vector<model::StatedFile> stated_;
  std::vector<model::StatedFile> files_;
  std::map<std::string, bool> origins_;  ///< by log: whether it is stated
  std::map<std::string, double> units_;  ///< by file and column
};

}  // namespace gainsmith::io
