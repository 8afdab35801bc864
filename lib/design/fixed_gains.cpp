#include "design/fixed_gains.h"

#include "base/named.h"
#include "design/sos_statements.h"
#include "design/sums_of_squares.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "bind/stated.h"
#include "design/gain_values.h"
#include "design/synthesize.h"
#include "expr/binding/substitute.h"
#include "verdict/printed_check.h"

namespace gainsmith::design {

namespace {

/// Relative to the largest element: gains that differ by less are the same computation, rounded.
constexpr double kSameGain = 1e-12;

/// The datum that a gain becomes: no other has this name.
std::string datum_name(const std::string& gain) { return "value of " + gain; }

/// A matrix of decimals as a formula.
model::Formula decimals_formula(const model::Decimals& decimals, const Place& place) {
  expr::Composer compose(place);
  std::vector<int> elements;
  for (const std::string& decimal : decimals.elements) {
    const bool negative = decimal.starts_with('-');
    const int number = compose.number(negative ? decimal.substr(1) : decimal);
    elements.push_back(negative ? compose.apply(expr::Op::negate, {number}) : number);
  }
  const expr::Shape shape = decimals.shape;
  const int whole = shape.size() == 0 ? compose.apply(expr::Op::zeros, {}, shape)
                    : shape.is_scalar()
                        ? elements.front()
                        : compose.apply(expr::Op::blocks, elements, shape, {shape.cols});
  return {compose.take(whole), place, decimals.key};
}

/// The input that a program is, if it is nothing else.
const std::string* only_input(const expr::Program& program) {
  const bool alone = program.code.size() == 1 && program.code[0].op == expr::Op::input;
  return alone ? &program.inputs[0].name : nullptr;
}

/// Makes data of the gains of a file, one after the other in the order of the method.
class Fixing {
 public:
  Fixing(const model::Instance& instance, const model::Gains& gains)
      : gains_(gains),
        stated_(bind::state(instance, gains)),
        design_(*instance.design),
        place_{gains.file} {
    result_.instance = instance;
  }

  FixedGains run() {
    keep_bases();
    for (const model::Design::Gain& gain : result_.instance.design->gains) fix(gain);
    for (model::Design::Inequality& inequality : design_.inequalities)
      for (model::Design::Comparison& comparison : inequality.comparisons)
        comparison.difference = expr::substitute(comparison.difference, replaced_);
    design_.gains.clear();
    design_.objective.reset();
    design_.quotient.reset();
    design_.search.reset();
    design_.report.clear();
    result_.instance.design = std::make_shared<const model::Design>(std::move(design_));
    evaluate();
    return std::move(result_);
  }

 private:
  using Replaced = expr::Replacements;

  /// The file's bases in the place of others.
  void keep_bases() {
    for (const auto& [name, basis] : gains_.bases) {
      const auto known = result_.instance.values.find(name);
      if (known == result_.instance.values.end() || known->second != basis)
        set_datum(decimals_at(gains_, "bases." + name, basis), name);
    }
  }

  void set_datum(const model::Decimals& decimals, const std::string& name) {
    model::Design::Datum datum;
    datum.name = name;
    datum.shape = decimals.shape;
    datum.value = decimals_formula(decimals, place_);
    datum.place = place_;
    const auto same = [&](const model::Design::Datum& known) { return known.name == name; };
    for (auto* list : {&design_.data, &design_.parameters})
      if (const auto found = std::find_if(list->begin(), list->end(), same); found != list->end()) {
        found->value = datum.value;
        return;
      }
    design_.data.push_back(std::move(datum));
  }

  /// Values of data from their programs, in order.
  void evaluate() {
    model::Instance& instance = result_.instance;
    numbers::Values values;
    for (const model::Design::Datum* datum : in_order(*instance.design))
      values[datum->name] = model::value_of(*instance.design, *datum, instance.overrides, values);
    instance.values = std::move(values);
  }

