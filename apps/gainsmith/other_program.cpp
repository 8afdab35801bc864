#include "gainsmith/other_program.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace gainsmith::app {

bool is_installed(const std::string& command) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((std::filesystem::path(folder) / command).c_str(), X_OK) == 0) return true;
  return false;
}

std::optional<int> run_program(std::vector<std::string> arguments,
                               std::vector<std::string> environment) {
  std::vector<char*> argv, envp;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  for (char** one = environ; *one != nullptr; ++one) envp.push_back(*one);
  for (std::string& one : environment)
    if (std::getenv(one.substr(0, one.find('=')).c_str()) == nullptr) envp.push_back(one.data());
  envp.push_back(nullptr);
  pid_t child = 0;
  if (::posix_spawnp(&child, argv.front(), nullptr, nullptr, argv.data(), envp.data()) != 0)
    return std::nullopt;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return std::nullopt;
  return WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
}

}  // namespace gainsmith::app
