# The generated clips are the test walker: no files needed.
target_link_libraries(test_course PRIVATE surefoot::room_synthetic)
