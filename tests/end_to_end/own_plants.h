// Problems with plants that are in no paper, as the pages of a method tell to write them.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace gainsmith::tests {

struct Own {
  std::string name;
  std::string method;
  std::string text;  ///< what stands below the name and the method
  std::string
      refused;  ///< what is said of a plant that the method does not serve; empty for one that it does
};

inline void PrintTo(const Own& own, std::ostream* out) { *out << own.name; }

class OwnPlants : public ::testing::TestWithParam<Own> {};

inline std::string name_of(const ::testing::TestParamInfo<Own>& own) { return own.param.name; }

}  // namespace gainsmith::tests
