// The folder of `--resume`: what is done of some long work, so that the same command goes on from
// it.
//
// Two files take turns, each written under another name, flushed to the disk and renamed: whatever
// happens, one of them is whole. A file that was damaged since then is known by its sha256; then
// the other one, which is older by seconds, counts. A lock keeps a second program out; it ends with
// the process that holds it, however that ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/json/json_text.h"

namespace gainsmith::app {

class KeptFolder {
 public:
  /// Makes the folder where there is none, and locks it. `statement`: what the work is, key by key
  /// (begin_statement()).
  /// InputError where that cannot be done, another program works in it, it holds other files, or
  /// other work.
  KeptFolder(std::filesystem::path folder, io::Json statement);
  KeptFolder(const KeptFolder&) = delete;
  KeptFolder& operator=(const KeptFolder&) = delete;
  ~KeptFolder();

  /// What was kept last: the document under the key "done", and the file that says so.
  struct Kept {
    io::Json done;
    std::string file;
  };
  std::optional<Kept> kept() const { return kept_; }

  /// Replaces it. InputError when it cannot be written; then what was kept before stays.
  void keep(io::Json done);

 private:
  void lock();
  void read();
  std::optional<Kept> read_turn(std::uint64_t turn);
  std::filesystem::path path_of(std::uint64_t turn) const;

  std::filesystem::path folder_;
  io::Json statement_;
  std::uint64_t saved_ = 0;  ///< how often
  std::optional<Kept> kept_;
  int lock_ = -1;
};

}  // namespace gainsmith::app
