#include "linear/polynomial.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "expr/program/assembly.h"
#include "expr/program/rewrite.h"
#include "linear/tolerances.h"

namespace gainsmith::linear {

namespace {

using expr::Instruction;
using expr::Op;
using expr::Program;
using expr::Shape;

/// A text that two programs share when they are instruction for instruction the same.
void append_key(const Program& program, std::string& key) {
  for (const Instruction& instruction : program.code) {
    key += std::to_string(static_cast<int>(instruction.op)) + ':';
    const bool input = instruction.op == Op::input;
    if (input) key += program.input_of(instruction).name;
    if (instruction.op == Op::constant) key += instruction.text;
    for (const int operand : instruction.operands) key += ',' + std::to_string(operand);
    if (!input)
      for (const int attribute : instruction.attributes) key += '.' + std::to_string(attribute);
    key += '|' + std::to_string(instruction.shape.rows) + 'x' +
           std::to_string(instruction.shape.cols) + ';';
    if (instruction.body) append_key(*instruction.body, key);
  }
  key += std::to_string(program.result);
}

/// Adds a program, inputs replaced by what `by` gives for them; the index of its result.
int add_program(expr::Assembly& assembly, const Program& program,
                const std::map<std::string, Program>& by) {
  const auto replace = [&](const Instruction& instruction,
                           const Instruction&) -> std::optional<int> {
    if (instruction.op != Op::input) return std::nullopt;
    const auto found = by.find(program.input_of(instruction).name);
    if (found == by.end()) return std::nullopt;
    return assembly.add_program(found->second);
  };
  return assembly.add_program(program, replace);
}

/// A coefficient that becomes 0 leaves the sum: this is where equal terms cancel.
void add_term(Polynomial& sum, Word word, std::int64_t coefficient) {
  if (coefficient == 0) return;
  const auto [found, fresh] = sum.terms.emplace(std::move(word), coefficient);
  if (!fresh && (found->second += coefficient) == 0) sum.terms.erase(found);
  if (sum.terms.size() > kMostWords) throw std::length_error("a polynomial of too many terms");
}

void add_to(Polynomial& sum, const Polynomial& other, std::int64_t factor) {
  for (const auto& [word, coefficient] : other.terms) add_term(sum, word, factor * coefficient);
}

Chain transposed(const Chain& chain) {
  Chain result(chain.rbegin(), chain.rend());
  for (Factor& factor : result) factor.transposed = !factor.transposed;
  return result;
}

Program single(Op op, Shape shape) {
  expr::Composer compose({});
  return compose.take(compose.apply(op, {}, shape));
}

}  // namespace

Program difference(const Program& a, const Program& b) {
  expr::Composer compose({});
  const int first = compose.program(a);
  const int second = compose.program(b);
  return compose.take(compose.apply(Op::subtract, {first, second}, a.shape()));
}

Program replace_inputs(const Program& program, const std::map<std::string, Program>& by) {
  expr::Assembly assembly;
  return assembly.extract(add_program(assembly, program, by));
}

int Polynomials::atom_of(const Program& program) {
  std::string key;
  append_key(program, key);
  const auto [found, fresh] = known_.emplace(key, static_cast<int>(atoms_.size()));
  if (fresh) atoms_.push_back(program);
  return found->second;
}

Polynomial Polynomials::of_atom(int atom) {
  Polynomial result{atoms_[static_cast<std::size_t>(atom)].shape(), {}};
  Word word;
  if (result.shape.is_scalar()) {
    word.scalars = {atom};
  } else {
    word.chain = {{atom, false}};
  }
  result.terms.emplace(std::move(word), 1);
  return result;
}

Polynomial Polynomials::transpose(const Polynomial& a) {
  Polynomial result{{a.shape.cols, a.shape.rows}, {}};
  for (const auto& [word, coefficient] : a.terms)
    add_term(result, {word.scalars, word.inner, transposed(word.chain)}, coefficient);
  return result;
}

Shape Polynomials::shape_of(const Factor& factor) const {
  const Shape shape = atom(factor.atom).shape();
  return factor.transposed ? Shape{shape.cols, shape.rows} : shape;
}

void Polynomials::split(Word& word) const {
  Chain rest;
  Chain part;
  for (const Factor& factor : word.chain) {
    part.push_back(factor);
    if (shape_of(factor).cols != 1) continue;
    if (shape_of(part.front()).rows == 1) {
      word.inner.push_back(std::min(part, transposed(part)));
    } else {
      rest.insert(rest.end(), part.begin(), part.end());
    }
    part.clear();
  }
  rest.insert(rest.end(), part.begin(), part.end());
  word.chain = std::move(rest);
  std::sort(word.inner.begin(), word.inner.end());
}

/// The product of each pair of words: 1 x 1 factors are sorted, chains are joined.
Polynomial Polynomials::multiply(const Polynomial& a, const Polynomial& b, Shape shape) const {
  Polynomial result{shape, {}};
  for (const auto& [x, cx] : a.terms)
    for (const auto& [y, cy] : b.terms) {
      Word word = x;
      word.scalars.insert(word.scalars.end(), y.scalars.begin(), y.scalars.end());
      std::sort(word.scalars.begin(), word.scalars.end());
      word.inner.insert(word.inner.end(), y.inner.begin(), y.inner.end());
      word.chain.insert(word.chain.end(), y.chain.begin(), y.chain.end());
      split(word);
      add_term(result, std::move(word), cx * cy);
    }
  return result;
}

/// The value of a linear function of a matrix: of each word's chain, its 1 x 1 factors aside.
Polynomial Polynomials::word_by_word(const Polynomial& value,
                                     const std::function<Program(const Program&)>& linear) {
  Polynomial result;
  for (const auto& [word, coefficient] : value.terms) {
    // f(s C) = s f(C) for 1 x 1 factors s and the chain C.
    Polynomial chain{value.shape, {{Word{{}, {}, word.chain}, 1}}};
    Polynomial factor{{1, 1}, {{Word{word.scalars, word.inner, {}}, coefficient}}};
    if (value.shape.is_scalar()) {
      chain.terms = {{word, 1}};
      factor.terms = {{Word{}, coefficient}};
    }
    const Polynomial image = of_atom(atom_of(linear(program(chain))));
    result.shape = image.shape;
    add_to(result, multiply(factor, image, image.shape), 1);
  }
  return result;
}

/// The sum of the blocks, each with zeros around it.
Polynomial Polynomials::of_blocks(const Instruction& instruction,
                                  const std::vector<Polynomial>& values) {
  Polynomial result{instruction.shape, {}};
  for (std::size_t k = 0; k < instruction.operands.size(); ++k) {
    const auto alone = [&](const Program& block) {
      expr::Composer compose({});
      std::vector<int> operands;
      for (std::size_t i = 0; i < instruction.operands.size(); ++i) {
        const Polynomial& other = values[static_cast<std::size_t>(instruction.operands[i])];
        operands.push_back(i == k ? compose.program(block)
                                  : compose.apply(Op::zeros, {}, other.shape));
      }
      return compose.take(
          compose.apply(Op::blocks, operands, instruction.shape, instruction.attributes));
    };
    add_to(result, word_by_word(values[static_cast<std::size_t>(instruction.operands[k])], alone),
           1);
  }
  return result;
}

/// Sums, products, powers up to 4, transposes, parts and blocks are expanded. Anything else is an
/// atom.
Polynomial Polynomials::of_instruction(const Program& program, std::size_t at,
                                       const std::vector<Polynomial>& values) {
  const Instruction& instruction = program.code[at];
  const auto value = [&](std::size_t i) -> const Polynomial& {
    return values[static_cast<std::size_t>(instruction.operands[i])];
  };
  const auto as_atom = [&] {
    expr::Assembly assembly;
    Instruction same = instruction;
    if (same.op == Op::input) {
      const expr::Input& input = program.input_of(same);
      return of_atom(
          atom_of(assembly.extract(assembly.add_input(input.name, input.shape, instruction))));
    }
    for (std::size_t i = 0; i < same.operands.size(); ++i)
      same.operands[i] = assembly.add_program(this->program(value(i)));
    return of_atom(atom_of(assembly.extract(assembly.add(std::move(same)))));
  };
  Polynomial result{instruction.shape, {}};
  switch (instruction.op) {
    case Op::zeros:
      return result;
    case Op::constant: {
      if (instruction.text == "0") return result;
      if (instruction.text == "1") {
        result.terms.emplace(Word{}, 1);
        return result;
      }
      return as_atom();
    }
    case Op::identity:
      for (const auto& [word, coefficient] : value(0).terms) add_term(result, word, coefficient);
      return result;
    case Op::add:
    case Op::subtract:
      result = value(0);
      add_to(result, value(1), instruction.op == Op::add ? 1 : -1);
      return result;
    case Op::negate:
      add_to(result, value(0), -1);
      return result;
    case Op::multiply:
    case Op::scale:
      return multiply(value(0), value(1), instruction.shape);
    case Op::power: {
      if (instruction.attributes[0] < 1 || instruction.attributes[0] > 4) return as_atom();
      result = value(0);
      for (int k = 1; k < instruction.attributes[0]; ++k)
        result = multiply(result, value(0), instruction.shape);
      return result;
    }
    case Op::transpose:
      return transpose(value(0));
    case Op::index: {
      result = word_by_word(value(0), [&](const Program& matrix) {
        expr::Composer compose({});
        return compose.take(compose.apply(Op::index, {compose.program(matrix)}, instruction.shape,
                                          instruction.attributes));
      });
      result.shape = instruction.shape;
      return result;
    }
    case Op::blocks:
      return of_blocks(instruction, values);
    default:
      return as_atom();
  }
}

Polynomial Polynomials::of(const Program& program) {
  std::vector<Polynomial> values;
  for (std::size_t at = 0; at < program.code.size(); ++at)
    values.push_back(of_instruction(program, at, values));
  return values[static_cast<std::size_t>(program.result)];
}

Program Polynomials::program(const Polynomial& polynomial) const {
  expr::Composer compose({});
  const auto product = [&](const Chain& chain) {
    int result = -1;
    int rows = 0;
    for (const Factor& factor : chain) {
      const Shape shape = shape_of(factor);
      int next = compose.program(atom(factor.atom));
      if (factor.transposed) next = compose.apply(Op::transpose, {next}, shape);
      if (result < 0) rows = shape.rows;
      result = result < 0 ? next : compose.apply(Op::multiply, {result, next}, {rows, shape.cols});
    }
    return result;
  };
  int sum = -1;
  for (const auto& [word, coefficient] : polynomial.terms) {
    int factor = -1;
    const auto times = [&](int next) {
      factor = factor < 0 ? next : compose.apply(Op::multiply, {factor, next});
    };
    const std::int64_t size = coefficient < 0 ? -coefficient : coefficient;
    if (size != 1) times(compose.number(std::to_string(size)));
    for (const int scalar : word.scalars) times(compose.program(atom(scalar)));
    for (const Chain& chain : word.inner) times(product(chain));
    int term = product(word.chain);
    if (term < 0) {
      if (factor < 0) factor = compose.number("1");
      term = polynomial.shape.is_scalar() ? factor
                                          : compose.apply(Op::identity, {factor}, polynomial.shape);
    } else if (factor >= 0) {
      term = compose.apply(Op::scale, {factor, term}, polynomial.shape);
    }
    if (coefficient < 0 && sum < 0) term = compose.apply(Op::negate, {term}, polynomial.shape);
    sum = sum < 0 ? term
                  : compose.apply(coefficient < 0 ? Op::subtract : Op::add, {sum, term},
                                  polynomial.shape);
  }
  return sum < 0 ? single(Op::zeros, polynomial.shape) : compose.take(sum);
}

int Polynomials::degree(const Word& word, const std::string& name) const {
  const auto is_input = [&](int at) {
    const Program& program = atom(at);
    return program.code.size() == 1 && program.code[0].op == Op::input &&
           program.inputs[0].name == name;
  };
  int count = 0;
  for (const int scalar : word.scalars) count += is_input(scalar) ? 1 : 0;
  const auto add = [&](const Chain& chain) {
    for (const Factor& factor : chain) count += is_input(factor.atom) ? 1 : 0;
  };
  for (const Chain& chain : word.inner) add(chain);
  add(word.chain);
  return count;
}

}  // namespace gainsmith::linear
