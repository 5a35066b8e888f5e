# What the toolchain files for Debian's Linux cross compilers share. The file that includes this one sets CAIRN_TRIPLET
# (aarch64-linux-gnu), CAIRN_QEMU (qemu-aarch64) and CMAKE_SYSTEM_PROCESSOR. Packages: g++-TRIPLET, and qemu-user for
# the tests. With -DCAIRN_CROSS_CLANG=ON clang compiles, with the headers and libraries of the same packages.
set(CMAKE_SYSTEM_NAME Linux)
if(CAIRN_CROSS_CLANG)
  set(CMAKE_C_COMPILER clang)
  set(CMAKE_CXX_COMPILER clang++)
  set(CMAKE_C_COMPILER_TARGET ${CAIRN_TRIPLET})
  set(CMAKE_CXX_COMPILER_TARGET ${CAIRN_TRIPLET})
else()
  set(CMAKE_C_COMPILER ${CAIRN_TRIPLET}-gcc)
  set(CMAKE_CXX_COMPILER ${CAIRN_TRIPLET}-g++)
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CAIRN_CROSS_CLANG)

# Libraries come from the target's folders. Headers without a library (Eigen, nanoflann, doctest) are the same for all
# machines: they come from there or from /usr.
list(PREPEND CMAKE_FIND_ROOT_PATH /usr/${CAIRN_TRIPLET})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_LIBRARY_ARCHITECTURE ${CAIRN_TRIPLET})
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/${CAIRN_TRIPLET}/pkgconfig)

set(CMAKE_CROSSCOMPILING_EMULATOR ${CAIRN_QEMU} -L /usr/${CAIRN_TRIPLET})
