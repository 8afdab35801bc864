#include "verdict/exact_form.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "numbers/types/enclosure.h"
#include "verdict/wide_algebra.h"

namespace gainsmith::verdict {

namespace {

using numbers::Ball;
using numbers::Enclosed;

/// Brings elements into order and adds up those of one place.
template <class S>
void settle(ExactElements<S>& elements) {
  const auto place = [](const ExactElement<S>& e) { return std::tie(e.column, e.row); };
  const auto before = [&](const auto& a, const auto& b) { return place(a) < place(b); };
  if (!std::is_sorted(elements.begin(), elements.end(), before))
    std::stable_sort(elements.begin(), elements.end(), before);
  std::size_t kept = 0;
  for (std::size_t at = 0; at < elements.size();) {
    ExactElement<S> sum = std::move(elements[at++]);
    for (; at < elements.size() && place(elements[at]) == place(sum); ++at) {
      const Ball<S> both = sum.ball() + elements[at].ball();
      sum.mid = both.mid;
      sum.rad = both.rad;
    }
    if (!sum.ball().is_zero()) elements[kept++] = std::move(sum);
  }
  elements.resize(kept);
}

/// Elements that are 0 with a radius of 0 are left out.
template <class S>
ExactElements<S> elements_of(const Enclosed<S>& matrix) {
  ExactElements<S> result;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      if (const Ball<S> ball = matrix.ball(i, j); !ball.is_zero())
        result.push_back({static_cast<int>(i), static_cast<int>(j), ball.mid, ball.rad});
  return result;
}

/// out: every coefficient mapped linearly, element by element. `map(element, push)` pushes what
/// becomes of an element.
template <class S, class Map>
void map_elements(const ExactForm<S>& form, expr::Shape shape, ExactForm<S>& out, const Map& map) {
  out = {shape, false, {}, {}};
  for (const auto& [i, elements] : form.terms) {
    ExactElements<S> result;
    const auto push = [&](int row, int column, const Ball<S>& value) {
      if (!value.is_zero()) result.push_back({row, column, value.mid, value.rad});
    };
    for (const ExactElement<S>& e : elements) map(e, push);
    spend(static_cast<double>(result.size()) * work_of<S>());
    settle(result);
    if (!result.empty()) out.terms.emplace_back(i, std::move(result));
  }
}

/// Products with the elements of one matrix, whose magnitudes are known.
template <class S>
class KnownFactor {
 public:
  explicit KnownFactor(const Enclosed<S>& matrix)
      : matrix_(matrix), sizes_(numbers::magnitudes<S>(matrix.mid)) {}

  Eigen::Index rows() const { return matrix_.rows(); }
  Eigen::Index cols() const { return matrix_.cols(); }
  bool is_zero(Eigen::Index i, Eigen::Index j) const {
    return sizes_(i, j) == 0 && matrix_.rad(i, j) == 0;
  }
  /// e times element (i, j); `size` is the magnitude of e.mid. With a = e and b the element, the
  /// radius is
  ///     |a| rad_b + rad_a (|b| + rad_b) + 2 u |a| |b|,
  /// rounded upward. Wide balls (rad above the midpoint) and products that may underflow take the
  /// general rule.
  Ball<S> times(const ExactElement<S>& e, double size, Eigen::Index i, Eigen::Index j) const {
    const double rad = matrix_.rad(i, j), own = sizes_(i, j);
    constexpr double least = 1e-140;  // products of what is larger do not underflow
    if ((rad == 0 && e.rad == 0) || !(own > least && size > least) || rad > own || e.rad > size)
      return e.ball() * matrix_.ball(i, j);
    const double error =
        size * rad + e.rad * (own + rad) + 2 * numbers::unit_roundoff<S>() * size * own;
    return {e.mid * matrix_.mid(i, j), numbers::bound_or_nothing(numbers::up(error, 8))};
  }

