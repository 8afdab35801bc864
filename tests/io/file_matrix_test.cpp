// Matrices of files of each format: their decimals, and what is refused, where.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/file.h"
#include "io/folder.h"
#include "io/matrix/csv_matrix.h"
#include "io/matrix/json_matrix.h"
#include "io/matrix/mat_matrix.h"
#include "io/matrix/npy_matrix.h"
#include "support/input_error.h"

namespace gainsmith::io {
namespace {

using tests::input_error;
using Texts = std::vector<std::string>;

const Place kHere{"p.yaml", 3, 12};

std::string shape(const FileMatrix& found) {
  const model::StatedMatrix& matrix = found.matrix;
  return std::to_string(matrix.rows) + " x " + std::to_string(matrix.cols) +
         (matrix.flat ? ", list" : "");
}

// CSV

InputError csv_error(const std::string& text) {
  return input_error([&] { csv_matrix(text, "A.csv"); });
}

TEST(CsvMatrix, KeepsTheDecimalsOfTheText) {
  const FileMatrix found = csv_matrix("0.2, -1.01\r\n+.5,1e-3\n", "A.csv");
  EXPECT_EQ(shape(found), "2 x 2");
  EXPECT_EQ(found.matrix.elements, (Texts{"0.2", "-1.01", "0.5", "1e-3"}));
  EXPECT_EQ(found.positions[3].line, 2);
  EXPECT_EQ(found.positions[3].column, 5);
}

TEST(CsvMatrix, LeavesOutALineOfNames) {
  EXPECT_EQ(shape(csv_matrix("x1,\"x2\"\n1,2\n", "A.csv")), "1 x 2");
  EXPECT_EQ(shape(csv_matrix("\xEF\xBB\xBF\n1\n2\n\n", "A.csv")), "2 x 1");
}

TEST(CsvMatrix, SaysWhereWhatIsNoNumber) {
  struct Case {
    const char* text;
    Place place;
    const char* says;
  };
  for (const Case& one : {
           Case{"1,2\n3,four\n", {"A.csv", 2, 3}, "found 'four'"},
           Case{"x,y\n1,z\n", {"A.csv", 2, 3}, "found 'z'"},
           Case{"1,2\n3,NaN\n", {"A.csv", 2, 3}, "finite decimal number, found 'NaN'"},
           Case{"nan,1\n", {"A.csv", 1, 1}, "finite decimal number"},
           Case{"1,-inf\n", {"A.csv", 1, 3}, "finite decimal number"},
           Case{"1,1e999\n", {"A.csv", 1, 3}, "found '1e999'"},
           Case{"1,2\n3\n", {"A.csv", 2, 1}, "the row has 1 cells, the first line 2"},
           Case{"1,2\n3,\n", {"A.csv", 2, 3}, "this cell is empty"},
           Case{"1;2\n3;4\n", {"A.csv", 1, 1}, "separated by commas"},
           Case{"1 2\n", {"A.csv", 1, 1}, "separated by commas"},
           Case{"", {"A.csv", 1, 1}, "no numbers"},
           Case{"a,b\n", {"A.csv", 1, 1}, "no numbers"},
           Case{"\u22121,\u22122\n0.5,1\n", {"A.csv", 1, 1}, "found '\u22121'"},
           Case{"NA,NA\n0.5,1\n", {"A.csv", 1, 1}, "found 'NA'"},
           Case{"x,?\n0.5,1\n", {"A.csv", 1, 1}, "found 'x'"},
           Case{"true,false\n0.5,1\n", {"A.csv", 1, 1}, "found 'true'"},
           Case{",\n0.5,1\n", {"A.csv", 1, 1}, "this cell is empty"},
           Case{"1+2i,3\n", {"A.csv", 1, 1}, "found '1+2i'"},
       }) {
    const InputError error = csv_error(one.text);
    EXPECT_EQ(error.place(), one.place) << one.text;
    EXPECT_NE(error.message().find(one.says), std::string::npos) << error.message();
  }
}

TEST(CsvMatrix, RefusesTooManyElementsBeforeItMakesCellsOfThem) {
  std::string row = "0";
  for (int k = 0; k < 1000; ++k) row += ",0";
  std::string text;
  for (int k = 0; k < 300; ++k) text += row + "\n";
  EXPECT_NE(csv_error(text).message().find("more than the 250000 elements"), std::string::npos);
  EXPECT_NE(csv_error(std::string(600000, '\n') + "1\n").message().find("more than"),
            std::string::npos);
}

TEST(FileMatrix, SpellsNumbersAsJsonDoes) {
  for (const auto& [text, json] : {std::pair{"1", "1"},
                                   {"+1", "1"},
                                   {"-.5", "-0.5"},
                                   {"1.", "1"},
                                   {"1.e5", "1e5"},
                                   {"007.50", "7.50"},
                                   {"-0", "-0.0"},
                                   {"0", "0"},
                                   {"1E-3", "1E-3"},
                                   {"-00.1e+2", "-0.1e+2"}})
    EXPECT_EQ(spelt_as_json(text), json);
}

// NumPy

template <class Number>
std::string bytes_of(Number value, bool big_endian = false) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// A file as numpy.save writes it.
std::string npy(const std::string& type, const std::string& shape, const std::string& data,
                bool by_columns = false, char version = 1) {
  std::string header = "{'descr': " + type +
                       ", 'fortran_order': " + (by_columns ? "True" : "False") + ", 'shape': (" +
                       shape + "), }";
  while ((header.size() + 11) % 64 != 0) header += ' ';
  header += '\n';
  const auto size = static_cast<std::uint32_t>(header.size());
  return "\x93NUMPY" + std::string{version, '\0'} + bytes_of(size).substr(0, version == 1 ? 2 : 4) +
         header + data;
}

Texts npy_elements(const std::string& bytes) {
  return npy_matrix(bytes, "A.npy", kHere).matrix.elements;
}

TEST(NpyMatrix, ReadsBothOrdersOfElementsAndBytes) {
  std::string rows, columns, swapped;
  for (const double value : {0.2, -1.01, 1.0, 0.0, 3.0, 1e-300}) rows += bytes_of(value);
  for (const double value : {0.2, 0.0, -1.01, 3.0, 1.0, 1e-300}) columns += bytes_of(value);
  for (const double value : {0.2, -1.01, 1.0, 0.0, 3.0, 1e-300}) swapped += bytes_of(value, true);
  const Texts expected{"0.2", "-1.01", "1", "0", "3", "1e-300"};
  EXPECT_EQ(npy_elements(npy("'<f8'", "2, 3", rows)), expected);
  EXPECT_EQ(npy_elements(npy("'<f8'", "2, 3", columns, true)), expected);
  EXPECT_EQ(npy_elements(npy("'>f8'", "2, 3", swapped)), expected);
  EXPECT_EQ(npy_elements(npy("'<f8'", "2, 3", rows, false, 2)), expected);
  EXPECT_EQ(shape(npy_matrix(npy("'<f8'", "2, 3", rows), "A.npy", kHere)), "2 x 3");
  EXPECT_EQ(shape(npy_matrix(npy("'<f8'", "6,", rows), "A.npy", kHere)), "1 x 6, list");
  EXPECT_EQ(shape(npy_matrix(npy("'<f8'", "", rows.substr(0, 8)), "A.npy", kHere)), "1 x 1");
}

TEST(NpyMatrix, ReadsWholeNumbersExactly) {
  EXPECT_EQ(npy_elements(npy("'<i8'", "1, 1", bytes_of(std::int64_t{-9007199254740993}))),
            Texts{"-9007199254740993"});
  EXPECT_EQ(npy_elements(npy("'<u8'", "1,", bytes_of(std::uint64_t{18446744073709551615U}))),
            Texts{"18446744073709551615"});
  EXPECT_EQ(npy_elements(npy("'|i1'", "2,", "\xFB\x07")), (Texts{"-5", "7"}));
  EXPECT_EQ(npy_elements(npy("'|b1'", "2,", std::string("\x01\x00", 2))), (Texts{"1", "0"}));
  EXPECT_EQ(npy_elements(npy("'>i2'", "1,", std::string("\xFF\xFE", 2))), Texts{"-2"});
  EXPECT_EQ(npy_elements(npy("'<f4'", "1,", bytes_of(0.1F))), Texts{"0.10000000149011612"});
}

TEST(NpyMatrix, RefusesWhatIsNoRealMatrix) {
  const std::string one = bytes_of(1.0);
  for (const auto& [bytes, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "no .npy file"},
           {"NUMPY", "no .npy file"},
           {npy("'<f8'", "1,", one).substr(0, 20), "cut off in its header"},
           {npy("'<f8'", "1,", one).substr(0, 9), "cut off in its header"},
           {npy("'<f8'", "2,", one),
            "the file is cut off: it has 8 bytes of elements, expected 16"},
           {npy("'<f8'", "1,", one + one), "more than its array"},
           {npy("'<c16'", "1,", one + one), "complex; save A.real"},
           {npy("'|O'", "1,", one), "Python objects; save numpy.array(A, dtype=float)"},
           {npy("'<f2'", "1,", "ab"), "'<f2' are no numbers that can be read"},
           {npy("'<U3'", "1,", one), "'<U3' are no numbers"},
           {npy("[('x', '<f8')]", "1,", one), "named fields"},
           {npy("'<f8'", "1, 1, 1", one), "3 dimensions; a matrix has two"},
           {npy("'<f8'", "-1, -1", one), "the shape '(-1, -1)' is none"},
           {npy("'<f8'", "1x, 1", one), "the shape '(1x, 1)' is none"},
           {npy("'<f8'", "1.0, 1", one), "the shape '(1.0, 1)' is none"},
           {npy("'<f8'", "0, 2", ""), "is 0 x 2: there is nothing in it"},
           {npy("'<f8'", "10000, 10000", one),
            "is 10000 x 10000, of more than the 250000 elements"},
           {npy("'<f8'", "99999999999999999999999, 3", one), "of more than the 250000 elements"},
           {npy("'<f8'", "2,", one + bytes_of(std::nan(""))), "NaN in row 1, column 2"},
           {npy("'<f8'", "1, 1", bytes_of(std::numeric_limits<double>::infinity())),
            "has Inf in row 1"},
           {npy("'<f8'", "1,", one, false, 9), "version 9"}}) {
    const InputError error = input_error([&] { npy_matrix(bytes, "A.npy", kHere); });
    EXPECT_EQ(error.place(), kHere);
    EXPECT_TRUE(error.message().starts_with("A.npy: ")) << error.message();
    EXPECT_NE(error.message().find(says), std::string::npos) << error.message() << "\n" << says;
  }
}

TEST(NpyMatrix, NoCutLeadsAstray) {
  const std::string whole =
      npy("'<f8'", "2, 2", bytes_of(1.0) + bytes_of(2.0) + bytes_of(3.0) + bytes_of(4.0));
  for (std::size_t size = 0; size < whole.size(); ++size)
    input_error([&] { npy_matrix(whole.substr(0, size), "A.npy", kHere); });
}

// JSON

TEST(JsonMatrix, FindsAMatrixByItsName) {
  const std::string text = R"({"A": [[0.1, 1e-1], [2, 3.50]], "gains": {"L": [1, 2]}, "a.b": 7})";
  const auto find = [&](const std::string& name) {
    return json_matrix(text, "f.json", name, kHere);
  };
  EXPECT_EQ(find("A").matrix.elements, (Texts{"0.1", "1e-1", "2", "3.50"}));
  EXPECT_EQ(shape(find("A")), "2 x 2");
  EXPECT_EQ(shape(find("gains.L")), "1 x 2, list");
  EXPECT_EQ(shape(find("a.b")), "1 x 1");
  EXPECT_EQ(shape(json_matrix("[[1], [2]]", "f.json", "", kHere)), "2 x 1");
}

TEST(JsonMatrix, SaysWhatIsThereAndWhatIsNoMatrix) {
  const std::string text =
      "{\"plant\": {\"A\": [[1, 2],\n [3]], \"B\": [1, \"x\"],\n \"C\": [null], \"D\": []}}";
  struct Case {
    const char* name;
    Place place;
    const char* says;
  };
  for (const Case& one :
       {Case{"plant.a", kHere, "has no 'a' in 'plant.a'; did you mean 'A'?"},
        Case{"plnt", kHere, "did you mean 'plant'?"}, Case{"plant.A.x", kHere, "has no 'x'"},
        Case{"plant", {"f.json", 1, 2}, "say which of it by 'name': plant.A, plant.B"},
        Case{"", {"f.json"}, "say which of it by 'name': plant"},
        Case{"plant.A", {"f.json", 2, 2}, "a row of 2 numbers"},
        Case{"plant.B", {"f.json", 2, 17}, "expected a number"},
        Case{"plant.C", {"f.json", 3, 8}, "expected a number"},
        Case{"plant.D", {"f.json"}, "nothing in it"}}) {
    const InputError error = input_error([&] { json_matrix(text, "f.json", one.name, kHere); });
    EXPECT_EQ(error.place(), one.place) << one.name << ": " << error.message();
    EXPECT_NE(error.message().find(one.says), std::string::npos) << error.message();
  }
  EXPECT_NE(input_error([&] { json_matrix("[1, NaN]", "f.json", "", kHere); })
                .message()
                .find("no complete JSON"),
            std::string::npos);
}

// MAT. The files were written by Octave (versions 4, 6 and 7 of its options).

std::string data(const std::string& name) { return std::string(GAINSMITH_TEST_DATA) + "/" + name; }

FileMatrix mat(const std::string& file, const std::string& name) {
  return mat_matrix(read_text(data(file)), data(file), name, kHere);
}

InputError mat_error(const std::string& file, const std::string& name) {
  return input_error([&] { mat(file, name); });
}

TEST(MatMatrix, ReadsVersion5) {
  for (const char* file : {"plant-v6.mat", "plant-v7.mat"}) {
    EXPECT_EQ(mat(file, "A").matrix.elements, (Texts{"0.2", "-1.01", "1", "0"})) << file;
    EXPECT_EQ(shape(mat(file, "C")), "1 x 2") << file;
    EXPECT_EQ(mat(file, "T1").matrix.elements, Texts{"0.5"}) << file;
  }
  EXPECT_EQ(shape(mat("one-v7.mat", "")), "2 x 2");
}

TEST(MatMatrix, ReadsSparseAndWholeNumbers) {
  for (const char* file : {"kinds-v6.mat", "kinds-v7.mat"}) {
    EXPECT_EQ(mat(file, "S").matrix.elements, (Texts{"0", "0", "2.5", "0", "-1", "0"})) << file;
    EXPECT_EQ(mat(file, "I8").matrix.elements, (Texts{"-5", "7"})) << file;
    EXPECT_EQ(mat(file, "F").matrix.elements, (Texts{"0.10000000149011612", "2"})) << file;
    EXPECT_EQ(mat(file, "L").matrix.elements, (Texts{"1", "0"})) << file;
  }
  EXPECT_EQ(mat("kinds-v7.mat", "U64").matrix.elements, Texts{"18446744073709551615"});
  EXPECT_EQ(mat("kinds-v7.mat", "I64").matrix.elements, Texts{"-9007199254740993"});
}

TEST(MatMatrix, SaysWhatIsNoMatrix) {
  for (const auto& [name, says] : {std::pair{"Z", "Z is complex; save real(Z) and imag(Z)"},
                                   {"txt", "is a text"},
                                   {"cel", "A = cel{1}"},
                                   {"st", "A = st.A"},
                                   {"D3", "3 dimensions; a matrix has two: save D3(:, :, k)"},
                                   {"E0", "is 0 x 2"},
                                   {"N", "N has NaN in row 2, column 1"},
                                   {"P", "P has Inf in row 1, column 3"},
                                   {"i8", "has no variable 'i8'; did you mean 'I8'?"},
                                   {"", "several variables; say which by 'name': S, Z, I8"}})
    for (const char* file : {"kinds-v6.mat", "kinds-v7.mat"}) {
      const InputError error = mat_error(file, name);
      EXPECT_EQ(error.place(), kHere);
      EXPECT_NE(error.message().find(says), std::string::npos) << error.message();
    }
  EXPECT_NE(
      mat_error("plant-v4.mat", "A").message().find("no MAT file of version 5: save it again"),
      std::string::npos);
}

class MatBytes : public Folder {
 protected:
  InputError error_of(const std::string& bytes) const {
    const std::string file = write("f.mat", bytes);
    return input_error([&] { mat_matrix(bytes, file, "T1", kHere); });
  }
};

TEST_F(MatBytes, NoCutLeadsAstray) {
  for (const char* name : {"plant-v6.mat", "plant-v7.mat"}) {
    const std::string whole = read_text(data(name));
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_NE(error_of(whole.substr(0, size)).message(), "") << name << " " << size;
  }
  EXPECT_NE(error_of(read_text(data("plant-v7.mat")).substr(0, 290))
                .message()
                .find("the file is cut off within variable 3"),
            std::string::npos);
}

/// A file of version 5 with one variable A, whose parts are given.
class Version5 {
 public:
  explicit Version5(bool big_endian) : big_endian_(big_endian) {}

