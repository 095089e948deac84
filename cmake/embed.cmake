# Writes the source of surefoot_embed (SurefootEmbed.cmake): OUT, FUNCTION, FILES separated by |.
string(REPLACE "|" ";" files "${FILES}")
set(text "")
foreach(file IN LISTS files)
  file(READ "${file}" content)
  string(APPEND text "${content}")
endforeach()
string(SHA256 hash "${text}")
file(WRITE "${OUT}"
     "namespace surefoot {\n"
     "const char* ${FUNCTION}();\n"
     "const char* ${FUNCTION}_sha256();\n"
     "const char* ${FUNCTION}() { return R\"embedded(${text})embedded\"; }\n"
     "const char* ${FUNCTION}_sha256() { return \"${hash}\"; }\n"
     "}  // namespace surefoot\n")
