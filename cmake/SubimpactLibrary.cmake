# One library target a source folder, with includes that can only point one way.
#
#   subimpact_library(<folder> [SOURCES <file>...] [USES <folder>...] [LINK <target>...])
#
# src/<folder> (private headers, included as "<folder>/x.h") and include/subimpact/<folder> (public
# headers, included as "subimpact/<folder>/x.h") are visible to the targets that name <folder> under
# USES, directly or through others, and to nobody else: each folder is reached through a link of its
# own in the build tree, so an include that goes against the floors does not compile. A folder
# without sources holds headers only.
function(subimpact_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;LINK" ${ARGN})
  set(target subimpact_${folder})
  set(stage ${PROJECT_BINARY_DIR}/stage/${folder})
  file(MAKE_DIRECTORY ${stage}/subimpact)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${folder} ${stage}/${folder} SYMBOLIC)
  if(EXISTS ${PROJECT_SOURCE_DIR}/include/subimpact/${folder})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/include/subimpact/${folder}
         ${stage}/subimpact/${folder} SYMBOLIC)
  endif()

  list(TRANSFORM ARG_USES PREPEND subimpact::)
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC ${stage})
    target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_LINK} PRIVATE subimpact_flags)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${stage})
    target_link_libraries(${target} INTERFACE ${ARG_USES} ${ARG_LINK})
  endif()
  add_library(subimpact::${folder} ALIAS ${target})
endfunction()
