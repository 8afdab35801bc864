#include "base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/nearest.h"

namespace gainsmith {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& action, int code) {
  throw InputError({path.string()}, action + ": " + std::generic_category().message(code));
}

/// "; did you mean 'motor.yaml'?": a file with a like name in the same folder; otherwise empty.
std::string like_named(const std::filesystem::path& path) {
  std::vector<std::string> beside;
  std::error_code error;
  const std::filesystem::path folder = path.parent_path().empty() ? "." : path.parent_path();
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    beside.push_back(entry->path().filename().string());
  std::sort(beside.begin(), beside.end());
  const std::string name = path.filename().string();
  auto near = nearest(name, beside);
  for (const char* ending : {".yaml", ".json"})
    if (std::binary_search(beside.begin(), beside.end(), name + ending)) near = name + ending;
  return near ? "; did you mean '" + (path.parent_path() / *near).string() + "'?" : "";
}

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ > STDERR_FILENO) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// Returns 0, or errno.
int write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Whether the path is, or is a link to, an open file of this process (/dev/stdout, /dev/fd/3).
bool is_open_file(std::filesystem::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks; ++i) {
    const auto folder = std::filesystem::canonical(path.parent_path() / ".", error);
    if (!error && folder.filename() == "fd" && folder.string().starts_with("/proc/")) return true;
    const auto target = std::filesystem::read_symlink(path, error);
    if (error) return false;
    path = path.parent_path() / target;
  }
  return false;
}

/// Whether a path is written and read as a stream, and cannot be replaced by renaming.
bool is_special(const std::filesystem::path& path) {
  if (is_open_file(path)) return true;
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  return std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status) ||
         std::filesystem::is_socket(status);
}

/// A pipe or a device gives its bytes once: read_text() keeps them.
std::string read_bytes(const std::filesystem::path& path) {
  const bool standard_input = path == "-";
  const Descriptor file(standard_input ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0 && errno == ENOENT)
    throw InputError(
        {path.string()},
        "cannot open this file: " + std::generic_category().message(ENOENT) + like_named(path));
  if (file.get() < 0) refuse(path, "cannot open this file", errno);
  std::string text;
  std::string chunk(1U << 16U, '\0');
  for (;;) {
    const ssize_t count = ::read(file.get(), chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EISDIR)
      throw InputError({path.string()}, "this is a folder; expected a file");
    if (count < 0) refuse(path, "cannot read this file", errno);
    if (count == 0) return text;
    text.append(chunk, 0, static_cast<std::size_t>(count));
  }
}

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  if (path != "-" && !is_special(path)) return read_bytes(path);
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::string> known;
  const std::scoped_lock lock(mutex);
  const auto found = known.find(path);
  return found != known.end() ? found->second : known.emplace(path, read_bytes(path)).first->second;
}

void write_atomically(const std::filesystem::path& path, std::string_view text) {
  if (is_special(path)) {
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
    const int code = file.get() < 0 ? errno : write_all(file.get(), text);
    if (code != 0) refuse(path, "cannot write this file", code);
    return;
  }
  std::error_code missing;
  if (std::filesystem::is_directory(path, missing))
    throw InputError({path.string()}, "this is a folder; expected the name of a file");
  const auto target = std::filesystem::is_symlink(path, missing)
                          ? std::filesystem::weakly_canonical(path, missing)
                          : path;
  std::string temporary = target.string() + ".tmp.XXXXXX";
  const Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) refuse(path, "cannot write beside this file", errno);
  int code = write_all(file.get(), text);
  // mkostemp makes the file private; give it the permissions that an ordinary new file gets.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (code == 0 && ::fchmod(file.get(), 0666 & ~mask) != 0) code = errno;
  if (code == 0 && ::fsync(file.get()) != 0) code = errno;
  if (code == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) code = errno;
  if (code != 0) {
    ::unlink(temporary.c_str());
    refuse(path, "cannot write this file", code);
  }
}

}  // namespace gainsmith