  std::string part(std::uint32_t type, const std::string& bytes) const {
    return word(type, 4) + word(static_cast<std::uint32_t>(bytes.size()), 4) + bytes +
           std::string((8 - bytes.size() % 8) % 8, '\0');
  }
  /// Up to four bytes within their tag.
  std::string small_part(std::uint32_t type, std::string bytes) const {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    bytes.resize(4);
    return word(size << 16U | type, 4) + bytes;
  }
  std::string words(const std::vector<std::uint64_t>& values, unsigned width) const {
    std::string result;
    for (const std::uint64_t value : values) result += word(value, width);
    return result;
  }
  std::string doubles(const std::vector<double>& values) const {
    std::string result;
    for (const double value : values) result += word(std::bit_cast<std::uint64_t>(value), 8);
    return result;
  }
  std::string file(std::uint32_t kind, std::uint32_t rows, std::uint32_t cols,
                   const std::string& data) const {
    const std::string variable = part(6, word(kind, 4) + word(0, 4)) +
                                 part(5, word(rows, 4) + word(cols, 4)) + small_part(1, "A") + data;
    return std::string(124, ' ') + word(0x0100, 2) + (big_endian_ ? "MI" : "IM") +
           part(14, variable);
  }

 private:
  std::string word(std::uint64_t value, unsigned width) const {
    std::string bytes;
    for (unsigned k = 0; k < width; ++k) bytes += static_cast<char>(value >> 8 * k);
    return big_endian_ ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  }

