// A table of texts and what is counted in each.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>

namespace gainsmith::tests {

using Counts = std::initializer_list<std::pair<std::string, std::size_t>>;

/// `count`: of a text.
template <typename Count>
void expect_counts(const Count& count, Counts expected) {
  for (const auto& [text, number] : expected) EXPECT_EQ(count(text), number) << text;
}

}  // namespace gainsmith::tests
