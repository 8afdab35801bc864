#include "base/own_process.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "base/error.h"

namespace gainsmith {

namespace {

/// How the answer of the other process begins.
enum class Kind : char { text = 't', error = 'e' };

void send(int fd, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t count = ::write(fd, text.data() + at, text.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    at += static_cast<std::size_t>(count);
  }
}

/// "file \0 line \0 column \0 message".
std::string packed(const InputError& error) {
  const Place& place = error.place();
  return place.file + '\0' + std::to_string(place.line) + '\0' + std::to_string(place.column) +
         '\0' + error.message();
}

[[noreturn]] void throw_packed(const std::string& text) {
  std::array<std::string, 3> parts;
  std::size_t at = 0;
  for (std::string& part : parts) {
    const std::size_t end = text.find('\0', at);
    part = text.substr(at, end - at);
    at = end + 1;
  }
  throw InputError({parts[0], std::atoi(parts[1].c_str()), std::atoi(parts[2].c_str())},
                   text.substr(at));
}

/// Bytes of addresses that this process has; 0 when the system does not say.
rlim_t address_space() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  return file >> pages ? pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

/// `space`: what the process has before it works.
[[noreturn]] void answer(int fd, rlim_t space, const std::function<std::string()>& work) {
  constexpr rlim_t kMemory = 200'000'000;
  // A crash is expected here and needs no record.
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit memory{space + kMemory, space + kMemory};
  if (space > 0) ::setrlimit(RLIMIT_AS, &memory);
  for (const int signal : {SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE}) std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // the one who waits for the answer ends both
  try {
    send(fd, std::string(1, static_cast<char>(Kind::text)) + work());
  } catch (const InputError& error) {
    send(fd, std::string(1, static_cast<char>(Kind::error)) + packed(error));
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

/// All that comes until the other end is closed; none after 20 s.
std::optional<std::string> receive(int fd) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(20);
  std::string text;
  std::string chunk(1U << 16U, '\0');
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return std::nullopt;
    pollfd one{fd, POLLIN, 0};
    const int ready = ::poll(&one, 1, static_cast<int>(left.count()));
    if (ready == 0) return std::nullopt;
    if (ready < 0 && errno == EINTR) continue;
    const ssize_t count = ::read(fd, chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(chunk, 0, static_cast<std::size_t>(count));
  }
}

}  // namespace

std::optional<std::string> in_own_process(const std::function<std::string()>& work) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) return work();
  const rlim_t space = address_space();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe[0]);
    answer(pipe[1], space, work);
  }
  ::close(pipe[1]);
  if (child < 0) {
    ::close(pipe[0]);
    return work();
  }
  const std::optional<std::string> text = receive(pipe[0]);
  ::close(pipe[0]);
  if (!text) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!text || text->empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  if (text->front() == static_cast<char>(Kind::error)) throw_packed(text->substr(1));
  return text->substr(1);
}

}  // namespace gainsmith
