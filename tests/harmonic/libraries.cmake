# A pose must not allocate: count it.
target_sources(test_harmonic PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
