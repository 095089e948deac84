# The oracle: convex hulls by libqhull (reentrant).
find_package(Qhull REQUIRED)
target_link_libraries(test_space PRIVATE Qhull::qhull_r)
target_sources(test_space PRIVATE "${PROJECT_SOURCE_DIR}/tests/support/allocations.cpp")
