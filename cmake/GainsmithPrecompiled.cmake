# Third-party headers that are read once for all sources of the rooms that see them.

# gainsmith_precompiled(TARGET)
#   The sources of TARGET start with Eigen, nlohmann-json and fmt, precompiled. They still include what
#   they use: clang and clang-tidy read them without.
function(gainsmith_precompiled target)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR GAINSMITH_TIDY)
    return()
  endif()
  if(NOT TARGET gainsmith_headers)
    set(source "${PROJECT_BINARY_DIR}/generated/headers.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "")
    add_library(gainsmith_headers OBJECT "${source}")
    target_link_libraries(gainsmith_headers PRIVATE Eigen3::Eigen nlohmann_json::nlohmann_json third_party::fmt)
    target_precompile_headers(gainsmith_headers PRIVATE <Eigen/Core> <nlohmann/json.hpp> <fmt/format.h>)
  endif()
  target_precompile_headers(${target} REUSE_FROM gainsmith_headers)
endfunction()