  /// The unknowns of the formula that were not replaced, in the order of the method.
  std::vector<std::string> unknowns_of(const expr::Program& formula) const {
    std::vector<std::string> names;
    for (const model::Design::Unknown& unknown : design_.unknowns) {
      const auto calls = [&](const expr::Input& function) {
        return function.name == unknown.name ||
               function.name == expr::derivative_name(unknown.name);
      };
      if (formula.uses(unknown.name) ||
          std::any_of(formula.functions.begin(), formula.functions.end(), calls))
        names.push_back(unknown.name);
    }
    return names;
  }

  /// Three cases: the formula is a datum, which takes the value; it is solved for an unknown, which
  /// is replaced everywhere; or neither, and an edited gain is stuck.
  void fix(const model::Design::Gain& gain) {
    const model::GainFunction* function = find_named(gains_.gain_functions, gain.name);
    const bool is_function = function != nullptr;
    if (is_function && function->kind != model::GainFunction::Kind::polynomial) {
      result_.solvable = false;
      if (function->formula != gain.formula.text) stick(gain);
      return;
    }
    const auto matrix = std::find_if(gains_.gains.begin(), gains_.gains.end(),
                                     [&](const auto& one) { return one.first == gain.name; });
    if (!is_function && matrix == gains_.gains.end()) return;  // it has no value
    const bool edited = is_edited(gain);
    if (edited) result_.edited.push_back(gain.name);
    const expr::Program formula = expr::substitute(gain.formula.program, replaced_);
    const std::vector<std::string> unknowns = unknowns_of(formula);
    const std::string* datum = only_input(formula);
    if (unknowns.empty() && datum != nullptr && !is_function)
      return set_datum(decimals_at(gains_, "gains." + gain.name, matrix->second), *datum);
    if (const auto solution = simplest(unknowns, gain, formula))
      return replace(solution->first, solution->second, gain, function);
    if (!unknowns.empty()) result_.solvable = false;
    if (edited) stick(gain);
  }

  void stick(const model::Design::Gain& gain) {
    result_.stuck.push_back(gain.name + ": " + gain.formula.text);
  }

  /// Whether the gain is something else than its formula at the unknowns of the file.
  bool is_edited(const model::Design::Gain& gain) const {
    numbers::Values values = stated_.values;
    // Where the gain is a datum, this is the problem's.
    const auto datum = result_.instance.values.find(gain.name);
    if (datum != result_.instance.values.end()) values[gain.name] = datum->second;
    const expr::Program formula = stated_.bodies.link(gain.formula.program);
    const expr::Program* given = nullptr;
    expr::Program body;
    if (!gain.variable.empty()) {
      body = stated_.bodies.link(stated_.bodies.body(gain.name, {}).program);
      given = &body;
    }
    // Of functions at a few points: polynomials that agree there are the same.
    constexpr int kPoints = 33;
    for (int k = 0; k < (given != nullptr ? kPoints : 1); ++k) {
      if (given != nullptr)
        values[gain.variable] = numbers::Matrix::Constant(1, 1, k / (kPoints - 1.0));
      if (!model::has_values(formula, values)) return true;
      const numbers::Matrix expected =
          given != nullptr ? numbers::evaluate(formula, values) : gain_value(formula, values);
      const numbers::Matrix found =
          given != nullptr ? numbers::evaluate(*given, values) : stated_.values.at(gain.name);
      if (expected.size() == 0) continue;
      if (!((expected - found).cwiseAbs().maxCoeff() <= kSameGain * expected.cwiseAbs().maxCoeff()))
        return true;
    }
    return false;
  }

