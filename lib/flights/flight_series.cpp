#include "flights/flight_series.h"

#include <algorithm>

#include "numbers/graph/scalar_rules.h"

namespace gainsmith::flights {

using numbers::NoFormula;
using numbers::ScalarGraph;
using numbers::ScalarOp;

/// Picard's iteration x_{i+1}(s) = x(0) + int_0^s f(x_i(u)) du, from x_0 = x(0). Of a nilpotent
/// flow it comes to rest after as many passes as the flow has integrators in a row: then x_i is the
/// solution. At rest means equal nodes, so that the test is exact.
FlightSeries::FlightSeries(PackGraph& texts, const Nodes& x, bool sizes)
    : texts_(texts), graph_(texts.graph()), x_(x), sizes_(sizes) {
  for (const int node : x) values_.push_back(constant(node));
  const Nodes rates = texts.rates(x);
  for (std::size_t pass = 0; pass <= most_degree + 1; ++pass) {
    begin();
    std::vector<Series> next = values_;
    for (const int row : texts.rows()) {
      const std::size_t k = index(row);
      next[k] = integral(x[k], of_node(rates[k]));
    }
    for (std::size_t k = 0; k < next.size(); ++k)
      next[k] = next[index(texts.kept(static_cast<int>(k)))];
    if (next == values_) return;
    values_ = std::move(next);
  }
  throw NoFormula();
}

void FlightSeries::begin() {
  known_.clear();
  for (std::size_t k = 0; k < x_.size(); ++k) known_[x_[k]] = values_[k];
}

Series FlightSeries::constant(int node) {
  return {{node}, sizes_ ? Nodes{graph_.apply(ScalarOp::abs, node)} : Nodes{}};
}

/// Drops leading coefficients that are the constant 0.
void FlightSeries::trim(Series& series) {
  while (series.value.size() > 1 && graph_.is_zero(series.value.back())) {
    series.value.pop_back();
    if (sizes_) series.size.pop_back();
  }
  if (series.degree() > most_degree) throw NoFormula();
}

/// start + sum_j rate_j s^(j+1)/(j + 1).
Series FlightSeries::integral(int start, const Series& rate) {
  Series made = constant(start);
  for (std::size_t j = 0; j < rate.value.size(); ++j) {
    const int part = graph_.constant(1 / static_cast<double>(j + 1));
    made.value.push_back(graph_.multiply(part, rate.value[j]));
    if (sizes_) made.size.push_back(graph_.multiply(part, rate.size[j]));
  }
  trim(made);
  return made;
}

Series FlightSeries::of_node(int node) {
  if (const auto known = known_.find(node); known != known_.end()) return known->second;
  Series made = made_of(node);
  trim(made);
  known_[node] = made;
  return made;
}

/// Sums and products of polynomials, quotients by what rests along flows. All other operations have
/// a polynomial only where their operands rest.
Series FlightSeries::made_of(int node) {
  const ScalarGraph::Node one = graph_.nodes()[index(node)];
  switch (one.op) {
    case ScalarOp::input:
    case ScalarOp::constant:
      return constant(node);
    case ScalarOp::add:
      return combined(of_node(one.a), of_node(one.b), false);
    case ScalarOp::subtract:
      return combined(of_node(one.a), of_node(one.b), true);
    case ScalarOp::negate:
      return combined(constant(graph_.constant(0)), of_node(one.a), true);
    case ScalarOp::multiply:
      return product(of_node(one.a), of_node(one.b));
    case ScalarOp::divide: {
      const Series divisor = of_node(one.b);
      if (divisor.degree() > 0) throw NoFormula();
      const int part = graph_.divide(graph_.constant(1), divisor.value[0]);
      return scaled(of_node(one.a), part, graph_.apply(ScalarOp::abs, part));
    }
    case ScalarOp::where_positive:
    case ScalarOp::where_nonnegative:
      return chosen(one);
    case ScalarOp::element:
      throw NoFormula();
    default:
      for (const int operand : {one.a, one.b, one.c})
        if (operand >= 0 && of_node(operand).degree() > 0) throw NoFormula();
      return constant(node);
  }
}

Series FlightSeries::combined(const Series& a, const Series& b, bool negated) {
  Series made = a;
  made.value.resize(std::max(a.value.size(), b.value.size()), graph_.constant(0));
  if (sizes_) made.size.resize(made.value.size(), graph_.constant(0));
  for (std::size_t j = 0; j < b.value.size(); ++j) {
    int& node = made.value[j];
    node = negated ? graph_.subtract(node, b.value[j]) : graph_.add(node, b.value[j]);
    if (sizes_) made.size[j] = graph_.add(made.size[j], b.size[j]);
  }
  return made;
}

/// Cauchy's product c_k = sum_{i+j=k} a_i b_j; the sizes multiply alike.
Series FlightSeries::product(const Series& a, const Series& b) {
  const std::size_t terms = a.value.size() + b.value.size() - 1;
  Series made{Nodes(terms, graph_.constant(0)), Nodes(sizes_ ? terms : 0, graph_.constant(0))};
  for (std::size_t i = 0; i < a.value.size(); ++i)
    for (std::size_t j = 0; j < b.value.size(); ++j) {
      int& node = made.value[i + j];
      node = graph_.add(node, graph_.multiply(a.value[i], b.value[j]));
      if (!sizes_) continue;
      int& size = made.size[i + j];
      size = graph_.add(size, graph_.multiply(a.size[i], b.size[j]));
    }
  return made;
}

Series FlightSeries::scaled(const Series& a, int factor, int size) {
  Series made = a;
  for (int& node : made.value) node = graph_.multiply(node, factor);
  for (int& node : made.size) node = graph_.multiply(node, size);
  return made;
}

/// By what rests along flows.
Series FlightSeries::chosen(const ScalarGraph::Node& node) {
  if (of_node(node.a).degree() > 0) throw NoFormula();
  Series yes = of_node(node.b);
  Series no = of_node(node.c);
  const std::size_t terms = std::max(yes.value.size(), no.value.size());
  const bool strict = node.op == ScalarOp::where_positive;
  for (Series* branch : {&yes, &no}) {
    branch->value.resize(terms, graph_.constant(0));
    if (sizes_) branch->size.resize(terms, graph_.constant(0));
  }
  for (std::size_t j = 0; j < terms; ++j) {
    yes.value[j] = graph_.where(strict, node.a, yes.value[j], no.value[j]);
    if (sizes_) yes.size[j] = graph_.where(strict, node.a, yes.size[j], no.size[j]);
  }
  return yes;
}

/// Horner's rule.
int FlightSeries::at(const Nodes& coefficients, int s) {
  int sum = coefficients.back();
  for (std::size_t j = coefficients.size() - 1; j-- > 0;)
    sum = graph_.add(graph_.multiply(sum, s), coefficients[j]);
  return sum;
}

}  // namespace gainsmith::flights
