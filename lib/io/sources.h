// Internal to io: the files that a problem names, on the disk or as a gain file states them. What was
// read is noted, with its SHA-256.
//
// A gain file states the problems that its own is `like`, and the matrices of files: it needs these
// files no more. Logs are too large for that. They are expected beside it, where the problem's paths
// lead from its folder. A file that is there must be the one that was read.
#pragma once

#include <filesystem>
#include <functional>
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

  /// The name of the file that `path` is in the file with the name `by`; the problem itself has none.
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

  /// Notes that the time of a log is counted from its first row although nothing says so. InputError
  /// at `place` when that was another log: their rows would be moved against each other.
  void begins_at_its_first_row(const std::string& log, const Place& place);

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
  std::string begins_at_first_row_;
};

}  // namespace gainsmith::io
