// The container of MAT files of version 5: a header of 128 bytes, then elements, each of which is a
// tag (type and length, 4 bytes each) and its bytes, filled up to 8.
//
// All headers are read first, of compressed variables from their first 4096 bytes; the numbers of
// the one that is wanted follow. Every length is compared with what is there before it is used.
#include "io/matrix/mat_matrix.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "io/matrix/mat_variable.h"

namespace gainsmith::io {

namespace {

constexpr std::size_t kFileHeader = 128;
constexpr std::size_t kTag = 8;  ///< a type and a length

/// Whether numbers begin with their highest byte, as the end of the header says.
bool is_big_endian(std::string_view bytes, const std::string& path, const Place& place) {
  const std::string_view end = bytes.substr(std::min(bytes.size(), kFileHeader - 4), 4);
  const std::string_view mark = end.substr(std::min<std::size_t>(end.size(), 2));
  const bool marked = mark == "IM" || mark == "MI";
  const std::uint64_t version = marked ? word_of(end.substr(0, 2), mark == "MI") : 0;
  if (version == 0x0100) return mark == "MI";
  throw InputError(place,
                   path +
                       (version == 0x0200 ? ": this is a MAT file of version 7.3, which is not read"
                                          : ": this is no MAT file of version 5") +
                       ": save it again, in MATLAB or Octave by save('-v7', 'file.mat', 'A')");
}

/// Without the tag at the beginning.
std::string_view behind_tag(std::string_view bytes) {
  return bytes.substr(std::min(kTag, bytes.size()));
}

/// The first `most` bytes of what zlib compressed; empty when it is damaged.
std::string inflated(std::string_view bytes, std::size_t most) {
  std::string text(most, '\0');
  uLongf size = most;
  const int code = ::uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  text.resize(code == Z_OK || code == Z_BUF_ERROR ? size : 0);
  return text;
}

/// Reads a variable part by part.
class PartReader {
 public:
  PartReader(std::string_view bytes, bool big_endian) : rest_(bytes), big_endian_(big_endian) {}

  /// Whether all parts were there so far, with the types that they must have.
  bool is_whole() const { return whole_; }

  std::uint32_t word(std::string_view bytes, std::size_t at = 0) const {
    if (at + 4 > bytes.size()) return 0;
    return static_cast<std::uint32_t>(word_of(bytes.substr(at, 4), big_endian_));
  }

  MatNumbers next() {
    // Up to four bytes are in the tag itself, which has their number in the upper half of the type.
    const std::uint32_t first = word(rest_), few = first >> 16U;
    const std::size_t size = few > 0 ? few : word(rest_, 4), begin = few > 0 ? 4 : kTag;
    whole_ = whole_ && rest_.size() >= kTag && few <= 4 && size <= rest_.size() - begin;
    if (!whole_) return {};
    const MatNumbers part{static_cast<int>(first & 0xFFFFU), rest_.substr(begin, size),
                          big_endian_};
    rest_.remove_prefix(std::min((begin + size + 7) / 8 * 8, rest_.size()));
    return part;
  }

  /// All but the numbers.
  MatVariable header() {
    MatVariable result;
    const MatNumbers flags = next();
    result.kind = static_cast<int>(word(flags.bytes) & 0xFFU);
    result.complex = (word(flags.bytes) & 0x800U) != 0;
    whole_ = whole_ && flags.type == mat::kUint32;
    if (result.kind == mat::kOpaqueClass) return result;
    const MatNumbers dimensions = next(), name = next();
    for (std::size_t at = 0; at < dimensions.bytes.size(); at += 4)
      result.dimensions.push_back(word(dimensions.bytes, at));
    result.name = name.bytes;
    whole_ = whole_ && dimensions.type == mat::kInt32 &&
             (name.type == mat::kInt8 || name.type == mat::kUint8);
    return result;
  }

 private:
  std::string_view rest_;
  bool big_endian_;
  bool whole_ = true;
};

}  // namespace

/// Two passes: the headers of all variables, then the numbers of one.
FileMatrix mat_matrix(const std::string& bytes, const std::string& path, const std::string& name,
                      const Place& place) {
  // Flags, dimensions and name of a variable need less than this.
  constexpr std::size_t kLongestHeader = 4096;
  // Of a full matrix 8 bytes an element, of a sparse one a row besides; a header.
  constexpr std::size_t kLongest = std::size_t{16} * kMostElements;
  const auto refuse = [&](const std::string& why) {
    throw InputError(place, path + ": the file is " + why);
  };
  const bool big_endian = is_big_endian(bytes, path, place);
  std::vector<MatVariable> found;  // their values are all of their bytes, as they are stored
  int count = 0;
  for (std::string_view rest = std::string_view(bytes).substr(kFileHeader); !rest.empty();) {
    const std::string variable = "variable " + std::to_string(++count);
    const PartReader tag(rest, big_endian);
    const std::uint32_t type = tag.word(rest), length = tag.word(rest, 4);
    rest.remove_prefix(std::min(kTag, rest.size()));
    if (type != mat::kMatrix && type != mat::kCompressed)
      refuse("damaged: " + variable + " is of no known kind");
    if (rest.size() < length)
      refuse("cut off within " + variable + ": " + std::to_string(rest.size()) + " of its " +
             std::to_string(length) + " bytes are there");
    const std::string_view stored = rest.substr(0, length);
    rest.remove_prefix(length);
    const bool compressed = type == mat::kCompressed;
    const std::string text = compressed ? inflated(stored, kLongestHeader) : std::string();
    PartReader parts(compressed ? behind_tag(text) : stored, big_endian);
    MatVariable header = parts.header();
    if (!parts.is_whole()) refuse("damaged: " + variable + " begins with no header");
    header.values = {static_cast<int>(type), stored, big_endian};
    // MATLAB writes what classes of its own need without a name.
    if (!header.name.empty()) found.push_back(std::move(header));
  }
  std::string text;
  const auto read = [&](std::size_t index) {
    std::string_view body = found[index].values.bytes;
    if (found[index].values.type == mat::kCompressed) {
      const std::string tag = inflated(body, kTag);
      const std::size_t length = kTag + PartReader(tag, big_endian).word(tag, 4);
      // One byte more than is said shows that there are more.
      if (length <= kLongest) text = inflated(body, length + 1);
      if (text.size() != length)
        refuse("damaged: " + found[index].name + " cannot be decompressed");
      body = behind_tag(text);
    }
    PartReader parts(body, big_endian);
    MatVariable variable = parts.header();
    if (variable.kind == mat::kSparseClass) {
      variable.rows = parts.next();
      variable.columns = parts.next();
    }
    variable.values = parts.next();
    return variable;
  };
  return {matrix_of_variable(found, name, path, place, read)};
}

}  // namespace gainsmith::io
