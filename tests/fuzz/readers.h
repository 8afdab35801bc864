// What reads people's files, for fuzzers: the libFuzzer targets (target.cpp) and the mutants of ctest (mutants_test.cpp).
//
// Whatever the bytes, a reader reads them (true), or refuses them with an InputError at a place inside them (false).
// std::logic_error for a place outside, and for a value that the bytes do not have.
#pragma once

#include <string_view>

namespace gainsmith::fuzz {

bool read_csv(std::string_view bytes);
bool read_json(std::string_view bytes);
bool read_language(std::string_view bytes);
bool read_mat(std::string_view bytes);
bool read_npy(std::string_view bytes);
bool read_sdpa(std::string_view bytes);
bool read_yaml(std::string_view bytes);


/// The same of compressed MAT files, whose values are looked for in `plain`.
bool read_compressed_mat(std::string_view bytes, std::string_view plain);

}  // namespace gainsmith::fuzz
