# Prints the table of golden vectors: golden_table > tests/golden/golden.txt when bits have changed on purpose.
add_executable(golden_table golden/table.cpp)
target_include_directories(golden_table PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(golden_table PRIVATE fovea_core fovea_warnings)
target_compile_options(golden_table PRIVATE -O0)
