# The generated default set, as a character to probe.
target_link_libraries(test_probe PRIVATE surefoot::room_synthetic)
