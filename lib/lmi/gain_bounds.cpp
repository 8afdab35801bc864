#include "lmi/gain_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "numbers/dense.h"

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
  if (form.terms.empty()) by_monomial[0].shape = form.shape;
  for (const auto& [key, matrix] : form.terms) {
    AffineForm& part = by_monomial[key.first];
    part.shape = form.shape;
    part.terms.emplace(std::pair(0, key.second), matrix);
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

/// Which coefficient stands for each call of an unknown function, by the call's text.
using Choice = std::map<std::string, std::string>;

/// A gain's formula with each call Y(...) of an unknown function replaced by one of its
/// coefficients, in all combinations: the gain is bounded when all of them are.
std::vector<Choice> choices_of(const Inequalities& of, const model::Design::Gain& gain) {
  std::vector<Choice> choices = {{}};
  const auto& calls = gain.whole.calls;
  for (auto call = calls.rbegin(); call != calls.rend(); ++call) {
    const std::string text = gain.whole.text.substr(call->first, call->second);
    const auto function =
        std::find_if(of.functions.begin(), of.functions.end(),
                     [&](const model::Function& f) { return is_call_of(text, f.name); });
    if (function == of.functions.end() || choices.front().contains(text)) continue;
    std::vector<Choice> next;
    for (const Choice& choice : choices) {
      for (const std::string& coefficient : function->coefficients()) {
        next.push_back(choice);
        next.back()[text] = coefficient;
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
    const auto chosen = choice.find(factor.text.substr(call->first, call->second));
    if (chosen != choice.end()) text.replace(call->first, call->second, chosen->second);
  }
  return text;
}

/// The program with the coefficients chosen. A call that stands in a definition is no part of the
/// gain's text: it stays the whole function.
expr::Program chosen(const Inequalities& of, const expr::Program& program, const Choice& choice) {
  std::map<std::string, expr::Body> bodies;
  return expr::link(
      program, [&](const std::string& name, const expr::Instruction& call) -> const expr::Body& {
        const auto found = choice.find(call.text);
        if (found == choice.end()) {
          const auto function =
              std::find_if(of.functions.begin(), of.functions.end(),
                           [&](const model::Function& f) { return f.name == name; });
          return bodies.try_emplace(name, function->body()).first->second;
        }
        expr::Composer composer(call.place());
        const int coefficient = composer.input(found->second, call.shape);
        return bodies.try_emplace(call.text, expr::Body{"", composer.take(coefficient)})
            .first->second;
      });
}

/// [ S , E/beta ; * , s I ] with S n x n, E n x k and the scalar s (0: s = 1).
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
  add(bound.s, [](int i, int j, double value, Elements& out) { out.emplace_back(i, j, value); });
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

AffineForm transposed(const AffineForm& form) {
  AffineForm result{{form.shape.cols, form.shape.rows}, {}};
  for (const auto& [key, matrix] : form.terms) result.terms.emplace(key, matrix.transpose());
  return result;
}

/// Collects the bounds of all gain formulas.
class Collector {
 public:
  Collector(const Inequalities& of, double beta) : of_(of) { result_.beta = beta; }

  GainBounds collect() {
    for (const model::Design::Gain& gain : of_.design().gains)
      for (const Choice& choice : choices_of(of_, gain)) add_formula(gain, choice);
    return std::move(result_);
  }

 private:
  void add_formula(const model::Design::Gain& gain, const Choice& choice) {
    for (const model::Design::Product& product : gain.products) add_product(gain, product, choice);
    if (!gain.products.empty()) return;
    for (const Part& part : affine_parts(gain, gain.whole, choice)) {
      if (!part.form.has_unknown()) continue;
      const int rows = part.form.shape.rows;
      add({text_of(gain.whole, choice) + part.factor,
           constant_form(numbers::Matrix::Identity(rows, rows)), part.form, 0});
    }
  }

  /// The parts of a factor; none when it is not affine in the unknowns.
  std::vector<Part> affine_parts(const model::Design::Gain& gain, const Factor& factor,
                                 const Choice& choice) const {
    if (!factor.program) return {};
    forall::MonomialTable monomials(forall::free_variable(gain.variable));
    try {
      const AffineForm form = evaluate_affine(chosen(of_, *factor.program, choice), of_.unknowns,
                                              monomials, of_.instance.values);
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
    // inv(Q(t)) of an unknown function is bounded through its coefficients.
    const auto coefficient = choice.find(product.inverse);
    const std::string& name = coefficient == choice.end() ? product.inverse : coefficient->second;
    const Unknown& unknown = *of_.unknowns.find(name);
    const std::string inverse = "inv(" + name + ")";
    const std::string text = text_of(*factor, choice);
    for (const Part& part : parts)
      add({(product.left ? inverse + "*" + text : text + "*" + inverse) + part.factor,
           unknown_form(unknown), product.left ? part.form : transposed(part.form),
           scalar_of(unknown)});
  }

  /// The scalar s of an unknown S, made when it is first asked for.
  int scalar_of(const Unknown& unknown) {
    const auto [found, fresh] =
        scalars_.try_emplace(unknown.name, of_.unknowns.size() + result_.scalars + 1);
    if (fresh) {
      ++result_.scalars;
      result_.blocks.push_back(floor_block(unknown_form(unknown), found->second, unknown.name));
    }
    return found->second;
  }

  void add(BoundedProduct bound) {
    if (bound.e.shape.size() == 0) return;
    for (const BoundedProduct& known : result_.list)
      if (known.scalar == bound.scalar && is_same(known.e, bound.e)) return;
    result_.blocks.push_back(bound_block(bound, result_.beta));
    result_.list.push_back(std::move(bound));
  }

  const Inequalities& of_;
  std::map<std::string, int> scalars_;
  GainBounds result_;
};

}  // namespace

GainBounds gain_bounds(const Inequalities& inequalities, std::optional<double> beta) {
  if (!beta) return {};
  return Collector(inequalities, *beta).collect();
}

std::vector<model::GainBound> reached_bounds(const GainBounds& bounds,
                                             const std::vector<double>& x) {
  constexpr double kActive = 0.99;
  std::vector<model::GainBound> result;
  for (const BoundedProduct& bound : bounds.list) {
    const numbers::Matrix s = value_of(bound.s, x);
    const numbers::Matrix e = value_of(bound.e, x);
    model::GainBound record{bound.what, bounds.beta, std::numeric_limits<double>::infinity(),
                            false};
    // A coefficient of a function need not be definite: then the measure says nothing.
    if (const numbers::Cholesky factor(s); factor) {
      const double largest =
          numbers::symmetric_eigenvalues(e.transpose() * factor.solve(e)).maxCoeff();
      record.reached =
          std::sqrt(std::max(0.0, largest) / numbers::symmetric_eigenvalues(s).minCoeff());
    }
    record.active = record.reached > kActive * bounds.beta;
    result.push_back(std::move(record));
  }
  return result;
}

}  // namespace gainsmith::lmi
