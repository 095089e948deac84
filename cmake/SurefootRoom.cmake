# A room is a folder under surefoot/ and a static library of its own, so that the linker, too, sees which room leans on
# which. A room of headers only becomes an interface library.
#
#   surefoot_room(NAME [RUNTIME | PLAYED] [DEPENDS room...] [LIBRARIES target...])
#
# RUNTIME rooms are built without exceptions; what a PLAYED room does runs each frame, too. DEPENDS are rooms, LIBRARIES are third-party targets.
function(surefoot_room name)
  cmake_parse_arguments(ROOM "RUNTIME;PLAYED" "" "DEPENDS;LIBRARIES" ${ARGN})
  set(target surefoot_${name})
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp")
  file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.h")
  list(TRANSFORM ROOM_DEPENDS PREPEND surefoot_)
  if(sources)
    add_library(${target} STATIC ${sources} ${headers})
    set(scope PUBLIC)
    surefoot_compile_options(${target})
    if(ROOM_RUNTIME)
      target_compile_options(${target} PRIVATE -fno-exceptions)
    elseif(EMSCRIPTEN AND NOT ROOM_PLAYED)
      # It is sent to browsers; what runs each frame stays fast.
      target_compile_options(${target} PRIVATE -Os)
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                             "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(${target} ${scope} ${ROOM_DEPENDS} ${ROOM_LIBRARIES})
  set_target_properties(${target} PROPERTIES EXPORT_NAME room_${name})
  add_library(surefoot::room_${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY SUREFOOT_ROOMS ${name})
  if(ROOM_RUNTIME)
    set_property(GLOBAL APPEND PROPERTY SUREFOOT_RUNTIME_ROOMS ${name})
  endif()
endfunction()

# Same bits with every instruction set: no contraction (DESIGN: bit-exact everywhere). -Wno-psabi silences notes about
# vector arguments, which never cross our public headers.
function(surefoot_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wno-psabi -ffp-contract=off -fno-math-errno
                                           $<$<BOOL:${SUREFOOT_WERROR}>:-Werror>)
  # GCC 12 makes vfmaddsub of alternating sums in spite of -ffp-contract=off where the processor of its flags has it.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
    target_compile_options(${target} PRIVATE -mno-fma)
  endif()
  # GCC 12 warns of impossible overlaps in std::string concatenation (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  # Under its sanitizers GCC takes members of std::regex, std::variant and the like for uninitialized, as its manual says
  # it may; the plain builds keep the warning.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize=")
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
endfunction()

# SIMD kernels of a room: <room>/kernels_<build>.cpp, one file for each instruction set. GCC 12 at -O2 makes them up to
# 2.5 times slower than at -O3. Builds beyond the target's own are left out where they make no sense.
function(surefoot_kernels name)
  set(folder "${CMAKE_CURRENT_SOURCE_DIR}/${name}")
  set_source_files_properties("${folder}/kernels_baseline.cpp" PROPERTIES COMPILE_OPTIONS "$<$<NOT:$<CONFIG:Debug>>:-O3>")
  foreach(level v3 v4)
    if(SUREFOOT_KERNELS_X86_64 AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" AND NOT EMSCRIPTEN
       AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
      set_source_files_properties("${folder}/kernels_${level}.cpp" PROPERTIES
        COMPILE_OPTIONS "$<$<NOT:$<CONFIG:Debug>>:-O3>;-march=x86-64-${level}")
      target_compile_definitions(surefoot_${name} PUBLIC SUREFOOT_HAS_KERNELS_X86_64)
    else()
      set_source_files_properties("${folder}/kernels_${level}.cpp" PROPERTIES HEADER_FILE_ONLY ON)
    endif()
  endforeach()
endfunction()
