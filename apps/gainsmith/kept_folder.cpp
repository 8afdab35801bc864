#include "gainsmith/kept_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "gainsmith/part_file.h"
#include "gainsmith/sealed.h"
#include "gainsmith/terminal.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = "gainsmith.lock";
constexpr const char* kKept = "what --resume keeps";

/// The process that holds the lock, as it wrote it there: " (process 1234)".
std::string holder_text(const fs::path& lock) {
  try {
    const std::string text = read_text(lock);
    return text.empty() ? "" : " (process " + text.substr(0, text.find('\n')) + ")";
  } catch (const InputError&) {
    return "";
  }
}

/// InputError for a folder that cannot be read, or holds files and no lock. Another program may make its
/// lock at any moment.
void require_ours(const fs::path& folder) {
  std::error_code error;
  std::string other;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    other = entry->path().filename().string();
  if (error) throw InputError({folder.string()}, "cannot read this folder: " + error.message());
  if (!other.empty() && !fs::exists(folder / kLock, error))
    throw InputError({folder.string()},
                     "this folder holds other files, such as '" + other +
                         "'; expected an empty or new one, or one of an earlier --resume");
}

/// Removes what a program that was killed was writing. Who holds the lock may do that.
void tidy(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (name.starts_with("kept-") && name.find(".tmp.") != std::string::npos)
      fs::remove(entry->path(), ignored);
  }
}

}  // namespace

KeptFolder::KeptFolder(fs::path folder, io::Json statement)
    : folder_(std::move(folder)), statement_(std::move(statement)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw InputError({folder_.string()}, "cannot make this folder: " + error.message());
  require_ours(folder_);
  lock();
  try {
    tidy(folder_);
    read();
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

KeptFolder::~KeptFolder() { ::close(lock_); }

void KeptFolder::lock() {
  const fs::path file = folder_ / kLock;
  lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0)
    throw InputError({folder_.string()},
                     "cannot write here: " + std::generic_category().message(errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    const int code = errno;
    ::close(lock_);
    throw InputError({folder_.string()},
                     code == EWOULDBLOCK
                         ? "another gainsmith works in this folder" + holder_text(file) +
                               "; wait for it, or choose another folder"
                         : "cannot lock this folder: " + std::generic_category().message(code));
  }
  // The number helps people; without it the lock is one all the same.
  const std::string process = std::to_string(::getpid()) + "\n";
  if (::ftruncate(lock_, 0) == 0)
    static_cast<void>(!::pwrite(lock_, process.data(), process.size(), 0));
}

fs::path KeptFolder::path_of(std::uint64_t turn) const {
  return folder_ / ("kept-" + std::to_string(turn % 2) + ".json");
}

/// None where there is no file, or a damaged one, which is told.
std::optional<KeptFolder::Kept> KeptFolder::read_turn(std::uint64_t turn) {
  const fs::path path = path_of(turn);
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  const std::string text = read_text(path);
  try {
    Kept found{unsealed(text, path.string(), kKept), path.string()};
    for (const char* key : {"statement", "saved", "done"})
      if (!found.done.contains(key))
        throw InputError({path.string()}, std::string("expected ") + kKept);
    return found;
  } catch (const InputError& damage) {
    say("gainsmith: " + std::string(damage.what()) + "; it does not count\n");
    return std::nullopt;
  }
}

void KeptFolder::read() {
  std::optional<Kept> newest;
  for (const std::uint64_t turn : {0, 1}) {
    std::optional<Kept> found = read_turn(turn);
    if (!found) continue;
    const std::uint64_t saved = found->done["saved"].get<std::uint64_t>();
    if (newest && saved < saved_) continue;
    saved_ = saved;
    newest = std::move(found);
  }
  if (!newest) return;
  const io::Json& found = newest->done["statement"];
  const std::string kind = found.value(kWork, "");
  const std::string different =
      kind == statement_.value(kWork, "") ? difference_of(found, statement_) : "a " + kind;
  if (!different.empty())
    throw InputError({folder_.string()}, "this folder keeps other work: " + different +
                                             "; choose another folder, or remove this one");
  kept_ = Kept{newest->done["done"], newest->file};
}

void KeptFolder::keep(io::Json done) {
  const std::uint64_t next = saved_ + 1;
  const io::Json document = {{"statement", statement_}, {"saved", next}, {"done", done}};
  try {
    write_atomically(path_of(next), sealed(document));
  } catch (const InputError& error) {
    if (saved_ == 0) throw;
    throw InputError(error.place(), error.message() +
                                        "; what was kept before is whole, and the same command "
                                        "goes on from it");
  }
  saved_ = next;
}

}  // namespace gainsmith::app
