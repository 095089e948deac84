# Real clips come through the readers; the generated default set needs none.
target_link_libraries(test_analysis PRIVATE surefoot::room_io surefoot::room_synthetic)

# The command's contract; with real clips where they lie beside the repository.
set(motion "${PROJECT_SOURCE_DIR}/../shared/motion")
set(clips "")
foreach(clip cmu_bvh o3de_mocap_bvh/WalkTurns1.bvh o3de_mocap_bvh/TurnOnSpot1.bvh ual1_locomotion_glb)
  if(EXISTS "${motion}/${clip}")
    list(APPEND clips "${motion}/${clip}")
  endif()
endforeach()
add_test(NAME analysis.analyze_keeps_its_contract
         COMMAND ${CMAKE_COMMAND} "-DPROGRAM=$<TARGET_FILE:surefoot_cli>" "-DCLIPS=${clips}"
                 "-DSCRATCH=${CMAKE_CURRENT_BINARY_DIR}/analyze_contract" -P "${CMAKE_CURRENT_SOURCE_DIR}/analysis/cli.cmake")
