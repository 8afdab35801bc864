# One library a room, one test program a room.

# gainsmith_compiled_together(TARGET [SIZE])
#   Compiles the sources of TARGET in groups of 32 or SIZE: what they instantiate of Eigen is then compiled once, in half
#   the time. Their names must not collide. GAINSMITH_GROUPS=OFF keeps them apart: one changed file is one file to
#   compile, and each is seen to include what it uses.
function(gainsmith_compiled_together target)
  set(size 32)
  if(ARGC GREATER 1)
    set(size ${ARGV1})
  endif()
  if(GAINSMITH_GROUPS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
  endif()
endfunction()

# gainsmith_group(TARGET NAME a.cpp ...)
#   Instead of groups by number: these sources of TARGET are one group, and those of no group stay apart.
function(gainsmith_group target name)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${name})
  gainsmith_compiled_together(${target})
endfunction()

# gainsmith_room(NAME SOURCES a.cpp ... ROOMS base expr PUBLIC lib ... PRIVATE lib ...)
#   The library gainsmith_NAME from lib/NAME. ROOMS are the rooms it may include (scripts/check_layers
#   holds the includes to its table); PUBLIC and PRIVATE are third-party targets.
function(gainsmith_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;PUBLIC;PRIVATE" ${ARGN})
  add_library(gainsmith_${name} STATIC ${ROOM_SOURCES})
  target_include_directories(gainsmith_${name} PUBLIC "${PROJECT_SOURCE_DIR}/lib")
  list(TRANSFORM ROOM_ROOMS PREPEND gainsmith_)
  target_link_libraries(gainsmith_${name} PUBLIC ${ROOM_ROOMS} ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
  gainsmith_compiled_together(gainsmith_${name})
endfunction()

# gainsmith_test(NAME SOURCES a_test.cpp ... LINK target ...)
#   The test program NAME_test, part of the target `tests`; every TEST in it is a test of its own for ctest. Sources are
#   compiled in groups, as those of rooms.
function(gainsmith_test name)
  cmake_parse_arguments(T "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name}_test ${T_SOURCES})
  target_include_directories(${name}_test PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${name}_test PRIVATE ${T_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  gainsmith_precompiled(${name}_test tests)
  gainsmith_compiled_together(${name}_test 12)
  add_dependencies(tests ${name}_test)
  set(seconds 600)
  if(GAINSMITH_SANITIZE)
    set(seconds 3600)
  endif()
  gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${seconds})
endfunction()
