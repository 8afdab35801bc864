#include "numbers/conformance.h"

#include "base/eigen_scalars.h"
#include "numbers/graph/stacked_functions.h"
#include "numbers/types/dual.h"
#include "numbers/types/enclosure.h"
#include "numbers/types/jet.h"

namespace gainsmith::numbers {
namespace {

const std::vector<expr::Op> kWithoutBound = {
    expr::Op::project_polytope, expr::Op::project_ellipsoid,  expr::Op::project_affine,
    expr::Op::project_convex,   expr::Op::flow_map,           expr::Op::extremum,
    expr::Op::eigenvalues,      expr::Op::continuous_riccati, expr::Op::discrete_riccati};

template <class Scalar>
Subject real(const std::string& name, double tolerance) {
  using Value = MatrixOf<Scalar>;
  const auto to = [](const Matrix& matrix) -> Value { return matrix.cast<Scalar>(); };
  const auto from = [](const Value& value) -> Matrix {
    return value.unaryExpr([](const Scalar& x) { return static_cast<double>(x); });
  };
  return subject<Real<Scalar>>(name, tolerance, to, to, from);
}

/// What moves has a radius, too small to show in the middle.
template <class Scalar>
Subject enclosure(const std::string& name, double tolerance) {
  using Value = Enclosed<Scalar>;
  const auto exact = [](const Matrix& matrix) -> Value {
    return exactly<Scalar>(matrix.cast<Scalar>());
  };
  const auto moving = [](const Matrix& matrix) -> Value {
    return {matrix.cast<Scalar>(),
            Matrix::Constant(matrix.rows(), matrix.cols(), unit_roundoff<Scalar>())};
  };
  const auto middle = [](const Value& value) -> Matrix {
    EXPECT_TRUE(value.is_known());
    return value.mid.unaryExpr([](const Scalar& x) { return static_cast<double>(x); });
  };
  Subject result = subject<Enclosure<Scalar>>(name, tolerance, exact, moving, middle);
  result.lacks = kWithoutBound;
  result.of_jacobians = 1e-14;
  return result;
}

/// All that moves, moves in one direction.
Subject dual() {
  const auto moving = [](const Matrix& matrix) -> Dual<double> {
    return {matrix, Matrix::Ones(matrix.size(), 1), {}};
  };
  const auto value = [](const Dual<double>& x) { return x.value; };
  return subject<DualNumbers<double>>("dual", 1e-14, constant_dual<double>, moving, value);
}

/// What moves has the slope 1.
Subject jet() {
  const auto fixed = [](const Matrix& matrix) { return constant_jet(exactly<double>(matrix)); };
  const auto moving = [](const Matrix& matrix) {
    Jet result = constant_jet(exactly<double>(matrix));
    result.order = 1;
    result.derivatives[1] = exactly<double>(Matrix::Ones(matrix.rows(), matrix.cols()));
    return result;
  };
  const auto middle = [](const Jet& value) -> Matrix {
    EXPECT_TRUE(value.value().is_known());
    return value.value().mid;
  };
  Subject result = subject<JetAlgebra>("jet", 1e-14, fixed, moving, middle);
  result.lacks = kWithoutBound;
  return result;
}

/// Constants, and one vector of what moves.
Subject tape() {
  Subject result;
  result.name = "tape";
  result.tolerance = 1e-14;
  result.of_jacobians = 1e-14;
  result.evaluate = [](const expr::Program& program, const Values& fixed, const Values& moving) {
    std::map<std::string, Eigen::Index> places;
    Vector x(0);
    for (const auto& [name, value] : moving) {
      places[name] = x.size();
      x.conservativeResize(x.size() + value.size());
      x.tail(value.size()) = value.reshaped();
    }
    const auto place = [&](const std::string& name) {
      const auto found = places.find(name);
      return found == places.end() ? std::nullopt : std::optional(found->second);
    };
    StackedFunctions functions({&program, &program}, place, fixed, x.size());
    if (!functions.run(x)) return Matrix(functions.at(0, x));
    const Matrix first = functions.value(0);
    EXPECT_EQ(functions.value(1), first);
    EXPECT_TRUE(functions.run(x));
    EXPECT_EQ(functions.value(0), first) << "another run gives other bits";
    EXPECT_EQ(shape_of(first), program.shape());
    return first;
  };
  return result;
}

INSTANTIATE_TEST_SUITE_P(NumberTypes, Conformance,
                         testing::Values(real<double>("double", 1e-14),
                                         real<DoubleDouble>("31 digits", 1e-29),
                                         real<Decimal100>("100 digits", 1e-97), jet(), dual(),
                                         tape(), enclosure<double>("enclosure", 1e-14),
                                         enclosure<DoubleDouble>("enclosure 31 digits", 1e-29),
                                         enclosure<Decimal100>("enclosure 100 digits", 1e-97)),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::ranges::replace(name, ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace gainsmith::numbers
