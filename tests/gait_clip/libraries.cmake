# Rigs of many kinds are made from the generated biped.
target_link_libraries(test_gait_clip PRIVATE surefoot::room_synthetic)
