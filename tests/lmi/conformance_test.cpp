// The affine form is a number type like the others, but for what is not affine in what moves.
#include "numbers/conformance.h"

#include <algorithm>
#include <memory>

#include "forall/variables.h"
#include "lmi/affine_algebra.h"

namespace gainsmith::numbers {
namespace {

/// The tables that forms refer to: one scalar unknown g, and tau in [0, 2].
struct Tables {
  forall::MonomialTable monomials{{forall::testing::interval("tau", 0, 2)}};
  lmi::Unknowns unknowns{{{"g", {}, model::Structure::scalar}}};
};

lmi::AffineForm term(const Matrix& matrix, lmi::AffineForm::Key key) {
  lmi::AffineForm form{shape_of(matrix), {}};
  lmi::add_term(form, key, lmi::Sparse(matrix.sparseView(0.0, 0.0)));
  return form;
}

/// At g = 1 and tau = 1.
Matrix value(const Tables& tables, const lmi::AffineForm& form) {
  Matrix sum = Matrix::Zero(form.shape.rows, form.shape.cols);
  for (const auto& [key, matrix] : form.terms) {
    double factor = 1;
    for (const forall::Factor& f : tables.monomials[key.first])
      factor *= forall::evaluate(f.atom, 1);
    sum += factor * Matrix(matrix);
  }
  return sum;
}

/// A matrix M moves as M g or as M tau.
Subject affine(const std::string& name, double tolerance, bool by_unknown) {
  const auto tables = std::make_shared<Tables>();
  const lmi::AffineForm::Key key{
      by_unknown ? 0 : tables->monomials.index(0, forall::Atom{1, 0, 0, false}),
      by_unknown ? 1 : 0};
  Subject result = subject<lmi::AffineAlgebra>(
      name, tolerance, lmi::constant_form, [=](const Matrix& matrix) { return term(matrix, key); },
      [=](const lmi::AffineForm& form) { return value(*tables, form); },
      {&tables->monomials, &tables->unknowns});
  // Where a moving value stands in one branch only, it has to be written as a sum.
  result.may_refuse = [](const expr::Program& program, const Subject::Moves& moves) {
    return is_not_affine(program, moves) ||
           std::ranges::any_of(program.code, [](const auto& i) { return i.op == expr::Op::where; });
  };
  return result;
}

INSTANTIATE_TEST_SUITE_P(AffineForms, Conformance,
                         testing::Values(affine("unknown", 1e-14, true),
                                         affine("tau", 1e-11, false)),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gainsmith::numbers
