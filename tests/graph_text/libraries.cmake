# The generated default set is the character; steady frames are counted not to allocate.
target_link_libraries(test_graph_text PRIVATE surefoot::room_synthetic)
target_sources(test_graph_text PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