 private:
  const Enclosed<S>& matrix_;
  numbers::Matrix sizes_;
};

/// a + b or a - b, coefficient by coefficient.
template <class S>
void add_forms(const ExactForm<S>& a, const ExactForm<S>& b, bool subtract, ExactForm<S>& out) {
  out = {a.shape, false, {}, {}};
  std::map<int, ExactElements<S>> sum;
  for (auto& [i, elements] : terms_of(a)) sum.emplace(i, std::move(elements));
  for (auto& [i, elements] : terms_of(b)) {
    if (subtract)
      for (ExactElement<S>& e : elements) e.mid = -e.mid;
    ExactElements<S>& into = sum[i];
    const bool fresh = into.empty();
    into.insert(into.end(), std::make_move_iterator(elements.begin()),
                std::make_move_iterator(elements.end()));
    if (!fresh) settle(into);
  }
  for (auto& [i, elements] : sum)
    if (!elements.empty()) out.terms.emplace_back(i, std::move(elements));
}

template <class S>
ExactForm<S> constant_of(Enclosed<S> number) {
  const expr::Shape shape{static_cast<int>(number.rows()), static_cast<int>(number.cols())};
  return {shape, true, std::move(number), {}};
}

/// The operations with at least one operand that is not constant. What is not affine, as the
/// product of two forms, is an EvaluationError.
template <class S>
struct ExactRules {
  using Op = expr::Op;
  using Form = ExactForm<S>;
  using At = expr::Step<Form>;
  template <Op op>
  using Is = expr::Is<op>;

  [[noreturn]] static void refuse(Op op) {
    throw expr::EvaluationError("the " + to_string(op) + " is not affine in the unknowns");
  }

