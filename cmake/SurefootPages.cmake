# Pages of documentation that the program can show: the Markdown files of a folder become one function from a page's
# name to its text, so that the text is written once.
#
#   surefoot_embed_pages(TARGET FOLDER HEADER FUNCTION)
function(surefoot_embed_pages target folder header function)
  file(GLOB pages CONFIGURE_DEPENDS "${folder}/*.md")
  set(cases "")
  foreach(page ${pages})
    get_filename_component(name "${page}" NAME_WE)
    if(name STREQUAL "README")
      continue()
    endif()
    file(READ "${page}" text)
    string(APPEND cases "    if (name == \"${name}\") return R\"page(${text})page\";\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
  endforeach()
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT [[// Made of the pages in @folder@.
#include <@header@>

namespace surefoot {

std::string_view @function@(std::string_view name) noexcept {
@cases@    return {};
}

}  // namespace surefoot
]])
  target_sources(${target} PRIVATE "${source}")
endfunction()
