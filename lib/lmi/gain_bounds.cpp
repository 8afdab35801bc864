#include "lmi/gain_bounds.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "expr/compile.h"

namespace gainsmith::lmi {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;

/// "inv(S)" of a symmetric unknown: its name.
const Unknown* inverse_of(const Node& node, const Unknowns& unknowns) {
  if (node.kind != NodeKind::call || node.text != "inv" || node.children.size() != 1) return nullptr;
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

/// A product inv(S)*E, or E*inv(S) (then `left` is false).
struct Product {
  const Unknown* unknown = nullptr;
  NodePtr factor;
  bool left = true;
};

void products_in(const NodePtr& node, const Unknowns& unknowns, std::vector<Product>& found) {
  std::vector<NodePtr> factors;
  factors_of(node, factors);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    const Unknown* unknown = inverse_of(*factors[k], unknowns);
    if (unknown != nullptr && k + 1 < factors.size()) found.push_back({unknown, factors[k + 1], true});
    if (unknown != nullptr && k + 1 == factors.size() && k > 0) found.push_back({unknown, factors[k - 1], false});
    if (unknown == nullptr)
      for (const NodePtr& child : factors[k]->children) products_in(child, unknowns, found);
  }
}

AffineForm form_of(const model::Instance& instance, const Unknowns& unknowns, const expr::Expression& expression) {
  AtomTable atoms;
  return evaluate_affine(expr::compile(expression, instance.design_scope()), unknowns, atoms,
                         instance.known_values(), "");
}

/// A form from a text of the language, for the unknowns named in it.
AffineForm form_of(const model::Instance& instance, const Unknowns& unknowns, const std::string& text) {
  return form_of(instance, unknowns, expr::parse(expr::Text(text, "gain bound")));
}

/// [ S , E/beta ; * , scale I ] with S n x n, E n x k and scale 1 x 1.
Block bound_block(const AffineForm& s, const AffineForm& e, const AffineForm& scale, double beta,
                  const std::string& name) {
  const int n = s.shape.rows;
  const int k = e.shape.cols;
  AffineForm whole{{n + k, n + k}, {}};
  const auto add = [&](const AffineForm& form, auto&& place) {
    for (const auto& [key, matrix] : form.terms) {
      std::vector<Eigen::Triplet<double>> elements;
      for (int column = 0; column < matrix.outerSize(); ++column)
        for (Sparse::InnerIterator it(matrix, column); it; ++it)
          place(static_cast<int>(it.row()), static_cast<int>(it.col()), it.value(), elements);
      Sparse placed(n + k, n + k);
      placed.setFromTriplets(elements.begin(), elements.end());
      const auto [found, fresh] = whole.terms.try_emplace(key, placed);
      if (!fresh) found->second = found->second + placed;
    }
  };
  add(s, [](int i, int j, double value, auto& out) { out.emplace_back(i, j, value); });
  add(e, [&](int i, int j, double value, auto& out) {
    out.emplace_back(i, n + j, value / beta);
    out.emplace_back(n + j, i, value / beta);
  });
  add(scale, [&](int, int, double value, auto& out) {
    for (int i = 0; i < k; ++i) out.emplace_back(n + i, n + i, value);
  });
  return block_of(whole, "bound on " + name, "", false, {});
}

AffineForm transposed(const AffineForm& form) {
  AffineForm result{{form.shape.cols, form.shape.rows}, {}};
  for (const auto& [key, matrix] : form.terms) result.terms.emplace(key, matrix.transpose());
  return result;
}

}  // namespace

std::vector<GainBoundBlock> gain_bounds(const model::Instance& instance, const Unknowns& unknowns,
                                        double beta) {
  std::vector<GainBoundBlock> bounds;
  const auto add = [&](const std::string& what, const AffineForm& s, const AffineForm& e,
                       const AffineForm& scale) {
    for (const GainBoundBlock& known : bounds)
      if (known.what == what) return;
    bounds.push_back({what, beta, s.shape.rows, bound_block(s, e, scale, beta, what)});
  };
  for (const model::Named& gain : instance.method->gains) {
    const Node& root = *gain.value.root;
    if (root.kind == NodeKind::name && unknowns.find(root.text) != nullptr) {
      const AffineForm k = form_of(instance, unknowns, root.text);
      add(root.text, constant_form(expr::Matrix::Identity(k.shape.rows, k.shape.rows)), k,
          constant_form(expr::Matrix::Ones(1, 1)));
      continue;
    }
    std::vector<Product> products;
    products_in(gain.value.root, unknowns, products);
    for (const Product& product : products) {
      const std::string& name = product.unknown->name;
      const std::size_t length = product.factor->end - product.factor->begin;
      const std::string factor = gain.value.text->str().substr(product.factor->begin, length);
      const AffineForm e = form_of(instance, unknowns, expr::Expression{gain.value.text, product.factor});
      const std::string size = std::to_string(product.unknown->shape.rows);
      add(product.left ? "inv(" + name + ")*" + factor : factor + "*inv(" + name + ")",
          form_of(instance, unknowns, name), product.left ? e : transposed(e),
          form_of(instance, unknowns, "trace(" + name + ")/" + size));
    }
  }
  return bounds;
}

std::vector<model::GainBound> reached_bounds(const std::vector<GainBoundBlock>& bounds,
                                             const std::vector<double>& x) {
  constexpr double kActive = 0.99;
  std::vector<model::GainBound> result;
  for (const GainBoundBlock& bound : bounds) {
    const expr::Matrix value = bound.block.value(x);
    const Eigen::Index n = bound.rows;
    const Eigen::Index k = value.rows() - n;
    const expr::Matrix e = value.topRightCorner(n, k);
    const Eigen::LLT<expr::Matrix> s(value.topLeftCorner(n, n));
    const expr::Matrix form = e.transpose() * s.solve(e);
    const double largest = Eigen::SelfAdjointEigenSolver<expr::Matrix>(form, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    model::GainBound record{bound.what, bound.bound, 0, false};
    record.reached = bound.bound * std::sqrt(std::max(0.0, largest / value(n, n)));
    record.active = record.reached > kActive * bound.bound;
    result.push_back(record);
  }
  return result;
}

}  // namespace gainsmith::lmi
