# Real clips come through the readers, made ones from the generator.
target_link_libraries(test_pack PRIVATE surefoot::room_io surefoot::room_synthetic)
