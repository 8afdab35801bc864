#include "gainsmith/picture_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "gainsmith/other_program.h"

namespace gainsmith::app {

namespace {

constexpr const char* kConverter = "rsvg-convert";

/// Removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "gainsmith.XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw InputError({name}, std::string("cannot make this folder: ") + std::strerror(errno));
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string extension_of(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

}  // namespace

void check_picture_name(const std::string& path, const std::string& option) {
  if (path.empty()) return;
  const std::vector<std::string> known = {".svg", ".pdf", ".png"};
  const std::string extension = extension_of(path);
  if (extension == known.front()) return;
  if (extension != known[1] && extension != known[2])
    throw InputError({option},
                     "a picture is SVG, PDF or PNG by its name: expected one that ends "
                     "with '.svg', '.pdf' or '.png', not '" +
                         path + "'");
  if (!is_installed(kConverter))
    throw InputError({option},
                     "PDF and PNG are made by rsvg-convert, which is not installed "
                     "(package librsvg2-bin in Debian); '.svg' needs nothing");
}

void write_picture(const std::string& path, const std::string& svg) {
  if (path.empty()) return;
  const std::string extension = extension_of(path);
  if (extension == ".svg") return write_atomically(path, svg);
  const TemporaryFolder folder;
  write_atomically(folder.file("picture.svg"), svg);
  const std::string made = folder.file("made");
  // The time of a PDF is that of SOURCE_DATE_EPOCH.
  if (run_program({kConverter, "--format", extension.substr(1), "--zoom",
                   extension == ".png" ? "2" : "1", "--output", made, folder.file("picture.svg")},
                  {"SOURCE_DATE_EPOCH=0"}) != 0)
    throw InputError({path}, "rsvg-convert could not make this picture");
  write_atomically(path, read_text(made));
}

}  // namespace gainsmith::app
