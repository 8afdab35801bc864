#include "lmi/exact.h"

#include <cmath>
#include <string>

#include "base/scalars.h"
#include "lmi/printed_check.h"

namespace gainsmith::lmi {

namespace {

using numbers::Enclosed;
using numbers::EnclosedValues;

/// Element (i, j) times the exact power of two `factor(i, j)`.
template <class S, class Factor>
void scale(Enclosed<S>& matrix, Factor factor) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const double by = factor(static_cast<int>(i), static_cast<int>(j));
      matrix.mid(i, j) = matrix.mid(i, j) * S(by);
      matrix.rad(i, j) = matrix.rad(i, j) * by;
    }
}

}  // namespace

template <class S>
ExactBlocks<S>::ExactBlocks(const Inequalities& of, const Balance& balance)
    : of_(of), balance_(balance), values_(enclosed_values<S>(of.instance)) {}

template <class S>
EnclosedValues<S> ExactBlocks<S>::values_at(const Block& block) const {
  EnclosedValues<S> values = values_;
  const Statement& statement = of_.statements[block.inequality];
  for (std::size_t v = 0; v < statement.domain.size(); ++v) {
    const forall::Variable& variable = statement.domain[v];
    const auto& stated = statement.stated->domain[v].points;
    const numbers::Matrix& at = block.where->values.at(variable.name);
    // A point of the domain that the file states is meant as it is written there.
    const expr::Program* program = nullptr;
    if (variable.is_interval()) {
      // An end stands for that of the file, and so does what rounding put outside of it.
      const S t(at(0, 0));
      const Enclosed<S> low = numbers::enclose(stated[0].program, values_);
      const Enclosed<S> high = numbers::enclose(stated[1].program, values_);
      if (at(0, 0) == variable.low || !(t > low.mid(0, 0) + S(low.rad(0, 0))))
        program = &stated[0].program;
      if (at(0, 0) == variable.high || !(t < high.mid(0, 0) - S(high.rad(0, 0))))
        program = &stated[1].program;
    } else {
      for (std::size_t e = 0; e < variable.elements.size() && program == nullptr; ++e)
        if (variable.elements[e] == at) program = &stated[e].program;
    }
    values[variable.name] = program != nullptr
                                ? numbers::enclose(*program, values_)
                                : numbers::exactly<S>(at.unaryExpr([](double x) { return S(x); }));
  }
  return values;
}

template <class S>
ExactBlock<S> ExactBlocks<S>::block(const Block& block, std::size_t at,
                                    const std::vector<int>& kept) const {
  const Statement& statement = of_.statements[block.inequality];
  const expr::Program& program = statement.differences[block.comparison];
  EnclosedValues<S> values = values_at(block);
  for (const Unknown& unknown : of_.unknowns.list())
    values[unknown.name] =
        numbers::exactly<S>(numbers::MatrixOf<S>::Zero(unknown.shape.rows, unknown.shape.cols));
  expr::Evaluator<numbers::Enclosure<S>> evaluator(program);
  for (const expr::Input& input : program.inputs) {
    const bool moves = of_.unknowns.find(input.name) != nullptr;
    if (moves)
      evaluator.set(input.name, values.at(input.name));
    else
      evaluator.fix(input.name, values.at(input.name));
  }
  ExactBlock<S> result;
  const Enclosed<S> constant = numbers::symmetric_part(evaluator.run());
  const auto add = [&](int i, Enclosed<S> matrix) {
    if (matrix.is_zero()) return;
    scale(matrix, [&](int r, int c) { return balance_.factor(at, r, c, i); });
    Enclosed<S> part{matrix.mid(kept, kept), matrix.rad(kept, kept)};
    if (!part.is_zero()) result.terms.emplace_back(i, std::move(part));
  };
  add(0, constant);
  for (const Unknown& unknown : of_.unknowns.list()) {
    if (program.input(unknown.name) < 0) continue;
    Enclosed<S>& value = values.at(unknown.name);
    for (int k = 0; k < unknown.count; ++k) {
      for (const auto& [row, column] : unknown.places(k)) value.mid(row, column) = S(1);
      add(unknown.first + k,
          numbers::difference(numbers::symmetric_part(evaluator.run()), constant));
      for (const auto& [row, column] : unknown.places(k)) value.mid(row, column) = S(0);
    }
  }
  return result;
}

template <class S>
BalancedBlock rounded(const ExactBlock<S>& block, int size) {
  BalancedBlock result{size, {}};
  for (const auto& [i, matrix] : block.terms)
    for (int c = 0; c < size; ++c)
      for (int r = 0; r <= c; ++r) {
        const auto value = as<DoubleDouble>(matrix.mid(r, c));
        if (value.hi() != 0) result.elements.push_back({i, r, c, value.hi(), value.lo()});
      }
  return result;
}

template BalancedBlock rounded(const ExactBlock<DoubleDouble>&, int);
template BalancedBlock rounded(const ExactBlock<Decimal100>&, int);

template class ExactBlocks<DoubleDouble>;
template class ExactBlocks<Decimal100>;

}  // namespace gainsmith::lmi
