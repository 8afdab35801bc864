# What `cmake --install` puts where, and the Debian packages that cpack makes of it. Two components: `program`, and
# `development` with the archive, its header and its CMake package.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(share "${CMAKE_INSTALL_DATADIR}/gainsmith")

# Made by the program of itself.
set(made "${PROJECT_BINARY_DIR}/made")
file(MAKE_DIRECTORY "${made}")
set(made_files)
function(gainsmith_made file)
  add_custom_command(
    OUTPUT "${made}/${file}"
    COMMAND "$<TARGET_FILE:gainsmith>" ${ARGN} > "${made}/${file}"
    DEPENDS gainsmith
    VERBATIM)
  set(made_files ${made_files} "${made}/${file}" PARENT_SCOPE)
endfunction()
gainsmith_made(gainsmith.bash completions bash)
gainsmith_made(_gainsmith completions zsh)
gainsmith_made(gainsmith.fish completions fish)
gainsmith_made(gainsmith.1 manual)
foreach(kind problem method gains)
  gainsmith_made(${kind}.schema.json schema ${kind})
endforeach()
find_program(GZIP_PROGRAM gzip REQUIRED)
add_custom_command(
  OUTPUT "${made}/gainsmith.1.gz"
  COMMAND "${GZIP_PROGRAM}" -9nc "${made}/gainsmith.1" > "${made}/gainsmith.1.gz"
  DEPENDS "${made}/gainsmith.1"
  VERBATIM)
add_custom_target(made ALL DEPENDS ${made_files} "${made}/gainsmith.1.gz"
                  COMMENT "manual page, completions and schemas")

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS gainsmith COMPONENT program)
install(FILES "${made}/gainsmith.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program)
install(FILES "${made}/gainsmith.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME gainsmith
        COMPONENT program)
install(FILES "${made}/gainsmith.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" COMPONENT program)
# zsh looks there for what is below /usr, and here for what is not.
install(CODE "
  set(folder site-functions)
  if(CMAKE_INSTALL_PREFIX MATCHES \"/usr$\")
    set(folder vendor-completions)
  endif()
  file(INSTALL \"${made}/_gainsmith\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/zsh/\${folder}\")"
        COMPONENT program)
# The pages name each other and the problems by their places in the source.
install(DIRECTORY docs problems DESTINATION "${share}" COMPONENT program)
install(DIRECTORY lib/methods DESTINATION "${share}/lib" COMPONENT program FILES_MATCHING PATTERN "*.yaml")
install(DIRECTORY scripts/cluster DESTINATION "${share}/scripts" COMPONENT program USE_SOURCE_PERMISSIONS)
install(DIRECTORY scripts/certify DESTINATION "${share}/scripts" COMPONENT program PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY apps/editors DESTINATION "${share}" COMPONENT program)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE DESTINATION "${share}" COMPONENT program)
install(FILES "${made}/problem.schema.json" "${made}/method.schema.json" "${made}/gains.schema.json" DESTINATION "${share}/schemas"
        COMPONENT program)
# Where Debian's Python and Octave look, below the prefix /usr.
install(DIRECTORY apps/python/gainsmith DESTINATION lib/python3/dist-packages COMPONENT program FILES_MATCHING PATTERN "*.py"
        PATTERN "__pycache__" EXCLUDE)
install(FILES apps/matlab/gainsmith.m DESTINATION "${CMAKE_INSTALL_DATADIR}/octave/site/m" COMPONENT program)
install(FILES cmake/copyright DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)

set(package "${CMAKE_INSTALL_LIBDIR}/cmake/gainsmith")
set(GAINSMITH_NEEDS "mpfr gmp nettle zlib")
if(NOT GAINSMITH_STATIC)
  string(APPEND GAINSMITH_NEEDS " fmt")
endif()
configure_package_config_file(cmake/gainsmithConfig.cmake.in "${PROJECT_BINARY_DIR}/gainsmithConfig.cmake"
                              INSTALL_DESTINATION "${package}" NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/gainsmithConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
# The names of what the package finds.
target_compile_features(gainsmith_archive INTERFACE cxx_std_17)
target_include_directories(gainsmith_archive INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(gainsmith_archive INTERFACE
  $<INSTALL_INTERFACE:yaml-cpp> $<INSTALL_INTERFACE:PkgConfig::GAINSMITH_NEEDS> $<INSTALL_INTERFACE:Threads::Threads>)
if(GAINSMITH_SANITIZE)
  target_link_options(gainsmith_archive INTERFACE -fsanitize=address,undefined)
endif()
install(TARGETS gainsmith_archive EXPORT gainsmithTargets COMPONENT development)
install(FILES lib/api/gainsmith.h DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/gainsmith" COMPONENT development)
install(EXPORT gainsmithTargets NAMESPACE gainsmith:: DESTINATION "${package}" COMPONENT development)
install(FILES "${PROJECT_BINARY_DIR}/gainsmithConfig.cmake" "${PROJECT_BINARY_DIR}/gainsmithConfigVersion.cmake"
        DESTINATION "${package}" COMPONENT development)
install(FILES cmake/copyright DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/gainsmith-dev" COMPONENT development)

# Debian packages: gainsmith and gainsmith-dev. The optimisation libraries are loaded by searches alone.
function(gainsmith_package_of file variable)
  execute_process(COMMAND dpkg-query -S "${file}" OUTPUT_VARIABLE found ERROR_QUIET)
  string(REGEX REPLACE ":.*" "" found "${found}")
  set(${variable} "${found}" PARENT_SCOPE)
endfunction()
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if(NOT DPKG_SHLIBDEPS)
  return()
endif()
file(REAL_PATH "${GAINSMITH_NLOPT_LIBRARY}" nlopt)
file(REAL_PATH "${GAINSMITH_IPOPT_LIBRARY}" ipopt)
gainsmith_package_of("${nlopt}" nlopt_package)
gainsmith_package_of("${ipopt}" ipopt_package)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gainsmith)
set(GAINSMITH_CONTACT "The gainsmith developers <gainsmith@localhost>" CACHE STRING "Who makes the Debian packages, with an address")
set(CPACK_PACKAGE_CONTACT "${GAINSMITH_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "observer and controller gains by matrix inequalities")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RELEASE "")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "It designs observers and controllers by matrix inequalities that are
written as text, proves the inequalities for the numbers that it writes, and
checks the closed loop in simulated runs.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Archive, header and CMake package of gainsmith: semidefinite programs,
gains from the text of a problem, gain files.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gainsmith)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${nlopt_package}, ${ipopt_package}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3, python3-yaml, python3-numpy, octave")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/prerm")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME gainsmith-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "cmake, g++, make, pkg-config, libyaml-cpp-dev, libmpfr-dev, nettle-dev, zlib1g-dev")
if(NOT GAINSMITH_STATIC)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libfmt-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "${nlopt_package}, ${ipopt_package}")
include(CPack)
