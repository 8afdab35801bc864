// An expression after names and shapes are known: a straight-line program over matrices, to be
// evaluated over any number type (see evaluate.h).
//
// The room is the matrix language, from characters to numbers:
//
//   text.h, lexer.h, parser.h, ast.h   a text with its places, tokens, the syntax tree
//   scope.h, compile.h, binder.h       names and shapes; a program of each text
//   operations.def, operations.h       the table of operations, and the shapes of their results
//   evaluate.h, number_type.h          the value of a program over a number type
//   rewrite.h, substitute.h            programs with parts replaced
//   derivative.h, branches.h           derivatives by rules; where a program is not smooth
//
// A program has no control flow, and no names but those of its inputs and of functions that are
// linked later. Decimals are kept as written until a number type rounds them. So the same program
// is evaluated in double, in 100 digits and in enclosures. Every instruction knows where it was
// written, for messages.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "expr/program/operations.h"
#include "expr/text/text.h"

namespace gainsmith::expr {

struct Program;

/// One operation. Its operands are indices of earlier instructions of the same program, so that a
/// program is evaluated from its first instruction to its last.
struct Instruction {
  Op op = Op::constant;
  std::vector<int> operands;  ///< earlier instructions
  Shape shape;                ///< of the result
  Attributes attributes{};
  std::string text;  ///< constant: the decimal as written; inverse: of what; call: as written;
                     ///< extremum: the names that run over the box; quotient, log, sqrt: what is
                     ///< said where there is no result (number_type.h)
  std::shared_ptr<const Text> origin;
  std::size_t offset = 0;  ///< where in the origin it was written
  /// jacobian: what is differentiated; its inputs are the operands. flow_map: the rate.
  /// project_convex: what is to be <= 0. extremum: what is maximised.
  std::shared_ptr<const Program> body = nullptr;

  Place place() const { return origin ? origin->place(offset) : Place{}; }
};

/// A matrix that a program reads, by name.
struct Input {
  std::string name;
  Shape shape;
};

/// An operation that was written where `like` was.
Instruction made(Op op, std::vector<int> operands, Shape shape, const Instruction& like,
                 Attributes attributes = {});

/// An instruction whose operands have moved: operand k is to[k] now.
Instruction moved(Instruction instruction, const std::vector<int>& to);

/// Code, what it reads, and which instruction is the result. `code` is not empty in a program that
/// is compiled; an empty one represents the number 1 in combination() (rewrite.h).
struct Program {
  std::vector<Instruction> code;
  std::vector<Input> inputs;
  std::vector<Input> functions;  ///< what is called, with the shape of its values
  int result = -1;               ///< the instruction whose value is the program's

  Shape shape() const { return code[static_cast<std::size_t>(result)].shape; }
  /// The position of an input, or -1.
  int input(const std::string& name) const;
  bool uses(const std::string& name) const { return input(name) >= 0; }
  /// What an instruction of the program reads.
  const Input& input_of(const Instruction& reading) const {
    return inputs[static_cast<std::size_t>(reading.attributes[0])];
  }
};

/// The names of the inputs of a body (jacobian, extremum): what it is a function of, from 0, and
/// the rest.
std::string variable_name(std::size_t k);
std::string other_name(std::size_t k);

/// Whether two programs compute the same by the same instructions; places do not count.
bool is_same(const Program& a, const Program& b);

/// Bodies by number; the same number for those that compute the same.
class Bodies {
 public:
  /// -1: no body.
  int number_of(const std::shared_ptr<const Program>& body);

 private:
  std::vector<std::shared_ptr<const Program>> known_;
};

}  // namespace gainsmith::expr
