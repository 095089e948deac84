# Many rigs are made from the generated biped.
target_link_libraries(test_ik PRIVATE surefoot::room_synthetic)
