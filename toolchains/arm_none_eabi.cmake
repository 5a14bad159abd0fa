# What all Arm chips without an operating system share; the file of a chip names its processor and includes this.
# The compiler is GCC, or with FOVEA_CHIP_COMPILER=clang Clang, which links by GCC and has its headers of C++.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR ${fovea_chip})
# CMake's trial programs have no startup code or linker script, so they end as a library.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FOVEA_CHIP_COMPILER)

set(fovea_compiler "")
if("${FOVEA_CHIP_COMPILER}" STREQUAL "clang")
  set(CMAKE_CXX_COMPILER clang++)
  # All but the M0 load words at any address; GCC does so without being told.
  if(NOT fovea_chip STREQUAL "cortex-m0")
    list(APPEND fovea_clang_options -munaligned-access)
  endif()
  execute_process(COMMAND arm-none-eabi-gcc -dumpversion OUTPUT_VARIABLE fovea_gcc OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(fovea_headers /usr/include/newlib/c++/${fovea_gcc})
  set(fovea_compiler --target=${fovea_clang_target} ${fovea_clang_options} -nostdinc++ -isystem ${fovea_headers}
      -isystem ${fovea_headers}/arm-none-eabi -isystem /usr/include/newlib)
  string(JOIN " " CMAKE_CXX_LINK_EXECUTABLE arm-none-eabi-g++ ${fovea_processor}
         "-mthumb <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>")
else()
  set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
endif()

# No exceptions, type information, guards of statics or unwind tables: nothing that wants a run-time library.
# Functions and data in sections of their own, so that the linker drops what is not called.
string(JOIN " " CMAKE_CXX_FLAGS_INIT ${fovea_compiler} ${fovea_processor} -mthumb -fno-exceptions -fno-rtti
       -fno-threadsafe-statics -fno-unwind-tables -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections)