  /// What the gain is: a datum, or the polynomial over its coefficients, which are data.
  expr::Program value_of(const model::Design::Gain& gain, const model::GainFunction* function) {
    const std::string name = datum_name(gain.name);
    if (function == nullptr) {
      set_datum(decimals_at(gains_, "gains." + gain.name, *gains_.find(gain.name)), name);
      expr::Composer compose(place_);
      return compose.take(compose.input(name, gain.shape));
    }
    const auto& coefficients = function->coefficients;
    for (std::size_t k = 0; k < coefficients.size(); ++k)
      set_datum(decimals_at(gains_, model::coefficient_key(gain.name, k), coefficients[k]),
                model::coefficient_name(name, k));
    const int degree = static_cast<int>(coefficients.size()) - 1;
    return model::Function{name,
                           gain.variable,
                           gain.shape,
                           model::Structure::full,
                           model::monomials(gain.variable, degree, place_),
                           place_}
        .body()
        .program;
  }

  /// Whether an inequality has the derivative of an unknown function.
  bool is_differentiated(const std::string& unknown) const {
    const std::string name = expr::derivative_name(unknown);
    for (const model::Design::Inequality& inequality : design_.inequalities)
      for (const model::Design::Comparison& comparison : inequality.comparisons)
        if (has_named(comparison.difference.functions, name)) return true;
    return false;
  }

  /// The unknown that a formula is solved for and what it is there, over the gain's datum. Of
  /// several the one with the fewest inverses: what has an inverse of an unknown is not affine in
  /// it. None: nothing is.
  std::optional<std::pair<std::string, expr::Program>> simplest(
      const std::vector<std::string>& unknowns, const model::Design::Gain& gain,
      const expr::Program& formula) const {
    std::optional<std::pair<std::string, expr::Program>> best;
    const auto inverses = [](const expr::Program& program) {
      return std::ranges::count(program.code, expr::Op::inverse, &expr::Instruction::op);
    };
    for (const std::string& name : unknowns) {
      // Values of a formula have no structure, unless they are the gain itself.
      const std::string* itself = only_input(formula);
      const bool free = unknown(name).structure == model::Structure::full ||
                        unknown(name).shape.is_scalar() || (itself != nullptr && *itself == name);
      if (!free || is_differentiated(name)) continue;
      auto found = expr::isolated(formula, name, gain.variable, datum_name(gain.name));
      if (found && (!best || inverses(*found) < inverses(best->second)))
        best = std::pair(name, std::move(*found));
    }
    return best;
  }

  const model::Design::Unknown& unknown(const std::string& name) const {
    return *find_named(design_.unknowns, name);
  }

  /// Puts the solution in the place of the unknown, also in the replacements made before.
  void replace(const std::string& name, const expr::Program& solution,
               const model::Design::Gain& gain, const model::GainFunction* function) {
    Replaced given;
    given.inputs.emplace(datum_name(gain.name), value_of(gain, function));
    const expr::Program program = expr::substitute(solution, given);
    Replaced replaced;
    if (unknown(name).variable.empty())
      replaced.inputs.emplace(name, program);
    else
      replaced.functions.emplace(name, expr::Body{gain.variable, program});
    for (auto& [known, earlier] : replaced_.inputs) earlier = expr::substitute(earlier, replaced);
    for (auto& [known, earlier] : replaced_.functions)
      earlier.program = expr::substitute(earlier.program, replaced);
    replaced_.inputs.merge(replaced.inputs);
    replaced_.functions.merge(replaced.functions);
    std::erase_if(design_.unknowns,
                  [&](const model::Design::Unknown& known) { return known.name == name; });
  }

