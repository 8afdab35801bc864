// Functions of a scalar that are unknown: a basis and a matrix for each of its elements,
//   Y(s) = sum_k phi_k(s) Y_k.
// The coefficients Y_k are unknowns like any other. Inequalities, gains and simulations call Y; a
// program is linked with the function's body before it is evaluated, so another basis changes no
// program that was bound.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "expr/program/program.h"
#include "expr/program/rewrite.h"
#include "model/design.h"

namespace gainsmith::model {

/// phi_0, phi_1, ...: 1 x 1 programs in the variable. One without instructions is the constant 1.
struct Basis {
  enum class Kind {
    monomials,  ///< 1, s, s^2, ...
    chebyshev,  ///< T_k on an interval (expr/binding/chebyshev.h), for the digits of high degrees
    weights     ///< those of the vertices of a box (forall/box.h): >= 0, their sum is 1
  };
  Kind kind = Kind::monomials;
  std::vector<expr::Program> elements;
  std::vector<std::string> texts;  ///< of each element in the matrix language; "" for 1
  /// d phi_k/ds for k = 1, 2, ...; phi_0 is a constant. None where it is not known.
  std::vector<expr::Program> derivatives;
};

Basis monomials(const std::string& variable, int degree, const Place& place);

/// T_0, ..., T_degree with [low, high] for [-1, 1].
Basis chebyshev(const std::string& variable, int degree, const Range& in, const Place& place);

struct Function {
  std::string name;      ///< "YL"
  std::string variable;  ///< "tau"
  expr::Shape shape;     ///< of the function and of each coefficient
  Structure structure = Structure::full;
  Basis basis;
  Place place;  ///< of the declaration

  /// "YL(tau)".
  std::string signature() const { return name + "(" + variable + ")"; }
  std::size_t size() const { return basis.elements.size(); }
  /// "YL_0", "YL_1", ....
  std::vector<std::string> coefficients() const;
  /// In the matrix language: "YL_0 + YL_1*tau", or with the weights before the coefficients.
  std::string text() const;
  /// What a call of the function is linked with.
  expr::Body body() const;
  /// The same of derivative(YL); the basis must have derivatives.
  expr::Body derivative() const;
};

/// "YL_2": the coefficient k = 0, 1, ... of the function `name`.
std::string coefficient_name(const std::string& name, std::size_t k);

/// The polynomials that an unknown function's basis has `size` of.
Basis basis_of(const Design::Unknown& unknown, std::size_t size);

/// "YL_0 + YL_1*tau + YL_2*tau^2", for `degree` 2.
std::string polynomial_text(const std::string& name, const std::string& variable, int degree);

/// The bodies of the functions of a program, by name.
class Bodies {
 public:
  Bodies() = default;
  explicit Bodies(const std::vector<Function>& functions);

  /// With its derivative, where the basis has one.
  void set(const Function& function);
  /// A body of another make, whose derivative is not known.
  void set(const std::string& name, expr::Body body);
  bool contains(const std::string& name) const { return bodies_.contains(name); }
  /// What replaces a call. InputError at its place for a derivative that is not known,
  /// std::logic_error for a function without a body.
  const expr::Body& body(const std::string& name, const expr::Instruction& call) const;
  /// The program without calls, by body().
  expr::Program link(const expr::Program& program) const;

 private:
  std::map<std::string, expr::Body> bodies_;
};

}  // namespace gainsmith::model
