# Header-only libraries for emscripten. The system's include folder must not be mixed into emscripten's own, so a folder
# of links in the build tree shows only what is wanted.
set(SUREFOOT_HOST_INCLUDE "/usr/include" CACHE PATH "Where the header-only libraries are installed")
set(wasm_headers "${PROJECT_BINARY_DIR}/third_party")
file(MAKE_DIRECTORY "${wasm_headers}")
foreach(entry nlohmann fmt fast_float tiny_gltf.h)
  if(NOT EXISTS "${SUREFOOT_HOST_INCLUDE}/${entry}")
    message(FATAL_ERROR "${SUREFOOT_HOST_INCLUDE}/${entry} is missing; run scripts/setup.sh build, or set "
                        "SUREFOOT_HOST_INCLUDE to where it is")
  endif()
  file(CREATE_LINK "${SUREFOOT_HOST_INCLUDE}/${entry}" "${wasm_headers}/${entry}" SYMBOLIC)
endforeach()

function(surefoot_wasm_library target)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE "${wasm_headers}")
endfunction()
surefoot_wasm_library(nlohmann_json::nlohmann_json)
surefoot_wasm_library(fmt::fmt)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
