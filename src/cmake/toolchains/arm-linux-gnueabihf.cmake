# 32-bit ARM Linux with a floating-point unit, with Debian's g++-arm-linux-gnueabihf; tests run under qemu-user.
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CAIRN_TRIPLET arm-linux-gnueabihf)
set(CAIRN_QEMU qemu-arm)
include(${CMAKE_CURRENT_LIST_DIR}/debian-linux-gnu.cmake)