  const model::Gains& gains_;
  model::Stated stated_;
  model::Design design_;
  Place place_;
  Replaced replaced_;
  FixedGains result_;
};

/// The unknowns of the file as one vector; none when one is missing, or has another shape or
/// structure.
std::optional<std::vector<double>> packed(const lmi::Unknowns& unknowns,
                                          const model::Gains& gains) {
  std::vector<double> x(static_cast<std::size_t>(unknowns.size()), 0.0);
  for (const lmi::Unknown& unknown : unknowns.list()) {
    const numbers::Matrix* matrix = gains.find(unknown.name);
    if (matrix == nullptr || numbers::shape_of(*matrix) != unknown.shape) return std::nullopt;
    for (int k = 0; k < unknown.count; ++k) {
      const auto places = unknown.places(k);
      const double value = (*matrix)(places.front().first, places.front().second);
      for (const auto& [row, column] : places)
        if ((*matrix)(row, column) != value) return std::nullopt;
      x[static_cast<std::size_t>(unknown.first + k - 1)] = value;
    }
  }
  return x;
}

/// Step 1. Whether something certainly fails.
bool check_own(const lmi::Inequalities& inequalities, const std::vector<double>& x,
               const sdp::Options& options, GainCheck& check) {
  if (has_sums_of_squares(inequalities.design())) {
    model::Gains own;
    check_sums_of_squares(inequalities, x, options, own);
    if (own.verdict != model::Verdict::yes)
      for (const auto& inequality : inequalities.design().inequalities)
        check.not_shown.push_back(inequality.name);
    check.margins = std::move(own.margins);
    check.message = own.solver.message;
    return false;
  }
  using Status = forall::DomainProof::Status;
  verdict::PrintedCheck printed(inequalities, x);
  bool fails = false;
  for (std::size_t i = 0; i < inequalities.statements.size(); ++i) {
    const auto& comparisons = inequalities.statements[i].stated->comparisons;
    for (std::size_t c = 0; c < comparisons.size(); ++c) {
      const forall::DomainProof proof = printed.check(i, c);
      model::Margin margin;
      margin.name = comparisons[c].name;
      margin.strict = comparisons[c].strict;
      margin.reached = proof.margin;
      if (proof.point) margin.worst_point = proof.point->label;
      margin.holds = proof.status == Status::holds;
      if (!margin.holds) check.not_shown.push_back(margin.name);
      fails = fails || proof.status == Status::fails;
      check.margins.push_back(std::move(margin));
    }
  }
  return fails;
}

/// Step 2.
void solve_anew(const model::Instance& instance, const sdp::Options& options, GainCheck& check) {
  try {
    const model::Gains solved = synthesize(instance, options);
    check.verdict = solved.verdict;
    check.message = solved.solver.message;
    if (!solved.margins.empty()) check.margins = solved.margins;
  } catch (const InputError& error) {
    check.message = "what remains unknown cannot be solved for: " + error.message();
  }
}

}  // namespace

FixedGains fix_gains(const model::Instance& instance, const model::Gains& gains) {
  return Fixing(instance, gains).run();
}

GainCheck check_gains(const model::Instance& instance, const model::Gains& gains,
                      const sdp::Options& options) {
  const FixedGains fixed = fix_gains(instance, gains);
  GainCheck check;
  check.edited = fixed.edited;
  if (instance.design->inequalities.empty()) {
    check.verdict = model::Verdict::yes;
    return check;
  }
  if (!fixed.stuck.empty()) {
    for (const std::string& gain : fixed.stuck)
      check.message += (check.message.empty() ? "" : "; ") + gain;
    check.message =
        "an edited gain whose formula cannot be solved for an unknown: " + check.message;
    return check;
  }
  const lmi::Inequalities inequalities(fixed.instance);
  // Step 1 where the file has all unknowns that remain, then step 2 where it may help.
  const bool nothing_unknown = inequalities.unknowns.size() == 0;
  if (const auto x = packed(inequalities.unknowns, gains)) {
    const bool fails = check_own(inequalities, *x, options, check);
    if (check.not_shown.empty()) {
      check.verdict = model::Verdict::yes;
      check.own_unknowns = true;
      return check;
    }
    // What a file without gains says is about its unknowns.
    const bool only_unknowns =
        instance.design->gains.empty() && has_sums_of_squares(*instance.design);
    if (nothing_unknown || only_unknowns) {
      if (fails) check.verdict = model::Verdict::no;
      return check;
    }
  }
  if (fixed.solvable)
    solve_anew(fixed.instance, options, check);
  else
    check.message = "the gains are formulas over the unknowns of the file, so none are solved for";
  return check;
}

}  // namespace gainsmith::design
