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
#include <functional>
#include <utility>

#include "expr/binder.h"

namespace gainsmith::expr {

namespace {

/// Emits operations whose shapes follow from their operands, all at the place of one call.
class Emitter {
 public:
  using Emit = std::function<int(Op, std::vector<int>, Attributes, std::string)>;

  Emitter(Emit emit, std::function<int(Shape)> zeros, std::function<Shape(int)> shape)
      : emit_(std::move(emit)), zeros_(std::move(zeros)), shape_(std::move(shape)) {}

  int add(int a, int b) const { return emit_(Op::add, {a, b}, {}, ""); }
  int negate(int a) const { return emit_(Op::negate, {a}, {}, ""); }
  int multiply(int a, int b) const { return emit_(Op::multiply, {a, b}, {}, ""); }
  int transpose(int a) const { return emit_(Op::transpose, {a}, {}, ""); }
  /// A' B A.
  int congruence(int a, int b) const { return multiply(multiply(transpose(a), b), a); }
  int exponential(int a, int t) const {
    return emit_(Op::matrix_exponential, {emit_(Op::scale, {t, a}, {}, "")}, {}, "");
  }
  int inverse(int a, const std::string& what) const { return emit_(Op::inverse, {a}, {}, what); }
  /// The k-th element of a row or column.
  int element(int vector, int k) const {
    const bool row = shape_(vector).rows == 1;
    return emit_(Op::index, {vector}, row ? Attributes{0, 1, k, k + 1} : Attributes{k, k + 1, 0, 1},
                 "");
  }
  /// int_0^t expm(f s)' q expm(f s) ds, from expm([-f', q; 0, f] t) = [expm(-f' t), X; 0, expm(f
  /// t)]: it is expm(f t)' X.
  int integral(int f, int q, int t) const {
    const int n = shape_(f).rows;
    const int zero = zeros_({n, n});
    const int block = emit_(Op::blocks, {negate(transpose(f)), q, zero, f}, {2}, "");
    const int both = exponential(block, t);
    const int x = emit_(Op::index, {both}, {0, n, n, 2 * n}, "");
    const int e = emit_(Op::index, {both}, {n, 2 * n, n, 2 * n}, "");
    return multiply(transpose(e), x);
  }

 private:
  Emit emit_;
  std::function<int(Shape)> zeros_;
  std::function<Shape(int)> shape_;
};

}  // namespace

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

  const Emitter make(
      [&](Op op, std::vector<int> operands, Attributes attributes, std::string text) {
        const Shape of = shape_of(op, operands, attributes).value();
        return emit(expression, node, op, std::move(operands), of, attributes, std::move(text));
      },
      [&](Shape of) { return emit(expression, node, Op::zeros, {}, of); },
      [&](int at) { return shape(at); });
  const int qc = make.multiply(make.transpose(hc), hc);
  const int qd = make.multiply(make.transpose(hd), hd);
  const int flow = backward ? make.negate(f) : f;
  const int jump = backward && count > 1 ? make.inverse(j, node.text +
                                                               ": the jump matrix J, which must be "
                                                               "invertible,")
                                         : j;
  // From the far end of the window to the end whose state is meant.
  const auto length = [&](int k) { return make.element(lengths, backward ? k : count - 1 - k); };
  int sum = make.integral(flow, qc, length(0));
  for (int k = 1; k < count; ++k) {
    const int t = length(k);
    const int inner = backward ? make.congruence(jump, make.add(sum, qd))
                               : make.add(qd, make.congruence(jump, sum));
    sum = make.add(make.integral(flow, qc, t), make.congruence(make.exponential(flow, t), inner));
  }
  return {sum};
}

}  // namespace gainsmith::expr
