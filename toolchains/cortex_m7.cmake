# Cortex-M7: as the M4, but two instructions a cycle. The float unit some have is not used.
set(fovea_processor -mcpu=cortex-m7 -mfloat-abi=soft)
include(${CMAKE_CURRENT_LIST_DIR}/arm_none_eabi.cmake)
