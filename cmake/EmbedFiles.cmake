# Text files within a library, so that a program finds them wherever it is installed.
#
#   subimpact_embed(<target> <directory> <file>...)
#
# Adds to the target a source that defines the function declared in <directory>/files.h,
#
#   std::string_view embedded_file(std::string_view name);
#
# which returns the text of a <file>, named relative to <directory>. The source is written anew when
# one of the files changes.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(subimpact_embed_script ${CMAKE_CURRENT_LIST_FILE})
  function(subimpact_embed target directory)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${directory}/files.cpp)
    set(root ${CMAKE_CURRENT_SOURCE_DIR}/${directory})
    list(TRANSFORM ARGN PREPEND ${root}/ OUTPUT_VARIABLE paths)
    add_custom_command(
      OUTPUT ${source}
      COMMAND ${CMAKE_COMMAND} -D source=${source} -D root=${root} -D directory=${directory}
              -D "names=${ARGN}" -P ${subimpact_embed_script}
      DEPENDS ${paths} ${subimpact_embed_script}
      COMMENT "Embedding the text files of ${directory}"
      VERBATIM)
    target_sources(${target} PRIVATE ${source})
  endfunction()
  return()
endif()

set(cases)
foreach(name IN LISTS names)
  file(READ ${root}/${name} text)
  string(APPEND cases "  if (name == \"${name}\") return R\"embedded(${text})embedded\";\n")
endforeach()
file(WRITE ${source} "#include \"${directory}/files.h\"

#include <stdexcept>
#include <string>

namespace subimpact {

std::string_view embedded_file(std::string_view name) {
${cases}  throw std::logic_error(\"not a file of this library: \" + std::string(name));
}

}  // namespace subimpact
")
