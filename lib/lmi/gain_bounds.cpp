#include "lmi/gain_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "base/number.h"
#include "lmi/balance.h"
#include "lmi/gain_units.h"
#include "numbers/dense/dense.h"

namespace gainsmith::lmi {

namespace {

using Factor = model::Design::Product::Factor;

/// A matrix that is a factor of a function of the gain's variable: "", "*tau", "*exp(-2*tau)".
struct Part {
  AffineForm form;
  std::string factor;
};

/// A form split by the functions of the gain's variable.
std::vector<Part> parts_of(const AffineForm& form, const forall::MonomialTable& monomials,
                           const std::string& variable) {
  std::map<int, AffineForm> by_monomial;
  if (form.terms.empty() && form.products.empty()) by_monomial[0].shape = form.shape;
  for (const auto& [key, matrix] : form.terms) {
    AffineForm& part = by_monomial[key.first];
    part.shape = form.shape;
    part.terms.emplace(std::pair(0, key.second), matrix);
  }
  for (Product product : form.products) {
    AffineForm& part = by_monomial[product.monomial];
    part.shape = form.shape;
    product.monomial = 0;
    part.products.push_back(std::move(product));
  }
  std::vector<Part> parts;
  for (auto& [index, part] : by_monomial)
    parts.push_back({std::move(part),
                     index == 0 ? "" : "*" + to_string(monomials[index].front().atom, variable)});
  return parts;
}

/// Whether a text is a call of the function.
bool is_call_of(const std::string& text, const std::string& function) {
  const std::size_t after = text.find_first_not_of(" \t\n", function.size());
  return text.starts_with(function) && after < text.size() && text[after] == '(';
}

/// What of a gain's formula is bounded: with a coefficient for each call of an unknown function, by
/// the call's text, or, without coefficients, at a value of the gain's variable.
struct Choice {
  std::map<std::string, std::string> coefficients;
  std::optional<double> at;

