#include "packs/pack_watch.h"

namespace gainsmith::packs {

namespace {

using Is = expr::Condition::Kind;

Truth of_comparison(const WatchedCondition& condition, const std::vector<Watch>& watches,
                    const Sides& sides, bool still) {
  Truth result = Truth::yes;
  for (const Watched& one : condition.elements) {
    const bool moves = watches[one.watch].moves;
    const int side = moves && still ? 0 : one.factor * sides[one.watch];
    if (moves && side == 0) {
      result = Truth::unknown;
      continue;
    }
    const bool holds = condition.kind == Is::positive      ? side > 0
                       : condition.kind == Is::nonnegative ? side >= 0
                                                           : side == 0;
    if (!holds) return Truth::no;
  }
  return result;
}

}  // namespace

Truth truth(const WatchedCondition& condition, const std::vector<Watch>& watches,
            const Sides& sides, bool still) {
  if (condition.kind == Is::none) {
    const Truth inner = truth(condition.parts.front(), watches, sides, still);
    return inner == Truth::unknown ? inner : inner == Truth::yes ? Truth::no : Truth::yes;
  }
  if (condition.kind != Is::all && condition.kind != Is::any)
    return of_comparison(condition, watches, sides, still);
  const Truth decides = condition.kind == Is::all ? Truth::no : Truth::yes;
  Truth result = condition.kind == Is::all ? Truth::yes : Truth::no;
  for (const WatchedCondition& part : condition.parts) {
    const Truth inner = truth(part, watches, sides, still);
    if (inner == decides) return decides;
    if (inner == Truth::unknown) result = Truth::unknown;
  }
  return result;
}

void mark(const WatchedCondition& condition, std::vector<char>& marked) {
  for (const Watched& one : condition.elements) marked[one.watch] = 1;
  for (const WatchedCondition& part : condition.parts) mark(part, marked);
}

}  // namespace gainsmith::packs
