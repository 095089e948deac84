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
