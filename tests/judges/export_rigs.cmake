# A character of every template, and one with all its options, into OUT/rigs. PROGRAM: surefoot.
file(REMOVE_RECURSE "${OUT}/rigs")
file(MAKE_DIRECTORY "${OUT}/rigs")
foreach(template adult child giant long_arms toe_walker)
  execute_process(COMMAND "${PROGRAM}" rig ${template} -o "${OUT}/rigs/${template}.glb" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND "${PROGRAM}" rig adult --stature 1.9 --spine 7 --fingers --no-toes -o "${OUT}/rigs/options.glb"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
