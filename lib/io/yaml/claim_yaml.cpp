// A claim is one of five kinds, and each kind has keys of its own; a key of another kind is an
// error.
#include "io/yaml/claim_yaml.h"

#include "expr/text/parser.h"

namespace gainsmith::io {

namespace {

using model::ClaimKind;

/// integral of flow + sum of jump <= below, each part optional.
void read_cost(const YamlFile& file, const YamlItem& cost, const YamlItem& below,
               model::Claim& claim) {
  YamlMap parts(file, cost.value, "cost", keys::cost);
  if (const auto flow = parts.find("flow")) claim.flow_cost = file.expression(flow->value, "flow");
  if (const auto jump = parts.find("jump")) claim.jump_cost = file.expression(jump->value, "jump");
  parts.finish();
  claim.value = file.expression(below.value, "below");
}

/// What is claimed: one of the kinds, with its own keys.
void read_kind(const YamlFile& file, const YamlItem& item, YamlMap& map, model::Claim& claim) {
  const auto nonincreasing = map.find("nonincreasing");
  const auto cost = map.find("cost");
  const auto shrinks = map.find("shrinks");
  const auto below = map.find("below");
  const auto above = map.find("above");
  const auto bound = map.find("bound");
  const auto to = map.find("to");
  int kinds = 0;
  for (const auto* kind : {&nonincreasing, &cost, &shrinks, &above}) kinds += kind->has_value();
  if (below && !cost) ++kinds;
  if (kinds != 1) {
    map.finish();
    throw InputError(item.place, "the claim '" + item.key + "' needs " +
                                     (kinds > 1 ? "exactly " : "") +
                                     "one of nonincreasing, cost, shrinks, below, above" +
                                     (kinds > 1 ? "; found " + std::to_string(kinds) : ""));
  }
  const bool bounded = (below && !cost) || above;
  if (bound && !bounded) throw InputError(bound->place, "bound: of the claims below and above");
  if (to && !shrinks) throw InputError(to->place, "to: of the claim shrinks");
  if (nonincreasing) claim.value = file.expression(nonincreasing->value, item.key);
  if (cost) {
    claim.kind = ClaimKind::cost;
    read_cost(file, *cost, map.require("below"), claim);
  }
  if (shrinks) {
    claim.kind = ClaimKind::shrinks;
    claim.value = file.expression(shrinks->value, item.key);
    claim.factor = file.expression(map.require("to").value, "to");
  }
  if (bounded) {
    claim.kind = above ? ClaimKind::above : ClaimKind::below;
    claim.value = file.expression((above ? above : below)->value, item.key);
    claim.bound = file.expression(map.require("bound").value, "bound");
  }
}

}  // namespace

model::Claim claim(const YamlFile& file, const YamlItem& item) {
  if (!item.value.IsMap())
    throw InputError(item.place,
                     "the claim '" + item.key +
                         "': expected {nonincreasing: V}, {below: v, bound: b}, {above: "
                         "v, bound: b}, {shrinks: v, to: s} or {cost: {flow: f}, below: "
                         "V}");
  YamlMap map(file, item.value, item.key, keys::claim);
  const auto after = map.find("after");
  const auto over = map.find("over");
  const auto tolerance = map.find("tolerance");
  model::Claim result;
  read_kind(file, item, map, result);
  map.finish();
  const expr::Signature signature = expr::parse_signature(item.key_text);
  if (!signature.parameters.empty())
    throw InputError(item.place, "a claim has no variables; one of a family is written " +
                                     signature.name + "(i in 1..N)");
  result.name = signature.name;
  result.indices = signature.indices;
  result.place = item.place;
  // These two are about the whole run: no part of it can be left out.
  for (const auto& part : {after, over})
    if (part && (result.kind == ClaimKind::cost || result.kind == ClaimKind::shrinks))
      throw InputError(part->place, part->key + ": of the claims nonincreasing, below and above");
  if (after) result.after = file.expression(after->value, "after");
  if (tolerance) {
    result.tolerance = file.positive(tolerance->value, "tolerance");
    if (result.tolerance >= 1)
      throw InputError(file.place(tolerance->value),
                       "tolerance: a part of the bound, such as 1e-6, so below 1");
  }
  if (over) {
    result.over = file.string(over->value, "over");
    result.over_place = file.place(over->value);
  }
  return result;
}

}  // namespace gainsmith::io
