// Internal to bind: what is written in a text once for all members of a family.
//
//   unknowns: {P: {shape: symmetric n, for: i in 1..N}}
//   require:  {flow: {forall: [i in 1..N, j in 1..N, i != j], that: P(i) < P(j)}}
//
// Binding makes one thing of each member, under a name of its own (expr::member_name): the unknowns
// P_1, P_2, ..., the inequalities "flow at i = 1, j = 2", ....
#pragma once

#include <map>
#include <string>
#include <vector>

#include "expr/binding/instantiate.h"
#include "expr/text/parser.h"
#include "model/problem.h"

namespace gainsmith::bind {

/// One choice of the indices.
struct Member {
  std::vector<int> values;             ///< of the indices, in order
  std::map<std::string, int> indices;  ///< the same by name
  std::string label;                   ///< "i = 1, j = 2"

  /// "P_1_2"; "P" where there are no indices.
  std::string name_of(const std::string& family) const;
  /// "flow at i = 1, j = 2"; "flow" where there are no indices.
  std::string title_of(const std::string& family) const;
};

/// All members, the last index fastest; the one without indices where there are none. A range may
/// depend on the indices before it. InputError for ends that are no whole numbers known beforehand,
/// and for more than 100,000 members.
std::vector<Member> members(const std::vector<expr::Index>& indices,
                            const std::vector<expr::Expression>& conditions,
                            const expr::Scope& scope);

/// The ranges of the indices of a name, none of which may be empty or begin below 0.
expr::Ranges ranges(const std::vector<expr::Index>& indices, const expr::Scope& scope);

/// The text for one member.
expr::Expression instantiate(const expr::Expression& expression, const Member& member,
                             const expr::Scope& scope);

/// The members that a value gives: the elements of a list; none when it is one value for all.
std::vector<model::Value> elements_of(const model::Value& value);

/// For a range that ends with a name that nothing fixed yet, such as 1..N, the N of `count`
/// members; false when it ends otherwise.
bool learn_count(const std::vector<expr::Index>& indices, std::size_t count,
                 std::map<std::string, int>& dimensions);

}  // namespace gainsmith::bind
