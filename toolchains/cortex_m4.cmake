# Cortex-M4: the DSP instructions, four pixels a word. The float unit some have is not used.
set(fovea_chip cortex-m4)
set(fovea_processor -mcpu=cortex-m4 -mfloat-abi=soft)
set(fovea_clang_target armv7em-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/arm_none_eabi.cmake)
