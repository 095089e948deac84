#Real clips come through the readers.
target_link_libraries(test_motion PRIVATE surefoot::room_io)
