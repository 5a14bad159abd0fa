# Built where OpenCV is, see ../CMakeLists.txt.
target_include_directories(test_peers SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(test_peers PRIVATE ${OpenCV_LIBS})
