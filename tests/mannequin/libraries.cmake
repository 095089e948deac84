# Templates give bodies of all proportions.
target_link_libraries(test_mannequin PRIVATE surefoot::room_rig_text)
