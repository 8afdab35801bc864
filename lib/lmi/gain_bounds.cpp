#include "lmi/gain_bounds.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "expr/compile.h"
#include "expr/parser.h"

namespace gainsmith::lmi {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;

/// "inv(S)" of a symmetric unknown, such as every 1 x 1 one: its name.
const Unknown* inverse_of(const Node& node, const Unknowns& unknowns) {
  if (node.kind != NodeKind::call || node.text != "inv" || node.children.size() != 1)
    return nullptr;
  const Node& argument = *node.children.front();
  if (argument.kind != NodeKind::name) return nullptr;
  const Unknown* unknown = unknowns.find(argument.text);
  const bool symmetric = unknown != nullptr && (unknown->structure == model::Structure::symmetric ||
                                                unknown->structure == model::Structure::diagonal ||
                                                unknown->shape == expr::Shape{1, 1});
  return symmetric ? unknown : nullptr;
}

/// The factors of a product, from left to right.
void factors_of(const NodePtr& node, std::vector<NodePtr>& factors) {
  if (node->kind != NodeKind::multiply) {
    factors.push_back(node);
    return;
  }
  factors_of(node->children[0], factors);
  factors_of(node->children[1], factors);
}

/// A product inv(S)*E, or E*inv(S) (then `left` is false); E is the product of the factors.
struct Product {
  const Unknown* unknown = nullptr;
  std::vector<NodePtr> factors;
  bool left = true;
};

void products_in(const NodePtr& node, const Unknowns& unknowns, std::vector<Product>& found) {
  std::vector<NodePtr> factors;
  factors_of(node, factors);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    const Unknown* unknown = inverse_of(*factors[k], unknowns);
    const auto at = factors.begin() + static_cast<std::ptrdiff_t>(k);
    if (unknown != nullptr && k + 1 < factors.size())
      found.push_back({unknown, {at + 1, factors.end()}, true});
    if (unknown != nullptr && k + 1 == factors.size() && k > 0)
      found.push_back({unknown, {factors.begin(), at}, false});
    if (unknown == nullptr)
      for (const NodePtr& child : factors[k]->children) products_in(child, unknowns, found);
  }
}

/// The product of factors as one expression.
NodePtr product_of(const std::vector<NodePtr>& factors) {
  NodePtr product = factors.front();
  for (std::size_t k = 1; k < factors.size(); ++k) {
    auto node = std::make_shared<Node>();
    node->kind = NodeKind::multiply;
    node->begin = factors.front()->begin;
    node->end = factors[k]->end;
    node->children = {product, factors[k]};
    product = node;
  }
  return product;
}

/// The factors as they are written.
std::string text_of(const expr::Expression& expression, const std::vector<NodePtr>& factors) {
  std::string text;
  for (const NodePtr& factor : factors) {
    const std::string part =
        expression.text->str().substr(factor->begin, factor->end - factor->begin);
    const bool sum = factor->kind == NodeKind::add || factor->kind == NodeKind::subtract;
    text += (text.empty() ? "" : "*") + (sum ? "(" + part + ")" : part);
  }
  return text;
}

/// A matrix that is a factor of a function of the gain's variable: "", "*tau", "*exp(-2*tau)".
struct Part {
  AffineForm form;
  std::string factor;
};

/// An expression that is affine in the unknowns, split by the functions of the gain's variable.
std::vector<Part> parts_of(const model::Instance& instance, const Unknowns& unknowns,
                           const model::Gain& gain, const expr::Expression& expression) {
  MonomialTable monomials(free_variable(gain.variable));
  const expr::Program program = model::compile_gain(
      {gain.name, expression, gain.place, gain.variable}, instance.design_scope());
  const AffineForm form = evaluate_affine(program, unknowns, monomials, instance.known_values());
  std::map<int, AffineForm> by_monomial;
  if (form.terms.empty()) by_monomial[0].shape = form.shape;
  for (const auto& [key, matrix] : form.terms) {
    AffineForm& part = by_monomial[key.first];
    part.shape = form.shape;
    part.terms.emplace(std::pair(0, key.second), matrix);
  }
  std::vector<Part> parts;
  for (auto& [index, part] : by_monomial)
    parts.push_back(
        {std::move(part),
         index == 0 ? "" : "*" + to_string(monomials[index].front().atom, gain.variable)});
  return parts;
}

/// The calls of unknown functions in an expression.
struct Call {
  const model::UnknownFunction* function = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
};

void calls_in(const Node& node, const model::Instance& instance, std::vector<Call>& calls) {
  for (const model::UnknownFunction& function : instance.functions)
    if (node.kind == NodeKind::call && node.text == function.name)
      calls.push_back({&function, node.begin, node.end});
  for (const NodePtr& child : node.children) calls_in(*child, instance, calls);
}

