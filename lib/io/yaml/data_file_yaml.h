// Internal to io: matrices in files of their own.
//
//   {csv: A.csv}   {npy: A.npy}   {mat: plant.mat, name: A}   {json: plant.json, name: plant.A}
//
// Paths are relative to the file that names them. `name` says which matrix of the file; it may be
// left out where a MAT file has one variable, or where a JSON document is the matrix.
#pragma once

#include "io/yaml/yaml.h"

namespace gainsmith::io {

/// Whether the node is a mapping of this kind.
bool names_file(const YAML::Node& node);

/// Its matrix, with the decimals of the file; those of a CSV file have their places in it.
/// InputError for what is no such matrix, with the place there or here.
model::Value matrix_of_file(const YamlFile& file, const YamlItem& item);

/// InputError for a mapping that names no file, with the formats that are known.
[[noreturn]] void refuse_mapping(const YamlFile& file, const YamlItem& item);

/// InputError for a text that is nothing but the path of a data file.
void refuse_bare_path(const YamlFile& file, const YamlItem& item);

}  // namespace gainsmith::io
