#include "packs/linear_graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bounded/tolerances.h"

namespace gainsmith::packs {

namespace {

using model::ClaimKind;
using Nodes = std::vector<int>;

/// More than all that underflows in one result.
constexpr double kTiny = 1e-290;
/// A square below that of this is none.
constexpr double kLeastRow = 1e-150;

/// Numbers with bounds of their errors: |true - value| <= radius, size >= |value| + radius.
struct Numbers {
  Nodes value, size, radius;
  std::size_t count() const { return value.size(); }
};
struct Known {
  int value = 0;
  int error = 0;
};

/// Of a symmetric F: |F_ij| over all lengths, and how far what is computed may be from it. Elements
/// beside the diagonal are those of both triangles together.
class Sizes {
 public:
  explicit Sizes(std::size_t count) : size_(count, std::vector<double>(count)), error_(size_) {}

  void set(std::size_t i, std::size_t j, double size, double error) {
    const double share = i == j ? 1 : 0.5;
    size_[i][j] = size_[j][i] = share * size;
    error_[i][j] = error_[j][i] = share * error;
  }
  /// w with |F_ij| <= w_i w_j: near the roots of the diagonal, which are enough where F >= 0.
  std::vector<double> weights() const {
    const std::size_t n = size_.size();
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, size_[i][j]);
    std::vector<double> w(n);
    for (std::size_t i = 0; i < n; ++i) {
      const bool zero =
          std::all_of(size_[i].begin(), size_[i].end(), [](double x) { return x == 0; });
      w[i] = zero ? 0 : std::max(std::sqrt(size_[i][i]), 1e-8 * std::sqrt(largest));
    }
    double excess = 1;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (size_[i][j] > 0) excess = std::max(excess, size_[i][j] / (w[i] * w[j]));
    for (double& one : w) one *= std::sqrt(excess) * bounded::kBoundSlack;
    return w;
  }
  /// The errors, as a part of w_i w_j.
  double part(const std::vector<double>& w) const {
    double most = 0;
    for (std::size_t i = 0; i < size_.size(); ++i)
      for (std::size_t j = 0; j < size_.size(); ++j)
        if (error_[i][j] > 0) most = std::max(most, error_[i][j] / (w[i] * w[j]));
    return most;
  }

 private:
  std::vector<std::vector<double>> size_, error_;
};

class Graph {
 public:
  Graph(const LinearSystem& system) : system_(system) {}

  int input() { return graph_.input(inputs_++); }
  Nodes inputs(std::size_t count) {
    Nodes nodes;
    for (std::size_t k = 0; k < count; ++k) nodes.push_back(input());
    return nodes;
  }
  int constant(double value) { return graph_.constant(value); }
  int add(int a, int b) { return graph_.add(a, b); }
  int subtract(int a, int b) { return graph_.subtract(a, b); }
  int multiply(int a, int b) { return graph_.multiply(a, b); }
  int scaled(double factor, int a) { return multiply(constant(factor), a); }
  int maximum(int a, int b) { return graph_.apply(numbers::ScalarOp::maximum, a, b); }
  int minimum(int a, int b) { return graph_.apply(numbers::ScalarOp::minimum, a, b); }
  int abs(int a) { return graph_.apply(numbers::ScalarOp::abs, a); }
  int root(int a) { return graph_.apply(numbers::ScalarOp::sqrt, a); }
  /// a where it is > 0, otherwise 1.
  int positive(int a) { return graph_.where(true, a, a, constant(1)); }
  int over(int a, int b) { return graph_.divide(a, b); }

  /// Where a polynomial is taken.
  int sigma(const LengthTable& table, int length) {
    return scaled(table.scale, add(length, constant(-table.middle)));
  }
  int polynomial(const LengthTable& table, std::size_t k, int sigma) {
    const std::vector<double>& powers = table.functions[k].powers;
    int sum = constant(powers.back());
    for (std::size_t i = powers.size() - 1; i-- > 0;)
      sum = add(multiply(sum, sigma), constant(powers[i]));
    return sum;
  }

