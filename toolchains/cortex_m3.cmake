# Cortex-M3: plain 32-bit words, division in hardware.
set(fovea_chip cortex-m3)
set(fovea_processor -mcpu=cortex-m3 -mfloat-abi=soft)
set(fovea_clang_target armv7m-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/arm_none_eabi.cmake)
