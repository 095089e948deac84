# The generated default set: cycles to fit that need no file; real clips come through the readers; gaits have files.
target_link_libraries(test_fit PRIVATE surefoot::room_synthetic surefoot::room_author)
