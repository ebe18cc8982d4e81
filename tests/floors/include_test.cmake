# cmake -D COMPILER= INCLUDES= ALLOWED= FORBIDDEN= FILE= -P include_test.cmake
# FILE with the allowed include compiles; with the forbidden one it does not, for lack of that header.
set(options -std=c++20 -fsyntax-only)
foreach(directory IN LISTS INCLUDES)
  list(APPEND options -I${directory})
endforeach()

function(compile header status messages)
  file(WRITE ${FILE} "#include \"${header}\"\n\nint main() {}\n")
  execute_process(COMMAND ${COMPILER} ${options} ${FILE}
                  RESULT_VARIABLE result ERROR_VARIABLE errors)
  set(${status} ${result} PARENT_SCOPE)
  set(${messages} "${errors}" PARENT_SCOPE)
endfunction()

compile(${ALLOWED} status messages)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "\"${ALLOWED}\" should compile:\n${messages}")
endif()
compile(${FORBIDDEN} status messages)
if(status EQUAL 0)
  message(FATAL_ERROR "\"${FORBIDDEN}\" should not be found from here")
endif()
# GCC: "fatal error: x.h: No such file or directory"; Clang: "'x.h' file not found".
if(NOT messages MATCHES "${FORBIDDEN}(: No such file|' file not found)")
  message(FATAL_ERROR "\"${FORBIDDEN}\" fails for another reason:\n${messages}")
endif()
