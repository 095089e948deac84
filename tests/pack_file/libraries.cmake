#What is packed is made as users make it : a project and a graph beside it.Steady frames are counted not to allocate.
target_link_libraries(test_pack_file PRIVATE surefoot::room_graph_text surefoot::room_synthetic)
    target_sources(test_pack_file PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
