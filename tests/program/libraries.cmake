#A steady frame must not allocate : count it.
target_sources(test_program PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
