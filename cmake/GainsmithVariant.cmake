# Sources that are compiled once more for newer machines, beside the code that every machine runs.

# gainsmith_variant(TARGET LEVEL SOURCES a.cpp ... LINK target ...)
#   Adds to TARGET one object of these sources, compiled for x86-64-LEVEL. All names that it defines begin with LEVEL_ there:
#   functions of templates and headers would otherwise be shared with code for every machine, compiled for this one.
function(gainsmith_variant target level)
  cmake_parse_arguments(V "" "" "SOURCES;LINK" ${ARGN})
  set(objects ${target}_${level})
  set(object "${CMAKE_CURRENT_BINARY_DIR}/${objects}.o")
  add_library(${objects} OBJECT ${V_SOURCES})
  target_include_directories(${objects} PRIVATE "${PROJECT_SOURCE_DIR}/lib")
  target_link_libraries(${objects} PRIVATE ${V_LINK})
  target_compile_options(${objects} PRIVATE -march=x86-64-${level})
  gainsmith_compiled_together(${objects})
  add_custom_command(OUTPUT "${object}"
    COMMAND "${CMAKE_COMMAND}" "-DOBJECTS=$<TARGET_OBJECTS:${objects}>" -DPREFIX=${level}_ -DOUTPUT=${object}
            -DLINKER=${CMAKE_LINKER} -DNM=${CMAKE_NM} -DOBJCOPY=${CMAKE_OBJCOPY}
            -P "${PROJECT_SOURCE_DIR}/cmake/rename_symbols.cmake"
    DEPENDS ${objects} $<TARGET_OBJECTS:${objects}> "${PROJECT_SOURCE_DIR}/cmake/rename_symbols.cmake"
    COMMENT "Naming ${objects}" VERBATIM)
  add_custom_target(${objects}_object DEPENDS "${object}")
  set_source_files_properties("${object}" PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  target_sources(${target} PRIVATE "${object}")
  set_property(TARGET ${target} PROPERTY GAINSMITH_OBJECTS "${object}")
endfunction()
