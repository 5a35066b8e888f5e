# 64-bit ARM Linux with Debian's g++-aarch64-linux-gnu; tests run under qemu-user.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CAIRN_TRIPLET aarch64-linux-gnu)
set(CAIRN_QEMU qemu-aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/debian-linux-gnu.cmake)
