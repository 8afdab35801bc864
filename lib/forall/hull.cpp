#include "forall/hull.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "forall/box.h"

namespace gainsmith::forall {

namespace {

/// The vertices of what contains the factors of one variable.
struct Corners {
  std::vector<Factor> factors;
  std::vector<std::vector<double>> values;  ///< [vertex][factor]
  std::vector<std::string> labels;
  std::vector<std::optional<numbers::Matrix>> places;  ///< of the variable, where they are known
  bool exact = true;
};

/// The factors of one variable that occur in the form, without repetition.
std::vector<Factor> factors_in(const std::set<int>& standing, const MonomialTable& monomials,
                               int variable) {
  std::vector<Factor> factors;
  for (const int index : standing)
    for (const Factor& factor : monomials[index])
      if (factor.variable == variable &&
          std::find(factors.begin(), factors.end(), factor) == factors.end())
        factors.push_back(factor);
  return factors;
}

/// Adds the vertices of the box of the factors' ranges on [low, high].
void add_box(Corners& corners, const Variable& variable, double low, double high,
             const Place& place) {
  std::vector<Atom> atoms;
  for (const Factor& factor : corners.factors) atoms.push_back(factor.atom);
  Box box = box_of(std::move(atoms), variable.name, low, high, place);
  std::move(box.vertices.begin(), box.vertices.end(), std::back_inserter(corners.values));
  std::move(box.labels.begin(), box.labels.end(), std::back_inserter(corners.labels));
}

/// One box for each of `slices` equal parts of the interval, or one for all of it where that is
/// exact.
Corners interval_corners(const Variable& variable, std::vector<Factor> factors, int slices,
                         const Place& place) {
  Corners corners{std::move(factors), {}, {}, {}, true};
  if (corners.factors.empty())
    return {{}, {{}}, {""}, {numbers::Matrix::Constant(1, 1, variable.low)}, true};
  const auto is_bounded_from_outside = [](const Factor& factor) {
    return factor.atom.power > 0 && factor.atom.frequency != 0;
  };
  corners.exact = corners.factors.size() == 1 && !is_bounded_from_outside(corners.factors[0]);
  const int parts = corners.exact ? 1 : slices;
  const double width = variable.high - variable.low;
  for (int i = 0; i < parts; ++i) {
    const double low = variable.low + width * i / parts;
    const double high = i + 1 == parts ? variable.high : variable.low + width * (i + 1) / parts;
    add_box(corners, variable, low, high, place);
    if (corners.values.size() > kMostVertices) refuse_vertices(place);
  }
  for (const std::vector<double>& values : corners.values) {
    const auto found =
        corners.exact ? place_of(corners.factors[0].atom, values[0], variable.low, variable.high)
                      : std::nullopt;
    std::optional<numbers::Matrix>& at = corners.places.emplace_back();
    if (found) at = numbers::Matrix::Constant(1, 1, *found);
  }
  return corners;
}

/// Weight j is 1 at vertex j and 0 at all others.
Corners polytope_corners(const Variable& variable, std::vector<Factor> factors) {
  Corners corners{std::move(factors), {}, {}, {}, true};
  if (corners.factors.empty()) return {{}, {{}}, {""}, {variable.elements.front()}, true};
  for (std::size_t j = 0; j < variable.elements.size(); ++j) {
    std::vector<double> values;
    for (const Factor& factor : corners.factors)
      values.push_back(factor.weight == static_cast<int>(j) ? 1.0 : 0.0);
    corners.values.push_back(std::move(values));
    corners.labels.push_back(variable.labels[j]);
    corners.places.emplace_back(variable.elements[j]);
  }
  return corners;
}

/// The largest |f| on the domain of its variable, or more.
double factor_size(const Factor& factor, const Variable& variable) {
  if (factor.weight > 0) return 1;
  const Range r = range(factor.atom, variable.low, variable.high);
  return std::max(std::abs(r.low), std::abs(r.high));
}

/// One vertex for each choice of a corner of every variable.
std::vector<Vertex> all_vertices(const std::vector<Corners>& corners,
                                 const MonomialTable& monomials, const Place& place) {
  std::size_t count = 1;
  for (const Corners& c : corners) {
    count *= c.values.size();
    if (count > kMostVertices) refuse_vertices(place);
  }
  std::vector<Vertex> vertices;
  for (std::size_t at = 0; at < count; ++at) {
    Vertex vertex;
    // A point of the domain as long as each corner is one.
    vertex.point.emplace();
    std::vector<std::size_t> choice;
    for (std::size_t v = 0, rest = at; v < corners.size(); ++v) {
      choice.push_back(rest % corners[v].values.size());
      rest /= corners[v].values.size();
      const std::string& label = corners[v].labels[choice[v]];
      vertex.label += (vertex.label.empty() || label.empty() ? "" : ", ") + label;
      const auto& value = corners[v].places[choice[v]];
      if (!value) vertex.point.reset();
      if (vertex.point)
        vertex.point->values.insert_or_assign(monomials.variables()[v].name, *value);
    }
    for (int index = 0; index < monomials.size(); ++index) {
      double value = 1;
      for (const Factor& factor : monomials[index]) {
        const auto v = static_cast<std::size_t>(factor.variable);
        const auto& factors = corners[v].factors;
        const auto found = std::find(factors.begin(), factors.end(), factor);
        // A factor of monomials that do not occur in the form has no corner: its value is unused.
        if (found != factors.end())
          value *= corners[v].values[choice[v]][static_cast<std::size_t>(found - factors.begin())];
      }
      vertex.values.push_back(value);
    }
    vertices.push_back(std::move(vertex));
  }
  return vertices;
}

}  // namespace

double largest_value(const Monomial& monomial, const MonomialTable& monomials) {
  double size = 1;
  for (const Factor& factor : monomial)
    size *= factor_size(factor, monomials.variables()[static_cast<std::size_t>(factor.variable)]);
  return size;
}

std::set<int> noise(const Sizes& coefficients, const MonomialTable& monomials) {
  // Of the largest term on the whole domain.
  constexpr double kNoise = 1e-13;
  Sizes sizes;
  double whole = 0;
  for (const auto& [index, coefficient] : coefficients) {
    sizes[index] = coefficient * largest_value(monomials[index], monomials);
    whole = std::max(whole, sizes[index]);
  }
  std::set<int> found;
  if (!std::isfinite(whole)) return found;  // hull_of says which function it is
  for (const auto& [index, size] : sizes)
    if (index != 0 && size <= kNoise * whole) found.insert(index);
  return found;
}

Hull hull_of(const std::set<int>& standing, const MonomialTable& monomials, int slices,
             const Place& place) {
  std::vector<Corners> corners;
  Hull hull;
  for (int v = 0; v < static_cast<int>(monomials.variables().size()); ++v) {
    const Variable& variable = monomials.variables()[static_cast<std::size_t>(v)];
    auto factors = factors_in(standing, monomials, v);
    corners.push_back(variable.is_interval()
                          ? interval_corners(variable, std::move(factors), slices, place)
                          : polytope_corners(variable, std::move(factors)));
    hull.exact &= corners.back().exact;
  }
  hull.vertices = all_vertices(corners, monomials, place);
  return hull;
}

}  // namespace gainsmith::forall
