# OUTPUT: the objects of the list OBJECTS as one, with PREFIX before each name that they define.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Groups are what functions of other sources are told from by: here all are of this object.
run("${LINKER}" -r --force-group-allocation -o "${OUTPUT}" ${OBJECTS})
execute_process(COMMAND "${NM}" -P --defined-only --extern-only "${OUTPUT}" OUTPUT_VARIABLE names COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "([^ \n]+) [^\n]*" "\\1 ${PREFIX}\\1" names "${names}")
file(WRITE "${OUTPUT}.names" "${names}")
run("${OBJCOPY}" "--redefine-syms=${OUTPUT}.names" "${OUTPUT}")
