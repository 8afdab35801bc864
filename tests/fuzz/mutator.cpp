#include "fuzz/mutator.h"

#include <algorithm>
#include <array>

namespace gainsmith::fuzz {

namespace {

using namespace std::string_view_literals;

constexpr auto kSigns = "[]{}()\"'*&!|>:;,#-?~%@\n\t 0e.^/+<I\r\\\0\xC3\xFF"sv;

}  // namespace

std::string Mutator::operator()(std::string bytes, const std::string& other) {
  for (std::size_t edits = 1 + pick(4); edits > 0 && !bytes.empty(); --edits) edit(bytes, other);
  return bytes;
}

void Mutator::edit(std::string& bytes, const std::string& other) {
  const std::size_t at = pick(bytes.size()), length = 1 + pick(12);
  switch (pick(10)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1U << pick(8)));
      break;
    case 1:
      bytes[at] = kSigns[pick(kSigns.size())];
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 4:
      bytes.insert(at, bytes.substr(pick(bytes.size()), 3 * length));
      break;
    case 5:
      bytes.insert(at, 1, kSigns[pick(kSigns.size())]);
      break;
    case 6:
      if (pick(4) == 0) bytes.resize(at);
      break;
    case 7:
      bytes = bytes.substr(0, at) + other.substr(std::min(at, other.size()));
      break;
    case 8:
      set_length(bytes, at);
      break;
    default:
      set_number(bytes, at);
  }
}

void Mutator::set_length(std::string& bytes, std::size_t at) {
  constexpr std::array<std::uint64_t, 12> kEnds = {
      0, 1, 2, 8, 0x7F, 0x80, 0xFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, ~std::uint64_t{0}};
  const std::size_t width = std::size_t{1} << pick(4);
  const std::uint64_t value = kEnds.at(pick(kEnds.size()));
  const bool big_endian = pick(4) == 0;
  at -= at % width;
  for (std::size_t k = 0; k < width && at + k < bytes.size(); ++k)
    bytes[at + k] = static_cast<char>(value >> 8 * (big_endian ? width - 1 - k : k));
}

void Mutator::set_number(std::string& bytes, std::size_t at) {
  constexpr std::array<std::string_view, 11> kEnds = {"0",
                                                      "1",
                                                      "-1",
                                                      "2147483648",
                                                      "99999999999999999999",
                                                      "1e999999999999",
                                                      "1e-2147483648",
                                                      "1e400",
                                                      "1e-400",
                                                      "250001",
                                                      "0.0e-2147483648"};
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t begin = bytes.find_first_of(kDigits, at);
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(bytes.find_first_not_of(kDigits, begin), bytes.size());
  bytes.replace(begin, end - begin, kEnds.at(pick(kEnds.size())));
}

}  // namespace gainsmith::fuzz
