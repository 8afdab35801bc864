// Where things are in a JSON text: nlohmann's reader says it of syntax errors only.
#pragma once

#include <cstddef>
#include <iterator>
#include <string>

#include "base/error.h"

namespace gainsmith::io {

/// Reads a text and counts, in a number of its owner, the bytes that were read.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t& read) : at_(at), read_(&read) {}

  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*read_;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  std::size_t* read_;
};

/// The line and column of a byte.
Place place_of(const std::string& text, const std::string& file, std::size_t byte);

/// Where the key, or the element of a list, begins that `path` leads to ("margins[2].name"). The
/// file alone when there is none.
Place place_in(const std::string& text, const std::string& file, const std::string& path);

}  // namespace gainsmith::io