  /// With the constant 1 behind, where there is one.
  Numbers exact(Nodes values) {
    Numbers numbers;
    for (const int one : values) push(one, constant(0), numbers);
    append_one(numbers);
    return numbers;
  }
  void push(int value, int radius, Numbers& numbers) {
    numbers.value.push_back(value);
    numbers.radius.push_back(radius);
    numbers.size.push_back(add(abs(value), radius));
  }
  void append_one(Numbers& numbers) {
    if (system_.model.constant) push(constant(1), constant(0), numbers);
  }

  /// M v of the functions from `next` on, `rows` times as many as v; what their errors and rounding
  /// add to that of v, with more rounding `beside`; and M, |M|.
  struct Product {
    Nodes value, added;
    std::vector<Nodes> M;
    std::vector<std::vector<double>> sizes;
  };
  Product product(const LengthTable& table, std::size_t& next, int sigma, std::size_t rows,
                  const Numbers& v, double beside = 0) {
    Product made;
    const double rounding = (static_cast<double>(v.count()) + 4) * kUnitRoundoff + beside;
    for (std::size_t i = 0; i < rows; ++i) {
      int value = constant(0), added = constant(kTiny);
      made.M.emplace_back();
      made.sizes.emplace_back();
      for (std::size_t j = 0; j < v.count(); ++j, ++next) {
        const LengthTable::Polynomial& function = table.functions[next];
        made.M.back().push_back(polynomial(table, next, sigma));
        made.sizes.back().push_back(function.size * bounded::kBoundSlack);
        value = add(multiply(made.M.back().back(), v.value[j]), value);
        added = add(
            scaled(bounded::kBoundSlack * (function.error + rounding * function.size), v.size[j]),
            added);
      }
      made.value.push_back(value);
      made.added.push_back(added);
    }
    return made;
  }

  /// v'F v with F the functions from `next` on.
  Known form(const LengthTable& table, std::size_t& next, int sigma, const Numbers& v) {
    Known made{constant(0), 0};
    Sizes sizes(v.count());
    for (std::size_t j = 0; j < v.count(); ++j) {
      int sum = constant(0);
      for (std::size_t i = 0; i <= j; ++i, ++next) {
        const LengthTable::Polynomial& function = table.functions[next];
        sum = add(multiply(polynomial(table, next, sigma), v.value[i]), sum);
        sizes.set(i, j, function.size, function.error);
      }
      made.value = add(multiply(sum, v.value[j]), made.value);
    }
    made.error = error(sizes, v);
    return made;
  }
  /// v'Q v with a constant Q.
  Known form(const Wide& Q, const Numbers& v) {
    Known made{constant(0), 0};
    Sizes sizes(v.count());
    for (std::size_t j = 0; j < v.count(); ++j) {
      int sum = constant(0);
      for (std::size_t i = 0; i <= j; ++i) {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        const double q = static_cast<double>(Q(row, column)) * (i == j ? 1 : 2);
        sum = add(scaled(q, v.value[i]), sum);
        sizes.set(i, j, std::abs(q), 2 * kUnitRoundoff * std::abs(q));
      }
      made.value = add(multiply(sum, v.value[j]), made.value);
    }
    made.error = error(sizes, v);
    return made;
  }

  lanes::LaneCode code(const std::vector<Nodes>& results,
                       std::optional<std::uint32_t> feed_back = {}) {
    return {graph_, results, static_cast<std::size_t>(inputs_), feed_back};
  }

 private:
  /// |v'F v - computed| <= A (part A + 2 R), A = sum w_i a_i, R = sum w_i r_i, where |F_ij| <= w_i w_j
  /// and the errors of F are at most `part` of that.
  int error(const Sizes& sizes, const Numbers& v) {
    const std::vector<double> w = sizes.weights();
    const double rounding = (2 * static_cast<double>(v.count()) + 8) * kUnitRoundoff;
    int A = constant(0), R = constant(0);
    for (std::size_t i = 0; i < v.count(); ++i) {
      A = add(scaled(w[i], v.size[i]), A);
      R = add(scaled(2 * w[i], v.radius[i]), R);
    }
    return add(multiply(add(scaled(sizes.part(w) + rounding, A), R), A), constant(kTiny));
  }

