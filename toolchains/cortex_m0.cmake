# Cortex-M0 and M0+: plain 32-bit words, no division instruction, no float unit.
set(fovea_chip cortex-m0)
set(fovea_processor -mcpu=cortex-m0 -mfloat-abi=soft)
set(fovea_clang_target armv6m-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/arm_none_eabi.cmake)
