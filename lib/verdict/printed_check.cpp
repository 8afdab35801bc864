#include "verdict/printed_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/scalars.h"
#include "model/gains.h"
#include "numbers/dense/rational_algebra.h"
#include "numbers/types/degree.h"
#include "verdict/rational_blocks.h"

namespace gainsmith::verdict {

using forall::DomainProof;
using numbers::Enclosed;
using numbers::EnclosedValues;

namespace {

/// The domain with ends that hold those of the file, and its elements as the file states them.
template <class S>
forall::Domain stated_domain(const lmi::Statement& statement, const EnclosedValues<S>& values,
                             forall::EnclosedElements<S>& elements) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  forall::Domain domain = statement.domain;
  for (std::size_t v = 0; v < domain.size(); ++v) {
    forall::Variable& variable = domain[v];
    const auto& points = statement.stated->domain[v].points;
    if (!variable.is_interval()) {
      auto& list = elements[variable.name];
      for (const model::Formula& point : points)
        list.push_back(numbers::enclose(point.program, values));
      continue;
    }
    // Half a unit in the last place holds a decimal that is no double; two of them hold the error
    // of a formula that double can be trusted with at all.
    for (double* end : {&variable.low, &variable.high}) {
      const bool low = end == &variable.low;
      const Enclosed<S> exact = numbers::enclose(points[low ? 0 : 1].program, values);
      while (std::isfinite(*end)) {
        const S outside = low ? exact.mid(0, 0) - S(exact.rad(0, 0)) - S(*end)
                              : S(*end) - exact.mid(0, 0) - S(exact.rad(0, 0));
        if (!(outside < S(0))) break;
        *end = std::nextafter(*end, low ? -kInfinity : kInfinity);
      }
    }
  }
  return domain;
}

/// A fraction as a ball: it is written in decimal with twice as many digits as the widest type has,
/// and read into S. The radius 2 u |mid| covers both roundings.
template <class S>
numbers::Ball<S> enclosed_fraction(const Rational& value) {
  constexpr int kDigits = 2 * kWideDigits;
  if (value == 0) return {S(0), 0};
  const double size = std::abs(nearest_double(value));
  if (!(size > 0)) return {S(0), std::numeric_limits<double>::min()};
  const int decimals = kDigits - static_cast<int>(std::floor(std::log10(size)));
  const Integer whole = nearest_integer(Rational(value * power_of_ten(decimals)));
  const S mid = *parse_as<S>(whole.str() + "e" + std::to_string(-decimals));
  return {mid, 2 * numbers::magnitude(mid) * numbers::unit_roundoff<S>()};
}

/// Whether the degree of the result in `name` is at most 1.
bool is_affine_in(const expr::Program& program, const std::string& name) {
  const auto degrees = numbers::degrees(program, [&](const std::string& it) { return it == name; });
  return degrees[static_cast<std::size_t>(program.result)] <= 1;
}

}  // namespace

/// The radius is u |mid| unless S holds the decimal exactly.
template <class S>
Enclosed<S> enclosed_decimal(double value) {
  const std::string text = model::printed(value);
  Enclosed<S> result = numbers::exact_number<S>(*parse_as<S>(text));
  if (!numbers::is_exact_decimal(text))
    result.rad(0, 0) = numbers::magnitude(result.mid(0, 0)) * numbers::unit_roundoff<S>();
  return result;
}

template <class S>
EnclosedValues<S> enclosed_values(const model::Instance& instance) {
  EnclosedValues<S> values;
  const model::Design& design = *instance.design;
  for (const model::Design::Datum* one : in_order(design)) {
    const model::Design::Datum& datum = *one;
    const auto overridden = instance.overrides.find(datum.name);
    if (overridden != instance.overrides.end()) {
      values[datum.name] = enclosed_decimal<S>(overridden->second);
      continue;
    }
    if (!datum.value) continue;
    const Enclosed<S> value = numbers::enclose(datum.value->program, values);
    const bool symmetric = datum.structure == model::Structure::symmetric ||
                           datum.structure == model::Structure::diagonal;
    values[datum.name] = symmetric ? numbers::symmetric_part(value) : value;
  }
  return values;
}

PrintedCheck::PrintedCheck(const lmi::Inequalities& of, const std::vector<double>& x,
                           std::size_t most_pieces, const std::vector<Rational>* solution)
    : of_(of), x_(x), most_pieces_(most_pieces), solution_(solution) {}