  template <Op op>
  requires expr::OneOf<op, Op::add, Op::subtract>
  void operator()(Is<op>, const At& at, Form& out) const {
    add_forms(at[0], at[1], op == Op::subtract, out);
  }
  void operator()(Is<Op::negate>, const At& at, Form& out) const {
    map_elements(at[0], at.shape(), out,
                 [](const auto& e, const auto& push) { push(e.row, e.column, -e.ball()); });
  }
  void operator()(Is<Op::multiply>, const At& at, Form& out) const {
    if (at[0].constant) {
      const KnownFactor<S> left(at[0].number);
      map_elements(at[1], at.shape(), out, [&](const auto& e, const auto& push) {
        const double size = numbers::magnitude(e.mid);
        for (Eigen::Index i = 0; i < left.rows(); ++i)
          if (!left.is_zero(i, e.row))
            push(static_cast<int>(i), e.column, left.times(e, size, i, e.row));
      });
    } else if (at[1].constant) {
      const KnownFactor<S> right(at[1].number);
      map_elements(at[0], at.shape(), out, [&](const auto& e, const auto& push) {
        const double size = numbers::magnitude(e.mid);
        for (Eigen::Index j = 0; j < right.cols(); ++j)
          if (!right.is_zero(e.column, j))
            push(e.row, static_cast<int>(j), right.times(e, size, e.column, j));
      });
    } else {
      refuse(Op::multiply);
    }
  }
  void operator()(Is<Op::scale>, const At& at, Form& out) const {
    if (at[0].constant) {
      const KnownFactor<S> factor(at[0].number);
      map_elements(at[1], at.shape(), out, [&](const auto& e, const auto& push) {
        push(e.row, e.column, factor.times(e, numbers::magnitude(e.mid), 0, 0));
      });
    } else if (at[1].constant) {
      spread(at[0], at[1].number, at.shape(), out);
    } else {
      refuse(Op::scale);
    }
  }
  void operator()(Is<Op::elementwise_product>, const At& at, Form& out) const {
    if (!at[0].constant && !at[1].constant) refuse(Op::elementwise_product);
    const Form& form = at[0].constant ? at[1] : at[0];
    const KnownFactor<S> factor(at[0].constant ? at[0].number : at[1].number);
    map_elements(form, at.shape(), out, [&](const auto& e, const auto& push) {
      push(e.row, e.column, factor.times(e, numbers::magnitude(e.mid), e.row, e.column));
    });
  }
  template <Op op>
  requires expr::OneOf<op, Op::divide, Op::elementwise_quotient>
  void operator()(Is<op>, const At& at, Form& out) const {
    if (!at[1].constant) refuse(op);
    map_elements(at[0], at.shape(), out, [&](const auto& e, const auto& push) {
      const Ball<S> by =
          op == Op::divide ? at[1].number.ball(0, 0) : at[1].number.ball(e.row, e.column);
      if (by.is_zero()) expr::fault::division_by_zero();
      push(e.row, e.column, e.ball() / by);
    });
  }
  template <Op op>
  requires expr::OneOf<op, Op::power, Op::elementwise_power>
  void operator()(Is<op>, const At& at, Form& out) const {
    const expr::Shape shape = at.shape();
    if (at.attribute(0) > 1) refuse(op);
    if (at.attribute(0) == 1)
      out = at[0];
    else if (op == Op::power)
      out = constant_of<S>(numbers::exact_identity<S>(shape.rows));
    else
      out = constant_of<S>(
          numbers::exactly<S>(numbers::MatrixOf<S>::Constant(shape.rows, shape.cols, S(1))));
  }
  /// That of what is affine does not depend on what moves.
  void operator()(Is<Op::jacobian>, const At& at, Form& out) const {
    std::vector<Enclosed<S>> values;
    for (const Form* operand : at.operands)
      values.push_back(operand->constant ? operand->number
                                         : numbers::exactly<S>(numbers::MatrixOf<S>::Zero(
                                               operand->shape.rows, operand->shape.cols)));
    std::vector<const Enclosed<S>*> operands;
    for (const Enclosed<S>& value : values) operands.push_back(&value);
    Enclosed<S> result;
    numbers::Enclosure<S>().apply(at.instruction, operands, result);
    out = constant_of<S>(std::move(result));
  }
  void operator()(Is<Op::transpose>, const At& at, Form& out) const {
    map_elements(at[0], at.shape(), out,
                 [](const auto& e, const auto& push) { push(e.column, e.row, e.ball()); });
  }
  void operator()(Is<Op::blocks>, const At& at, Form& out) const {
    const auto columns = static_cast<std::size_t>(at.attribute(0));
    std::map<int, ExactElements<S>> sum;
    int row = 0;
    for (std::size_t first = 0; first < at.operands.size(); first += columns) {
      int column = 0;
      for (std::size_t k = first; k < first + columns; ++k) {
        for (auto& [i, elements] : terms_of(at[k]))
          for (ExactElement<S>& e : elements)
            sum[i].push_back({row + e.row, column + e.column, std::move(e.mid), e.rad});
        column += at[k].shape.cols;
      }
      row += at[first].shape.rows;
    }
    out = {at.shape(), false, {}, {}};
    for (auto& [i, elements] : sum) {
      settle(elements);
      out.terms.emplace_back(i, std::move(elements));
    }
  }
  void operator()(Is<Op::index>, const At& at, Form& out) const {
    const int row = at.attribute(0), column = at.attribute(2);
    const expr::Shape shape = at.shape();
    map_elements(at[0], shape, out, [&](const auto& e, const auto& push) {
      const int i = e.row - row, j = e.column - column;
      if (i >= 0 && i < shape.rows && j >= 0 && j < shape.cols) push(i, j, e.ball());
    });
  }
  void operator()(Is<Op::identity>, const At& at, Form& out) const {
    const expr::Shape shape = at.shape();
    map_elements(at[0], shape, out, [&](const auto& e, const auto& push) {
      for (int i = 0; i < shape.rows; ++i) push(i, i, e.ball());
    });
  }
  void operator()(Is<Op::fill>, const At& at, Form& out) const {
    const expr::Shape shape = at.shape();
    map_elements(at[0], shape, out, [&](const auto& e, const auto& push) {
      for (int j = 0; j < shape.cols; ++j)
        for (int i = 0; i < shape.rows; ++i) push(i, j, e.ball());
    });
  }
  void operator()(Is<Op::trace>, const At& at, Form& out) const {
    map_elements(at[0], at.shape(), out, [](const auto& e, const auto& push) {
      if (e.row == e.column) push(0, 0, e.ball());
    });
  }
  void operator()(Is<Op::diagonal_of>, const At& at, Form& out) const {
    map_elements(at[0], at.shape(), out, [](const auto& e, const auto& push) {
      if (e.row == e.column) push(e.row, 0, e.ball());
    });
  }
  void operator()(Is<Op::diagonal_matrix>, const At& at, Form& out) const {
    map_elements(at[0], at.shape(), out, [](const auto& e, const auto& push) {
      push(e.row + e.column, e.row + e.column, e.ball());
    });
  }
  template <Op op>
  requires(expr::is_function(op) || expr::is_one_of(op, {Op::constant, Op::zeros, Op::where})) void
  operator()(Is<op>, const At&, Form&) const {
    refuse(op);
  }

