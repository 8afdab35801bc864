// Internal to model: the state of one binding.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "expr/compile.h"
#include "expr/scope.h"
#include "model/bind.h"
#include "model/convex.h"
#include "model/dynamics_names.h"
#include "model/families.h"

namespace gainsmith::model {

/// What each part of a design may use (design.h).
struct Names {
  expr::Scope known;    ///< data, parameters, definitions
  expr::Scope design;   ///< and unknowns
  expr::Scope running;  ///< and gains, states
  expr::Scope results;  ///< and the objective
};

/// The values of data and parameters so far. Notes the ranks that were asked for.
struct Recorder : expr::KnownValues {
  numbers::Values values;
  mutable std::vector<Design::Rank> ranks;

  double number(const expr::Program& program) const override;
  int rank(const expr::Program& matrix, const expr::Program* tolerance) const override;
};

bool is_proper_column(expr::Shape shape);

/// A flat list is a row; where a column is declared it is turned.
expr::Expression oriented(const Value& value, bool column);

/// What is asked of values besides data and assumptions: that ranges have ends in order, and that
/// the campaign lies within its ranges.
enum class Checks { all, none };

class Binding {
 public:
  Binding(std::shared_ptr<const Problem> problem, const Overrides& overrides, Checks checks);
  Instance run();

 private:
  const Problem& problem() const { return *source_; }
  const Method& method() const { return *source_->method; }

  // bind_data.cpp
  void bind_data();
  void refuse_unknown_names() const;
  const ScalarRange* find_searched(const std::string& name) const;
  void start_at_end(const ScalarRange& searched, Design::Datum& datum) const;
  /// A datum that is declared, with what the problem gives.
  struct Given {
    Declaration declaration;
    std::optional<Value> value;
  };
  std::vector<Given> given(const Declaration& datum);
  void add_datum(const Given& datum);
  void check_shape(const Given& datum) const;
  void add_parameter(const Parameter& parameter);
  void define(Design::Datum datum, std::vector<Design::Datum>& list);
  void add_definitions();
  void add_assumption(const Named& assumption);
  int degree_of(const UnknownDeclaration& unknown, Design::Unknown& bound) const;
  void add_unknowns();
  void add_unknown(const UnknownDeclaration& unknown);
  expr::Expression instantiate(const expr::Expression& expression, const Member& member,
                               const expr::Scope& scope) const;
  expr::Shape known_shape(const Declaration& declaration, const char* what) const;

  // bind_inequalities.cpp
  void bind_inequalities();
  void bind_objective(const expr::Expression& text);
  void add_inequality(const Requirement& requirement, const Member& member);
  Design::Variable variable(const Forall& forall, const Member& member) const;
  std::vector<expr::Expression> points_of(const Forall& forall, const Member& member) const;

  void add_comparisons(const std::vector<expr::Expression>& comparisons, Design::Inequality& bound,
                       const std::string& stem, const std::string& member,
                       const expr::Scope& scope) const;

  // bind_convex.cpp
  bool reads_unknowns(const expr::Expression& part, const expr::Scope& scope) const;
  std::optional<Curvature> curvature_at(const expr::Expression& text, const expr::Node& node,
                                        const expr::Scope& scope) const;
  bool has_curvature(const expr::Expression& text, const expr::Node& node,
                     const expr::Scope& scope) const;
  expr::NodePtr with_terms(const expr::Expression& text, const expr::NodePtr& node,
                           const expr::Scope& scope) const;
  std::vector<expr::Shape> shapes_of(const expr::Expression& text, const expr::Node& call,
                                     const expr::Scope& scope) const;
  void refuse_nested(const expr::Expression& text, const expr::Node& call,
                     const expr::Scope& scope) const;
  std::vector<expr::Expression> bounds_of(const expr::Expression& text, const expr::Node& call,
                                          const expr::NodePtr& bound, expr::Scope& scope,
                                          bool strict) const;
  expr::NodePtr bounding_unknown(const expr::Expression& text, const expr::Node& call,
                                 Curvature curvature);
  expr::NodePtr bounded(const expr::Expression& text, const expr::NodePtr& node, int sign,
                        bool quantified, const expr::Scope& scope);
  std::vector<expr::Expression> affine_comparisons(const expr::Expression& stated,
                                                   expr::Scope& scope, bool quantified);