numbers::RationalValues PrintedCheck::unknowns() const {
  numbers::RationalValues values;
  for (const lmi::Unknown& unknown : of_.unknowns.list()) {
    numbers::RationalMatrix& value = values[unknown.name];
    value = numbers::RationalMatrix::Constant(unknown.shape.rows, unknown.shape.cols, Rational(0));
    for (int k = 0; k < unknown.count; ++k) {
      const auto i = static_cast<std::size_t>(unknown.first + k - 1);
      for (const auto& [row, column] : unknown.places(k))
        value(row, column) = solution_ != nullptr ? (*solution_)[i] : printed_fraction(x_[i]);
    }
  }
  return values;
}

template <class S>
DomainProof PrintedCheck::check_in(const lmi::Statement& statement, std::size_t comparison,
                                   std::optional<EnclosedValues<S>>& known) {
  try {
    if (!known) {
      known = enclosed_values<S>(of_.instance);
      const numbers::Values printed = of_.unknowns.values(x_);
      for (const auto& [name, matrix] : unknowns()) {
        Enclosed<S>& value = (*known)[name];
        value.resize(matrix.rows(), matrix.cols());
        for (Eigen::Index i = 0; i < matrix.size(); ++i)
          value.set(i, solution_ != nullptr ? enclosed_fraction<S>(matrix(i))
                                            : enclosed_decimal<S>(printed.at(name)(i)).ball(0));
      }
    }
    forall::EnclosedElements<S> elements;
    const forall::Domain domain = stated_domain(statement, *known, elements);
    return forall::prove_on_domain(statement.differences[comparison], domain, *known,
                                   statement.stated->comparisons[comparison].strict, elements,
                                   {.most_pieces = most_pieces_});
  } catch (const expr::EvaluationError& error) {
    DomainProof open;
    open.status = DomainProof::Status::open;
    open.reason = error.message();
    return open;
  }
}

DomainProof PrintedCheck::check(std::size_t inequality, std::size_t comparison) {
  const lmi::Statement& statement = of_.statements[inequality];
  DomainProof proof = check_in(statement, comparison, in_double_);
  // A domain that is too long for its waves is so in all digits.
  // The order is double, 31 digits, 100 digits, fractions; the next is asked only where one is
  // open.
  if (proof.pieces >= most_pieces_) return proof;
  if (proof.status == DomainProof::Status::open) proof = check_in(statement, comparison, in_31_);
  if (proof.status == DomainProof::Status::open) proof = check_in(statement, comparison, in_100_);
  // A point that fails may be one that rounding put outside of the file's interval.
  const bool at_ends = !statement.domain.empty() && proof.status == DomainProof::Status::fails;
  if (proof.status != DomainProof::Status::open && !at_ends) return proof;
  const std::optional<bool> holds = check_in_fractions(statement, comparison);
  if (holds == true) return {};
  if (holds == false && statement.domain.empty()) proof.status = DomainProof::Status::fails;
  return proof;
}

/// A function that is affine in each variable takes its extremes over a box at the corners, so each
/// combination of ends, vertices and elements is tested, in fractions.
std::optional<bool> PrintedCheck::check_in_fractions(const lmi::Statement& statement,
                                                     std::size_t comparison) const {
  const auto& domain = statement.domain;
  if (!std::all_of(domain.begin(), domain.end(), [&](const forall::Variable& variable) {
        return !variable.is_interval() ||
               is_affine_in(statement.differences[comparison], variable.name);
      }))
    return std::nullopt;
  const bool strict = statement.stated->comparisons[comparison].strict;
  try {
    numbers::RationalValues values = rational_values(of_.instance);
    const numbers::RationalValues data = values;
    for (auto& [name, matrix] : unknowns()) values[name] = std::move(matrix);
    const auto holds_at = [&](const auto& self, std::size_t v) -> bool {
      if (v == domain.size()) {
        const auto value = numbers::rational_symmetric_part(
            numbers::rational_value(statement.differences[comparison], values));
        return strict ? numbers::is_rational_definite(value)
                      : numbers::is_rational_semidefinite(value);
      }
      for (const model::Formula& element : statement.stated->domain[v].points) {
        values[domain[v].name] = numbers::rational_value(element.program, data);
        if (!self(self, v + 1)) return false;
      }
      return true;
    };
    return holds_at(holds_at, 0);
  } catch (const expr::EvaluationError&) {
    return std::nullopt;
  }
}

#define GAINSMITH_INSTANTIATE(S)                    \
  template Enclosed<S> enclosed_decimal<S>(double); \
  template EnclosedValues<S> enclosed_values<S>(const model::Instance&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::verdict
