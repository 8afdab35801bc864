// How many texts were read and bound so far, so that a test can say what does none of it.
#pragma once

#include <cstdint>

namespace gainsmith::expr {

/// Counts since the process began. They only grow.
struct Work {
  std::uint64_t parsed = 0;    ///< calls of parse() (parser.h)
  std::uint64_t bound = 0;     ///< calls of compile() and compile_relations() (compile.h)
  std::uint64_t problems = 0;  ///< problem files that were read
  std::uint64_t designs = 0;   ///< problems that were bound

  bool operator==(const Work&) const = default;
};

/// Of the whole process, all threads.
Work work_done();

void count_parsed();
void count_bound();
void count_problem();
void count_design();

}  // namespace gainsmith::expr
