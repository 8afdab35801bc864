// Files of NumPy (NEP 1): "\x93NUMPY", the version, the length of the header in 2 bytes or, from
// version 2 on, in 4; then the header as a mapping of Python, and the elements.
#include "io/matrix/npy_matrix.h"

#include <cctype>
#include <string_view>
#include <vector>

namespace gainsmith::io {

namespace {

using namespace std::string_view_literals;

/// The header of a file.
struct Layout {
  std::string type;  ///< "<f8"
  bool by_columns = false;
  std::vector<double> shape;
  std::size_t data = 0;  ///< where the elements begin
};

class NpyReader {
 public:
  NpyReader(const std::string& bytes, const std::string& path, const Place& place)
      : bytes_(bytes), path_(path), what_(path + ": the array"), place_(place) {}

  FileMatrix read() const {
    const Layout layout = header();
    const bool list = layout.shape.size() == 1;
    const double rows = list || layout.shape.empty() ? 1 : layout.shape[0];
    const double cols = layout.shape.empty() ? 1 : layout.shape.back();
    model::StatedMatrix matrix = sized_matrix(rows, cols, what_, place_);
    matrix.flat = list;
    const std::size_t width = width_of(layout.type);
    const auto elements = static_cast<std::size_t>(rows * cols);
    const std::size_t there = bytes_.size() - layout.data;
    if (there != elements * width)
      refuse((there < elements * width ? "the file is cut off: it has "
                                       : "the file has more than its array: ") +
             std::to_string(there) + " bytes of elements, expected " +
             std::to_string(elements * width));
    const auto height = static_cast<std::size_t>(matrix.rows);
    const auto breadth = static_cast<std::size_t>(matrix.cols);
    for (std::size_t i = 0; i < height; ++i)
      for (std::size_t j = 0; j < breadth; ++j) {
        const std::size_t at = layout.by_columns ? j * height + i : i * breadth + j;
        add_stored(layout.type[1], std::string_view(bytes_).substr(layout.data + at * width, width),
                   layout.type[0] == '>', what_, place_, matrix);
      }
    return {matrix};
  }

 private:
  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(place_, path_ + ": " + message);
  }

  /// The order of elements, their type and the shape, all of which the header must have.
  Layout header() const {
    constexpr auto kMagic = "\x93NUMPY"sv;
    if (!bytes_.starts_with(kMagic))
      refuse("this is no .npy file; expected what numpy.save writes");
    if (bytes_.size() < 12) refuse("the file is cut off in its header");
    const int version = bytes_[kMagic.size()];
    if (version < 1 || version > 3)
      refuse("version " + std::to_string(version) + " of .npy files is not known; expected 1 to 3");
    const std::size_t count = version == 1 ? 2 : 4;
    const std::size_t begin = kMagic.size() + 2 + count;
    const auto length = static_cast<std::size_t>(
        word_of(std::string_view(bytes_).substr(begin - count, count), false));
    if (bytes_.size() - begin < length) refuse("the file is cut off in its header");
    const std::string text = bytes_.substr(begin, length);
    Layout layout;
    layout.data = begin + length;
    layout.type = type_of(value_of(text, "descr"));
    layout.by_columns = value_of(text, "fortran_order").starts_with("True");
    layout.shape = shape_of(value_of(text, "shape"));
    return layout;
  }

  /// What follows a key of the header, which is a mapping as Python writes it.
  std::string value_of(const std::string& text, const std::string& key) const {
    const std::size_t at = text.find("'" + key + "':");
    if (at == std::string::npos) refuse("the header has no '" + key + "'");
    const std::size_t begin = text.find_first_not_of(' ', at + key.size() + 3);
    if (begin == std::string::npos) refuse("the header is cut off behind '" + key + "'");
    return text.substr(begin);
  }

  /// A type such as "<f8": order of bytes, kind, bytes of an element.
  std::string type_of(const std::string& value) const {
    if (value[0] == '[') refuse("the array has named fields; save the field that is the matrix");
    const std::string type = value.substr(1, value.find('\'', 1) - 1);
    if (type.size() < 2 || std::string("<>|=").find(type[0]) == std::string::npos)
      refuse("the type '" + type + "' of the elements is not known");
    const char kind = type[1];
    if (kind == 'c') refuse("the array is complex; save A.real and A.imag");
    if (kind == 'O') refuse("the elements are Python objects; save numpy.array(A, dtype=float)");
    if (std::string("fiub").find(kind) == std::string::npos || width_of(type) == 0)
      refuse("the elements of type '" + type +
             "' are no numbers that can be read; save "
             "numpy.array(A, dtype=float)");
    return type;
  }

  /// Bytes of an element; 0 when there is no such type.
  static std::size_t width_of(const std::string& type) {
    const std::string width = type.substr(2);
    const bool real = type[1] == 'f';
    for (const std::size_t known : {1U, 2U, 4U, 8U})
      if (width == std::to_string(known)) return real && known < 4 ? 0 : known;
    return 0;
  }

  /// A tuple of Python, at most two whole numbers: "(3, 2)", "(3,)", "()".
  std::vector<double> shape_of(const std::string& value) const {
    std::vector<double> shape;
    const std::size_t close = value.find(')');
    if (value[0] != '(' || close == std::string::npos) refuse("the header has no shape");
    if (value.find_first_not_of("0123456789, ", 1) < close)
      refuse("the shape '" + value.substr(0, close + 1) + "' is none");
    for (std::size_t at = 1; at < close; ++at) {
      if (std::isdigit(static_cast<unsigned char>(value[at])) == 0) continue;
      double size = 0;
      for (; std::isdigit(static_cast<unsigned char>(value[at])) != 0; ++at)
        size = 10 * size + (value[at] - '0');
      shape.push_back(size);
    }
    if (shape.size() > 2)
      refuse("the array has " + std::to_string(shape.size()) +
             " dimensions; a matrix has two: save one A[k] of it");
    return shape;
  }

  const std::string& bytes_;
  const std::string& path_;
  std::string what_;
  const Place& place_;
};

}  // namespace

FileMatrix npy_matrix(const std::string& bytes, const std::string& path, const Place& place) {
  return NpyReader(bytes, path, place).read();
}

}  // namespace gainsmith::io
