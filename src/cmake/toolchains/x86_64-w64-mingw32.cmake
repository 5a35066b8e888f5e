# 64-bit Windows with Debian's g++-mingw-w64-x86-64-posix. The compiler of the other thread model (win32) has no
# std::thread.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(triplet x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${triplet}-gcc-posix)
set(CMAKE_CXX_COMPILER ${triplet}-g++-posix)
set(CMAKE_RC_COMPILER ${triplet}-windres)

# Headers of the build machine in /usr/include are not for this target. Packages of headers (Eigen, nanoflann, doctest)
# must be found elsewhere: pass -DCMAKE_FIND_ROOT_PATH=FOLDER with a copy of them.
list(PREPEND CMAKE_FIND_ROOT_PATH /usr/${triplet})
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(ENV{PKG_CONFIG_LIBDIR} /usr/${triplet}/lib/pkgconfig)

# The compiler's own libraries go into each DLL and program, which then needs only what Windows has.
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT -static)
endforeach()

find_program(CAIRN_WINE NAMES wine64 wine)
if(CAIRN_WINE)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${CAIRN_WINE})
endif()
