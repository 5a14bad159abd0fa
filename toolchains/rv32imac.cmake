# 32-bit RISC-V chips: plain words, multiplication and division. Debian's compiler comes without headers of C++; those of
# the Arm compiler are the same. By the older name of the instruction set GCC 12 finds its 32-bit arithmetic library.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR rv32imac)
set(CMAKE_CXX_COMPILER riscv64-unknown-elf-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

execute_process(COMMAND arm-none-eabi-gcc -dumpversion OUTPUT_VARIABLE fovea_gcc OUTPUT_STRIP_TRAILING_WHITESPACE)
set(fovea_headers /usr/include/newlib/c++/${fovea_gcc})
string(JOIN " " CMAKE_CXX_FLAGS_INIT -march=rv32imac -mabi=ilp32 -misa-spec=2.2 -mcmodel=medany -ffreestanding
       -nostdinc++ -isystem ${fovea_headers} -isystem ${fovea_headers}/arm-none-eabi -isystem /usr/include/newlib
       -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-unwind-tables -fno-asynchronous-unwind-tables
       -ffunction-sections -fdata-sections)
