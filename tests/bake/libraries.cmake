# The generated default set, as a character to bake.
target_link_libraries(test_bake PRIVATE surefoot::room_synthetic)
target_sources(test_bake PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
