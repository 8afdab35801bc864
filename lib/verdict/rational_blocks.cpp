#include "verdict/rational_blocks.h"

#include <stdexcept>

#include "base/stop.h"
#include "expr/program/evaluate.h"
#include "model/gains.h"
#include "numbers/dense/rational_algebra.h"
#include "verdict/stated_point.h"

namespace gainsmith::verdict {

namespace {

using numbers::RationalMatrix;
using numbers::RationalValues;

RationalMatrix zeros(const expr::Shape& shape) {
  return RationalMatrix::Constant(shape.rows, shape.cols, Rational(0));
}

/// The values of a block's variables, those that the file states as it states them.
void add_point(const lmi::Statement& statement, const lmi::Block& block, RationalValues& values) {
  const RationalValues known = values;
  for (std::size_t v = 0; v < statement.domain.size(); ++v) {
    const std::string& name = statement.domain[v].name;
    const numbers::Matrix& at = block.where->values.at(name);
    const expr::Program* stated = stated_at(statement, v, block, [&](const auto& text, End end) {
      const Rational value = numbers::rational_value(text, known)(0);
      return end == End::low ? Rational(at(0, 0)) <= value : Rational(at(0, 0)) >= value;
    });
    values[name] = stated != nullptr
                       ? numbers::rational_value(*stated, known)
                       : at.unaryExpr([](double x) { return printed_fraction(x); }).eval();
  }
}

void add_term(int i, RationalMatrix matrix, RationalBlock& result) {
  if (!numbers::is_rational_zero(matrix)) result.terms.emplace_back(i, std::move(matrix));
}

/// EvaluationError where something has no fraction.
/// B_0 = B(0) and B_i = B(e_i) - B(0), each the symmetric part of the text's value: m + 1
/// evaluations in fractions.
RationalBlock evaluated(const lmi::Inequalities& of, const lmi::Block& block,
                        RationalValues values) {
  const lmi::Statement& statement = of.statements[block.inequality];
  const expr::Program& program = statement.differences[block.comparison];
  add_point(statement, block, values);
  for (const lmi::Unknown& unknown : of.unknowns.list())
    values[unknown.name] = zeros(unknown.shape);
  numbers::require_fractions(program);
  expr::Evaluator<numbers::RationalNumbers> evaluator(program);
  for (const expr::Input& input : program.inputs) {
    const auto found = values.find(input.name);
    if (found == values.end())
      throw expr::EvaluationError("the value of " + input.name + " has no exact fraction");
    if (of.unknowns.find(input.name) != nullptr)
      evaluator.set(input.name, found->second);
    else
      evaluator.fix(input.name, found->second);
  }
  RationalBlock result{block.size, block.strict, true, {}};
  const RationalMatrix constant = numbers::rational_symmetric_part(evaluator.run());
  add_term(0, constant, result);
  for (const lmi::Unknown& unknown : of.unknowns.list()) {
    if (program.input(unknown.name) < 0) continue;
    RationalMatrix& value = values.at(unknown.name);
    for (int k = 0; k < unknown.count; ++k) {
      check_stop();
      for (const auto& [row, column] : unknown.places(k)) value(row, column) = 1;
      add_term(unknown.first + k, numbers::rational_symmetric_part(evaluator.run()) - constant,
               result);
      for (const auto& [row, column] : unknown.places(k)) value(row, column) = 0;
    }
  }
  return result;
}

/// The coefficients in double as fractions, where the text has none: `exact` is false.
RationalBlock rounded(const lmi::Block& block) {
  RationalBlock result{block.size, block.strict, false, {}};
  for (const auto& [i, matrix] : block.terms) {
    RationalMatrix term = zeros({block.size, block.size});
    for (int c = 0; c < matrix.outerSize(); ++c)
      for (lmi::Sparse::InnerIterator it(matrix, c); it; ++it)
        term(it.row(), it.col()) = Rational(it.value());
    result.terms.emplace_back(i, std::move(term));
  }
  return result;
}

}  // namespace

RationalMatrix RationalBlock::value(const std::vector<Rational>& x) const {
  RationalMatrix sum = zeros({size, size});
  for (const auto& [i, matrix] : terms) {
    const Rational factor = i == 0 ? Rational(1) : x[static_cast<std::size_t>(i) - 1];
    if (factor == 0) continue;
    for (Eigen::Index e = 0; e < sum.size(); ++e)
      if (matrix(e) != 0) sum(e) += factor * matrix(e);
  }
  return sum;
}

ExactBlock<DoubleDouble> exact_block(const RationalBlock& block, const lmi::Balance& balance,
                                     std::size_t at, const std::vector<int>& kept) {
  ExactBlock<DoubleDouble> result{static_cast<int>(kept.size()), {}};
  for (const auto& [i, matrix] : block.terms) {
    ExactElements<DoubleDouble> elements;
    for (int c = 0; c < result.size; ++c)
      for (int r = 0; r < result.size; ++r) {
        const int row = kept[static_cast<std::size_t>(r)];
        const int column = kept[static_cast<std::size_t>(c)];
        if (matrix(row, column) == 0) continue;
        const auto ball = numbers::scaled(numbers::ball_of(matrix(row, column)),
                                          balance.factor(at, row, column, i));
        elements.push_back({r, c, ball.mid, ball.rad});
      }
    if (!elements.empty()) result.terms.emplace_back(i, std::move(elements));
  }
  return result;
}

Rational printed_fraction(double value) {
  const auto fraction = parse_rational(model::printed(value));
  if (!fraction) throw std::invalid_argument("not a number that is printed");
  return *fraction;
}

RationalValues rational_values(const model::Instance& instance) {
  RationalValues values;
  const model::Design& design = *instance.design;
  for (const model::Design::Datum* one : in_order(design)) {
    const model::Design::Datum& datum = *one;
    const auto overridden = instance.overrides.find(datum.name);
    if (overridden != instance.overrides.end()) {
      values[datum.name] = RationalMatrix::Constant(1, 1, printed_fraction(overridden->second));
      continue;
    }
    if (!datum.value) continue;
    try {
      const RationalMatrix value = numbers::rational_value(datum.value->program, values);
      const bool symmetric = datum.structure == model::Structure::symmetric ||
                             datum.structure == model::Structure::diagonal;
      values[datum.name] = symmetric ? numbers::rational_symmetric_part(value) : value;
    } catch (const expr::EvaluationError&) {
      continue;
    }
  }
  return values;
}

std::vector<RationalBlock> rational_blocks(const lmi::Inequalities& of,
                                           const std::vector<lmi::Block>& blocks) {
  const RationalValues values = rational_values(of.instance);
  std::vector<RationalBlock> result;
  for (const lmi::Block& block : blocks) {
    try {
      result.push_back(block.where ? evaluated(of, block, values) : rounded(block));
    } catch (const expr::EvaluationError&) {
      result.push_back(rounded(block));
    }
  }
  return result;
}

}  // namespace gainsmith::verdict
