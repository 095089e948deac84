# The generated default set, as a character to bake.
target_link_libraries(test_bake PRIVATE surefoot::room_preset)
