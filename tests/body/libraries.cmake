# The generated biped, from which other rigs are made, and the T-stance. A steady frame must not allocate: count it.
target_link_libraries(test_body PRIVATE surefoot::room_synthetic surefoot::room_gait_text)
target_sources(test_body PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/support/allocations.cpp")
