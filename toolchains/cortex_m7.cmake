# Cortex-M7: as the M4, but two instructions a cycle. The float unit some have is not used.
set(fovea_chip cortex-m7)
set(fovea_processor -mcpu=cortex-m7 -mfloat-abi=soft)
set(fovea_clang_target armv7em-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/arm_none_eabi.cmake)
