#include "lmi/hull.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "lmi/box.h"

namespace gainsmith::lmi {

namespace {

/// The vertices of what contains the factors of one variable.
struct Corners {
  std::vector<Factor> factors;
  std::vector<std::vector<double>> values;  ///< [vertex][factor]
  std::vector<std::string> labels;
  bool exact = true;
};

std::set<int> monomials_in(const AffineForm& form) {
  std::set<int> found;
  for (const auto& [key, matrix] : form.terms)
    if (key.first != 0) found.insert(key.first);
  return found;
}

/// The factors of one variable that stand in the form, without repetition.
std::vector<Factor> factors_in(const AffineForm& form, const MonomialTable& monomials,
                               int variable) {
  std::vector<Factor> factors;
  for (const int index : monomials_in(form))
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

Corners interval_corners(const Variable& variable, std::vector<Factor> factors, int slices,
                         const Place& place) {
  Corners corners{std::move(factors), {}, {}, true};
  if (corners.factors.empty()) return {{}, {{}}, {""}, true};
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
  return corners;
}

Corners polytope_corners(const Variable& variable, std::vector<Factor> factors) {
  Corners corners{std::move(factors), {}, {}, true};
  if (corners.factors.empty()) return {{}, {{}}, {""}, true};
  for (std::size_t j = 0; j < variable.elements.size(); ++j) {
    std::vector<double> values;
    for (const Factor& factor : corners.factors)
      values.push_back(factor.weight == static_cast<int>(j) ? 1.0 : 0.0);
    corners.values.push_back(std::move(values));
    corners.labels.push_back(variable.labels[j]);
  }
  return corners;
}

double factor_size(const Factor& factor, const Variable& variable) {
  if (factor.weight > 0) return 1;
  const Range r = range(factor.atom, variable.low, variable.high);
  return std::max(std::abs(r.low), std::abs(r.high));
}

/// The largest |phi| on the domain, or more.
double monomial_size(const Monomial& monomial, const MonomialTable& monomials) {
  double size = 1;
  for (const Factor& factor : monomial)
    size *= factor_size(factor, monomials.variables()[static_cast<std::size_t>(factor.variable)]);
  return size;
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
    std::vector<std::size_t> choice;
    for (std::size_t v = 0, rest = at; v < corners.size(); ++v) {
      choice.push_back(rest % corners[v].values.size());
      rest /= corners[v].values.size();
      const std::string& label = corners[v].labels[choice[v]];
      vertex.label += (vertex.label.empty() || label.empty() ? "" : ", ") + label;
    }
    for (int index = 0; index < monomials.size(); ++index) {
      double value = 1;
      for (const Factor& factor : monomials[index]) {
        const auto v = static_cast<std::size_t>(factor.variable);
        const auto& factors = corners[v].factors;
        const auto found = std::find(factors.begin(), factors.end(), factor);
        // A factor of monomials that do not stand in the form has no corner: its value is unused.
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

void remove_noise(AffineForm& form, const MonomialTable& monomials) {
  constexpr double kNoise = 1e-13;
  std::map<int, double> sizes;
  double whole = 0;
  for (const auto& [key, matrix] : form.terms) {
    double& size = sizes[key.first];
    size = std::max(size, largest_element(matrix) * monomial_size(monomials[key.first], monomials));
    whole = std::max(whole, size);
  }
  if (!std::isfinite(whole)) return;  // hull_of says which function it is
  std::erase_if(form.terms, [&](const auto& term) {
    return term.first.first != 0 && sizes.at(term.first.first) <= kNoise * whole;
  });
}

Hull hull_of(const AffineForm& form, const MonomialTable& monomials, int slices,
             const Place& place) {
  std::vector<Corners> corners;
  Hull hull;
  for (int v = 0; v < static_cast<int>(monomials.variables().size()); ++v) {
    const Variable& variable = monomials.variables()[static_cast<std::size_t>(v)];
    auto factors = factors_in(form, monomials, v);
    corners.push_back(variable.is_interval()
                          ? interval_corners(variable, std::move(factors), slices, place)
                          : polytope_corners(variable, std::move(factors)));
    hull.exact &= corners.back().exact;
  }
  hull.vertices = all_vertices(corners, monomials, place);
  return hull;
}

AffineForm at_vertex(const AffineForm& form, const std::vector<double>& values) {
  AffineForm result{form.shape, {}};
  for (const auto& [key, matrix] : form.terms) {
    const double factor = values[static_cast<std::size_t>(key.first)];
    const auto [found, fresh] = result.terms.try_emplace({0, key.second}, factor * matrix);
    if (!fresh) found->second = found->second + factor * matrix;
  }
  return result;
}

}  // namespace gainsmith::lmi
