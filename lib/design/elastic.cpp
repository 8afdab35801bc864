#include "design/elastic.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/number.h"
#include "design/bisect.h"
#include "design/variants.h"
#include "expr/parser.h"
#include "lmi/formulation.h"
#include "lmi/vertex_gains.h"

namespace gainsmith::design {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;

/// A node at the place of another.
NodePtr node(NodeKind kind, std::string text, std::vector<NodePtr> children, const Node& place) {
  auto result = std::make_shared<Node>();
  result->kind = kind;
  result->text = std::move(text);
  for (const NodePtr& child : children)
    result->height = std::max(result->height, child->height + 1);
  result->children = std::move(children);
  result->begin = place.begin;
  result->end = place.end;
  return result;
}

/// side + scale*slack*I.
NodePtr relaxed(const NodePtr& side, const std::string& slack, double scale) {
  const Node& at = *side;
  const NodePtr product = node(
      NodeKind::multiply, "",
      {node(NodeKind::number, decimal17(scale), {}, at), node(NodeKind::name, slack, {}, at)}, at);
  return node(
      NodeKind::add, "",
      {side, node(NodeKind::multiply, "", {product, node(NodeKind::name, "I", {}, at)}, at)}, at);
}

/// One requirement for each comparison of the chain, its larger side raised by the slack.
void add_relaxed(const model::Requirement& requirement, const std::string& slack, double scale,
                 std::vector<model::Requirement>& out) {
  const Node& chain = *requirement.that.root;
  for (std::size_t k = 0; k < chain.relations.size(); ++k) {
    NodePtr left = chain.children[k];
    NodePtr right = chain.children[k + 1];
    const expr::Relation relation = chain.relations[k];
    const bool less = relation == expr::Relation::less || relation == expr::Relation::less_equal;
    NodePtr& larger = less ? right : left;
    larger = relaxed(larger, slack, scale);
    auto comparison = std::make_shared<Node>(chain);
    comparison->children = {left, right};
    comparison->relations = {relation};
    model::Requirement one = requirement;
    one.that.root = comparison;
    if (chain.relations.size() > 1) one.name += "." + std::to_string(k + 1);
    out.push_back(std::move(one));
  }
}

model::UnknownDeclaration scalar_unknown(const std::string& name, const model::Requirement& of) {
  model::UnknownDeclaration unknown;
  unknown.name = name;
  unknown.shape = model::parse_shape(expr::Text("scalar", of.place.file));
  unknown.place = of.place;
  return unknown;
}

/// No name of a person ends in two of these, so no slack shadows one.
std::string slack_name(const model::Requirement& requirement) {
  return "slack_" + requirement.name + "__";
}

model::Requirement not_negative(const std::string& slack, const model::Requirement& of) {
  return {slack, {}, expr::parse(expr::Text(slack + " >= 0", of.place.file)), of.place};
}

}  // namespace

ByRequirement scales_of(const model::Problem& problem, const model::Overrides& overrides) {
  const lmi::Lmi lmi =
      lmi::compile(lmi::with_vertex_gains(model::make_instance(problem, overrides)));
  const lmi::Formulation formulation =
      lmi::formulate(lmi, {}, problem.synthesis, lmi::goal_of(lmi, {}));
  ByRequirement scales;
  for (const model::Requirement& requirement : problem.method->require) {
    double& scale = scales[requirement.name];
    for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
      if (lmi.blocks[k].name == requirement.name ||
          lmi.blocks[k].name.starts_with(requirement.name + "."))
        scale = std::max(scale, formulation.scales[k]);
  }
  return scales;
}

model::Problem elastic(model::Problem problem, const ByRequirement& scales,
                       std::map<std::string, std::string>& slacks) {
  return with_method(std::move(problem), [&](model::Method& method) {
    std::vector<model::Requirement> require;
    std::string sum;
    for (const model::Requirement& requirement : method.require) {
      const auto scale = scales.find(requirement.name);
      if (scale == scales.end()) {
        require.push_back(requirement);
        continue;
      }
      const std::string slack = slack_name(requirement);
      slacks[requirement.name] = slack;
      method.unknowns.push_back(scalar_unknown(slack, requirement));
      add_relaxed(requirement, slack, scale->second, require);
      require.push_back(not_negative(slack, requirement));
      sum += (sum.empty() ? "" : " + ") + slack;
    }
    method.require = std::move(require);
    method.minimize = expr::parse(expr::Text(sum, method.file));
  });
}

Slacks smallest_slacks(const model::Problem& problem, const ByRequirement& scales,
                       const model::Overrides& overrides, const sdp::Options& solver) {
  std::map<std::string, std::string> names;
  const model::Problem relaxed = elastic(problem, scales, names);
  const model::Gains gains = synthesize_at(relaxed, overrides, solver);
  Slacks slacks{gains.verdict, {}};
  if (gains.verdict != model::Verdict::yes) return slacks;
  for (const auto& [requirement, slack] : names) {
    const double value = (*gains.find(slack))(0, 0);
    slacks.by_requirement[requirement] = value > problem.synthesis.margin ? value : 0;
  }
  return slacks;
}

}  // namespace gainsmith::design