  // bind_estimates.cpp
  void note_estimate(const std::string& name, const expr::Program& program);
  expr::Estimate estimate(const expr::Program& program) const;
  void refuse_estimate(const expr::Program& program, const std::string& what) const;

  // bind_gains.cpp
  void bind_gains();
  void bind_gain_bounds();
  void add_gain(const Gain& gain);
  void add_products(const Gain& gain, const expr::Scope& scope, Design::Gain& bound) const;

  // bind_simulation.cpp
  void bind_components();
  std::vector<NamedFormula> named(const std::vector<Named>& list, const expr::Scope& scope) const;
  void bind_dynamics();
  void add_rates();
  std::set<std::string> varied() const;
  void finish_dynamics();

  // bind_claims.cpp
  void bind_claims();
  Claim instantiated(Claim claim, const Member& member) const;
  std::vector<std::pair<std::string, Claim>> readings(Claim claim) const;
  Formula constant_of_claim(const expr::Expression& text, const std::string& key) const;
  void add_claim(const Claim& claim, const std::string& title, std::optional<std::size_t> over);

  // bind_campaign.cpp
  void bind_campaign();
  void bind_starts();
  bool is_run() const;
  const Dynamics::Event* timer_event() const;
  std::size_t clock_of(const SamplingLaw& law) const;
  Design::Start start(const InitialValue& initial) const;
  std::vector<Formula> ellipsoid(const InitialValue& initial, expr::Shape state) const;
  InputError no_state(const std::string& name, const Place& place) const;
  void bind_accuracy(const RunAccuracy& accuracy);
  void check_box(const Design::Start& start, const InitialValue& initial) const;
  void check_within(const Formula& formula, const Formula& low, const Formula& high,
                    const std::string& what) const;
  std::optional<numbers::Matrix> known_value(const Formula& formula) const;
  std::optional<double> known_scalar(const Formula& formula) const;
  std::size_t state_of(const std::string& name) const;

  // bind_search.cpp
  void bind_search();
  Range range(const ScalarRange& range) const;
  Formula figure(const expr::Expression& text) const;
  void bind_expectation();
  std::vector<Figure> figures(const FigureText& text) const;
  std::optional<std::size_t> find_event(const std::string& name, const std::string& observer) const;
  std::size_t event_of(const FigureText& text, const std::string& observer) const;
  void bind_comparison();

  Formula scalar(const expr::Expression& expression, const expr::Scope& scope) const;
  Formula formula(const expr::Expression& expression, const expr::Scope& scope,
                  std::optional<expr::Shape> expected = std::nullopt) const;
  /// A value that may be a flat list, which is a column where a column is expected.
  Formula value(const Value& value, const expr::Scope& scope,
                std::optional<expr::Shape> expected) const;

  std::shared_ptr<const Problem> source_;
  Overrides overrides_;
  Checks checks_;
  std::shared_ptr<Design> design_;
  std::shared_ptr<Names> names_;
  std::shared_ptr<Recorder> recorder_;
  std::unique_ptr<DynamicsNames> dynamics_names_;  ///< from bind_components() on
};

/// The value of a datum or parameter from those declared before it.
numbers::Matrix value_of(const Design& design, const Design::Datum& datum,
                         const Overrides& overrides, const numbers::Values& values);

/// Binds the texts of a design anew for values that change its shapes. Ranges and the campaign were
/// checked with the values of the problem; a scan goes beyond them.
Instance bind_again(const Design& design, const Overrides& overrides);

/// The formula of a gain that a gain file brings, over the names of its design and the file's
/// coefficients.
expr::Program bind_gain_formula(const Instance& instance,
                                const std::vector<UnknownMatrix>& unknowns, const std::string& text,
                                const std::string& variable, const Place& place);

}  // namespace gainsmith::model
