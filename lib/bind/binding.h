// Internal to bind: the state of one binding.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "bind/convex.h"
#include "bind/dynamics_names.h"
#include "bind/families.h"
#include "expr/compile.h"
#include "expr/scope.h"

namespace gainsmith::bind {

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
  mutable std::vector<model::Design::Rank> ranks;

  double number(const expr::Program& program) const override;
  int rank(const expr::Program& matrix, const expr::Program* tolerance) const override;
};

bool is_proper_column(expr::Shape shape);

/// A flat list is a row; where a column is declared it is turned.
expr::Expression oriented(const model::Value& value, bool column);

/// What is asked of values besides data and assumptions: that ranges have ends in order, and that
/// the campaign lies within its ranges.
enum class Checks { all, none };

class Binding {
 public:
  Binding(std::shared_ptr<const model::Problem> problem, const model::Overrides& overrides,
          Checks checks);
  model::Instance run();

 private:
  const model::Problem& problem() const { return *source_; }
  const model::Method& method() const { return *source_->method; }

  // bind_data.cpp
  void bind_data();
  void refuse_unknown_names() const;
  const model::ScalarRange* find_searched(const std::string& name) const;
  void start_at_end(const model::ScalarRange& searched, model::Design::Datum& datum) const;
  /// A datum that is declared, with what the problem gives.
  struct Given {
    model::Declaration declaration;
    std::optional<model::Value> value;
  };
  std::vector<Given> given(const model::Declaration& datum);
  void add_datum(const Given& datum);
  void check_shape(const Given& datum) const;
  void add_parameter(const model::Parameter& parameter);
  void define(model::Design::Datum datum, std::vector<model::Design::Datum>& list);
  void add_definitions();
  void add_assumption(const model::Named& assumption);
  int degree_of(const model::UnknownDeclaration& unknown, model::Design::Unknown& bound) const;
  void add_unknowns();
  void add_unknown(const model::UnknownDeclaration& unknown);
  expr::Expression instantiate(const expr::Expression& expression, const Member& member,
                               const expr::Scope& scope) const;
  expr::Shape known_shape(const model::Declaration& declaration, const char* what) const;

  // bind_inequalities.cpp
  void bind_inequalities();
  void bind_objective(const expr::Expression& text);
  void add_inequality(const model::Requirement& requirement, const Member& member);
  model::Design::Variable variable(const model::Forall& forall, const Member& member) const;
  std::vector<expr::Expression> points_of(const model::Forall& forall, const Member& member) const;

  void add_comparisons(const std::vector<expr::Expression>& comparisons,
                       model::Design::Inequality& bound, const std::string& stem,
                       const std::string& member, const expr::Scope& scope) const;

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
  void add_gain(const model::Gain& gain);
  void add_products(const model::Gain& gain, const expr::Scope& scope,
                    model::Design::Gain& bound) const;

  // bind_simulation.cpp
  void bind_components();
  std::vector<model::NamedFormula> named(const std::vector<model::Named>& list,
                                         const expr::Scope& scope) const;
  void bind_dynamics();
  void add_rates();
  std::set<std::string> varied() const;
  void finish_dynamics();

  // bind_claims.cpp
  void bind_claims();
  model::Claim instantiated(model::Claim claim, const Member& member) const;
  std::vector<std::pair<std::string, model::Claim>> readings(model::Claim claim) const;
  model::Formula constant_of_claim(const expr::Expression& text, const std::string& key) const;
  void add_claim(const model::Claim& claim, const std::string& title,
                 std::optional<std::size_t> over);

  // bind_campaign.cpp
  void bind_campaign();
  void bind_starts();
  bool is_run() const;
  const model::Dynamics::Event* timer_event() const;
  std::size_t clock_of(const model::SamplingLaw& law) const;
  model::Design::Start start(const model::InitialValue& initial) const;
  std::vector<model::Formula> ellipsoid(const model::InitialValue& initial,
                                        expr::Shape state) const;
  InputError no_state(const std::string& name, const Place& place) const;
  void bind_accuracy(const model::RunAccuracy& accuracy);
  void check_box(const model::Design::Start& start, const model::InitialValue& initial) const;
  void check_within(const model::Formula& formula, const model::Formula& low,
                    const model::Formula& high, const std::string& what) const;
  std::optional<numbers::Matrix> known_value(const model::Formula& formula) const;
  std::optional<double> known_scalar(const model::Formula& formula) const;
  std::size_t state_of(const std::string& name) const;

  // bind_search.cpp
  void bind_search();
  model::Range range(const model::ScalarRange& range) const;
  model::Formula figure(const expr::Expression& text) const;
  void bind_expectation();
  std::vector<model::Figure> figures(const model::FigureText& text) const;
  std::optional<std::size_t> find_event(const std::string& name, const std::string& observer) const;
  std::size_t event_of(const model::FigureText& text, const std::string& observer) const;
  void bind_comparison();

  model::Formula scalar(const expr::Expression& expression, const expr::Scope& scope) const;
  model::Formula formula(const expr::Expression& expression, const expr::Scope& scope,
                         std::optional<expr::Shape> expected = std::nullopt) const;
  /// A value that may be a flat list, which is a column where a column is expected.
  model::Formula value(const model::Value& value, const expr::Scope& scope,
                       std::optional<expr::Shape> expected) const;

  std::shared_ptr<const model::Problem> source_;
  model::Overrides overrides_;
  Checks checks_;
  std::shared_ptr<model::Design> design_;
  std::shared_ptr<Names> names_;
  std::shared_ptr<Recorder> recorder_;
  std::unique_ptr<DynamicsNames> dynamics_names_;  ///< from bind_components() on
};

/// Binds the texts of a design anew for values that change its shapes. Ranges and the campaign were
/// checked with the values of the problem; a scan goes beyond them.
model::Instance bind_again(const model::Design& design, const model::Overrides& overrides);

/// The formula of a gain that a gain file brings, over the names of its design and the file's
/// coefficients.
expr::Program bind_gain_formula(const model::Instance& instance,
                                const std::vector<model::UnknownMatrix>& unknowns,
                                const std::string& text, const std::string& variable,
                                const Place& place);

}  // namespace gainsmith::bind
