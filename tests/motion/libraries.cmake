# Real clips come through the readers; the generated set and its measurements serve where feet must stand.
target_link_libraries(test_motion PRIVATE surefoot::room_io surefoot::room_analysis surefoot::room_synthetic)
