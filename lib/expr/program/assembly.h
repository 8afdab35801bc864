// A program under construction.
//
// Instructions are numbered by value: one that is added twice is there once. So a subexpression
// that a text repeats, or that two texts share, is computed once.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "expr/program/program.h"

namespace gainsmith::expr {

/// Collects instructions, equal ones once, and takes programs out of them.
/// It only grows; indices of instructions stay valid.
class Assembly {
 public:
  /// Adds an instruction whose operands are here already, unless there is one like it; its index.
  /// std::logic_error when its shapes are not as the operation's rule says.
  int add(Instruction instruction);
  /// The instruction that reads an input. `like` gives its place.
  int add_input(const std::string& name, Shape shape, const Instruction& like);
  /// The instruction that calls a function of the given shape; `like` gives its place and text.
  int add_call(const std::string& name, Shape shape, int argument, const Instruction& like);

  /// Adds a program: where each of its instructions is then. replace(one, copy) gives what takes
  /// the place of one, if anything does; the copy has its operands here.
  template <class Replace>
  std::vector<int> add_all(const Program& program, const Replace& replace) {
    std::vector<int> places;
    places.reserve(program.code.size());
    for (const Instruction& one : program.code) {
      Instruction copy = moved(one, places);
      const std::optional<int> other = replace(one, copy);
      places.push_back(other ? *other : add_copy(program, std::move(copy)));
    }
    return places;
  }
  /// Where its result is then.
  template <class Replace>
  int add_program(const Program& program, const Replace& replace) {
    return add_all(program, replace)[static_cast<std::size_t>(program.result)];
  }
  int add_program(const Program& program);

  const Instruction& operator[](int at) const {
    return program_.code[static_cast<std::size_t>(at)];
  }
  Shape shape(int at) const { return (*this)[at].shape; }
  /// Of an instruction that reads one.
  const std::string& input_name(const Instruction& input) const {
    return program_.input_of(input).name;
  }
  int size() const { return static_cast<int>(program_.code.size()); }

  /// The program that computes `at`, without the instructions that it does not need.
  Program extract(int at) const;

 private:
  using Key = std::tuple<Op, std::vector<int>, int, int, Attributes, std::string, int>;

  int add_copy(const Program& program, Instruction copy);

  Program program_;
  Bodies bodies_;
  std::map<Key, int> known_;
};

}  // namespace gainsmith::expr