  /// " at s = 0.35", for what is said.
  std::string where(const std::string& variable) const {
    return at ? " at " + variable + " = " + brief(*at) : "";
  }
};

/// The unknown function that a text calls; nullptr where it calls none.
const model::Function* function_called(const Inequalities& of, const std::string& text) {
  const auto found =
      std::find_if(of.functions.begin(), of.functions.end(),
                   [&](const model::Function& f) { return is_call_of(text, f.name); });
  return found == of.functions.end() ? nullptr : &*found;
}

/// The calls of functions in a factor, as they are written.
std::vector<std::string> calls_of(const Factor& factor) {
  std::vector<std::string> texts;
  for (const auto& [begin, length] : factor.calls)
    texts.push_back(factor.text.substr(begin, length));
  return texts;
}

/// Whether the formula is bounded at points: coefficients bound nothing where the basis is not that
/// of weights and powers, or where a function is inverted.
bool is_bounded_at_points(const Inequalities& of, const model::Design::Gain& gain) {
  using Kind = model::Basis::Kind;
  for (const std::string& text : calls_of(gain.whole))
    if (const auto* function = function_called(of, text);
        function != nullptr && function->basis.kind == Kind::chebyshev)
      return true;
  return std::any_of(gain.products.begin(), gain.products.end(), [&](const auto& product) {
    const auto* function = function_called(of, product.inverse);
    return function != nullptr && function->basis.kind != Kind::weights;
  });
}

/// The ends and the extrema between them of a Chebyshev polynomial, on the interval over which the
/// variable runs in the inequalities.
std::vector<Choice> points_of(const Inequalities& of, const model::Design::Gain& gain) {
  if (gain.variable.empty()) return {{}};
  std::size_t most = 2;
  for (const std::string& text : calls_of(gain.whole))
    if (const auto* function = function_called(of, text)) most = std::max(most, function->size());
  std::vector<Choice> points;
  for (const Statement& statement : of.statements)
    for (const forall::Variable& variable : statement.domain) {
      if (variable.name != gain.variable || !variable.is_interval() || !points.empty()) continue;
      for (std::size_t k = 0; k <= most; ++k) {
        // Extrema of the Chebyshev polynomial of degree `most` on [low, high]; the ends exactly.
        const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(most);
        const double middle = variable.low / 2 + variable.high / 2;
        const double half = variable.high / 2 - variable.low / 2;
        points.push_back({{},
                          k == 0      ? variable.low
                          : k == most ? variable.high
                                      : middle - half * std::cos(angle)});
      }
    }
  return points;
}

/// A gain's formula with each call Y(...) of an unknown function replaced by one of its
/// coefficients, in all combinations: the gain is bounded when all of them are.
std::vector<Choice> choices_of(const Inequalities& of, const model::Design::Gain& gain) {
  if (is_bounded_at_points(of, gain)) return points_of(of, gain);
  std::vector<Choice> choices = {{}};
  const std::vector<std::string> calls = calls_of(gain.whole);
  for (auto call = calls.rbegin(); call != calls.rend(); ++call) {
    const model::Function* function = function_called(of, *call);
    if (function == nullptr || choices.front().coefficients.contains(*call)) continue;
    std::vector<Choice> next;
    for (const Choice& choice : choices) {
      for (const std::string& coefficient : function->coefficients()) {
        next.push_back(choice);
        next.back().coefficients[*call] = coefficient;
      }
    }
    choices = std::move(next);
  }
  return choices;
}

/// The factors as they are written, with the coefficients chosen.
std::string text_of(const Factor& factor, const Choice& choice) {
  std::string text = factor.text;
  for (auto call = factor.calls.rbegin(); call != factor.calls.rend(); ++call) {
    const auto chosen = choice.coefficients.find(factor.text.substr(call->first, call->second));
    if (chosen != choice.coefficients.end())
      text.replace(call->first, call->second, chosen->second);
  }
  return text;
}

/// The program with the coefficients chosen. A call in a definition is no part of the gain's
/// text: it stays the whole function.
expr::Program chosen(const Inequalities& of, const expr::Program& program, const Choice& choice) {
  std::map<std::string, expr::Body> bodies;
  return expr::link(
      program, [&](const std::string& name, const expr::Instruction& call) -> const expr::Body& {
        const auto found = choice.coefficients.find(call.text);
        if (found == choice.coefficients.end()) return of.bodies.body(name, call);
        expr::Composer composer(call.place());
        const int coefficient = composer.input(found->second, call.shape);
        return bodies.try_emplace(call.text, expr::Body{"", composer.take(coefficient)})
            .first->second;
      });
}

/// [ S , E/beta ; * , s I ] with S n x n, E n x k and the scalar s (0: s = 1); S + S' - s I for S.
Block bound_block(const BoundedProduct& bound, double beta) {
  const int n = bound.s.shape.rows;
  const int k = bound.e.shape.cols;
  using Elements = std::vector<Eigen::Triplet<double>>;
  std::map<int, Elements> elements;
  const auto add = [&](const AffineForm& form, auto&& place) {
    for (const auto& [key, matrix] : form.terms)
      for (int column = 0; column < matrix.outerSize(); ++column)
        for (Sparse::InnerIterator it(matrix, column); it; ++it)
          place(static_cast<int>(it.row()), static_cast<int>(it.col()), it.value(),
                elements[key.second]);
  };
  add(bound.s, [&](int i, int j, double value, Elements& out) {
    out.emplace_back(i, j, value);
    if (!bound.symmetric) out.emplace_back(j, i, value);
  });
  for (int i = 0; i < n && !bound.symmetric; ++i) elements[bound.scalar].emplace_back(i, i, -1.0);
  add(bound.e, [&](int i, int j, double value, Elements& out) {
    out.emplace_back(i, n + j, value / beta);
    out.emplace_back(n + j, i, value / beta);
  });
  for (int i = n; i < n + k; ++i) elements[bound.scalar].emplace_back(i, i, 1.0);
  AffineForm whole{{n + k, n + k}, {}};
  for (const auto& [index, list] : elements) {
    Sparse matrix(n + k, n + k);
    matrix.setFromTriplets(list.begin(), list.end());
    whole.terms.emplace(std::pair(0, index), std::move(matrix));
  }
  const AffineForm matrices_of_e{bound.e.shape, {}, bound.e.products};
  const AffineForm matrices_of_s{bound.s.shape, {}, bound.s.products};
  add_placed(whole, matrices_of_s, 0, 0);
  if (!bound.symmetric) add_placed(whole, transposed(matrices_of_s), 0, 0);
  add_placed(whole, matrices_of_e, 0, n, 1 / beta);
  add_placed(whole, transposed(matrices_of_e), n, 0, 1 / beta);
  return block_of(whole, "bound on " + bound.what, "", false, {});
}

/// S >= s I.
Block floor_block(const AffineForm& s, int scalar, const std::string& name) {
  AffineForm difference = s;
  Sparse identity(s.shape.rows, s.shape.rows);
  identity.setIdentity();
  difference.terms.emplace(std::pair(0, scalar), -identity);
  return block_of(difference, "bound through " + name, "", false, {});
}

/// Collects the bounds of all gain formulas.
class Collector {
 public:
  Collector(const Inequalities& of, double beta, std::vector<int> units) : of_(of) {
    result_.beta = beta;
    result_.units = std::move(units);
  }

