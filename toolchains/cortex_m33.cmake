# Cortex-M33: the DSP instructions of the M4, in ARMv8-M. The float unit some have is not used.
set(fovea_chip cortex-m33)
set(fovea_processor -mcpu=cortex-m33 -mfloat-abi=soft)
set(fovea_clang_target armv8m.main-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/arm_none_eabi.cmake)
