// The doubles that a program computes with are not what a person wrote: 0.1 is rounded. A proof is
// about the decimals, so they are read anew in 100 digits.
#include "bind/exact_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace gainsmith::bind {

namespace {

using expr::Op;
using Wide = numbers::MatrixOf<Decimal100>;

/// Element by element (shortest_decimal).
Wide shortest_decimals(const numbers::Matrix& matrix) {
  return matrix.unaryExpr([](double value) { return shortest_decimal(value); });
}

/// Relative: a text that gives another number is not what the number is from.
constexpr double kOfText = 1e-9;

/// Whether the text alone gives the value. Bases that are chosen, as of orth, and calls are not.
bool is_determined(const expr::Program& program) {
  return !model::chooses_basis(program) &&
         std::none_of(program.code.begin(), program.code.end(),
                      [](const auto& instruction) { return instruction.op == Op::call; });
}

/// The datum's text in 100 digits; none when it does not give the double that is in use.
std::optional<Wide> from_text(const model::Design::Datum& datum, const numbers::Matrix& used,
                              const numbers::ValuesOf<Decimal100>& values) {
  if (!datum.value || !is_determined(datum.value->program)) return std::nullopt;
  try {
    Wide wide = numbers::evaluate<Decimal100>(datum.value->program, values);
    const numbers::Matrix rounded =
        wide.unaryExpr([](const Decimal100& v) { return as<double>(v); });
    const double size = used.size() > 0 ? used.cwiseAbs().maxCoeff() : 0;
    if (rounded.rows() != used.rows() || rounded.cols() != used.cols()) return std::nullopt;
    if (used.size() > 0 && !((rounded - used).cwiseAbs().maxCoeff() <= kOfText * size))
      return std::nullopt;
    return wide;
  } catch (const expr::EvaluationError&) {
    return std::nullopt;
  }
}

}  // namespace

/// By std::to_chars, which promises the shortest decimal that reads back as the same double.
Decimal100 shortest_decimal(double value) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  const auto parsed = parse_as<Decimal100>({text.data(), end.ptr});
  return parsed ? *parsed : Decimal100(value);
}

/// Data in their order, each over the wide values of those before it.
numbers::ValuesOf<Decimal100> exact_values(const model::Instance& instance,
                                           const numbers::Values& constants,
                                           const model::Gains& gains) {
  numbers::ValuesOf<Decimal100> values;
  const auto in_file = [&](const std::string& name) {
    return std::any_of(gains.parameters.begin(), gains.parameters.end(),
                       [&](const auto& parameter) { return parameter.first == name; });
  };
  const model::Design& design = *instance.design;
  for (const model::Design::Datum* one : in_order(design)) {
    const model::Design::Datum& datum = *one;
    const auto used = constants.find(datum.name);
    if (used == constants.end()) continue;
    std::optional<Wide> wide;
    if (!in_file(datum.name) && !instance.overrides.contains(datum.name))
      wide = from_text(datum, used->second, values);
    values[datum.name] = wide ? *wide : shortest_decimals(used->second);
  }
  for (const auto& [name, value] : constants)
    if (!values.contains(name)) values[name] = shortest_decimals(value);
  return values;
}

}  // namespace gainsmith::bind
