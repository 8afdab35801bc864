// Internal to bind: one binding, and what is made of it so far.
//
// The parts are bound one after the other, each with the names that those before it made. Scopes
// grow: known < design < running.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "bind/dynamics_names.h"
#include "expr/binding/scope.h"

namespace gainsmith::bind {

/// What each part of a design may use (design.h).
struct Names {
  expr::Scope known;                ///< data, parameters, definitions
  expr::Scope design;               ///< and unknowns
  expr::Scope running;              ///< and gains, states
  expr::Scope results;              ///< of the design, its gains and the objective
  std::vector<std::string> unread;  ///< unread_names()
};

/// The values of data and parameters so far. Notes the ranks, units and gains that were asked
/// for.
struct Recorder : expr::KnownValues {
  numbers::Values values;
  mutable std::vector<model::Design::Rank> ranks;
  mutable std::vector<model::Design::Units> units_found;
  mutable std::vector<model::Design::Plant> plants;

  /// Each evaluates over `values`.
  double number(const expr::Program& program) const override;
  int rank(const expr::Program& matrix, const expr::Program* tolerance) const override;
  std::vector<int> units(const expr::Program& A, const expr::Program& C) const override;
  std::vector<double> output_gain(const expr::Program& A, const expr::Program& B,
                                  const expr::Program& C, bool discrete) const override;
};

/// What is asked of values besides data and assumptions: that ranges have ends in order, and that
/// the campaign lies within its ranges.
enum class Checks { all, none };

/// One binding: of what, and what is made of it so far. The parts (data.h, observer_families.h,
/// inequalities.h, gains.h, simulation.h, search.h, claims.h, campaign.h) are bound one after the
/// other; each reads what those before it made.
struct Binding {
  Binding(std::shared_ptr<const model::Problem> problem, const model::Overrides& overrides,
          Checks checks);

  const model::Problem& problem() const { return *source; }
  const model::Method& method() const { return *source->method; }

  /// What is bound; bind_observer_families() replaces it by one with plain observers.
  std::shared_ptr<const model::Problem> source;
  model::Overrides overrides;
  Checks checks;
  std::shared_ptr<model::Design> design;
  std::shared_ptr<Names> names;
  /// It is the known values of all scopes.
  std::shared_ptr<Recorder> recorder;
  std::map<std::string, expr::Expression> data_texts;  ///< of data and parameters, by name
  std::unique_ptr<DynamicsNames> dynamics_names;       ///< from bind_components() on
};

/// What the texts of a method of the user's own declare and do not read, a sentence each.
std::vector<std::string> unread_names(const Binding& binding, const std::set<std::string>& read);

/// Binds the texts of a design anew for values that change its shapes. Ranges and the campaign were
/// checked with the values of the problem; a scan goes beyond them.
model::Instance bind_again(const model::Design& design, const model::Overrides& overrides);

}  // namespace gainsmith::bind
