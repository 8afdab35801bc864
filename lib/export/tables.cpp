// Files that hold matrices alone.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "base/number.h"
#include "export/files.h"
#include "export/shared_text.h"

namespace gainsmith::exports {

namespace {

constexpr int kLatexDigits = 6;

/// "-1.5 \times 10^{-6}".
std::string latex_number(double value) {
  const std::string text = brief(value, kLatexDigits);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  return text.substr(0, e) + " \\times 10^{" + std::to_string(std::stoi(text.substr(e + 1))) + "}";
}

/// "L", "F_{0}", "\mathit{Ldno}".
std::string latex_name(const std::string& name) {
  // What follows the first underscore is an index, further ones separate indices.
  const std::size_t bar = name.find('_');
  const std::string base = name.substr(0, bar);
  std::string text = base.size() == 1 ? base : "\\mathit{" + base + "}";
  if (bar == std::string::npos) return text;
  std::string index;
  for (const char c : name.substr(bar + 1))
    index += c == '_' ? std::string(",") : std::string(1, c);
  return text + "_{" + index + "}";
}

/// Numbers of a MAT-file, the least significant byte first.
template <class Number>
void append(std::string& bytes, Number value) {
  auto bits = static_cast<std::uint64_t>(value);
  for (std::size_t k = 0; k < sizeof(Number); ++k, bits >>= 8)
    bytes += static_cast<char>(bits & 0xffU);
}

/// A data element: type, size, bytes, filled up to 8 bytes.
std::string element(std::uint32_t type, const std::string& bytes) {
  std::string text;
  append(text, type);
  append(text, static_cast<std::uint32_t>(bytes.size()));
  text += bytes;
  text.append((8 - bytes.size() % 8) % 8, '\0');
  return text;
}

/// A matrix of class double: flags, dimensions, name, numbers column by column.
std::string mat_element(const std::string& name, const numbers::Matrix& value) {
  // Codes of types and classes of MAT-files, level 5.
  constexpr std::uint32_t kInt8 = 1, kInt32 = 5, kUint32 = 6, kDouble = 9, kMatrix = 14,
                          kDoubleClass = 6;
  std::string flags, size, numbers;
  append(flags, kDoubleClass);
  append(flags, std::uint32_t{0});
  append(size, static_cast<std::uint32_t>(value.rows()));
  append(size, static_cast<std::uint32_t>(value.cols()));
  for (Eigen::Index k = 0; k < value.size(); ++k)
    append(numbers, std::bit_cast<std::uint64_t>(value(k)));
  return element(kMatrix, element(kUint32, flags) + element(kInt32, size) + element(kInt8, name) +
                              element(kDouble, numbers));
}

}  // namespace

/// Each gain is one displayed equation.
std::string latex_file(const Content& content, const std::vector<GainMatrix>& matrices) {
  constexpr Eigen::Index kColumns = 10;  // of a bmatrix, unless more are asked for
  std::vector<std::string> head = head_lines(content, "Gains");
  head.emplace_back("The numbers are rounded to " + std::to_string(kLatexDigits) +
                    " digits. What was shown is of the gains in the gain file, not of these.");
  std::string text = lines_text(head, "% ");
  Eigen::Index columns = 0;
  for (const GainMatrix& gain : matrices) columns = std::max(columns, gain.value.cols());
  if (columns > kColumns) text += fmt::format("\\setcounter{{MaxMatrixCols}}{{{}}}\n", columns);
  for (const GainMatrix& gain : matrices) {
    if (gain.value.size() == 0) continue;
    text += "\\[\n  " + latex_name(gain.name) + " = ";
    if (gain.value.size() == 1) {
      text += latex_number(gain.value(0, 0)) + "\n\\]\n";
      continue;
    }
    text += "\\begin{bmatrix}\n";
    for (Eigen::Index i = 0; i < gain.value.rows(); ++i) {
      text += "    ";
      for (Eigen::Index j = 0; j < gain.value.cols(); ++j)
        text += (j > 0 ? " & " : "") + latex_number(gain.value(i, j));
      text += i + 1 < gain.value.rows() ? " \\\\\n" : "\n";
    }
    text += "  \\end{bmatrix}\n\\]\n";
  }
  return text;
}

std::string mat_file(const std::vector<GainMatrix>& matrices) {
  // The header has 128 bytes: text, offset of data (none), version 0x0100, mark of byte order.
  constexpr std::size_t kText = 116, kHead = 124;
  std::string bytes = "MATLAB 5.0 MAT-file, written by gainsmith";
  bytes.resize(kText, ' ');
  bytes.resize(kHead, '\0');
  append(bytes, std::uint16_t{0x0100});
  bytes += "IM";
  Identifiers names(Language::matlab);
  for (const GainMatrix& gain : matrices) bytes += mat_element(names(gain.name), gain.value);
  return bytes;
}

std::string csv_text(const numbers::Matrix& matrix) {
  std::string text;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += (j > 0 ? "," : "") + model::printed(matrix(i, j));
    text += "\n";
  }
  return text;
}

}  // namespace gainsmith::exports
