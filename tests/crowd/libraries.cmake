# A steady frame must not allocate: count it.
target_sources(test_crowd PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
find_package(Threads REQUIRED)
target_link_libraries(test_crowd PRIVATE Threads::Threads)
# Feet are measured on a character that has some.
target_link_libraries(test_crowd PRIVATE surefoot::room_bake surefoot::room_synthetic)
