#include "io/matrix/mat_layout.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/matrix/file_matrix.h"

namespace gainsmith::io {

namespace {

constexpr std::size_t kHeader = 128;
constexpr const char* kSaveAgain =
    ": save it again, in MATLAB or Octave by save('-v7', 'file.mat', 'A')";

/// A file of version 4 begins with the variable itself: a type of four digits, rows, columns,
/// whether it is complex, and the length of its name.
bool is_version_4(const std::string& bytes) {
  constexpr std::size_t kBegin = 20;
  if (bytes.size() < kBegin) return false;
  const auto begins = [&](bool big_endian) {
    const auto word = [&](std::size_t at) {
      return word_of(std::string_view(bytes).substr(at, 4), big_endian);
    };
    const std::uint64_t type = word(0), complex = word(12), name = word(16);
    return type < 5000 && type / 100 % 10 == 0 && type / 10 % 10 < 6 && type % 10 < 3 &&
           complex < 2 && name > 0 && name < 256;
  };
  return begins(false) || begins(true);
}

}  // namespace

bool is_big_endian(const std::string& bytes, const std::string& path, const Place& place) {
  const auto refuse = [&](const std::string& why) { throw InputError(place, path + ": " + why); };
  const std::string_view mark =
      std::string_view(bytes).substr(std::min(bytes.size(), kHeader - 2), 2);
  if (mark != "IM" && mark != "MI") {
    if (bytes.size() < kHeader && bytes.starts_with("MATLAB"))
      refuse("the file is cut off within its header");
    if (is_version_4(bytes))
      refuse(std::string("this is a MAT file of version 4, which is not read") + kSaveAgain);
    refuse(std::string("this is no MAT file") + kSaveAgain);
  }
  const bool big_endian = mark == "MI";
  const std::uint64_t version = word_of(std::string_view(bytes).substr(kHeader - 4, 2), big_endian);
  if (version == 0x0200)
    refuse(std::string("this is a MAT file of version 7.3, which is not read") + kSaveAgain);
  if (version != 0x0100)
    refuse(std::string("this is a MAT file of an unknown version") + kSaveAgain);
  return big_endian;
}

}  // namespace gainsmith::io
