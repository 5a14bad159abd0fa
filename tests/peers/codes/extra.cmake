# Built where one of them is, see ../../CMakeLists.txt.
target_link_libraries(test_peers_codes PRIVATE fovea_app_headers foreign_readers)
