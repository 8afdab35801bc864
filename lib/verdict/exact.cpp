#include "verdict/exact.h"

#include <algorithm>
#include <string>
#include <type_traits>

#include "base/scalars.h"
#include "verdict/printed_check.h"
#include "verdict/stated_point.h"

namespace gainsmith::verdict {

namespace {

using numbers::Enclosed;
using numbers::EnclosedValues;

/// (B + B')/2 in the units of a balance, at the rows `kept`. `place` is the new number of each row,
/// -1 of one that is left out. Units are powers of two, so they add no error; equal pairs of
/// elements are taken as they are, which rounds nothing.
template <class S, class Factor>
ExactElements<S> symmetric_part(const ExactElements<S>& elements, const std::vector<int>& place,
                                const Factor& factor) {
  ExactElements<S> result;
  const auto at = [](int row, int column) {
    return [=](const ExactElement<S>& e) {
      return e.column != column ? e.column < column : e.row < row;
    };
  };
  const auto add = [&](int row, int column, const S& mid, double rad) {
    const int r = place[static_cast<std::size_t>(row)], c = place[static_cast<std::size_t>(column)];
    if (r < 0 || c < 0) return;
    const double by = factor(row, column);
    result.push_back({r, c, mid * S(by), rad * by});
  };
  for (const ExactElement<S>& e : elements) {
    if (e.row == e.column) {
      add(e.row, e.column, e.mid, e.rad);
      continue;
    }
    const auto mirror = std::partition_point(elements.begin(), elements.end(), at(e.column, e.row));
    const bool paired =
        mirror != elements.end() && mirror->row == e.column && mirror->column == e.row;
    if (paired && mirror->mid == e.mid && mirror->rad == e.rad) {
      add(e.row, e.column, e.mid, e.rad);
    } else if (!paired || e.row < e.column) {
      const numbers::Ball<S> twice = paired ? e.ball() + mirror->ball() : e.ball();
      if (twice.is_zero()) continue;
      const S mid = twice.mid / S(2);
      const double rad = twice.rad / 2 + numbers::kTiny;
      add(e.row, e.column, mid, rad);
      add(e.column, e.row, mid, rad);
    }
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  return result;
}

}  // namespace

template <class S>
ExactBlocks<S>::ExactBlocks(const lmi::Inequalities& of, const lmi::Balance& balance)
    : of_(of), balance_(balance), values_(enclosed_values<S>(of.instance)) {}

/// The values of data, parameters and the block's variables: those of the file where the point is
/// one of its numbers (stated_point.h), else the printed decimals.
template <class S>
EnclosedValues<S> ExactBlocks<S>::values_at(const lmi::Block& block) const {
  EnclosedValues<S> values = values_;
  const lmi::Statement& statement = of_.statements[block.inequality];
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

/// One evaluation of the text over exact affine forms gives the coefficients of all unknowns.
template <class S>
std::vector<std::pair<int, ExactElements<S>>> ExactBlocks<S>::terms(const expr::Program& program,
                                                                    const EnclosedValues<S>& values,
                                                                    const Form& form) const {
  std::vector<ExactForm<S>> inputs;
  for (const expr::Input& input : program.inputs) {
    const lmi::Unknown* unknown = of_.unknowns.find(input.name);
    inputs.push_back(unknown != nullptr ? form(*unknown)
                                        : exact_constant<S>(values.at(input.name)));
  }
  expr::Evaluator<ExactAlgebra<S>> evaluator(program);
  for (std::size_t k = 0; k < inputs.size(); ++k) evaluator.fix(program.inputs[k].name, inputs[k]);
  return terms_of(evaluator.run());
}

/// With the unknown matrices in the direction times one scalar, x_1.
template <class S>
bool ExactBlocks<S>::vanishes(const lmi::Block& block, const std::vector<int>& kept,
                              const std::vector<double>& d) const {
  const auto form = [&](const lmi::Unknown& unknown) {
    numbers::MatrixOf<S> value = numbers::MatrixOf<S>::Zero(unknown.shape.rows, unknown.shape.cols);
    for (int k = 0; k < unknown.count; ++k)
      for (const auto& [row, column] : unknown.places(k))
        value(row, column) = S(d[static_cast<std::size_t>(unknown.first + k) - 1]);
    auto terms = terms_of(exact_constant(numbers::exactly<S>(std::move(value))));
    for (auto& [i, elements] : terms) i = 1;
    return ExactForm<S>{unknown.shape, false, {}, std::move(terms)};
  };
  const auto is_kept = [&](int row) { return std::ranges::find(kept, row) != kept.end(); };
  if (!block.where) {
    numbers::MatrixOf<S> sum = numbers::MatrixOf<S>::Zero(block.size, block.size);
    for (const auto& [i, matrix] : block.terms)
      for (int c = 0; i > 0 && c < matrix.outerSize(); ++c)
        for (lmi::Sparse::InnerIterator it(matrix, c); it; ++it)
          sum(it.row(), c) += S(it.value()) * S(d[static_cast<std::size_t>(i) - 1]);
    return sum(kept, kept).isZero(S(0));
  }
  for (const auto& [i, elements] : terms(
           of_.statements[block.inequality].differences[block.comparison], values_at(block), form))
    for (const ExactElement<S>& e : elements)
      if (i == 1 && is_kept(e.row) && is_kept(e.column)) return false;
  return true;
}

template <class S>
std::vector<numbers::Ball<S>> ExactBlocks<S>::objective() const {
  std::vector<numbers::Ball<S>> costs(static_cast<std::size_t>(of_.unknowns.size()) + 1);
  for (const auto& [i, elements] :
       terms(of_.bodies.link(of_.design().objective->program), values_)) {
    costs[static_cast<std::size_t>(i)] =
        numbers::scaled(elements.front().ball(), i == 0 ? 1 : balance_.unit(i));
  }
  return costs;
}

/// The coefficients in double without an error bound: the block is what was solved.
template <class S>
ExactBlock<S> ExactBlocks<S>::as_solved(const lmi::Block& block, std::size_t at,
                                        const std::vector<int>& kept) const {
  ExactBlock<S> result{static_cast<int>(kept.size()), {}};
  lmi::for_each_balanced(block, balance_, at, kept, [&](int i, int row, int column, double value) {
    if (result.terms.empty() || result.terms.back().first != i)
      result.terms.emplace_back(i, ExactElements<S>());
    ExactElements<S>& elements = result.terms.back().second;
    elements.push_back({row, column, S(value), 0});
    if (row != column) elements.push_back({column, row, S(value), 0});
  });
  return result;
}

template <class S>
ExactBlock<S> ExactBlocks<S>::block(const lmi::Block& block, std::size_t at,
                                    const std::vector<int>& kept) const {
  if (!block.where) return as_solved(block, at, kept);
  const lmi::Statement& statement = of_.statements[block.inequality];
  std::vector<int> place(static_cast<std::size_t>(block.size), -1);
  for (std::size_t k = 0; k < kept.size(); ++k)
    place[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
  ExactBlock<S> result;
  result.size = static_cast<int>(kept.size());
  for (const auto& [i, elements] :
       terms(statement.differences[block.comparison], values_at(block))) {
    ExactElements<S> part = symmetric_part(
        elements, place, [&, i = i](int r, int c) { return balance_.factor(at, r, c, i); });
    if (!part.empty()) result.terms.emplace_back(i, std::move(part));
  }
  return result;
}

template <class S>
numbers::Enclosed<S> dense(const ExactElements<S>& elements, int size) {
  numbers::Enclosed<S> result = numbers::exactly<S>(numbers::MatrixOf<S>::Zero(size, size));
  for (const ExactElement<S>& e : elements) {
    result.mid(e.row, e.column) = e.mid;
    result.rad(e.row, e.column) = e.rad;
  }
  return result;
}

template <class S>
lmi::BalancedBlock rounded(const ExactBlock<S>& block) {
  lmi::BalancedBlock result{block.size, {}, {}};
  for (const auto& [i, elements] : block.terms)
    for (const ExactElement<S>& e : elements) {
      if (e.row > e.column) continue;
      const auto value = as<DoubleDouble>(e.mid);
      if (value.hi() == 0) continue;
      result.elements.push_back({i, e.row, e.column, value.hi(), value.lo()});
      if constexpr (std::is_same_v<S, Decimal100>) result.finer.push_back(finer_part(e.mid));
    }
  return result;
}

template numbers::Enclosed<DoubleDouble> dense(const ExactElements<DoubleDouble>&, int);
template numbers::Enclosed<Decimal100> dense(const ExactElements<Decimal100>&, int);
template lmi::BalancedBlock rounded(const ExactBlock<DoubleDouble>&);
template lmi::BalancedBlock rounded(const ExactBlock<Decimal100>&);

template class ExactBlocks<DoubleDouble>;
template class ExactBlocks<Decimal100>;

}  // namespace gainsmith::verdict
