#include "lmi/exact.h"

#include <cmath>
#include <string>
#include <type_traits>

#include "base/scalars.h"
#include "lmi/printed_check.h"
#include "lmi/stated_point.h"

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
    const std::string& name = statement.domain[v].name;
    const numbers::Matrix& at = block.where->values.at(name);
    const expr::Program* stated = stated_at(statement, v, block, [&](const auto& text, End end) {
      const Enclosed<S> value = numbers::enclose(text, values_);
      const S t(at(0, 0));
      return end == End::low ? !(t > value.mid(0, 0) + S(value.rad(0, 0)))
                             : !(t < value.mid(0, 0) - S(value.rad(0, 0)));
    });
    values[name] = stated != nullptr ? numbers::enclose(*stated, values_)
                   : at.size() == 1
                       ? enclosed_decimal<S>(at(0, 0))
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
  BalancedBlock result{size, {}, {}};
  for (const auto& [i, matrix] : block.terms)
    for (int c = 0; c < size; ++c)
      for (int r = 0; r <= c; ++r) {
        const auto value = as<DoubleDouble>(matrix.mid(r, c));
        if (value.hi() == 0) continue;
        result.elements.push_back({i, r, c, value.hi(), value.lo()});
        if constexpr (std::is_same_v<S, Decimal100>)
          result.finer.push_back(finer_part(matrix.mid(r, c)));
      }
  return result;
}

template BalancedBlock rounded(const ExactBlock<DoubleDouble>&, int);
template BalancedBlock rounded(const ExactBlock<Decimal100>&, int);

template class ExactBlocks<DoubleDouble>;
template class ExactBlocks<Decimal100>;

}  // namespace gainsmith::lmi
