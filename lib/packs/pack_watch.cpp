#include "packs/pack_watch.h"

namespace gainsmith::packs {

namespace {

using Is = expr::Condition::Kind;

/// All elements must be on the side that is asked for. One that certainly is not decides; one that
/// is unknown leaves the whole unknown otherwise.
Truth of_comparison(const WatchedCondition& condition, const std::vector<Watch>& watches,
                    const Sides& sides, Zeros zeros) {
  Truth result = Truth::yes;
  for (const Watched& watched : condition.elements) {
    const bool moves = watches[watched.watch].moves;
    const int side = moves && zeros == Zeros::still ? 0 : watched.factor * sides[watched.watch];
    if (moves && side == 0 && zeros != Zeros::exact) {
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
            const Sides& sides, Zeros zeros) {
  if (condition.kind != Is::all && condition.kind != Is::any && condition.kind != Is::none)
    return of_comparison(condition, watches, sides, zeros);
  return expr::joined(condition.kind, condition.parts, [&](const WatchedCondition& part) {
    return truth(part, watches, sides, zeros);
  });
}

void mark(const WatchedCondition& condition, std::vector<char>& marked) {
  for (const Watched& watched : condition.elements) marked[watched.watch] = 1;
  for (const WatchedCondition& part : condition.parts) mark(part, marked);
}

}  // namespace gainsmith::packs
