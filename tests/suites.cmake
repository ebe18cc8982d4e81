# Writes a test of ctest for every suite of a test program; cmake -P, after the program is linked.
#
#   PROGRAM  the test program        PREFIX   of the names
#   LABEL    of the tests; those of "unit" that take long are "run"
#   COSTS    a file with lines "<name> <seconds>", of suites that take long
#   TIMEOUT  in seconds
#   OUTPUT   the file to write
#
# A suite, not a test, is one process: starting it takes longer than most tests.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${listing}")
file(STRINGS ${COSTS} costs REGEX "^[^#]")
set(text "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([A-Za-z0-9_/]+)\\.")  # the tests of a suite are indented
    continue()
  endif()
  set(suite ${CMAKE_MATCH_1})
  set(name ${PREFIX}/${suite})
  set(cost 0)
  foreach(entry IN LISTS costs)
    if(entry MATCHES "^${name} ([0-9.]+)$")
      set(cost ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(label ${LABEL})
  if(label STREQUAL "unit" AND cost GREATER 0)
    set(label run)
  endif()
  string(APPEND text "add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
                     "set_tests_properties([=[${name}]=] PROPERTIES LABELS ${label} TIMEOUT ${TIMEOUT} "
                     "COST ${cost} WORKING_DIRECTORY [=[${DIRECTORY}]=])\n")
endforeach()
file(WRITE ${OUTPUT} "${text}")
