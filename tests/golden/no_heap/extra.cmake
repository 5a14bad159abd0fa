# At another level than golden_test: the bits are the same.
target_compile_options(test_golden_no_heap PRIVATE -O1)
