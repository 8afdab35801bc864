// A method: a published design as read. Every expression keeps its place in the file. bind() makes
// a design of it (design.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "expr/text/ast.h"
#include "expr/text/parser.h"
#include "model/component.h"
#include "model/declaration.h"
#include "model/measured.h"
#include "model/range.h"

namespace gainsmith::model {

/// An unknown: a matrix or, with `variable`, a function of a scalar given by coefficient matrices,
/// or, with `arguments`, a polynomial in their elements.
struct UnknownDeclaration : Declaration {
  std::string variable;                     ///< "tau" of `of: tau`; empty: a matrix
  std::optional<expr::Expression> degree;   ///< of its polynomial; none: 0
  std::optional<expr::Expression> least{};  ///< degree of its terms: 2 of `degree: [2, 4]`
  std::optional<ScalarRange> in{};          ///< "in: [0, T2]": where its digits are kept
};

/// A scalar that the engineer may tune.
struct Parameter {
  std::string name;
  std::optional<expr::Expression> fallback;
  std::string help;
  Place place;
  /// Where synthesis searches for it when the problem gives no value.
  std::optional<ScalarRange> search{};
};

/// A gain: a matrix or, with `variable`, a function of a scalar: "F(tau): inv(P)*Z(tau)"; with
/// indices a family: "L(i in 1..N): inv(P(i))*Y(i)".
struct Gain {
  std::string name;
  expr::Expression value;
  Place place;
  std::string variable;  ///< empty: a matrix
  std::vector<expr::Index> indices{};
};

/// "forall: tau in [a, b]", "forall: k in {a, b, c}" or "forall: A in conv{A1, A2}".
struct Forall {
  std::string variable;
  Over over = Over::interval;
  std::vector<expr::Expression> points;  ///< the two ends, the elements, the vertices, or n of R^n
  Place place;
  bool of_vector = false;  ///< "forall: h in v": the elements of one vector
};

/// A named matrix inequality, or a chain of them; with indices a family of them.
struct Requirement {
  std::string name;
  std::vector<expr::Index> indices;
  std::vector<expr::Expression> conditions;  ///< "i != j": those of the members
  std::vector<Forall> forall;
  expr::Expression that;
  Place place;
  /// Asked for as a sum of squares, which it also is with a variable over all numbers; where the
  /// comparisons of `where` hold.
  bool sos = false;
  std::vector<expr::Expression> where{};
  std::optional<int> degree{};  ///< of all its terms
  bool adds_degree = false;     ///< to that of the inequality
};

/// What a simulation can check of the gains. Expressions may use data, parameters, gains, values of
/// unknowns, states, outputs, signals and the timer.
struct Claim {
  std::string name;
  ClaimKind kind = ClaimKind::nonincreasing;
  expr::Expression value;                     ///< scalar
  std::optional<expr::Expression> flow_cost;  ///< cost
  std::optional<expr::Expression> jump_cost;  ///< cost
  std::optional<expr::Expression> factor;     ///< shrinks
  Place place;
  std::vector<expr::Index> indices{};
  std::optional<expr::Expression> bound{};  ///< below, above: of constants
  std::optional<expr::Expression> after{};  ///< the time from which on it is claimed
  std::string over{};                       ///< the event just after whose jumps alone it is
  Place over_place{};
  double tolerance = 0;  ///< relative to the bound (claims/claim_check.h)
};

struct Method {
  bool has_dynamics = false;

  std::string name;
  std::string source;   ///< paper, theorem, equations
  std::string summary;  ///< one line
  std::string task;     ///< one of tasks()
  std::string example;  ///< a problem to begin with, by its name: "everyday/lqr"
  std::string file;     ///< where it was read, for messages
  std::string text;     ///< the whole file

  std::vector<Declaration> data;
  std::vector<Parameter> parameters;
  std::vector<Named> assume;  ///< comparisons of scalars that data and parameters must satisfy
  std::vector<UnknownDeclaration> unknowns;
  std::vector<Let> let;
  std::vector<Requirement> require;
  std::vector<Requirement> necessary;  ///< what any gains satisfy: it may show that there are none
  std::optional<expr::Expression> minimize;
  std::vector<Gain> gains;
  std::vector<Named> report;  ///< values that the synthesis shows beside the gains

  Component plant;
  std::vector<Component> observers;
  std::vector<EventText> events;
  std::vector<std::string> order;      ///< of the events, when it is not that of the file
  std::vector<Named> inputs;           ///< functions of the time t
  std::vector<MeasuredText> measured;  ///< inputs and outputs of the plant that files say
  std::vector<NoiseText> noise;
  Place dynamics_place;        ///< where the dynamics begin
  std::vector<Named> signals;  ///< e.g. the errors e = z - zh
  std::vector<Claim> claims;
  std::string no_campaign;  ///< why nothing is simulated: nothing moves; empty: it may be
};

/// What methods are for, in the order in which they are listed.
const std::vector<std::string>& tasks();

/// Its name for what is left of the clock of its timer; empty: it has none.
std::string timer_name(const Method& method);

/// The names of the scalar data and the parameters of a method, in its order: what may be
/// overridden.
std::vector<std::string> scalar_names(const Method& method);

/// InputError at `place` when `name` is none of scalar_names, with the nearest that is.
void check_scalar_name(const Method& method, const std::string& name, const Place& place);

}  // namespace gainsmith::model
