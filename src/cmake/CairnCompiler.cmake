# Flags that every target of the project is compiled with.

# ccache caches objects with a precompiled header only if this option allows it.
foreach(language IN ITEMS C CXX)
  if(CMAKE_${language}_COMPILER_LAUNCHER MATCHES "ccache$")
    set(CMAKE_${language}_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
        ${CMAKE_${language}_COMPILER_LAUNCHER})
  endif()
endforeach()
set(CMAKE_C_STANDARD 99)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_compile_options(-Wall -Wextra -Wshadow $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>)
# GCC's vectors wider than the target's registers are never part of an ABI here.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-psabi>)
if(CAIRN_DEVELOPER)
  add_compile_options(-Werror)
endif()
if(CAIRN_SANITIZE)
  add_compile_options(-fsanitize=${CAIRN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # The checks for null, alignment and object size stand at every access to memory. In Eigen's inline functions they are
  # two thirds of what both sanitizers cost the compiler. The address sanitizer finds most of what they find: a read or
  # write through a null pointer or beyond an object. The C sources, which compile quickly, keep them.
  if(NOT CAIRN_SANITIZE_ACCESSES)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fno-sanitize=null,alignment,object-size>)
  endif()
  add_link_options(-fsanitize=${CAIRN_SANITIZE})
endif()
