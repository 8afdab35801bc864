#include "forall/box.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number.h"

namespace gainsmith::forall {

namespace {

/// The range of an atom; InputError where it is not finite.
Range finite_range(const Atom& atom, const std::string& variable, double low, double high,
                   const Place& place) {
  const Range result = range(atom, low, high);
  if (std::isfinite(result.low) && std::isfinite(result.high)) return result;
  throw InputError(place, to_string(atom, variable) + " is too large for double on [" + brief(low) +
                              ", " + brief(high) + "]");
}

/// The point of the interval where the vertex of a single atom is one of its ends, otherwise the
/// values of the atoms.
std::string label_of(const Box& box, const std::string& variable, const std::vector<double>& values,
                     double low, double high) {
  if (box.atoms.size() == 1)
    for (const double end : {low, high})
      if (evaluate(box.atoms[0], end) == values[0]) return variable + " = " + brief(end);
  std::string label;
  for (std::size_t k = 0; k < values.size(); ++k)
    label +=
        (label.empty() ? "" : ", ") + to_string(box.atoms[k], variable) + " = " + brief(values[k]);
  return label;
}

}  // namespace

int Box::find(const Atom& atom) const {
  const auto found = std::find(atoms.begin(), atoms.end(), atom);
  return found == atoms.end() ? -1 : static_cast<int>(found - atoms.begin());
}

Box box_of(std::vector<Atom> atoms, const std::string& variable, double low, double high,
           const Place& place) {
  const std::size_t count = atoms.size();
  if (count >= 63 || (std::size_t{1} << count) > kMostVertices) refuse_vertices(place);
  Box box;
  box.atoms = std::move(atoms);
  for (const Atom& atom : box.atoms)
    box.ranges.push_back(finite_range(atom, variable, low, high, place));
  for (std::size_t vertex = 0; vertex < (std::size_t{1} << count); ++vertex) {
    std::vector<double> values;
    bool repeated = false;
    for (std::size_t k = 0; k < count; ++k) {
      // Bit k of the number of a vertex says which end of the k-th range it is at.
      const bool upper = ((vertex >> k) & 1U) != 0;
      repeated |= upper && box.ranges[k].low == box.ranges[k].high;
      values.push_back(upper ? box.ranges[k].high : box.ranges[k].low);
    }
    if (repeated) continue;
    box.labels.push_back(label_of(box, variable, values, low, high));
    box.vertices.push_back(std::move(values));
  }
  return box;
}

namespace {

/// The value of an atom in brackets, as a number of the language.
std::string number(double value) {
  return value < 0 ? "(" + decimal17(value) + ")" : decimal17(value);
}

/// (theta - low)/(high - low) or (high - theta)/(high - low), for each function that is no
/// constant.
std::string weight_text(const Box& box, const std::vector<double>& vertex,
                        const std::string& variable) {
  constexpr int kAllDigits = 17;
  std::string text;
  for (std::size_t k = 0; k < box.atoms.size(); ++k) {
    const auto& [low, high] = box.ranges[k];
    if (low == high) continue;
    const std::string atom = to_string(box.atoms[k], variable, kAllDigits);
    text += text.empty() ? "" : "*";
    text += vertex[k] == high ? "(" + atom + " - " + number(low) + ")"
                              : "(" + number(high) + " - " + atom + ")";
    text += "/" + number(high - low);
  }
  return text;
}

/// The same as a program; without instructions when it is 1.
expr::Program weight_program(const Box& box, const std::vector<double>& vertex,
                             const std::string& variable, const Place& place) {
  using expr::Op;
  expr::Composer composer(place);
  int weight = -1;
  for (std::size_t k = 0; k < box.atoms.size(); ++k) {
    const auto& [low, high] = box.ranges[k];
    if (low == high) continue;
    const int atom = compose(composer, box.atoms[k], variable);
    const bool upper = vertex[k] == high;
    const int end = composer.number(decimal17(upper ? low : high));
    const int distance = upper ? composer.apply(Op::subtract, {atom, end})
                               : composer.apply(Op::subtract, {end, atom});
    const int whole = weight < 0 ? distance : composer.apply(Op::multiply, {weight, distance});
    weight = composer.apply(Op::divide, {whole, composer.number(decimal17(high - low))});
  }
  return weight < 0 ? expr::Program{} : composer.take(weight);
}

}  // namespace

model::Basis weights(const Box& box, const std::string& variable, const Place& place) {
  model::Basis basis;
  basis.kind = model::Basis::Kind::weights;
  for (const std::vector<double>& vertex : box.vertices) {
    basis.elements.push_back(weight_program(box, vertex, variable, place));
    basis.texts.push_back(weight_text(box, vertex, variable));
  }
  return basis;
}

void refuse_vertices(const Place& place) {
  throw InputError(place, "the hull of this inequality has more than " +
                              std::to_string(kMostVertices) +
                              " vertices; use synthesis: {forall: exchange} or fewer slices");
}

}  // namespace gainsmith::forall
