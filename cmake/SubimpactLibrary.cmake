# Half of the time to compile goes into the same headers of other libraries: they are precompiled, once
# for all hot floors, for the others and for programs. Not with ccache, which would keep no objects made with them.
if(CMAKE_CXX_COMPILER_LAUNCHER OR SUBIMPACT_SANITIZE OR SUBIMPACT_FUZZ)
  set(SUBIMPACT_PRECOMPILE OFF)
else()
  set(SUBIMPACT_PRECOMPILE ON)
endif()
set(SUBIMPACT_HOT_HEADERS <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <ranges>
                          <span> <string> <vector> <Eigen/Core>)
set(SUBIMPACT_OTHER_HEADERS ${SUBIMPACT_HOT_HEADERS} <filesystem> <fstream> <regex>
                           <fmt/format.h> <nlohmann/json.hpp>)

# The headers of a target: `hot`, `other` or, of programs, which are compiled as such, `program`.
function(subimpact_precompile target kind)
  if(NOT SUBIMPACT_PRECOMPILE)
    return()
  endif()
  set(owner subimpact_${kind}_headers)
  set(headers ${SUBIMPACT_OTHER_HEADERS})
  set(is_hot OFF)
  if(kind STREQUAL "hot")
    set(headers ${SUBIMPACT_HOT_HEADERS})
    set(is_hot ON)
  endif()
  if(NOT TARGET ${owner})
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/headers/${owner}.cpp CONTENT "")
    add_library(${owner} OBJECT ${PROJECT_BINARY_DIR}/headers/${owner}.cpp)
    set_target_properties(${owner} PROPERTIES SUBIMPACT_HOT ${is_hot})
    target_link_libraries(${owner} PRIVATE Eigen3::Eigen subimpact_flags)
    if(NOT is_hot)
      target_link_libraries(${owner} PRIVATE fmt::fmt nlohmann_json::nlohmann_json)
    endif()
    target_compile_definitions(${owner} PRIVATE Eigen=subimpact_eigen)
    target_precompile_headers(${owner} PRIVATE ${headers})
    if(kind STREQUAL "program")
      subimpact_compile_as_program(${owner})
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

function(subimpact_compile_as_program target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${target} PRIVATE $<$<BOOL:${CMAKE_POSITION_INDEPENDENT_CODE}>:-fPIE>)
endfunction()

# One library target a source folder, with includes that can only point one way.
#
#   subimpact_library(<folder> [STUDIES] [HOT] [USES <folder>...] [LINK <target>...])
#
# It is part of the library of studies with STUDIES, else of the core (SubimpactPackage.cmake). HOT:
# runs spend their time in its loops, so that it is compiled with -O3. Its sources are all of
# src/<folder>. src/<folder> (private headers, included as "<folder>/x.h") and
# include/subimpact/<folder> (public headers, included as "subimpact/<folder>/x.h") are visible to the
# targets that name <folder> under USES, directly or through others, and to nobody else: each folder is
# reached through a link of its own in the build tree, so an include that goes against the floors does
# not compile. A folder without sources holds headers only.
function(subimpact_library folder)
  cmake_parse_arguments(ARG "STUDIES;HOT" "" "USES;LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  set(target subimpact_${folder})
  set(stage ${PROJECT_BINARY_DIR}/stage/${folder})
  file(MAKE_DIRECTORY ${stage}/subimpact)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${folder} ${stage}/${folder} SYMBOLIC)
  if(EXISTS ${PROJECT_SOURCE_DIR}/include/subimpact/${folder})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/include/subimpact/${folder}
         ${stage}/subimpact/${folder} SYMBOLIC)
  endif()

  list(TRANSFORM ARG_USES PREPEND subimpact::)
  if(sources)
    add_library(${target} STATIC ${sources})
    target_include_directories(${target} PUBLIC ${stage})
    target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_LINK} PRIVATE subimpact_flags)
    set_target_properties(${target} PROPERTIES SUBIMPACT_HOT ${ARG_HOT})
    set(kind other)
    if(ARG_HOT)
      set(kind hot)
    endif()
    subimpact_precompile(${target} ${kind})
    set(library core)
    if(ARG_STUDIES)
      set(library studies)
    endif()
    set_property(GLOBAL APPEND PROPERTY SUBIMPACT_OBJECTS_${library} $<TARGET_OBJECTS:${target}>)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${stage})
    target_link_libraries(${target} INTERFACE ${ARG_USES} ${ARG_LINK})
  endif()
  add_library(subimpact::${folder} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY SUBIMPACT_HEADER_FLOORS ${folder})
endfunction()

# Target check_headers: each header compiles when it is all that a file includes, twice, with what its
# floor may see; public ones also with include/ alone. For work on the project; not built by default.
function(subimpact_check_headers)
  add_custom_target(check_headers)
  get_property(floors GLOBAL PROPERTY SUBIMPACT_HEADER_FLOORS)
  foreach(folder IN LISTS floors)
    set(stage ${PROJECT_BINARY_DIR}/stage/${folder})
    file(GLOB_RECURSE headers FOLLOW_SYMLINKS RELATIVE ${stage} ${stage}/*.h)
    subimpact_header_target(check_headers_${folder} ${headers})
    target_link_libraries(check_headers_${folder} PRIVATE subimpact::${folder} subimpact_flags)
  endforeach()
  # The private headers of sundials/ are for the sources beside them.
  target_link_libraries(check_headers_integrate
    PRIVATE $<TARGET_PROPERTY:subimpact_integrate,LINK_LIBRARIES>)
  target_link_libraries(check_headers_io PRIVATE $<TARGET_PROPERTY:subimpact_io,LINK_LIBRARIES>)

  file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR}/include
       ${PROJECT_SOURCE_DIR}/include/*.h)
  subimpact_header_target(check_headers_public ${headers})
  target_include_directories(check_headers_public PRIVATE ${PROJECT_SOURCE_DIR}/include)
endfunction()

function(subimpact_header_target target)
  set(sources)
  foreach(header IN LISTS ARGN)
    set(source ${PROJECT_BINARY_DIR}/headers/${target}/${header}.cpp)
    file(CONFIGURE OUTPUT ${source}
         CONTENT "#include \"${header}\"\n#include \"${header}\"  // again, on purpose\n")
    list(APPEND sources ${source})
  endforeach()
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${sources})
  target_compile_options(${target} PRIVATE -O0)
  add_dependencies(check_headers ${target})
endfunction()
