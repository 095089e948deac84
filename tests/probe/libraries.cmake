# Sets of clips, as characters to probe.
target_link_libraries(test_probe PRIVATE surefoot::room_synthetic surefoot::room_preset)
