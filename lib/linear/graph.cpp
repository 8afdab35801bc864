#include "linear/graph.h"

#include <cmath>

#include "linear/block.h"
#include "linear/error_graph.h"

namespace gainsmith::linear {

namespace {

using model::ClaimKind;

/// A square below that of this is none.
constexpr double kLeastRow = 1e-150;

/// What a lane carries as nodes.
struct Carried {
  Nodes z, G, b;
  std::vector<Nodes> claims;
};

Carried carried_inputs(const LinearSystem& system, ErrorGraph& graph) {
  Carried made;
  made.z = graph.inputs(system.rank);
  made.G = graph.inputs(system.rank * system.rank);
  made.b = graph.inputs(system.rank);
  for (const CarriedNumbers& claim : system.claims)
    made.claims.push_back(graph.inputs(claim.count));
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
int row_of(const LinearSystem& system, const Nodes& G, std::size_t i, ErrorGraph& graph) {
  int sum = graph.abs(G[i]);
  for (std::size_t j = 1; j < system.rank; ++j)
    sum = graph.add(graph.abs(G[j * system.rank + i]), sum);
  return sum;
}

/// z with the bounds of its errors: root |row of G| + b.
Numbers known_z(const LinearSystem& system, const Carried& carried, int root, ErrorGraph& graph) {
  Numbers z;
  for (std::size_t i = 0; i < system.rank; ++i) {
    const int row = row_of(system, carried.G, i, graph);
    graph.push(carried.z[i], graph.add(graph.multiply(root, row), carried.b[i]), z);
  }
  graph.append_one(z);
  return z;
}

/// v just after a jump against all before it. A tolerance forgives a part of the size of the least
/// value, at least that of its lower bound where this is positive.
void compare(const Known& v, double tolerance, Nodes& claim, ErrorGraph& graph) {
  int low = claim[0], high = claim[1];
  if (tolerance > 0) {
    claim[kWholeRise] =
        graph.maximum(claim[kWholeRise], graph.subtract(graph.subtract(v.value, v.error), high));
    constexpr double rounding = 0x1p-30;
    const int size = graph.maximum(graph.abs(low), graph.abs(high));
    high = graph.add(high, graph.scaled(tolerance * (1 + rounding), size));
    low = graph.maximum(low, graph.scaled(1 + tolerance * (1 - rounding), low));
  }
  claim[2] = graph.maximum(claim[2], graph.subtract(graph.add(v.value, v.error), low));
  claim[3] = graph.maximum(claim[3], graph.subtract(graph.subtract(v.value, v.error), high));
}

/// The least v - error and the least v + error so far.
void keep_least(const Known& v, Nodes& claim, ErrorGraph& graph) {
  claim[0] = graph.minimum(claim[0], graph.subtract(v.value, v.error));
  claim[1] = graph.minimum(claim[1], graph.add(v.value, v.error));
}

/// The largest v - error and v + error so far.
void keep_largest(const Known& v, Nodes& claim, ErrorGraph& graph) {
  claim[0] = graph.maximum(claim[0], graph.subtract(v.value, v.error));
  claim[1] = graph.maximum(claim[1], graph.add(v.value, v.error));
}

/// A cost is a sum, with the sum of its errors.
void add_cost(const Known& cost, Nodes& claim, ErrorGraph& graph) {
  claim[0] = graph.add(cost.value, claim[0]);
  claim[1] = graph.add(cost.error, claim[1]);
}

/// A form of z with the error that the claim has in this block.
Known form_in_block(const LengthTable& table, std::size_t& next, int sigma, const Nodes& z,
                    int error, ErrorGraph& graph) {
  return {graph.form_value(table, next, sigma, z), error};
}

/// The claims over the first flow and the jump at its end, and their values just after its start.
Nodes start_claims(const LinearSystem& system, const LengthTable& table, std::size_t next,
                   int sigma, const Numbers& xi, std::vector<Nodes>& claims, ErrorGraph& graph) {
  Nodes values;
  for (std::size_t c = 0; c < claims.size(); ++c) {
    const Known start = graph.form(table, next, sigma, xi);
    values.insert(values.end(), {start.value, start.error});
    if (is_bounded(system.model.claims[c])) keep_largest(start, claims[c], graph);
    if (is_compared(system.model.claims[c]))
      keep_least(graph.form(table, next, sigma, xi), claims[c], graph);
    if (system.model.claims[c].kind == ClaimKind::cost)
      add_cost(graph.form(table, next, sigma, xi), claims[c], graph);
  }
  return values;
}

/// The claims over another flow and the jump at its end.
void follow_claims(const LinearSystem& system, const LengthTable& table, std::size_t next,
                   int sigma, const Nodes& z, std::vector<Nodes>& claims, ErrorGraph& graph) {
  const std::size_t size = z.size() * (z.size() + 1) / 2;
  for (std::size_t c = 0; c < claims.size(); ++c) {
    if (is_compared(system.model.claims[c])) {
      const int error = claims[c][kBlockError];
      compare(form_in_block(table, next, sigma, z, error, graph), system.model.claims[c].tolerance,
              claims[c], graph);
      // It has fallen along the flow.
      keep_least(form_in_block(table, next, sigma, z, error, graph), claims[c], graph);
    } else if (is_bounded(system.model.claims[c])) {
      keep_largest(form_in_block(table, next, sigma, z, claims[c][kPeakError], graph), claims[c],
                   graph);
    } else {
      next += size;
    }
    if (system.model.claims[c].kind == ClaimKind::cost)
      claims[c][0] = graph.add(graph.form_value(table, next, sigma, z), claims[c][0]);
  }
}

/// The errors of claims over a block, with bounds of z and its errors for all its flows.
void bound_claims(const LinearSystem& system, const LengthTable& table, std::size_t next,
                  const Numbers& z, std::vector<Nodes>& claims, ErrorGraph& graph) {
  const std::size_t size = z.count() * (z.count() + 1) / 2;
  for (std::size_t c = 0; c < claims.size(); ++c) {
    if (is_compared(system.model.claims[c])) {
      const int start = graph.form_error(table, next, z);
      claims[c][kBlockError] = graph.maximum(start, graph.form_error(table, next, z));
    } else if (is_bounded(system.model.claims[c])) {
      claims[c][kPeakError] = graph.form_error(table, next, z);
    } else {
      next += size;
    }
    if (system.model.claims[c].kind == ClaimKind::cost)
      claims[c][1] = graph.add(graph.scaled(static_cast<double>(system.flows_of_block),
                                            graph.form_error(table, next, z)),
                               claims[c][1]);
  }
}

/// From xi to z behind the first jump. z has the error b of this product alone, so G = 0.
lanes::LaneCode first_code(const LinearSystem& system, const LengthTable& table) {
  ErrorGraph graph(system.model.constant);
  const int length = graph.input();
  const Numbers xi = graph.exact(graph.inputs(system.model.drawn.size()));
  graph.give(table);
  const int sigma = graph.sigma(table, length);
  std::size_t next = 0;
  const ErrorGraph::Product z = graph.product(table, next, sigma, system.rank, xi);
  Carried carried{z.value, Nodes(system.rank * system.rank, graph.constant(0)), z.added, {}};
  const int most = graph.constant(1e300), least = graph.constant(-1e300), zero = graph.constant(0);
  for (const CarriedNumbers& claim : system.claims)
    carried.claims.push_back(
        claim.count > kComparedNumbers    ? Nodes{most, most, least, least, zero, least}
        : claim.count == kComparedNumbers ? Nodes{most, most, least, least, zero}
        : claim.count == kCostNumbers     ? Nodes{zero, zero}
        : claim.count == kPeakNumbers     ? Nodes{least, least, zero}
                                          : Nodes{});
  const Nodes values = start_claims(system, table, next, sigma, xi, carried.claims, graph);
  return graph.code({all_of(carried), values});
}

/// z+ = M z and G+ = M G, with M the r x r (or r x (r + 1)) polynomials of the length, and the
/// claims over this flow.
lanes::LaneCode step_code(const LinearSystem& system, const LengthTable& table) {
  ErrorGraph graph(system.model.constant);
  const std::size_t r = system.rank;
  const int length = graph.input();
  Carried carried = carried_inputs(system, graph);
  const int sigma = graph.sigma(table, length);
  const Nodes z = graph.exact(carried.z).value;
  // Claims first, so that what they read may then be written over.
  const std::size_t maps = r * z.size();
  follow_claims(system, table, maps, sigma, z, carried.claims, graph);
  Carried after = carried;
  const auto dot = [&](const Nodes& row, const auto& element, std::size_t count) {
    int sum = graph.constant(0);
    for (std::size_t k = 0; k < count; ++k)
      sum = graph.add(graph.multiply(row[k], element(k)), sum);
    return sum;
  };
  std::size_t next = 0;
  for (std::size_t i = 0; i < r; ++i) {
    Nodes row;
    for (std::size_t j = 0; j < z.size(); ++j)
      row.push_back(graph.polynomial(table, next++, sigma));
    after.z[i] = dot(
        row, [&](std::size_t k) { return z[k]; }, z.size());
    for (std::size_t j = 0; j < r; ++j)
      after.G[j * r + i] = dot(
          row, [&](std::size_t k) { return carried.G[j * r + k]; }, r);
  }
  return graph.code({all_of(after)}, 1);
}

/// R of [G, sqrt(r) diag(b)]' = Q R by Gram and Schmidt, by rows.
std::vector<Nodes> triangulated(const LinearSystem& system, const Carried& carried,
                                ErrorGraph& graph) {
  const std::size_t r = system.rank;
  const double spread = std::sqrt(static_cast<double>(r)) * kBoundSlack;
  std::vector<Nodes> columns;  // of the matrix on the left: rows of G, then of b
  for (std::size_t i = 0; i < r; ++i) {
    Nodes& column = columns.emplace_back();
    for (std::size_t k = 0; k < r; ++k) column.push_back(carried.G[k * r + i]);
    for (std::size_t k = 0; k < r; ++k)
      column.push_back(i == k ? graph.scaled(spread, carried.b[i]) : graph.constant(0));
  }
  // Modified Gram and Schmidt. R' R = G G' + r diag(b)^2, so
  // |row i of R'|^2 = |row i of G|^2 + r b_i^2.
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
  return R;
}

/// rho, and what b is at the start of a block: the rounding of R. Then b, and z with its bounds, over
/// the block.
Numbers over_block(const LinearSystem& system, const BlockBounds& bounds, int root,
                   Carried& carried, ErrorGraph& graph) {
  const std::size_t r = system.rank;
  const double rounding = 200 * static_cast<double>(r * r) * kUnitRoundoff;
  Nodes rho, size, b;
  for (std::size_t i = 0; i < r; ++i) {
    rho.push_back(graph.multiply(root, row_of(system, carried.G, i, graph)));
    b.push_back(graph.add(graph.scaled(rounding, rho[i]), graph.constant(16 * kLeastRow)));
    size.push_back(graph.add(graph.add(graph.abs(carried.z[i]), rho[i]), b[i]));
  }
  if (system.model.constant) size.push_back(graph.constant(1));
  const auto grown = [&](const numbers::Matrix& by, std::size_t i, const Nodes& of, int sum) {
    for (std::size_t k = 0; k < of.size(); ++k) {
      const double one = by(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      if (one != 0) sum = graph.add(graph.scaled(one, of[k]), sum);
    }
    return sum;
  };
  Numbers z;
  for (std::size_t i = 0; i < r; ++i) {
    const int zero = graph.constant(0);
    carried.b[i] = grown(bounds.added, i, size, grown(bounds.growth, i, b, zero));
    z.value.push_back(carried.z[i]);
    z.radius.push_back(grown(bounds.growth, i, rho, carried.b[i]));
    z.size.push_back(grown(bounds.growth, i, size, zero));
  }
  graph.append_one(z);
  return z;
}

/// Once a block: R' takes the place of G, all is scaled by a power of 2, claims by its square, and
/// bounds for the next block are made.
lanes::LaneCode gather_code(const LinearSystem& system, const LengthTable& table) {
  ErrorGraph graph(system.model.constant);
  const std::size_t r = system.rank;
  const int scale = graph.input();
  const int root = graph.scaled(kBoundSlack, graph.input());
  Carried carried = carried_inputs(system, graph);
  const std::vector<Nodes> R = triangulated(system, carried, graph);
  for (std::size_t i = 0; i < r; ++i) {
    carried.z[i] = graph.multiply(carried.z[i], scale);
    for (std::size_t j = 0; j < r; ++j)
      carried.G[j * r + i] = j <= i ? graph.multiply(R[j][i], scale) : graph.constant(0);
  }
  const int square = graph.multiply(scale, scale);
  for (Nodes& claim : carried.claims)
    for (int& one : claim) one = graph.multiply(one, square);
  const Numbers z =
      over_block(system, block_bounds(table, r, system.model.constant, system.flows_of_block), root,
                 carried, graph);
  bound_claims(system, table, r * z.count(), z, carried.claims, graph);
  return graph.code({all_of(carried)});
}

/// The value of a claim at the end of a run, with the factors of what is left of the length.
Known end_value(const LinearSystem& system, std::size_t c, const LengthTable& factors,
                std::size_t& next, int left, const Numbers& x, ErrorGraph& graph) {
  const int sigma = graph.sigma(factors, left);
  Known sum{graph.constant(0), graph.constant(0)};
  for (const LinearForm& form : system.model.claims[c].value) {
    const LengthTable::Polynomial& function = factors.functions[next];
    const int factor = graph.polynomial(factors, next++, sigma);
    const Known known = graph.form(form.Q, x);
    sum.value = graph.add(graph.multiply(factor, known.value), sum.value);
    const double rounding = 4 * (static_cast<double>(system.model.claims[c].value.size()) + 2) *
                            kUnitRoundoff * function.size;
    sum.error = graph.add(graph.scaled(function.size * kBoundSlack, known.error), sum.error);
    sum.error =
        graph.add(graph.scaled(function.error + rounding, graph.abs(known.value)), sum.error);
  }
  return sum;
}

/// The rest of the last flow, without a jump: x = E(rest) B z with radii, then values and costs at
/// the end.
lanes::LaneCode last_code(const LinearSystem& system, const LinearTables& tables) {
  ErrorGraph graph(system.model.constant);
  const int rest = graph.input(), length = graph.input(), left = graph.input(),
            root = graph.input();
  Carried carried = carried_inputs(system, graph);
  const LengthTable& end_table = tables.rest.whole;
  graph.give(end_table);
  const Numbers z = known_z(system, carried, root, graph);
  const int sigma = graph.sigma(end_table, rest);
  const int whole = graph.sigma(tables.length, length);
  std::size_t next = 0, next_length = 0;
  const auto n = static_cast<std::size_t>(system.model.A.rows()) - (system.model.constant ? 1 : 0);
  const ErrorGraph::Product end = graph.product(end_table, next, sigma, n, z);
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
      add_cost(graph.form(end_table, next, sigma, z), carried.claims[c], graph);
    if (is_compared(system.model.claims[c]))
      compare(graph.form(tables.length, next_length, whole, z), system.model.claims[c].tolerance,
              carried.claims[c], graph);
    if (is_bounded(system.model.claims[c]))
      keep_largest(graph.form(tables.length, next_length, whole, z), carried.claims[c], graph);
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
  system.first.emplace(first_code(system, tables.first.whole));
  system.step.emplace(step_code(system, tables.step));
  system.gather.emplace(gather_code(system, tables.step));
  system.last.emplace(last_code(system, tables));
}

}  // namespace gainsmith::linear
