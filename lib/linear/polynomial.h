// Programs as polynomials in what they are made of, so that equal terms cancel exactly.
//
//   (A - L*C)*zh + L*C*z  with  zh = z - d   is   A z - A d + L C d
//
// because L C z - L C z is nothing here. In any arithmetic A - fl(L C) - fl(A - L C) is not 0 and
// would multiply a large z. A polynomial is a sum of words with whole coefficients, a word a
// product of atoms: inputs, decimals, and values of functions that are no sums or products (exp,
// inv, expm, where, ...). Products of matrices keep their order, 1 x 1 factors commute. A part of
// a sum is the sum of the parts, and so are blocks. No numbers of the data are used: what cancels,
// cancels for all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "expr/program/program.h"

namespace gainsmith::linear {

/// An atom or its transpose.
struct Factor {
  int atom = 0;
  bool transposed = false;
  auto operator<=>(const Factor&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// A product of factors, left to right.
using Chain = std::vector<Factor>;

/// The product of 1 x 1 atoms, of 1 x 1 chains, and of one chain of the polynomial's shape; an
/// empty chain of that shape is the identity. A part of a chain that is 1 x 1 is an inner chain of
/// its own: with a row C, L*C*z is the chain L and the inner chain C z.
struct Word {
  std::vector<int> scalars;  ///< sorted
  std::vector<Chain> inner;  ///< sorted; each the lesser of itself and its transpose
  Chain chain;
  auto operator<=>(const Word&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct Polynomial {
  expr::Shape shape;
  std::map<Word, std::int64_t> terms;
};

/// Polynomials over one table of atoms.
class Polynomials {
 public:
  /// The program's value. std::length_error when it has more than kMostWords words.
  Polynomial of(const expr::Program& program);

  /// A program for the polynomial.
  expr::Program program(const Polynomial& polynomial) const;
  /// The atom as a program.
  const expr::Program& atom(int at) const { return atoms_[static_cast<std::size_t>(at)]; }
  /// How many factors of the word are the input `name`.
  int degree(const Word& word, const std::string& name) const;

 private:
  int atom_of(const expr::Program& program);
  Polynomial of_atom(int atom);
  expr::Shape shape_of(const Factor& factor) const;
  /// Moves the 1 x 1 parts of the chain to the inner chains.
  void split(Word& word) const;
  Polynomial multiply(const Polynomial& a, const Polynomial& b, expr::Shape shape) const;
  static Polynomial transpose(const Polynomial& a);
  Polynomial of_instruction(const expr::Program& program, std::size_t at,
                            const std::vector<Polynomial>& values);
  Polynomial of_blocks(const expr::Instruction& instruction, const std::vector<Polynomial>& values);
  Polynomial word_by_word(const Polynomial& value,
                          const std::function<expr::Program(const expr::Program&)>& linear);

  std::vector<expr::Program> atoms_;
  std::map<std::string, int> known_;
};

/// The program with inputs replaced by programs of the same shape over its other inputs.
expr::Program replace_inputs(const expr::Program& program,
                             const std::map<std::string, expr::Program>& by);

/// The program of a - b.
expr::Program difference(const expr::Program& a, const expr::Program& b);

}  // namespace gainsmith::linear
