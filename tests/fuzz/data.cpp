// Files of data: CSV, NumPy, MAT, JSON with gain files, and SDPA.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "fuzz/places.h"
#include "fuzz/readers.h"
#include "fuzz/values.h"
#include "io/json/gains_json.h"
#include "io/matrix/csv_matrix.h"
#include "io/matrix/csv_table.h"
#include "io/matrix/json_matrix.h"
#include "io/matrix/mat_matrix.h"
#include "io/matrix/npy_matrix.h"
#include "sdp/files/sdpa_file.h"
#include "sdp/problem.h"

namespace gainsmith::fuzz {

namespace {

const std::string kFile = "fuzz";
const Place kHere{"fuzz.yaml", 1, 1};

/// Whether `read` reads; what it refuses has a place in `text`, or is about the whole file.
template <class Read>
bool reads(std::string_view text, Read read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    if (error.place() != Place{kFile} && error.place() != kHere) require_place(error, kFile, text);
    return false;
  }
}

/// Any of the variables of the files in tests/data. `plain`: where their values stand.
bool read_variables(std::string_view bytes, std::string_view plain) {
  bool any = false;
  for (const char* name : {"", "A", "C", "T1", "S", "I8", "U64", "I64", "F", "L"})
    any |= reads(bytes, [&] {
      const io::FileMatrix found = io::mat_matrix(std::string(bytes), kFile, name, kHere);
      for (const std::string& element : found.matrix.elements)
        if (element != "0") require_stored(element, plain);
    });
  return any;
}

}  // namespace

bool read_csv(std::string_view bytes) {
  const std::string text(bytes);
  const NumbersOfText numbers(bytes);
  // Columns of CSV count bytes, and what ends with a carriage return alone is a line.
  std::string lines = text;
  for (std::size_t at = 0; at < lines.size(); ++at)
    if (static_cast<unsigned char>(lines[at]) >= 0x80)
      lines[at] = '?';
    else if (lines[at] == '\r' && !lines.substr(at + 1).starts_with('\n'))
      lines[at] = '\n';
  const bool matrix = reads(lines, [&] {
    for (const std::string& element : io::csv_matrix(text, kFile).matrix.elements)
      numbers.require(element);
  });
  const bool table = reads(lines, [&] {
    const io::CsvTable read(text, kFile);
    for (std::size_t i = 0; i < read.rows(); ++i)
      for (std::size_t j = 0; j < read.columns(); ++j)
        if (const auto value = read.number(i, j)) numbers.require(*value);
  });
  return matrix || table;
}

bool read_json(std::string_view bytes) {
  const std::string text(bytes);
  const NumbersOfText numbers(bytes);
  bool any = false;
  for (const char* name : {"", "A", "gains.L"})
    any |= reads(bytes, [&] {
      for (const std::string& element : io::json_matrix(text, kFile, name, kHere).matrix.elements)
        numbers.require(element);
    });
  return reads(bytes,
               [&] {
                 const model::Gains gains = io::parse_gains(text, kFile);
                 for (const auto& [name, matrix] : gains.gains)
                   for (const double value : matrix.reshaped()) numbers.require(value);
                 io::stated_problem(gains, kFile);
               }) ||
         any;
}

bool read_mat(std::string_view bytes) { return read_variables(bytes, bytes); }

bool read_compressed_mat(std::string_view bytes, std::string_view plain) {
  return read_variables(bytes, plain);
}

bool read_npy(std::string_view bytes) {
  return reads(bytes, [&] {
    for (const std::string& element :
         io::npy_matrix(std::string(bytes), kFile, kHere).matrix.elements)
      require_stored(element, bytes);
  });
}

bool read_sdpa(std::string_view bytes) {
  const NumbersOfText numbers(bytes);
  return reads(bytes, [&] {
    const sdp::Problem problem = sdp::read_sdpa(bytes, kFile);
    sdp::validate(problem);
    for (const double cost : problem.c) numbers.require(cost);
    for (const auto& matrix : problem.f)
      for (const sdp::Entry& entry : matrix) numbers.require(entry.value);
  });
}

}  // namespace gainsmith::fuzz
