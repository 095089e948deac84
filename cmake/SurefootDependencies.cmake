# Third-party libraries of the authoring side, all Debian 12 packages (scripts/setup.sh installs them).
if(EMSCRIPTEN)
  include(SurefootWasmHeaders)
else()
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
endif()

add_library(surefoot_json INTERFACE)
target_link_libraries(surefoot_json INTERFACE nlohmann_json::nlohmann_json)

# Threads of the tools: oneTBB natively, serial in the browser.
add_library(surefoot_threads INTERFACE)
if(NOT EMSCRIPTEN)
  find_package(TBB REQUIRED)
  target_link_libraries(surefoot_threads INTERFACE TBB::tbb)
endif()

# Readers: tinygltf (header only), fast_float (header only), assimp for FBX and Collada.
add_library(surefoot_io_libraries INTERFACE)
target_link_libraries(surefoot_io_libraries INTERFACE surefoot_json)
if(NOT EMSCRIPTEN)
  find_package(assimp REQUIRED)
  target_link_libraries(surefoot_io_libraries INTERFACE assimp::assimp)
endif()

# Exported with the authoring rooms that use them (cmake/SurefootInstall.cmake).
set_property(GLOBAL PROPERTY SUREFOOT_LIBRARY_TARGETS surefoot_json surefoot_threads surefoot_io_libraries)
foreach(library json threads io_libraries)
  set_target_properties(surefoot_${library} PROPERTIES EXPORT_NAME library_${library})
endforeach()
