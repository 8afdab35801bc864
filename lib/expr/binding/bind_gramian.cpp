// Observability Gramians of a hybrid system x' = F x, yc = Hc x; x+ = J x, yd = Hd x, over
// consecutive flows of the lengths t_1, ..., t_N with the N - 1 jumps between them (Tran, Bernard
// and Marconi, equations (12) and (13)):
//
//   gramian            what the outputs say of the state at the start, R_1 of
//                        R_k = W(t_k) + E_k' (Hd' Hd + J' R_{k+1} J) E_k,   R_N = W(t_N)
//   backward_gramian   what they say of the state at the end, B_N of
//                        B_k = E_k^-T J^-T (B_{k-1} + Hd' Hd) J^-1 E_k^-1 + V(t_k),   B_1 = V(t_1)
//
// with E_k = expm(F t_k), W(t) = int_0^t expm(F s)' Hc' Hc expm(F s) ds, and V(t) the same with -F.
// With M = E_N J ... J E_1:  backward = M^-T forward M^-1.
//
// They are bound to sums, products and exponentials, so that they may be used wherever these may.
#include <utility>

#include "expr/binding/emitter.h"

namespace gainsmith::expr {

namespace {

/// A' B A.
int congruence(const Emitter& make, int a, int b) {
  return make.multiply(make.multiply(make.transpose(a), b), a);
}

/// int_0^t expm(f s)' q expm(f s) ds, from expm([-f', q; 0, f] t) = [expm(-f' t), X; 0, expm(f
/// t)]: it is expm(f t)' X.
int integral(const Emitter& make, int f, int q, int t) {
  const int n = make.shape(f).rows;
  const int block = make.blocks({make.negate(make.transpose(f)), q, make.zeros({n, n}), f}, 2);
  const int both = make.exponential(block, t);
  const int x = make.part(both, 0, n, n, 2 * n);
  const int e = make.part(both, n, 2 * n, n, 2 * n);
  return make.multiply(make.transpose(e), x);
}

}  // namespace

/// The recursions above from the far end of the window; F and J n x n, Hc p x n, Hd q x n. The
/// backward Gramian is the forward one of the inverse system, with -F and J^-1.
Bound Binder::gramian(const Expression& expression, const Node& node, bool backward) {
  const auto argument = [&](std::size_t i) {
    return sized(expression, *node.children[i], bind(expression, *node.children[i]));
  };
  const int f = square_argument(expression, node, node.text);
  const int n = shape(f).rows;
  const int hc = argument(1);
  const int j = argument(2);
  const int hd = argument(3);
  const int lengths = argument(4);
  if (shape(j) != Shape{n, n}) materialise(expression, *node.children[2], {j}, {n, n});
  for (const auto& [h, at] : {std::pair{hc, 1}, std::pair{hd, 3}})
    if (shape(h).cols != n)
      materialise(expression, *node.children[static_cast<std::size_t>(at)], {h},
                  {shape(h).rows, n});
  const int count = shape(lengths).size();
  if ((shape(lengths).rows != 1 && shape(lengths).cols != 1) || count == 0)
    fail(expression, *node.children[4],
         node.text + " needs the lengths of the flows as a row or a column, not " +
             describe(expression, *node.children[4], {lengths}));

  const Emitter make(*this, expression, node);
  const int qc = make.multiply(make.transpose(hc), hc);
  const int qd = make.multiply(make.transpose(hd), hd);
  const int flow = backward ? make.negate(f) : f;
  const int jump =
      backward && count > 1
          ? make(Op::inverse, {j}, {}, node.text + ": the jump matrix J, which must be invertible,")
          : j;
  // From the far end of the window to the end whose state is meant.
  const auto length = [&](int k) { return make.element(lengths, backward ? k : count - 1 - k); };
  int sum = integral(make, flow, qc, length(0));
  for (int k = 1; k < count; ++k) {
    const int t = length(k);
    const int inner = backward ? congruence(make, jump, make.add(sum, qd))
                               : make.add(qd, congruence(make, jump, sum));
    sum = make.add(integral(make, flow, qc, t), congruence(make, make.exponential(flow, t), inner));
  }
  return {sum};
}

}  // namespace gainsmith::expr