  GainBounds collect() {
    for (const model::Design::Gain& gain : of_.design().gains) {
      const auto share = of_.design().synthesis.share_of_bound(gain.name);
      if (!share) continue;
      share_ = *share;
      for (const Choice& choice : choices_of(of_, gain)) add_formula(gain, choice);
    }
    return std::move(result_);
  }

 private:
  void add_formula(const model::Design::Gain& gain, const Choice& choice) {
    for (const model::Design::Product& product : gain.products) add_product(gain, product, choice);
    if (!gain.products.empty()) return;
    for (const Part& part : affine_parts(gain, gain.whole, choice)) {
      if (!part.form.has_unknown()) continue;
      const int rows = part.form.shape.rows;
      BoundedProduct bound{text_of(gain.whole, choice) + part.factor + choice.where(gain.variable),
                           constant_form(numbers::Matrix::Identity(rows, rows)), part.form, 0};
      if (!result_.units.empty()) bring_to_units(bound.s, bound.e, false, result_.units);
      add(std::move(bound));
    }
  }

  /// The parts of a factor; none when it is not affine in the unknowns.
  std::vector<Part> affine_parts(const model::Design::Gain& gain, const Factor& factor,
                                 const Choice& choice) const {
    if (!factor.program) return {};
    forall::MonomialTable monomials(choice.at ? forall::Domain{}
                                              : forall::free_variable(gain.variable));
    numbers::Values values = of_.instance.values;
    if (choice.at)
      values.insert_or_assign(gain.variable, numbers::Matrix::Constant(1, 1, *choice.at));
    try {
      const AffineForm form =
          evaluate_affine(chosen(of_, *factor.program, choice), of_.unknowns, monomials, values);
      return parts_of(form, monomials, gain.variable);
    } catch (const InputError&) {
      return {};
    }
  }

  /// Bounds inv(S) times all factors beside it or, when their product is not affine, times the
  /// nearest.
  void add_product(const model::Design::Gain& gain, const model::Design::Product& product,
                   const Choice& choice) {
    const Factor* factor = &product.all;
    auto parts = affine_parts(gain, *factor, choice);
    if (parts.empty()) {
      factor = &product.nearest;
      parts = affine_parts(gain, *factor, choice);
    }
    // inv(Q(t)) of an unknown function is bounded through its coefficients, or its value.
    const auto coefficient = choice.coefficients.find(product.inverse);
    const std::string& name =
        coefficient == choice.coefficients.end() ? product.inverse : coefficient->second;
    const Unknown* unknown = of_.unknowns.find(name);
    const auto inverted = unknown != nullptr ? std::vector<Part>{{unknown_form(*unknown), ""}}
                                             : affine_parts(gain, product.inverted, choice);
    if (inverted.size() != 1) return;
    const std::string where = choice.where(gain.variable);
    const std::string inverse = "inv(" + name + ")";
    const std::string text = text_of(*factor, choice);
    for (const Part& part : parts) {
      BoundedProduct bound{
          (product.left ? inverse + "*" + text : text + "*" + inverse) + part.factor + where,
          product.left ? inverted.front().form : transposed(inverted.front().form),
          product.left ? part.form : transposed(part.form)};
      if (bound.e.shape.size() == 0) continue;
      bound.symmetric = is_same(bound.s, transposed(bound.s));
      if (!result_.units.empty()) bring_to_units(bound.s, bound.e, true, result_.units);
      bound.scalar = scalar_of(unknown != nullptr ? name : name + where, bound);
      add(std::move(bound));
    }
  }

