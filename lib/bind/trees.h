// Internal to bind: syntax trees that are put in the place of a part of a text.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "expr/text/ast.h"

namespace gainsmith::bind {

/// Builds trees that are placed where the call is.
class Trees {
 public:
  explicit Trees(const expr::Node& at) : at_(at) {}

  expr::NodePtr make(expr::NodeKind kind, std::vector<expr::NodePtr> children,
                     std::string text = "") const {
    auto node = std::make_shared<expr::Node>();
    node->kind = kind;
    node->begin = at_.begin;
    node->end = at_.end;
    node->children = std::move(children);
    node->text = std::move(text);
    return node;
  }
  /// A whole number from 0 on.
  expr::NodePtr number(int value) const {
    return make(expr::NodeKind::number, {}, std::to_string(value));
  }
  expr::NodePtr call(const std::string& function, expr::NodePtr argument) const {
    return make(expr::NodeKind::call, {std::move(argument)}, function);
  }
  expr::NodePtr identity() const { return make(expr::NodeKind::name, {}, "I"); }
  expr::NodePtr times(expr::NodePtr a, expr::NodePtr b) const {
    return make(expr::NodeKind::multiply, {std::move(a), std::move(b)});
  }
  /// a <= b, or a < b where `strict`.
  expr::NodePtr at_most(expr::NodePtr a, expr::NodePtr b, bool strict) const {
    auto node =
        std::make_shared<expr::Node>(*make(expr::NodeKind::compare, {std::move(a), std::move(b)}));
    node->relations = {strict ? expr::Relation::less : expr::Relation::less_equal};
    return node;
  }
  /// Two entries in a row.
  expr::NodePtr block(std::vector<expr::NodePtr> entries) const {
    auto node = std::make_shared<expr::Node>(*make(expr::NodeKind::block, std::move(entries)));
    node->columns = 2;
    return node;
  }

 private:
  const expr::Node& at_;
};

}  // namespace gainsmith::bind
