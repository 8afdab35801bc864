// Internal to io: a symmetric block matrix filled by the names of its rows.
//
//   blocks:
//     x: {x: He(P*A), w: P*B, z: C'}
//     w: {w: -g*I}
//     z: {z: -g*I}
//   is: < 0
//
// says [He(P*A), P*B, C'; *, -g*I, 0; *, *, -g*I] < 0.
#pragma once

#include "io/yaml/yaml.h"

namespace gainsmith::io {

/// The comparison. Rows are in the order in which their names appear; what is not given is 0, and
/// below the diagonal is the transpose. InputError when a block is given on both sides of the
/// diagonal, or when `is` is no comparison with 0.
expr::Expression named_blocks(const YamlFile& file, const YamlItem& blocks, const YamlItem& is);

}  // namespace gainsmith::io
