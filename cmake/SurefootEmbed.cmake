# Texts that travel inside the program: surefoot_embed(ROOM FUNCTION file...) gives the room
#
#   const char* FUNCTION();         the files one after the other
#   const char* FUNCTION_sha256();  the hash of that text, in hexadecimal (for a page's content security policy)
#
# The files stay what they are, readable and testable beside the sources.
function(surefoot_embed room function)
  set(files ${ARGN})
  list(TRANSFORM files PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/${room}/")
  set(out "${CMAKE_CURRENT_BINARY_DIR}/embedded/${function}.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed.cmake")
  string(REPLACE ";" "|" joined "${files}")
  add_custom_command(OUTPUT "${out}" DEPENDS ${files} "${script}" VERBATIM
                     COMMAND ${CMAKE_COMMAND} "-DOUT=${out}" "-DFUNCTION=${function}" "-DFILES=${joined}" -P "${script}")
  target_sources(surefoot_${room} PRIVATE "${out}")
endfunction()

# Pages of documentation that the program can show: the Markdown files of a folder become one function from a page's
# name to its text, so that the text is written once. EXTENSION takes other files than Markdown; NAMES asks for a
# function that gives the names, one a line, in order.
#
#   surefoot_embed_pages(TARGET FOLDER HEADER FUNCTION [EXTENSION md] [NAMES FUNCTION])
function(surefoot_embed_pages target folder header function)
  cmake_parse_arguments(PAGES "" "EXTENSION;NAMES" "" ${ARGN})
  if(NOT PAGES_EXTENSION)
    set(PAGES_EXTENSION md)
  endif()
  file(GLOB pages CONFIGURE_DEPENDS "${folder}/*.${PAGES_EXTENSION}")
  set(cases "")
  set(names "")
  foreach(page ${pages})
    get_filename_component(name "${page}" NAME_WE)
    if(name STREQUAL "README")
      continue()
    endif()
    file(READ "${page}" text)
    string(APPEND cases "    if (name == \"${name}\") return R\"page(${text})page\";\n")
    string(APPEND names "${name}\\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
  endforeach()
  set(list_of_names "")
  if(PAGES_NAMES)
    set(list_of_names "\nstd::string_view ${PAGES_NAMES}() noexcept { return \"${names}\"; }\n")
  endif()
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT [[// Made of the pages in @folder@.
#include <@header@>

namespace surefoot {

std::string_view @function@(std::string_view name) noexcept {
@cases@    return {};
}
@list_of_names@
}  // namespace surefoot
]])
  target_sources(${target} PRIVATE "${source}")
endfunction()