/// The gain's formula with each call Y(...) of an unknown function replaced by one of its
/// coefficients, in all combinations: the gain is bounded when all of them are.
std::vector<model::Gain> by_coefficients(const model::Instance& instance, const model::Gain& gain) {
  std::vector<Call> calls;
  calls_in(*gain.value.root, instance, calls);
  std::sort(calls.begin(), calls.end(),
            [](const Call& a, const Call& b) { return a.begin > b.begin; });
  std::vector<std::string> texts = {gain.value.text->str()};
  for (const Call& call : calls) {
    std::vector<std::string> next;
    for (const std::string& text : texts)
      for (const std::string& coefficient : call.function->coefficients)
        next.push_back(std::string(text).replace(call.begin, call.end - call.begin, coefficient));
    texts = std::move(next);
  }
  if (calls.empty()) return {gain};
  std::vector<model::Gain> result;
  for (const std::string& text : texts)
    result.push_back({gain.name, expr::parse(expr::Text::generated(text, gain.place)), gain.place,
                      gain.variable});
  return result;
}

/// [ S , E/beta ; * , s I ] with S n x n, E n x k and the scalar s (0: s = 1).
Block bound_block(const GainBound& bound, double beta) {
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
  Collector(const model::Instance& instance, const Unknowns& unknowns, double beta)
      : instance_(instance), unknowns_(unknowns) {
    result_.beta = beta;
  }

  GainBounds collect() {
    for (const model::Gain& gain : instance_.method->gains)
      for (const model::Gain& formula : by_coefficients(instance_, gain)) add_formula(formula);
    return std::move(result_);
  }

 private:
  void add_formula(const model::Gain& gain) {
    std::vector<Product> products;
    products_in(gain.value.root, unknowns_, products);
    for (const Product& product : products) add_product(gain, product);
    if (!products.empty()) return;
    for (const Part& part : affine_parts(gain, gain.value.root)) {
      if (!part.form.has_unknown()) continue;
      const int rows = part.form.shape.rows;
      add({text_of(gain.value, {gain.value.root}) + part.factor,
           constant_form(numbers::Matrix::Identity(rows, rows)), part.form, 0});
    }
  }

  /// The parts of an expression; none when it is not affine in the unknowns.
  std::vector<Part> affine_parts(const model::Gain& gain, const NodePtr& node) const {
    try {
      return parts_of(instance_, unknowns_, gain, {gain.value.text, node});
    } catch (const InputError&) {
      return {};
    }
  }

  /// Bounds inv(S) times all factors beside it or, when their product is not affine, times the
  /// nearest.
  void add_product(const model::Gain& gain, const Product& product) {
    std::vector<NodePtr> factors = product.factors;
    auto parts = affine_parts(gain, product_of(factors));
    if (parts.empty()) {
      factors = {product.left ? factors.front() : factors.back()};
      parts = affine_parts(gain, factors.front());
    }
    const std::string inverse = "inv(" + product.unknown->name + ")";
    const std::string factor = text_of(gain.value, factors);
    for (const Part& part : parts)
      add({(product.left ? inverse + "*" + factor : factor + "*" + inverse) + part.factor,
           unknown_form(*product.unknown), product.left ? part.form : transposed(part.form),
           scalar_of(*product.unknown)});
  }

  /// The scalar s of an unknown S, made when it is first asked for.
  int scalar_of(const Unknown& unknown) {
    const auto [found, fresh] =
        scalars_.try_emplace(unknown.name, unknowns_.size() + result_.scalars + 1);
    if (fresh) {
      ++result_.scalars;
      result_.blocks.push_back(floor_block(unknown_form(unknown), found->second, unknown.name));
    }
    return found->second;
  }

  void add(GainBound bound) {
    if (bound.e.shape.size() == 0) return;
    for (const GainBound& known : result_.list)
      if (known.scalar == bound.scalar && is_same(known.e, bound.e)) return;
    result_.blocks.push_back(bound_block(bound, result_.beta));
    result_.list.push_back(std::move(bound));
  }

  const model::Instance& instance_;
  const Unknowns& unknowns_;
  std::map<std::string, int> scalars_;
  GainBounds result_;
};

/// The matrix of a form at x.
numbers::Matrix value_of(const AffineForm& form, const std::vector<double>& x) {
  numbers::Matrix result = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
  for (const auto& [key, matrix] : form.terms)
    result += (key.second == 0 ? 1.0 : x[static_cast<std::size_t>(key.second) - 1]) *
              numbers::Matrix(matrix);
  return result;
}

Eigen::VectorXd eigenvalues(const numbers::Matrix& matrix) {
  return Eigen::SelfAdjointEigenSolver<numbers::Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

GainBounds gain_bounds(const model::Instance& instance, const Unknowns& unknowns,
                       std::optional<double> beta) {
  if (!beta) return {};
  return Collector(instance, unknowns, *beta).collect();
}

std::vector<model::GainBound> reached_bounds(const GainBounds& bounds,
                                             const std::vector<double>& x) {
  constexpr double kActive = 0.99;
  std::vector<model::GainBound> result;
  for (const GainBound& bound : bounds.list) {
    const numbers::Matrix s = value_of(bound.s, x);
    const numbers::Matrix e = value_of(bound.e, x);
    const double largest = eigenvalues(e.transpose() * s.llt().solve(e)).maxCoeff();
    model::GainBound record{bound.what, bounds.beta, 0, false};
    record.reached = std::sqrt(std::max(0.0, largest) / eigenvalues(s).minCoeff());
    record.active = record.reached > kActive * bounds.beta;
    result.push_back(std::move(record));
  }
  return result;
}

}  // namespace gainsmith::lmi
