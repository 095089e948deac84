# Installs a build into a folder of its own, then configures, builds and runs the outside project against it.
#   cmake -DCOMPONENT=runtime|author -DBUILD=… -DSCRATCH=… -DSOURCE=… -DCOMPILER=… -DFLAGS=… -P run.cmake
function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${status}): ${command}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
set(prefix "${SCRATCH}/prefix")
step(${CMAKE_COMMAND} --install "${BUILD}" --component runtime --prefix "${prefix}")
if(COMPONENT STREQUAL "author")
  step(${CMAKE_COMMAND} --install "${BUILD}" --component author --prefix "${prefix}")
  step("${prefix}/bin/surefoot" --version)
endif()
step(${CMAKE_COMMAND} -S "${SOURCE}" -B "${SCRATCH}/build" -G Ninja -DCMAKE_PREFIX_PATH=${prefix}
     -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCOMPONENT=${COMPONENT})
step(${CMAKE_COMMAND} --build "${SCRATCH}/build")
step("${SCRATCH}/build/runtime_user")
if(COMPONENT STREQUAL "author")
  step("${SCRATCH}/build/author_user")
  # The examples are what a newcomer copies from: they must build from what is installed, and run.
  step(${CMAKE_COMMAND} -S "${EXAMPLES}" -B "${SCRATCH}/examples" -G Ninja -DCMAKE_PREFIX_PATH=${prefix}
       -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS})
  step(${CMAKE_COMMAND} --build "${SCRATCH}/examples")
  set(project "${SCRATCH}/hero")
  step("${prefix}/bin/surefoot" author --default -o "${project}")
  step("${prefix}/bin/surefoot" bake "${project}" -o "${project}.sfpack")
  step("${SCRATCH}/examples/play_a_clip" "${project}.sfpack" walk)
  foreach(example steer own_ground crowd crowd_tbb rollback)
    step("${SCRATCH}/examples/${example}" "${project}.sfpack")
  endforeach()
  file(COPY "${EXAMPLES}/hero.json" DESTINATION "${SCRATCH}/graphs")  # its project is ../hero
  step("${prefix}/bin/surefoot" bake "${SCRATCH}/graphs/hero.json" -o "${SCRATCH}/graphs/hero.sfpack")
  step("${SCRATCH}/examples/state_machine" "${SCRATCH}/graphs/hero.sfpack")
endif()
