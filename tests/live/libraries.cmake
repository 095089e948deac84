# The bundled gait is read by author/; a frame must not allocate: count it.
target_link_libraries(test_live PRIVATE surefoot::room_author)
target_sources(test_live PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
