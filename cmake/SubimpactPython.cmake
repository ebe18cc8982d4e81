# Whether the Python package of python/ is built, for which interpreter, and what it asks of the library.
#
#   SUBIMPACT_PYTHON   AUTO: if an interpreter with NumPy and pybind11 are there; ON: they must be; OFF
#   Python_EXECUTABLE  the interpreter; by default the first one with NumPy of python3 and /usr/bin/python3
#
# Sets SUBIMPACT_PYTHON_FOUND and SUBIMPACT_PYTHON_DIR, where the package is installed. The module is a
# shared object, so the floors are compiled as position-independent code, also where an interpreter is
# still missing: installing it later then compiles nothing again. Without semantic interposition, which
# the module rules out by its own list of symbols, this costs no inlining.
set(SUBIMPACT_PYTHON AUTO CACHE STRING "Build the Python package: AUTO, ON or OFF")
set_property(CACHE SUBIMPACT_PYTHON PROPERTY STRINGS AUTO ON OFF)
set(SUBIMPACT_PYTHON_FOUND FALSE)

function(subimpact_find_interpreter)
  if(Python_EXECUTABLE)
    return()
  endif()
  foreach(candidate IN ITEMS python3 /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import sys, numpy; print(sys.executable)"
                    OUTPUT_VARIABLE executable RESULT_VARIABLE status
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(status EQUAL 0)
      set(Python_EXECUTABLE ${executable} CACHE FILEPATH "Interpreter of the Python package")
      return()
    endif()
  endforeach()
endfunction()

function(subimpact_without_python reason)
  if(SUBIMPACT_PYTHON STREQUAL AUTO)
    message(STATUS "Python package: left out (${reason})")
  else()
    message(FATAL_ERROR "The Python package cannot be built: ${reason}. Install python3-dev, "
            "pybind11-dev and python3-numpy, or configure with -DSUBIMPACT_PYTHON=OFF")
  endif()
endfunction()

if(NOT SUBIMPACT_PYTHON)
  message(STATUS "Python package: left out (SUBIMPACT_PYTHON=${SUBIMPACT_PYTHON})")
  return()
elseif(SUBIMPACT_SANITIZE OR SUBIMPACT_FUZZ)
  subimpact_without_python("a module with sanitizers needs an interpreter with sanitizers")
  return()
elseif(SUBIMPACT_PYTHON STREQUAL AUTO AND NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

set(CMAKE_POSITION_INDEPENDENT_CODE ON)
target_compile_options(subimpact_flags INTERFACE -fno-semantic-interposition)
subimpact_find_interpreter()
if(NOT Python_EXECUTABLE)
  subimpact_without_python("no interpreter has NumPy")
  return()
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
if(NOT Python_FOUND)
  subimpact_without_python("${Python_EXECUTABLE} lacks the headers of Python or of NumPy")
  return()
endif()
find_package(pybind11 2.10 QUIET CONFIG)
if(NOT pybind11_FOUND)
  subimpact_without_python("pybind11 2.10 is missing")
  return()
endif()
set(SUBIMPACT_PYTHON_FOUND TRUE)
set(SUBIMPACT_PYTHON_DIR
    lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/site-packages CACHE STRING
    "Where the Python package is installed, below the prefix")
message(STATUS "Python package: for ${Python_EXECUTABLE} (${Python_VERSION})")