  const LinearSystem& system_;
  numbers::ScalarGraph graph_;
  int inputs_ = 0;
};

/// What a lane carries as nodes.
struct Carried {
  Nodes z, G, b;
  std::vector<Nodes> claims;
};

Carried carried_inputs(const LinearSystem& system, Graph& graph) {
  Carried made;
  made.z = graph.inputs(system.rank);
  made.G = graph.inputs(system.rank * system.rank);
  made.b = graph.inputs(system.rank);
  for (const CarriedClaim& claim : system.claims) made.claims.push_back(graph.inputs(claim.count));
  return made;
}

Nodes all_of(const Carried& carried) {
  Nodes nodes;
  for (const Nodes* part : {&carried.z, &carried.G, &carried.b})
    nodes.insert(nodes.end(), part->begin(), part->end());
  for (const Nodes& claim : carried.claims) nodes.insert(nodes.end(), claim.begin(), claim.end());
  return nodes;
}

/// At least |row i of G|: the sum of sizes, which takes no root.
int row_of(const LinearSystem& system, const Nodes& G, std::size_t i, Graph& graph) {
  int sum = graph.abs(G[i]);
  for (std::size_t j = 1; j < system.rank; ++j)
    sum = graph.add(graph.abs(G[j * system.rank + i]), sum);
  return sum;
}

/// z with the bounds of its errors: root |row of G| + b.
Numbers known_z(const LinearSystem& system, const Carried& carried, int root, Graph& graph) {
  Numbers z;
  for (std::size_t i = 0; i < system.rank; ++i) {
    const int row = row_of(system, carried.G, i, graph);
    graph.push(carried.z[i], graph.add(graph.multiply(root, row), carried.b[i]), z);
  }
  graph.append_one(z);
  return z;
}

/// v just after a jump against all before it.
void compare(const Known& v, Nodes& claim, Graph& graph) {
  claim[2] = graph.maximum(claim[2], graph.subtract(graph.add(v.value, v.error), claim[0]));
  claim[3] = graph.maximum(claim[3], graph.subtract(graph.subtract(v.value, v.error), claim[1]));
}

void keep_least(const Known& v, Nodes& claim, Graph& graph) {
  claim[0] = graph.minimum(claim[0], graph.subtract(v.value, v.error));
  claim[1] = graph.minimum(claim[1], graph.add(v.value, v.error));
}

void add_cost(const Known& cost, Nodes& claim, Graph& graph) {
  claim[0] = graph.add(cost.value, claim[0]);
  claim[1] = graph.add(cost.error, claim[1]);
}

/// The claims over a flow and the jump at its end. `values`: gets those just after its start.
void follow_claims(const LinearSystem& system, const LengthTable& table, std::size_t next,
                   int sigma, const Numbers& v, std::vector<Nodes>& claims, Nodes* values,
                   Graph& graph) {
  const std::size_t size = v.count() * (v.count() + 1) / 2;
  for (std::size_t c = 0; c < claims.size(); ++c) {
    const bool compared = is_compared(system.model.claims[c]);
    if (values == nullptr && !compared) {
      next += size;
    } else {
      const Known start = graph.form(table, next, sigma, v);
      if (values != nullptr) values->insert(values->end(), {start.value, start.error});
      if (values == nullptr) compare(start, claims[c], graph);
    }
    // It has fallen along the flow.
    if (compared) keep_least(graph.form(table, next, sigma, v), claims[c], graph);
    if (system.model.claims[c].kind == ClaimKind::cost)
      add_cost(graph.form(table, next, sigma, v), claims[c], graph);
  }
}

lanes::LaneCode first_code(const LinearSystem& system, const LengthTable& table) {
  Graph graph(system);
  const int length = graph.input();
  const Numbers xi = graph.exact(graph.inputs(system.model.drawn.size()));
  const int sigma = graph.sigma(table, length);
  std::size_t next = 0;
  const Graph::Product z = graph.product(table, next, sigma, system.rank, xi);
  Carried carried{z.value, Nodes(system.rank * system.rank, graph.constant(0)), z.added, {}};
  const int most = graph.constant(1e300), least = graph.constant(-1e300), zero = graph.constant(0);
  for (const CarriedClaim& claim : system.claims)
    carried.claims.push_back(claim.count == 4   ? Nodes{most, most, least, least}
                             : claim.count == 2 ? Nodes{zero, zero}
                                                : Nodes{});
  Nodes values;
  follow_claims(system, table, next, sigma, xi, carried.claims, &values, graph);
  return graph.code({all_of(carried), values});
}

lanes::LaneCode step_code(const LinearSystem& system, const LengthTable& table) {
  Graph graph(system);
  const std::size_t r = system.rank;
  const int length = graph.input(), root = graph.input();
  Carried carried = carried_inputs(system, graph);
  const int sigma = graph.sigma(table, length);
  const Numbers z = known_z(system, carried, root, graph);
  // Claims first, so that what they read may then be written over.
  const std::size_t maps = r * z.count();
  follow_claims(system, table, maps, sigma, z, carried.claims, nullptr, graph);
  // The rounding of M G is a part of the sizes of z, as that of M z is.
  std::size_t next = 0;
  const double rounding = 4 * (static_cast<double>(r) + 2) * kUnitRoundoff;
  const Graph::Product moved = graph.product(table, next, sigma, r, z, rounding);
  Carried after = carried;
  after.z = moved.value;
  for (std::size_t i = 0; i < r; ++i) {
    after.b[i] = moved.added[i];
    for (std::size_t k = 0; k < r; ++k)
      after.b[i] = graph.add(graph.scaled(moved.sizes[i][k], carried.b[k]), after.b[i]);
    for (std::size_t j = 0; j < r; ++j) {
      int sum = graph.constant(0);
      for (std::size_t k = 0; k < r; ++k)
        sum = graph.add(graph.multiply(moved.M[i][k], carried.G[j * r + k]), sum);
      after.G[j * r + i] = sum;
    }
  }
  return graph.code({all_of(after)}, 2);
}

/// R of [G, sqrt(r) diag(b)]' = Q R by Gram and Schmidt: R' is the new G.
lanes::LaneCode gather_code(const LinearSystem& system) {
  Graph graph(system);
  const std::size_t r = system.rank;
  const int scale = graph.input(), root = graph.input();
  Carried carried = carried_inputs(system, graph);
  const double spread = std::sqrt(static_cast<double>(r)) * bounded::kBoundSlack;
  std::vector<Nodes> columns;  // of the matrix on the left: rows of G, then of b
  for (std::size_t i = 0; i < r; ++i) {
    Nodes& column = columns.emplace_back();
    for (std::size_t k = 0; k < r; ++k) column.push_back(carried.G[k * r + i]);
    for (std::size_t k = 0; k < r; ++k)
      column.push_back(i == k ? graph.scaled(spread, carried.b[i]) : graph.constant(0));
  }
  std::vector<Nodes> R(r, Nodes(r, graph.constant(0)));
  const auto dot = [&](const Nodes& a, const Nodes& b) {
    int sum = graph.constant(0);
    for (std::size_t k = 0; k < a.size(); ++k) sum = graph.add(graph.multiply(a[k], b[k]), sum);
    return sum;
  };
  for (std::size_t j = 0; j < r; ++j) {
    R[j][j] = graph.root(dot(columns[j], columns[j]));
    const int inverse = graph.over(graph.constant(1), graph.positive(R[j][j]));
    for (int& one : columns[j]) one = graph.multiply(one, inverse);
    for (std::size_t k = j + 1; k < r; ++k) {
      R[j][k] = dot(columns[j], columns[k]);
      for (std::size_t e = 0; e < columns[k].size(); ++e)
        columns[k][e] = graph.subtract(columns[k][e], graph.multiply(R[j][k], columns[j][e]));
    }
  }
  const double rounding = 200 * static_cast<double>(r * r) * kUnitRoundoff;
  for (std::size_t i = 0; i < r; ++i) {
    carried.z[i] = graph.multiply(carried.z[i], scale);
    int sizes = graph.constant(0);
    for (std::size_t j = 0; j < r; ++j) {
      const int one = j <= i ? graph.multiply(R[j][i], scale) : graph.constant(0);
      carried.G[j * r + i] = one;
      sizes = graph.add(graph.abs(one), sizes);
    }
    carried.b[i] = graph.add(graph.scaled(rounding, graph.multiply(sizes, root)),
                             graph.constant(16 * kLeastRow));
  }
  const int square = graph.multiply(scale, scale);
  for (Nodes& claim : carried.claims)
    for (int& one : claim) one = graph.multiply(one, square);
  return graph.code({all_of(carried)});
}

/// The value of a claim at the end of a run, with the factors of what is left of the length.
Known end_value(const LinearSystem& system, std::size_t c, const LengthTable& factors,
                std::size_t& next, int left, const Numbers& x, Graph& graph) {
  const int sigma = graph.sigma(factors, left);
  Known sum{graph.constant(0), graph.constant(0)};
  for (const LinearForm& form : system.model.claims[c].value) {
    const LengthTable::Polynomial& function = factors.functions[next];
    const int factor = graph.polynomial(factors, next++, sigma);
    const Known one = graph.form(form.Q, x);
    sum.value = graph.add(graph.multiply(factor, one.value), sum.value);
    const double rounding = 4 * (static_cast<double>(system.model.claims[c].value.size()) + 2) *
                            kUnitRoundoff * function.size;
    sum.error = graph.add(graph.scaled(function.size * bounded::kBoundSlack, one.error), sum.error);
    sum.error = graph.add(graph.scaled(function.error + rounding, graph.abs(one.value)), sum.error);
  }
  return sum;
}

lanes::LaneCode last_code(const LinearSystem& system, const LinearTables& tables) {
  Graph graph(system);
  const int rest = graph.input(), length = graph.input(), left = graph.input(),
            root = graph.input();
  Carried carried = carried_inputs(system, graph);
  const Numbers z = known_z(system, carried, root, graph);
  const int sigma = graph.sigma(tables.rest, rest);
  const int whole = graph.sigma(tables.length, length);
  std::size_t next = 0, next_length = 0;
  const auto n = static_cast<std::size_t>(system.model.A.rows()) - (system.model.constant ? 1 : 0);
  const Graph::Product end = graph.product(tables.rest, next, sigma, n, z);
  Numbers x;
  for (std::size_t i = 0; i < n; ++i) {
    int radius = end.added[i];
    for (std::size_t k = 0; k < z.count(); ++k)
      radius = graph.add(graph.scaled(end.sizes[i][k], z.radius[k]), radius);
    graph.push(end.value[i], radius, x);
  }
  graph.append_one(x);
  for (std::size_t c = 0; c < system.claims.size(); ++c) {
    if (system.model.claims[c].kind == ClaimKind::cost)
      add_cost(graph.form(tables.rest, next, sigma, z), carried.claims[c], graph);
    if (is_compared(system.model.claims[c]))
      compare(graph.form(tables.length, next_length, whole, z), carried.claims[c], graph);
  }
  Nodes values;
  std::size_t factor = 0;
  for (std::size_t c = 0; c < system.claims.size(); ++c) {
    const Known value = end_value(system, c, tables.left, factor, left, x, graph);
    values.insert(values.end(), {value.value, value.error});
  }
  return graph.code({all_of(carried), values});
}

}  // namespace

void add_code(const LinearTables& tables, LinearSystem& system) {
  system.first.emplace(first_code(system, tables.first));
  system.step.emplace(step_code(system, tables.step));
  system.gather.emplace(gather_code(system));
  system.last.emplace(last_code(system, tables));
}

}  // namespace gainsmith::packs
