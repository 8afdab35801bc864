// A program under construction.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "expr/program.h"

namespace gainsmith::expr {

/// Collects instructions, equal ones once, and takes programs out of them.
class Assembly {
 public:
  /// Adds an instruction whose operands are here already, unless there is one like it; its index.
  /// std::logic_error when its shapes are not as the operation's rule says.
  int add(Instruction instruction);
  /// The instruction that reads an input. `like` gives its place.
  int add_input(const std::string& name, Shape shape, const Instruction& like);
  /// The instruction that calls a function of the given shape; `like` gives its place and text.
  int add_call(const std::string& name, Shape shape, int argument, const Instruction& like);

  const Instruction& operator[](int at) const {
    return program_.code[static_cast<std::size_t>(at)];
  }
  Shape shape(int at) const { return (*this)[at].shape; }
  /// Of an instruction that reads one.
  const std::string& input_name(const Instruction& input) const {
    return program_.inputs[static_cast<std::size_t>(input.attributes[0])].name;
  }
  int size() const { return static_cast<int>(program_.code.size()); }

  /// The program that computes `at`, without the instructions that it does not need.
  Program extract(int at) const;

 private:
  using Key = std::tuple<Op, std::vector<int>, int, int, Attributes, std::string, int>;

  /// Which of the bodies it is; equal ones are the same. -1: none.
  int number_of(const std::shared_ptr<const Program>& body);

  Program program_;
  std::vector<std::shared_ptr<const Program>> bodies_;
  std::map<Key, int> known_;
};

}  // namespace gainsmith::expr