  bool big_endian_;
};

Texts elements_of(const std::string& bytes) {
  return mat_matrix(bytes, "f.mat", "A", kHere).matrix.elements;
}

constexpr std::uint32_t kSparse = 5, kDouble = 6, kInt16 = 10;                     // classes
constexpr std::uint32_t kByte = 2, kShort = 3, kWord = 5, kEight = 9, kLong = 13;  // types

TEST(MatVersion5, ReadsBothOrdersOfBytes) {
  for (const bool big_endian : {false, true}) {
    const Version5 v(big_endian);
    EXPECT_EQ(elements_of(v.file(kDouble, 2, 2, v.part(kEight, v.doubles({0.2, 1, -1.01, 0})))),
              (Texts{"0.2", "-1.01", "1", "0"}));
    // MATLAB writes whole numbers in as few bytes as they need.
    EXPECT_EQ(elements_of(v.file(kDouble, 1, 3, v.small_part(kByte, "\x01\x02\xFF"))),
              (Texts{"1", "2", "255"}));
    EXPECT_EQ(elements_of(v.file(kInt16, 1, 2, v.small_part(kShort, v.words({0xFFFB, 7}, 2)))),
              (Texts{"-5", "7"}));
    EXPECT_EQ(elements_of(v.file(kSparse, 2, 2,
                                 v.part(kWord, v.words({0, 1, 0}, 4)) +
                                     v.part(kWord, v.words({0, 2, 3}, 4)) +
                                     v.part(kEight, v.doubles({1, 2.5, -3})))),
              (Texts{"1", "-3", "2.5", "0"}));
  }
}

TEST(MatVersion5, RefusesNumbersThatAreNoneOfItsMatrix) {
  const Version5 v(false);
  const std::string four = v.doubles({1, 2, 3, 4});
  const auto sparse = [&](const std::vector<std::uint64_t>& rows,
                          const std::vector<std::uint64_t>& columns) {
    return v.file(kSparse, 2, 2,
                  v.part(kWord, v.words(rows, 4)) + v.part(kWord, v.words(columns, 4)) +
                      v.part(kEight, v.doubles({1, 2.5, -3})));
  };
  for (const std::string& bytes :
       {v.file(kDouble, 2, 2, v.part(0, four)), v.file(kDouble, 2, 2, v.part(kLong, four)),
        v.file(kDouble, 2, 2, v.part(kWord, four)), v.file(kDouble, 2, 3, v.part(kEight, four)),
        v.file(kDouble, 1, 3, v.part(kEight, four)), v.file(kInt16, 2, 2, v.part(kEight, four)),
        sparse({0, 2, 0}, {0, 2, 3}), sparse({1, 0, 0}, {0, 2, 3}), sparse({0, 0, 0}, {0, 2, 3}),
        sparse({0, 1, 0}, {0, 9, 3}), sparse({0, 1, 0}, {0, 2, 4}), sparse({0, 1, 0}, {1, 2, 3}),
        sparse({0, 1, 0}, {0, 2}), sparse({0, 1}, {0, 2, 3})}) {
    const InputError error = input_error([&] { elements_of(bytes); });
    EXPECT_EQ(error.place(), kHere);
    EXPECT_NE(error.message().find("f.mat: A: the file is damaged"), std::string::npos)
        << error.message();
  }
}

TEST_F(MatBytes, RefusesManyElementsByTheirSizeAlone) {
  std::string bytes = read_text(data("plant-v6.mat"));
  // The variables are followed by their flags, dimensions and names; the third one is T1.
  const std::string dimensions = bytes_of(std::int32_t{1}) + bytes_of(std::int32_t{1});
  const std::size_t at = bytes.rfind(dimensions, bytes.find("T1"));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 8, bytes_of(std::int32_t{10000}) + bytes_of(std::int32_t{10000}));
  EXPECT_NE(error_of(bytes).message().find("T1 is 10000 x 10000, of more than the 250000"),
            std::string::npos);
}

TEST_F(MatBytes, TellsOtherFilesApart) {
  std::string bytes = read_text(data("plant-v6.mat"));
  bytes.replace(124, 2, {'\0', '\2'});
  const std::string message = error_of(bytes).message();
  EXPECT_NE(message.find("version 7.3, which is not read: save it again"), std::string::npos);
  EXPECT_NE(error_of("1,2\n3,4\n").message().find("this is no MAT file"), std::string::npos);
  EXPECT_NE(error_of("").message().find("this is no MAT file"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::io
