# Debian packages by `cpack`, of a build for any processor (`cmake --preset package`):
#
#   subimpact           the program, its manual page and the completion of bash
#   python3-subimpact   the Python package and subimpact-sweep, if they are built
#   libsubimpact-dev    the library, its headers, and what CMake and pkg-config need
#
# The files that Debian asks for besides, copyright and changelog, are made here.
if(SUBIMPACT_NATIVE)
  return()  # Such a package would stop with "illegal instruction" elsewhere.
endif()
find_program(GZIP gzip)
find_program(DPKG dpkg)
if(NOT GZIP OR NOT DPKG)
  message(STATUS "Debian packages: left out (gzip and dpkg are needed)")
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME subimpact)
set(CPACK_PACKAGE_VENDOR "The subimpact authors")
# Who distributes a package states an address: DEBFULLNAME="..." DEBEMAIL=... cmake --preset package
set(name "The subimpact authors")
set(address subimpact@localhost)
if(DEFINED ENV{DEBFULLNAME})
  set(name $ENV{DEBFULLNAME})
endif()
if(DEFINED ENV{DEBEMAIL})
  set(address $ENV{DEBEMAIL})
endif()
set(CPACK_PACKAGE_CONTACT "${name} <${address}>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET subimpact_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "sub-impacts of a rigid mass that strikes a beam")
set(text
"A rigid mass that strikes a beam does not hit it once: one blow is dozens of
sub-impacts, some of them a few microseconds long. subimpact finds when each
begins and ends, its force, impulse and dent, and with what error, for beams
that yield and contacts that dent.")
if(TARGET subimpact_python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
endif()
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
# subimpact_debian_package(<component> <package> <what the package holds>)
macro(subimpact_debian_package component package holds)
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${COMPONENT}_DESCRIPTION "${text}\n.\n${holds}")
  set(doc ${PROJECT_BINARY_DIR}/debian/${package})
  configure_file(cmake/debian-copyright ${doc}/copyright COPYONLY)
  file(WRITE ${doc}/changelog
"subimpact (${PROJECT_VERSION}) unstable; urgency=medium

  * See CHANGELOG.md of the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  execute_process(COMMAND ${GZIP} -9nf ${doc}/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(DIRECTORY ${doc}/ DESTINATION share/doc/${package} COMPONENT ${component}
          EXCLUDE_FROM_ALL)
endmacro()
subimpact_debian_package(program subimpact "This package has the program.")
subimpact_debian_package(library libsubimpact-dev
  "This package has the library for C++ with its headers.")
subimpact_debian_package(python python3-subimpact
  "This package has the Python package, and the command subimpact-sweep.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-subimpact, libjs-dygraphs")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas, python3-scipy, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libsundials-dev, libsuitesparse-dev, libfmt-dev, libtomlplusplus-dev, libssl-dev")
if(TARGET subimpact)
  # In Debian's packages manual pages are compressed.
  install(CODE "
    set(manual \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1/subimpact.1\")
    if(EXISTS \"\${manual}\" AND \"\${CMAKE_INSTALL_PREFIX}\" STREQUAL /usr)
      execute_process(COMMAND ${GZIP} -9nf \"\${manual}\" COMMAND_ERROR_IS_FATAL ANY)
    endif()" COMPONENT program)
endif()
include(CPack)
