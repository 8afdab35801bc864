# Headers that are read once for all sources of the rooms that see them.

# gainsmith_precompiled(TARGET SET)
#   The sources of TARGET start with a set of precompiled headers: `eigen`, `all` with nlohmann-json and fmt
#   besides, or `tests` with GoogleTest. They still include what they use: clang, and GAINSMITH_GROUPS=OFF, read
#   them without.
function(gainsmith_precompiled target set)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR NOT GAINSMITH_GROUPS)
    return()
  endif()
  set(headers gainsmith_headers_${set})
  if(NOT TARGET ${headers})
    set(source "${PROJECT_BINARY_DIR}/generated/${headers}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "")
    add_library(${headers} OBJECT "${source}")
    target_link_libraries(${headers} PRIVATE Eigen3::Eigen third_party::fmt)
    target_precompile_headers(${headers} PRIVATE
      <Eigen/Core> <boost/multiprecision/mpfr.hpp> <algorithm> <functional> <map> <memory> <optional> <set> <string> <vector>)
    if(set STREQUAL "tests")
      target_compile_options(${headers} PRIVATE -O1)
      target_link_libraries(${headers} PRIVATE GTest::gtest GTest::gmock)
      target_precompile_headers(${headers} PRIVATE <gtest/gtest.h> <gmock/gmock.h> <Eigen/Dense> <random>)
    endif()
    if(set STREQUAL "all")
      # What reads and writes text computes nothing.
      target_compile_options(${headers} PRIVATE -O1)
      target_link_libraries(${headers} PRIVATE nlohmann_json::nlohmann_json)
      target_precompile_headers(${headers} PRIVATE <nlohmann/json.hpp> <fmt/format.h>)
    endif()
  endif()
  if(set STREQUAL "all")
    target_compile_options(${target} PRIVATE -O1)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()
