# Cortex-M55 with Helium, its 16-byte vectors, in integers alone: +nofp leaves the integer half of Helium there.
# The ABI must be softfp (arguments in core registers, as with soft): with soft GCC 12 switches Helium off too.
set(fovea_chip cortex-m55)
set(fovea_processor -mcpu=cortex-m55+nofp -mfloat-abi=softfp)
set(fovea_clang_target armv8.1m.main-none-eabi)
# Clang 14 computes wrong addresses in gathers that it makes itself: the golden vector of polygons told.
set(fovea_clang_options -mllvm -enable-arm-maskedgatscat=false)
include(${CMAKE_CURRENT_LIST_DIR}/arm_none_eabi.cmake)
