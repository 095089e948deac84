# Real clips come through the readers.
target_link_libraries(test_pack PRIVATE surefoot::room_io)