  /// The scalar s of what S is called, made when it is first asked for.
  int scalar_of(const std::string& name, const BoundedProduct& bound) {
    const auto [found, fresh] =
        scalars_.try_emplace(name, of_.unknowns.size() + result_.scalars + 1);
    if (fresh) {
      ++result_.scalars;
      if (bound.symmetric) result_.blocks.push_back(floor_block(bound.s, found->second, name));
    }
    return found->second;
  }

  /// Adds a bound and its block, unless one at least as tight on the same product is there.
  void add(BoundedProduct bound) {
    if (bound.e.shape.size() == 0) return;
    bound.share = share_;
    for (const BoundedProduct& known : result_.list)
      if (known.scalar == bound.scalar && known.share <= bound.share && is_same(known.e, bound.e))
        return;
    // A little less, so that what the solver reaches is within.
    constexpr double kRoom = 1e-9;
    result_.blocks.push_back(bound_block(bound, result_.beta * bound.share * (1 - kRoom)));
    result_.list.push_back(std::move(bound));
  }

  const Inequalities& of_;
  std::map<std::string, int> scalars_;
  double share_ = 1;  ///< of the gain that is added now
  GainBounds result_;
};

}  // namespace

GainBounds gain_bounds(const Inequalities& inequalities, std::optional<double> beta,
                       std::vector<int> units) {
  if (!beta) return {};
  return Collector(inequalities, *beta, std::move(units)).collect();
}

GainBounds gain_bounds(const Inequalities& inequalities, const Lmi& lmi) {
  const model::SynthesisOptions& asked = inequalities.design().synthesis;
  if (!asked.gain_bound || asked.gain_bound_stated || inequalities.design().gains.empty())
    return gain_bounds(inequalities, asked.gain_bound);
  std::vector<const Block*> blocks;
  for (const Block& block : lmi.blocks) blocks.push_back(&block);
  return gain_bounds(inequalities, asked.gain_bound,
                     balance(blocks, lmi.unknowns, lmi.objective).unknowns);
}

std::vector<model::GainBound> reached_bounds(const GainBounds& bounds,
                                             const std::vector<double>& x) {
  constexpr double kActive = 0.99;
  std::vector<model::GainBound> result;
  for (const BoundedProduct& bound : bounds.list) {
    const numbers::Matrix s = value_of(bound.s, x);
    const numbers::Matrix e = value_of(bound.e, x);
    model::GainBound record{bound.what, bounds.beta * bound.share,
                            std::numeric_limits<double>::infinity(), false, !bounds.units.empty()};
    // A coefficient of a function need not be definite: then the measure says nothing.
    if (!bound.symmetric) {
      const numbers::Inverse inverse = numbers::inverse(s);
      if (inverse.condition > 0)
        record.reached = (1 + 1e-12) * numbers::singular_values(inverse.matrix * e).maxCoeff();
    } else if (const numbers::Cholesky factor(s); factor) {
      const double largest =
          numbers::symmetric_eigenvalues(e.transpose() * factor.solve(e)).maxCoeff();
      // With the rounding of these lines.
      record.reached = (1 + 1e-12) * std::sqrt(std::max(0.0, largest) /
                                               numbers::symmetric_eigenvalues(s).minCoeff());
    }
    record.active = record.reached > kActive * record.bound;
    result.push_back(std::move(record));
  }
  return result;
}

}  // namespace gainsmith::lmi
