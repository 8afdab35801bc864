#include "gainsmith/optimizers.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace gainsmith::app {

namespace {

constexpr const char* kProgram = "gainsmith-full";

/// Makes `text` what standard input gives.
void restore_standard_input(const std::string& text) {
  std::FILE* file = std::tmpfile();
  const bool written = file != nullptr &&
                       std::fwrite(text.data(), 1, text.size(), file) == text.size() &&
                       std::fflush(file) == 0 && std::fseek(file, 0, SEEK_SET) == 0;
  if (!written || ::dup2(::fileno(file), STDIN_FILENO) < 0)
    throw InputError({}, "cannot keep standard input for " + std::string(kProgram));
}

}  // namespace

const search::Optimizers* optimizers_for(const design::SearchRequest& request,
                                         const model::Design& design) {
  if (request.over.empty() || linked_optimizers() != nullptr) return linked_optimizers();
  throw OptimizersNeeded{design.file == "-" ? std::optional(design.statement.problem_text)
                                            : std::nullopt};
}

void continue_with_optimizers(char** arguments, const OptimizersNeeded& need) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string program = (self.parent_path() / kProgram).string();
  if (need.standard_input) restore_standard_input(*need.standard_input);
  ::execv(program.c_str(), arguments);
  throw InputError({program}, "cannot be started (" + std::generic_category().message(errno) +
                                  "); a search over scalars ('search' with 'over') needs it "
                                  "beside gainsmith. Scalars that have a value under 'data' or "
                                  "'parameters' are not searched");
}

}  // namespace gainsmith::app
