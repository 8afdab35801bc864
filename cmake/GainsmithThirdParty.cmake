# Libraries whose Debian packages give a shared library as their target, under names that are static when
# GAINSMITH_STATIC is on.
add_library(gainsmith_fmt INTERFACE)
add_library(third_party::fmt ALIAS gainsmith_fmt)
add_library(gainsmith_yaml INTERFACE)
add_library(third_party::yaml ALIAS gainsmith_yaml)
if(GAINSMITH_STATIC)
  # Header-only, fmt is a third of the time that a source of the program takes. fmt.cpp knows fmt 9.
  if(fmt_VERSION VERSION_LESS 10)
    add_library(gainsmith_fmt_archive STATIC "${CMAKE_CURRENT_LIST_DIR}/fmt.cpp")
    target_link_libraries(gainsmith_fmt INTERFACE gainsmith_fmt_archive)
  else()
    target_link_libraries(gainsmith_fmt INTERFACE fmt::fmt-header-only)
  endif()
  find_library(GAINSMITH_YAML_ARCHIVE yaml-cpp REQUIRED)
  target_link_libraries(gainsmith_yaml INTERFACE "${GAINSMITH_YAML_ARCHIVE}")
else()
  target_link_libraries(gainsmith_fmt INTERFACE fmt::fmt)
  target_link_libraries(gainsmith_yaml INTERFACE yaml-cpp)
endif()

# CVODE of SUNDIALS; its archive holds the vectors and solvers that it works with.
add_library(gainsmith_cvode INTERFACE)
add_library(third_party::cvode ALIAS gainsmith_cvode)
find_library(GAINSMITH_CVODE_LIBRARY sundials_cvode REQUIRED)
target_link_libraries(gainsmith_cvode INTERFACE "${GAINSMITH_CVODE_LIBRARY}")
if(NOT GAINSMITH_STATIC)
  find_library(GAINSMITH_NVECTOR_LIBRARY sundials_nvecserial REQUIRED)
  target_link_libraries(gainsmith_cvode INTERFACE "${GAINSMITH_NVECTOR_LIBRARY}")
endif()

# The memory allocator of the release programs (docs/decisions/0057-one-program.md); other builds keep that of
# the C library, which the sanitizers replace.
if(GAINSMITH_STATIC)
  find_library(GAINSMITH_JEMALLOC_ARCHIVE jemalloc_pic REQUIRED)
  add_library(gainsmith_allocator INTERFACE)
  add_library(third_party::allocator ALIAS gainsmith_allocator)
  target_link_libraries(gainsmith_allocator INTERFACE "${GAINSMITH_JEMALLOC_ARCHIVE}" Threads::Threads ${CMAKE_DL_LIBS})
endif()

# Libraries that are loaded by the searches that need them: only their headers and the names of
# the files that belong to these headers are built in.
function(gainsmith_loaded name file)
  add_library(gainsmith_${name} INTERFACE)
  add_library(third_party::${name} ALIAS gainsmith_${name})
  find_file(GAINSMITH_${file}_LIBRARY lib${name}.so PATHS /usr/lib PATH_SUFFIXES "${CMAKE_LIBRARY_ARCHITECTURE}" REQUIRED)
  execute_process(COMMAND "${CMAKE_OBJDUMP}" -p "${GAINSMITH_${file}_LIBRARY}" OUTPUT_VARIABLE header COMMAND_ERROR_IS_FATAL ANY)
  if(NOT header MATCHES "SONAME +([^ \n]+)")
    message(FATAL_ERROR "${GAINSMITH_${file}_LIBRARY} has no SONAME")
  endif()
  target_compile_definitions(gainsmith_${name} INTERFACE GAINSMITH_${file}_FILE="${CMAKE_MATCH_1}")
endfunction()
gainsmith_loaded(nlopt NLOPT)
gainsmith_loaded(ipopt IPOPT)
