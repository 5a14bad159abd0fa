# 32-bit Arm boards with Linux (Debian armhf): no NEON is promised there, but the DSP instructions are.
# Where a board has NEON, add -DCMAKE_CXX_FLAGS=-mfpu=neon.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(CMAKE_CXX_COMPILER arm-linux-gnueabihf-g++)
