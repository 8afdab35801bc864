#include "io/matrix/mat_layout.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gainsmith::io {

namespace {

using namespace std::string_view_literals;

constexpr std::size_t kHeader = 128;
constexpr const char* kSaveAgain =
    ": save it again, in MATLAB or Octave by save('-v7', 'file.mat', 'A')";

/// Four bytes as a whole number.
std::uint32_t word32(const std::string& bytes, std::size_t at, bool big_endian) {
  std::uint32_t result = 0;
  for (std::size_t k = 0; k < 4; ++k)
    result = result << 8U | static_cast<unsigned char>(bytes[big_endian ? at + k : at + 3 - k]);
  return result;
}

/// A file of version 4 begins with the variable itself: a type of four digits, rows, columns,
/// whether it is complex, and the length of its name.
bool is_version_4(const std::string& bytes) {
  constexpr std::size_t kBegin = 20;
  if (bytes.size() < kBegin) return false;
  const auto begins = [&](bool big_endian) {
    const std::uint32_t type = word32(bytes, 0, big_endian);
    const std::uint32_t complex = word32(bytes, 12, big_endian);
    const std::uint32_t name = word32(bytes, 16, big_endian);
    return type < 5000 && type / 100 % 10 == 0 && type / 10 % 10 < 6 && type % 10 < 3 &&
           complex < 2 && name > 0 && name < 256;
  };
  return begins(false) || begins(true);
}

/// The variables of version 5 follow each other: a type, a length, and so many bytes.
void check_variables(const std::string& bytes, bool big_endian, const std::string& path,
                     const Place& place) {
  constexpr std::uint32_t kMatrix = 14;
  constexpr std::uint32_t kCompressed = 15;
  constexpr std::size_t kTag = 8;
  int count = 0;
  for (std::size_t at = kHeader; at < bytes.size(); ++count) {
    const std::string variable = "variable " + std::to_string(count + 1);
    if (bytes.size() - at < kTag)
      throw InputError(place, path + ": the file is cut off at the beginning of " + variable);
    const std::uint32_t type = word32(bytes, at, big_endian);
    const std::uint32_t length = word32(bytes, at + 4, big_endian);
    if (type != kMatrix && type != kCompressed)
      throw InputError(place, path + ": the file is damaged: " + variable + " is of no known kind");
    if (bytes.size() - at - kTag < length)
      throw InputError(place, path + ": the file is cut off within " + variable + ": " +
                                  std::to_string(bytes.size() - at - kTag) + " of its " +
                                  std::to_string(length) + " bytes are there");
    at += kTag + length;
  }
}

}  // namespace

void check_mat_layout(const std::string& bytes, const std::string& path, const Place& place) {
  constexpr auto kHdf5 = "\x89HDF\r\n\x1a\n"sv;
  constexpr std::size_t kHdf5At = 512;
  const std::string_view mark =
      std::string_view(bytes).substr(std::min(bytes.size(), kHeader - 2), 2);
  if (mark != "IM" && mark != "MI") {
    if (bytes.size() < kHeader && bytes.starts_with("MATLAB"))
      throw InputError(place, path + ": the file is cut off within its header");
    if (bytes.starts_with(kHdf5))
      throw InputError(
          place, path + ": this is an HDF5 file without the header of a MAT file" + kSaveAgain);
    throw InputError(
        place,
        path + ": " +
            (is_version_4(bytes) ? std::string("this is a MAT file of version 4, which is not read")
                                 : "this is no MAT file") +
            kSaveAgain);
  }
  const bool big_endian = mark == "MI";
  const std::uint32_t version =
      word32(bytes, kHeader - 4, big_endian) >> (big_endian ? 16U : 0U) & 0xFFFFU;
  if (version == 0x0100) return check_variables(bytes, big_endian, path, place);
  if (version != 0x0200)
    throw InputError(place, path + ": this is a MAT file of an unknown version" + kSaveAgain);
  if (std::string_view(bytes).substr(std::min(bytes.size(), kHdf5At), kHdf5.size()) != kHdf5)
    throw InputError(
        place,
        path + ": the file is cut off or damaged: a MAT file of version 7.3 continues as HDF5");
}

}  // namespace gainsmith::io
