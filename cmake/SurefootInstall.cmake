# cmake --install, and the package behind find_package(surefoot COMPONENTS runtime author).
#
# Two components, installable apart: `runtime` (no third party) and `author` (with the program). Each has an export file
# of its own, so that a runtime-only installation asks its user for no library.
if(EMSCRIPTEN OR NOT SUREFOOT_INSTALL)
  return()
endif()
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/surefoot")

function(surefoot_install_targets component)
  install(TARGETS ${ARGN} EXPORT surefoot_${component}
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${component})
  install(EXPORT surefoot_${component} NAMESPACE surefoot:: FILE surefoot-${component}.cmake
          DESTINATION "${package_folder}" COMPONENT ${component})
endfunction()

function(surefoot_install_rooms component)
  foreach(room ${ARGN})
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/surefoot/${room}"
            DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/surefoot" COMPONENT ${component}
            FILES_MATCHING PATTERN "*.h" PATTERN "*.inl")
  endforeach()
endfunction()

get_property(rooms GLOBAL PROPERTY SUREFOOT_ROOMS)
get_property(runtime_rooms GLOBAL PROPERTY SUREFOOT_RUNTIME_ROOMS)
set(author_rooms ${rooms})
list(REMOVE_ITEM author_rooms ${runtime_rooms})

list(TRANSFORM runtime_rooms PREPEND surefoot_ OUTPUT_VARIABLE runtime_targets)
surefoot_install_targets(runtime ${runtime_targets} surefoot_runtime)
surefoot_install_rooms(runtime ${runtime_rooms})

if(SUREFOOT_BUILD_TOOLS)
  list(TRANSFORM author_rooms PREPEND surefoot_ OUTPUT_VARIABLE author_targets)
  get_property(library_targets GLOBAL PROPERTY SUREFOOT_LIBRARY_TARGETS)
  surefoot_install_targets(author ${author_targets} surefoot_author_library ${library_targets})
  surefoot_install_rooms(author ${author_rooms})
  install(TARGETS surefoot_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT author)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/gaits" DESTINATION "${CMAKE_INSTALL_DATADIR}/surefoot" COMPONENT author)
  # `make studio` builds it; without it the program says so.
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/build/studio" DESTINATION "${CMAKE_INSTALL_DATADIR}/surefoot" COMPONENT author
          OPTIONAL)
  install(FILES "${PROJECT_SOURCE_DIR}/docs/graph.schema.json" DESTINATION "${CMAKE_INSTALL_DATADIR}/surefoot"
          COMPONENT author)
endif()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/surefoot-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/surefoot-config.cmake" INSTALL_DESTINATION "${package_folder}")
# Before 1.0 a minor version may change interfaces.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/surefoot-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/surefoot-config.cmake" "${PROJECT_BINARY_DIR}/surefoot-config-version.cmake"
        DESTINATION "${package_folder}" COMPONENT runtime)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)
