# Eigen takes longer to compile than all that is compared with it: once.
target_sources(test_core_linear PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/support/eigen_oracle.cpp)