 private:
  /// A scalar form times a matrix.
  static void spread(const Form& scalar, const Enclosed<S>& matrix, expr::Shape shape, Form& out) {
    const KnownFactor<S> factor(matrix);
    map_elements(scalar, shape, out, [&](const auto& e, const auto& push) {
      const double size = numbers::magnitude(e.mid);
      for (Eigen::Index j = 0; j < factor.cols(); ++j)
        for (Eigen::Index i = 0; i < factor.rows(); ++i)
          if (!factor.is_zero(i, j))
            push(static_cast<int>(i), static_cast<int>(j), factor.times(e, size, i, j));
    });
  }
};

}  // namespace

template <class S>
std::vector<std::pair<int, ExactElements<S>>> terms_of(const ExactForm<S>& form) {
  if (!form.constant) return form.terms;
  std::vector<std::pair<int, ExactElements<S>>> result;
  if (auto elements = elements_of(form.number); !elements.empty())
    result.emplace_back(0, std::move(elements));
  return result;
}

template <class S>
ExactForm<S> exact_constant(Enclosed<S> number) {
  return constant_of(std::move(number));
}

template <class S>
ExactForm<S> exact_unknown(const lmi::Unknown& unknown) {
  ExactForm<S> result{unknown.shape, false, {}, {}};
  for (int k = 0; k < unknown.count; ++k) {
    ExactElements<S> elements;
    for (const auto& [row, column] : unknown.places(k)) elements.push_back({row, column, S(1), 0});
    settle(elements);
    result.terms.emplace_back(unknown.first + k, std::move(elements));
  }
  return result;
}

template <class S>
void ExactAlgebra<S>::apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
                            Value& out) const {
  if (std::any_of(operands.begin(), operands.end(),
                  [](const Value* operand) { return !operand->constant; }))
    return expr::dispatch(ExactRules<S>{}, instruction, operands, out);
  std::vector<const Enclosed<S>*> values;
  for (const Value* operand : operands) values.push_back(&operand->number);
  out.constant = true;
  out.shape = instruction.shape;
  out.terms.clear();
  numbers::Enclosure<S>().apply(instruction, values, out.number);
}

template ExactForm<DoubleDouble> exact_constant(Enclosed<DoubleDouble>);
template ExactForm<Decimal100> exact_constant(Enclosed<Decimal100>);
template std::vector<std::pair<int, ExactElements<DoubleDouble>>> terms_of(
    const ExactForm<DoubleDouble>&);
template std::vector<std::pair<int, ExactElements<Decimal100>>> terms_of(
    const ExactForm<Decimal100>&);
template ExactForm<DoubleDouble> exact_unknown(const lmi::Unknown&);
template ExactForm<Decimal100> exact_unknown(const lmi::Unknown&);
template struct ExactAlgebra<DoubleDouble>;
template struct ExactAlgebra<Decimal100>;

}  // namespace gainsmith::verdict
