# What all Arm chips without an operating system share; the file of a chip sets its processor and includes this.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# CMake's trial programs have no startup code or linker script, so they end as a library.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

# No exceptions, type information, guards of statics or unwind tables: nothing that wants a run-time library.
# Functions and data in sections of their own, so that the linker drops what is not called.
string(JOIN " " CMAKE_CXX_FLAGS_INIT ${fovea_processor} -mthumb -fno-exceptions -fno-rtti -fno-threadsafe-statics
       -fno-unwind-tables -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections)
