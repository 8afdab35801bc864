// Operations on the nodes of a scalar graph, with decisions as numbers.
//
// Lanes do not branch: both results are computed, and `pick` takes one of them. So a decision that
// is known when the graph is made costs nothing.
#pragma once

#include "numbers/graph/scalar_graph.h"

namespace gainsmith::flights {

/// Operations on nodes. What is true is 1, what is false 0; a number that is none is not positive.
/// A test that only picks takes no operation of its own.
class LaneTerms {
 public:
  explicit LaneTerms(numbers::ScalarGraph& graph) : graph_(graph) {}

  int number(double value) { return graph_.constant(value); }
  int add(int a, int b) { return graph_.add(a, b); }
  int minus(int a, int b) { return graph_.subtract(a, b); }
  int minus(int a) { return graph_.negate(a); }
  int times(int a, int b) { return graph_.multiply(a, b); }
  /// a b of a number a; the larger of two; the root of what is positive, otherwise 0.
  int part(double a, int b) { return graph_.multiply(number(a), b); }
  int abs(int a) { return graph_.apply(numbers::ScalarOp::abs, a); }
  int most(int a, int b) { return graph_.apply(numbers::ScalarOp::maximum, a, b); }
  int root(int a) { return graph_.apply(numbers::ScalarOp::sqrt, most(a, number(0))); }
  /// a/b; `otherwise` where b is 0.
  int quotient(int a, int b, double otherwise) {
    const int is = is_positive(abs(b));
    return pick(is, graph_.divide(a, pick(is, b, number(1))), number(otherwise));
  }
  /// 1 or -1; -1 of 0.
  int sign(int a) { return pick(is_positive(a), number(1), number(-1)); }

  int is_positive(int a) { return graph_.where(true, a, number(1), number(0)); }
  int is_at_least_0(int a) { return graph_.where(false, a, number(1), number(0)); }
  /// a == b, of finite a.
  int is_equal(int a, double b) { return no(is_positive(abs(minus(a, number(b))))); }
  int no(int a) { return pick(a, number(0), number(1)); }
  int both(int a, int b) { return a == b ? a : pick(a, b, number(0)); }
  int either(int a, int b) { return a == b ? a : pick(a, number(1), b); }
  /// What is true picks the first.
  int pick(int is, int a, int b) {
    if (a == b) return a;
    if (graph_.is_constant(is)) return graph_.value(is) > 0 ? a : b;
    const numbers::ScalarGraph::Node test = graph_.nodes()[static_cast<std::size_t>(is)];
    const bool strict = test.op == numbers::ScalarOp::where_positive;
    if (!strict && test.op != numbers::ScalarOp::where_nonnegative)
      return graph_.where(true, is, a, b);
    const auto is_number = [&](int node, double value) {
      return graph_.is_constant(node) && graph_.value(node) == value;
    };
    if (is_number(test.b, 1) && is_number(test.c, 0)) return graph_.where(strict, test.a, a, b);
    if (is_number(test.b, 0) && is_number(test.c, 1)) return graph_.where(strict, test.a, b, a);
    return graph_.where(true, is, a, b);
  }

 private:
  numbers::ScalarGraph& graph_;
};

}  // namespace gainsmith::flights
