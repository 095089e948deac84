# The oracle: convex hulls by libqhull (reentrant).
find_package(Qhull REQUIRED)
target_link_libraries(test_space PRIVATE Qhull::qhull_r)
