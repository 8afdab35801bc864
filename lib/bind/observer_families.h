// Internal to bind: observers that a method has once for all members of a family.
//
//   observers:
//     filter: {for: i in 1..N, state: {xh: n}, flow: {xh: A*xh + L(i)*(y - C*xh)}}
//
// From here on they are the observers filter_1, filter_2, ..., with numbers for the index.
#pragma once

namespace gainsmith::bind {

struct Binding;

/// Gives the binding a method with the members in place of their families. InputError for a range
/// that is empty or begins below 0.
void bind_observer_families(Binding& binding);

}  // namespace gainsmith::bind
