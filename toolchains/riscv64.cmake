# 64-bit RISC-V boards with Linux (Debian riscv64, rv64gc): plain 32-bit words, no vectors.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR riscv64)
set(CMAKE_CXX_COMPILER riscv64-linux-gnu-g++)
