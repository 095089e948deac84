#The generated default set : clips to author that need no file.
target_link_libraries(test_author PRIVATE surefoot::room_synthetic)
