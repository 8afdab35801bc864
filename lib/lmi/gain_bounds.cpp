#include "lmi/gain_bounds.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "expr/compile.h"

namespace gainsmith::lmi {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;

/// "inv(S)" of a symmetric unknown: its name.
const Unknown* inverse_of(const Node& node, const Unknowns& unknowns) {
  if (node.kind != NodeKind::call || node.text != "inv" || node.children.size() != 1)
    return nullptr;
  const Node& argument = *node.children.front();
  if (argument.kind != NodeKind::name) return nullptr;
  const Unknown* unknown = unknowns.find(argument.text);
  const bool symmetric = unknown != nullptr && (unknown->structure == model::Structure::symmetric ||
                                                unknown->structure == model::Structure::diagonal);
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

AffineForm form_of(const model::Instance& instance, const Unknowns& unknowns,
                   const expr::Expression& expression) {
  AtomTable atoms;
  return evaluate_affine(expr::compile(expression, instance.design_scope()), unknowns, atoms,
                         instance.known_values(), "");
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
    for (const model::Named& gain : instance_.method->gains) {
      std::vector<Product> products;
      products_in(gain.value.root, unknowns_, products);
      for (const Product& product : products) add_product(gain, product);
      if (!products.empty()) continue;
      const auto affine = affine_form({gain.value.text, gain.value.root});
      if (!affine || !affine->has_unknown()) continue;
      const int rows = affine->shape.rows;
      add({text_of(gain.value, {gain.value.root}),
           constant_form(expr::Matrix::Identity(rows, rows)), *affine, 0});
    }
    return std::move(result_);
  }

 private:
  /// The form of an expression, when it is affine in the unknowns.
  std::optional<AffineForm> affine_form(const expr::Expression& expression) const {
    try {
      return form_of(instance_, unknowns_, expression);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  /// Bounds inv(S) times all factors beside it or, when their product is not affine, times the
  /// nearest.
  void add_product(const model::Named& gain, const Product& product) {
    std::vector<NodePtr> factors = product.factors;
    auto e = affine_form({gain.value.text, product_of(factors)});
    if (!e) {
      factors = {product.left ? factors.front() : factors.back()};
      e = affine_form({gain.value.text, factors.front()});
    }
    if (!e) return;
    const std::string inverse = "inv(" + product.unknown->name + ")";
    const std::string factor = text_of(gain.value, factors);
    add({product.left ? inverse + "*" + factor : factor + "*" + inverse,
         unknown_form(*product.unknown), product.left ? *e : transposed(*e),
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
    for (const GainBound& known : result_.list)
      if (known.what == bound.what) return;
    result_.blocks.push_back(bound_block(bound, result_.beta));
    result_.list.push_back(std::move(bound));
  }

  const model::Instance& instance_;
  const Unknowns& unknowns_;
  std::map<std::string, int> scalars_;
  GainBounds result_;
};

/// The matrix of a form at x.
expr::Matrix value_of(const AffineForm& form, const std::vector<double>& x) {
  expr::Matrix result = expr::Matrix::Zero(form.shape.rows, form.shape.cols);
  for (const auto& [key, matrix] : form.terms)
    result += (key.second == 0 ? 1.0 : x[static_cast<std::size_t>(key.second) - 1]) *
              expr::Matrix(matrix);
  return result;
}

Eigen::VectorXd eigenvalues(const expr::Matrix& matrix) {
  return Eigen::SelfAdjointEigenSolver<expr::Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
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
    const expr::Matrix s = value_of(bound.s, x);
    const expr::Matrix e = value_of(bound.e, x);
    const double largest = eigenvalues(e.transpose() * s.llt().solve(e)).maxCoeff();
    model::GainBound record{bound.what, bounds.beta, 0, false};
    record.reached = std::sqrt(std::max(0.0, largest) / eigenvalues(s).minCoeff());
    record.active = record.reached > kActive * bounds.beta;
    result.push_back(std::move(record));
  }
  return result;
}

}  // namespace gainsmith::lmi
