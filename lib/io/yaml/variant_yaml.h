// Internal to io: a problem that is `like` another one.
//
//   problem: slower
//   like: published.yaml
//   data: {T2: 0.8}
//   campaign: {initial: {z: {box: [-1, 1]}}}
//   method: {observer: {let: {L: "[1; 2]"}}}
//
// What is written here replaces what has its name there; `none` removes that; all else stays.
// Mappings of names are joined entry by entry: the sections, those of `method`, what `initial`,
// `values` and `over` list, each observer and its parts. Anything below is replaced as a whole: a
// datum, a claim, a start, the map of an event. The other one may be `like` a third. Its name and
// what it expects are its own. Each node keeps its place, and the paths in a file are relative to
// it.
//
// By the same rules the method of a problem may be `like` one of the program:
//
//   method: {like: nonlinear-observer, claims: {error: none}}
#pragma once

#include "io/yaml/problem_yaml.h"
#include "io/yaml/yaml.h"

namespace gainsmith::io {

/// The root of a problem with all that it takes from others; its own root when it is like none.
/// InputError for a file or a method that is not there, one that is like itself, for `none` where
/// there is nothing, and for a name that is likely to be a misspelling of one there.
YAML::Node with_what_it_is_like(YamlFile& file, const MethodLibrary& library);

}  // namespace gainsmith::io
